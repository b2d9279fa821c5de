"""Exercise 1.5: advances against tolerance, with your step and with the linear one.

Reads RUN_DIR/crank.csv, which the target ch01_ex05_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, ORANGE, Table, plot_main

LOOKS = {"linear": {"color": ORANGE, "ls": "-", "lw": 4, "ms": 7, "alpha": 0.5},  # wide: seen also where yours is as good
         "yours": {"color": BLUE, "ls": "--", "lw": 1.4, "ms": 4}}
MARKS = {"hit at 30 degrees": "o", "grazing": "s"}


def draw(run: Path) -> plt.Figure:
    table = Table(run / "crank.csv")
    whose, case, tolerance, advances = table.text("step"), table.text("case"), table["tolerance"], table["advances"]
    figure, axes = plt.subplots(figsize=(6.2, 3.6))
    for step, look in LOOKS.items():
        for name, mark in MARKS.items():
            rows = [i for i in range(len(table)) if whose[i] == step and case[i] == name]
            axes.loglog(tolerance[rows], advances[rows], marker=mark, **look, label=f"{step}, {name}")
    axes.set(title="A pin under a ceiling", xlabel="tolerance [m]", ylabel="advances")
    axes.invert_xaxis()
    axes.legend(title="step")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch01_ex05_crank", __doc__)
