"""Exercise 3.2: what gradients achieve with a number of products with A, with your momentum and without.

Reads RUN_DIR/descent.csv, which the target ch03_ex02_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, ORANGE, Table, plot_main

METHODS = {"plain": (ORANGE, "plain"), "momentum": (BLUE, "your momentum")}
LEAST = 1e-16


def draw(run: Path) -> plt.Figure:
    table = Table(run / "descent.csv")
    method, balls = np.array(table.text("method")), table["balls"]
    figure, axes = plt.subplots(figsize=(6.2, 3.6))
    for name, (color, words) in METHODS.items():
        for count, line in ((10, "o-"), (100, "s--")):
            rows = (method == name) & (balls == count)
            axes.loglog(table["products"][rows], np.maximum(table["fault"][rows], LEAST), line, ms=4, color=color, label=f"{words}, {count} balls")
    axes.set(title="A row of balls, struck at its end", xlabel="products with A", ylabel="distance from the answer [m/s]")
    axes.legend()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch03_ex02_momentum", __doc__)
