"""Exercise 2.3: looks at pairs of nodes against tolerance, with your search and with two others.

Reads RUN_DIR/looks.csv, which the target ch02_ex03_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREEN, ORANGE, Table, plot_main

COLOURS = {"depth first": ORANGE, "global step": GREEN, "yours": BLUE}


def draw(run: Path) -> plt.Figure:
    table = Table(run / "looks.csv")
    whose, tolerance, looks = table.text("search"), table["tolerance"], table["looks"]
    figure, axes = plt.subplots(figsize=(6.2, 3.6))
    for name, colour in COLOURS.items():
        rows = [i for i, owner in enumerate(whose) if owner == name]
        axes.loglog(tolerance[rows], looks[rows], "o-", ms=4, color=colour, label=name)
    axes.set(title="Two bumpy balls", xlabel="tolerance [m]", ylabel="looks at pairs of nodes")
    axes.invert_xaxis()
    axes.set_ylim(100, 10000)
    axes.legend(loc="upper left", ncol=3)
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch02_ex03_own_time", __doc__)
