"""Exercise 5.3: the largest island of cubes that touch with a given chance, and what it would be if the floor joined.

Reads RUN_DIR/islands.csv, which the target ch05_ex03_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    table = Table(run / "islands.csv")
    scene = np.array(table.text("scene"))
    figure, panels = plt.subplots(1, 2, figsize=(8.4, 3.4), sharey=True)
    for axes, (name, title) in zip(panels, {"lying": "6,400 cubes on a floor", "wall": "A wall, 80 by 80"}.items()):
        rows = scene == name
        chance, contacts = table["chance"][rows], table["contacts"][rows]
        axes.plot(chance, table["largest"][rows] / contacts, color=BLUE, label="fixed bodies do not join")
        axes.plot(chance, table["largest if floors join"][rows] / contacts, color=ORANGE, ls="--", label="they do")
        axes.set(title=title, xlabel="chance that neighbours touch", ylim=(0, 1.05))
    panels[0].set_ylabel("rows in the largest island, of all")
    panels[1].legend(loc="lower right")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch05_ex03_islands", __doc__)
