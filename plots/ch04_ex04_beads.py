"""Exercise 4.4: the world lines of beads on a wire.

Reads RUN_DIR/beads.csv, which the target ch04_ex04_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREEN, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    table = Table(run / "beads.csv")
    figure, axes = plt.subplots(figsize=(6.4, 4))
    labels = {1: "1 kg", 4: "4 kg", 8: "8 kg"}
    for bead in sorted(set(table["bead"])):
        rows = table["bead"] == bead
        mass = int(table["mass"][rows][0])
        colour = {1: BLUE, 4: ORANGE, 8: GREEN}[mass]
        axes.plot(table["place"][rows], table["t"][rows], color=colour, lw=0.7 + 0.25 * mass, label=labels.pop(mass, None))
    axes.set(title="Beads on a wire: who is where, and when", xlabel="place [m]", ylabel="t [s]")
    axes.legend(loc="lower left")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch04_ex04_beads", __doc__)
