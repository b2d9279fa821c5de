"""Exercise 1.1: the advances with your bound beside those with the naive one.

Reads RUN_DIR/door.csv, which the target ch01_ex01_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, ORANGE, Table, plot_main

COLOURS = {"naive": ORANGE, "yours": BLUE}


def draw(run: Path) -> plt.Figure:
    table = Table(run / "door.csv")
    whose, advance, gap = table.text("bound"), table["advance"], table["gap"]
    figure, axes = plt.subplots(figsize=(6.2, 3.4))
    for name, colour in COLOURS.items():
        rows = [i for i, owner in enumerate(whose) if owner == name and gap[i] > 0]
        axes.semilogy(advance[rows], gap[rows], "o-", ms=3.5, color=colour, label=name)
    axes.set(title="A door swings towards a ball", xlabel="advance", ylabel="certified gap [m]")
    axes.legend(title="motion bound")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch01_ex01_door", __doc__)
