"""Exercise 3.1: the plane of b for five matrices, coloured by who pushes.

Reads RUN_DIR/cones.csv, which the target ch03_ex01_demo writes.
"""

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREEN, GREY, ORANGE, SKY, Table, plot_main

# The name in the table: its colour, and the shape that shows through where several answers lie upon each other.
KINDS = {"nobody": (GREY, "s", 4.0), "1": (SKY, "s", 4.0), "2": (ORANGE, "s", 2.8), "both": (BLUE, "s", 1.6),
         "no answer": ("white", "s", 1.0)}


def draw(run: Path) -> plt.Figure:
    table = Table(run / "cones.csv")
    matrix, pushing = table.text("matrix"), table.text("pushing")
    b = table.vectors("b 1", "b 2")
    names = list(dict.fromkeys(matrix))
    figure, axes = plt.subplots(1, len(names), figsize=(2.4 * len(names), 3.3), sharey=True)
    for panel, name in zip(axes, names):
        for kind, (colour, marker, size) in KINDS.items():
            rows = [i for i, (m, p) in enumerate(zip(matrix, pushing)) if m == name and p == kind]
            panel.plot(*b[rows].T, marker, ms=size, mew=0, color=colour)
        panel.axhline(0, color="black", lw=0.6)
        panel.axvline(0, color="black", lw=0.6)
        panel.set(xlabel="$b_1$ [m/s]", aspect="equal")
        panel.set_title(name, fontsize=8.5)
        panel.grid(False)
    axes[0].set_ylabel("$b_2$ [m/s]")
    marks = [plt.Line2D([], [], ls="", marker="s", color=colour, mec=GREEN if colour == "white" else colour)
             for colour, _, _ in KINDS.values()]
    figure.legend(marks, [k if k.startswith("no") else f"pushing: {k}" for k in KINDS], loc="lower center",
                  ncol=len(KINDS), bbox_to_anchor=(0.5, -0.01))
    figure.set_constrained_layout_pads(rect=(0, 0.08, 1, 0.92))
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch03_ex01_two_contacts", __doc__)
