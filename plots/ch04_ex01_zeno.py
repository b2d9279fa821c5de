"""Exercise 4.1: a bouncing ball, in closed form and by the chapter's engine.

Reads RUN_DIR/zeno.csv, which the target ch04_ex01_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREY, ORANGE, RED, Table, plot_main


def draw(run: Path) -> plt.Figure:
    table = Table(run / "zeno.csv")
    t, bounces = table["t"], table["bounces"]
    figure, (height, count) = plt.subplots(1, 2, figsize=(8.4, 3.4))
    height.plot(t, table["height"], color=BLUE, label="closed form")
    height.plot(t, table["engine height"], color=ORANGE, ls="--", label="the engine")
    height.set(title="Height", xlabel="t [s]", ylabel="height [m]")
    moving = bounces >= 0
    count.step(t[moving], bounces[moving], where="post", color=BLUE, label="bounces, closed form")
    if (~moving).any():
        count.axvline(t[~moving][0], color=GREY, ls=":", label="infinitely many")
    count.step(t, table["engine impacts"], where="post", color=ORANGE, ls="--", label="impacts, the engine")
    lost = count.twinx()
    lost.plot(t, table["lost time"], color=RED, lw=1)
    lost.set_ylabel("lost time [s]", color=RED)
    lost.grid(False)
    count.set(title="Bounces", xlabel="t [s]", ylim=(0, 1.3 * np.max(table["engine impacts"])))
    for axes in (height, count):
        axes.legend(loc="upper right" if axes is height else "upper left")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch04_ex01_zeno", __doc__)
