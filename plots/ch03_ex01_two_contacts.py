"""Exercise 3.1: the plane of b for five matrices, coloured by which contacts push.

Reads RUN_DIR/cones.csv, which the target ch03_ex01_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREY, ORANGE, RED, SKY, Table, plot_main

# The name in the table: its colour, and its size where several answers lie upon each other, so that all are seen.
KINDS = {"nobody": (GREY, 4.0), "1": (SKY, 4.0), "2": (ORANGE, 1.9), "both": (BLUE, 1.0)}
ALONE = 4.0
NONE = {"facecolor": "white", "edgecolor": RED, "hatch": "////", "linewidth": 0}


def draw(run: Path) -> plt.Figure:
    table = Table(run / "cones.csv")
    matrix, pushing = table.text("matrix"), table.text("pushing")
    b, answers = table.vectors("b 1", "b 2"), table["answers"]
    names = list(dict.fromkeys(matrix))
    figure, axes = plt.subplots(1, len(names), figsize=(2.4 * len(names), 3.3), sharey=True)
    for panel, name in zip(axes, names):
        none = np.array([m == name and p == "no answer" for m, p in zip(matrix, pushing)])
        if none.any():  # hatched, and then covered where a contact pushes
            (x0, y0), (x1, y1) = b[none].min(axis=0), b[none].max(axis=0)
            panel.add_patch(plt.Rectangle((x0, y0), x1 - x0, y1 - y0, zorder=0, **NONE))
        for kind, (colour, size) in KINDS.items():
            rows = np.array([m == name and p == kind for m, p in zip(matrix, pushing)])
            for some, ms in ((rows & (answers <= 1), ALONE), (rows & (answers > 1), size)):
                panel.plot(*b[some].T, "s", ms=ms, mew=0, color=colour)
        panel.axhline(0, color="black", lw=0.6)
        panel.axvline(0, color="black", lw=0.6)
        panel.set(xlabel="$b_1$ [m/s]", aspect="equal")
        panel.set_title(name, fontsize=8.5)
        panel.grid(False)
    axes[0].set_ylabel("$b_2$ [m/s]")
    marks = [plt.Line2D([], [], ls="", marker="s", color=colour) for colour, _ in KINDS.values()]
    figure.legend([*marks, plt.Rectangle((0, 0), 1, 1, **NONE)], [*(f"pushing: {k}" for k in KINDS), "no answer"],
                  loc="lower center", ncol=len(KINDS) + 1, bbox_to_anchor=(0.5, -0.01))
    figure.set_constrained_layout_pads(rect=(0, 0.08, 1, 0.92))
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch03_ex01_two_contacts", __doc__)
