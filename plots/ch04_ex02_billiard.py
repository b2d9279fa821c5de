"""Exercise 4.2: billiards in an ellipse, and the curves that their chords touch.

Reads RUN_DIR/billiard.csv, which the target ch04_ex02_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREY, ORANGE, Table, plot_main

HALF_AXES = np.array([2, 1.3])  # m, as in the demo


def draw(run: Path) -> plt.Figure:
    table = Table(run / "billiard.csv")
    figure, panels = plt.subplots(1, 2, figsize=(8.6, 3.2))
    phi = np.linspace(0, 2 * np.pi, 400)
    foci = np.sqrt(HALF_AXES[0] ** 2 - HALF_AXES[1] ** 2)
    for axes, start, colour, title in zip(panels, sorted(set(table["start"])), (BLUE, ORANGE),
                                          ("Between the foci: they touch a hyperbola", "Around the foci: an ellipse")):
        rows = table["start"] == start
        axes.plot(table["x"][rows], table["y"][rows], color=colour, lw=0.5)
        axes.plot(HALF_AXES[0] * np.cos(phi), HALF_AXES[1] * np.sin(phi), color=GREY)
        axes.plot([-foci, foci], [0, 0], "k.", ms=5)
        axes.set_aspect("equal")
        axes.set_axis_off()
        axes.set_title(title)
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch04_ex02_billiard", __doc__)
