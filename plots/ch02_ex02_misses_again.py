"""Exercise 2.2: the gap of two bodies, that of their tips, and where your steps began.

Reads RUN_DIR/miss.csv, which the target ch02_ex02_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREY, ORANGE, Table, plot_main

LINES = {"gap of the bodies": ("-", ORANGE), "gap of the tips": ("-", GREY), "where you looked": ("o", BLUE)}


def draw(run: Path) -> plt.Figure:
    table = Table(run / "miss.csv")
    what, t, gap = table.text("what"), table["t"], table["gap"]
    figure, axes = plt.subplots(figsize=(6.2, 3.4))
    for name, (line, colour) in LINES.items():
        rows = [i for i, kind in enumerate(what) if kind == name]
        axes.plot(t[rows], gap[rows], line, ms=4, color=colour, label=name)
    axes.set(title="An arm swings round to a post", xlabel="time [s]", ylabel="gap [m]")
    axes.legend()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch02_ex02_misses_again", __doc__)
