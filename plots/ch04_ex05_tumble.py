"""Exercise 4.5: a tumbling body by steps, against the closed form.

Reads RUN_DIR/tumble.csv, which the target ch04_ex05_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREY, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    table = Table(run / "tumble.csv")
    figure, (orientation, energy) = plt.subplots(1, 2, figsize=(8.2, 3.4), sharex=True)
    h = table["step"]
    for axes, ours, plain in ((orientation, "error", "explicit error"), (energy, "energy error", "explicit energy error")):
        axes.loglog(h, np.maximum(table[ours], 1e-17), "o-", color=BLUE, ms=4, label="your step")
        axes.loglog(h, np.maximum(table[plain], 1e-17), "s-", color=ORANGE, ms=4, label="explicit Euler")
        axes.set_xlabel("step [s]")
    orientation.loglog(h, table["error"][-1] * (h / h[-1]) ** 2, ":", color=GREY, label="step squared")
    orientation.set_title("Orientation after 10 s: error")
    energy.set_title("Kinetic energy: relative change")
    orientation.legend()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch04_ex05_tumble", __doc__)
