"""Exercise 2.1: the advances with your speed and your step beside those with the radius in the bound.

Reads RUN_DIR/capsule.csv, which the target ch02_ex01_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREEN, ORANGE, Table, plot_main

COLOURS = {"with the radius": ORANGE, "your speed": GREEN, "your step": BLUE}


def draw(run: Path) -> plt.Figure:
    table = Table(run / "capsule.csv")
    whose, advance, gap = table.text("step"), table["advance"], table["gap"]
    figure, axes = plt.subplots(figsize=(6.2, 3.4))
    for name, colour in COLOURS.items():
        rows = [i for i, owner in enumerate(whose) if owner == name and gap[i] > 0]
        axes.loglog(advance[rows] + 1, gap[rows], "o-", ms=3.5, color=colour, label=name)
    axes.set(title="A fat capsule tumbles towards a post", xlabel="look (the first is 1)", ylabel="gap [m]")
    axes.legend(title="step")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch02_ex01_capsule", __doc__)
