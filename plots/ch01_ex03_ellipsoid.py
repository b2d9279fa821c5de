"""Exercise 1.3: the advances with your bound beside those with the longest half axis as reach.

Reads RUN_DIR/ellipsoid.csv, which the target ch01_ex03_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, ORANGE, Table, plot_main

COLOURS = {"longest half axis": ORANGE, "yours": BLUE}


def draw(run: Path) -> plt.Figure:
    table = Table(run / "ellipsoid.csv")
    whose, advance, gap = table.text("bound"), table["advance"], table["gap"]
    figure, axes = plt.subplots(figsize=(6.2, 3.4))
    for name, colour in COLOURS.items():
        rows = [i for i, owner in enumerate(whose) if owner == name and gap[i] > 0]
        axes.semilogy(advance[rows], gap[rows], "o-", ms=3.5, color=colour, label=name)
    axes.set(title="A spindle falls to the floor", xlabel="advance", ylabel="gap [m]")
    axes.legend(title="motion bound")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch01_ex03_ellipsoid", __doc__)
