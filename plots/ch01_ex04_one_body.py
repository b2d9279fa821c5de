"""Exercise 1.4: two bodies, their Minkowski difference, and what it sweeps over; does the origin lie in it?

Reads RUN_DIR/outline.csv, which the target ch01_ex04_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREEN, ORANGE, SKY, Table, plot_main

COLOURS = {"swept": SKY, "B - A": BLUE, "A": ORANGE, "B": GREEN}


def draw(run: Path) -> plt.Figure:
    table = Table(run / "outline.csv")
    names, x, y = table.text("set"), table["x"], table["y"]
    figure, axes = plt.subplots(figsize=(5, 5))
    for name, colour in COLOURS.items():
        rows = [i for i, owner in enumerate(names) if owner == name]
        axes.fill(x[rows], y[rows], facecolor=colour + "40", edgecolor=colour, label=name)
    axes.plot(0, 0, "k+", ms=12, mew=2, label="origin")
    axes.set(title="One body instead of two", xlabel="x [m]", ylabel="y [m]", aspect="equal")
    axes.legend()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch01_ex04_one_body", __doc__)
