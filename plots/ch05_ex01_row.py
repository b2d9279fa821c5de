"""Exercise 5.1: gaps that come to half of the envelope, by displacements and by velocities.

Reads RUN_DIR/row.csv, which the target ch05_ex01_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREY, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    table = Table(run / "row.csv")
    way = table.text("way")
    figure, (gap, energy) = plt.subplots(1, 2, figsize=(8.4, 3.4))
    for name, colour, line in (("Baumgarte", ORANGE, "--"), ("displacements", BLUE, "-")):
        label = name
        for start in sorted({s for s, w in zip(table["start"], way) if w == name}):
            rows = [i for i, (s, w) in enumerate(zip(table["start"], way)) if w == name and s == start]
            gap.plot(table["t"][rows], 1000 * table["gap"][rows], color=colour, ls=line, lw=1.2, label=label)
            energy.plot(table["t"][rows], 1e6 * table["kinetic"][rows], color=colour, ls=line, lw=1.2, label=label)
            label = None
    gap.axhline(2.5, color=GREY, ls=":", lw=1, label="h / 2")
    gap.set(title="Gap", xlabel="t [s]", ylabel="gap [mm]")
    energy.set(title="Kinetic energy", xlabel="t [s]", ylabel="energy [µJ]", yscale="symlog", xlim=(0, 0.3))
    gap.legend(loc="upper right")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch05_ex01_row", __doc__)
