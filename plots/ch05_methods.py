"""Chapter 5's picture of three methods on the same scenes: from contact to contact, with an envelope, and by Moreau's and
Jean's time stepping.

Reads RUN_DIR/histories.csv and RUN_DIR/ball.csv of ch05_study --part methods.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, ORANGE, Table, plot_main

METHODS = [("events", "from contact to contact", ORANGE, "o", "--"), ("envelope", "with an envelope", BLUE, "D", "-"),
           ("moreau", "Moreau and Jean", GREEN, "s", "-")]


def history(axes: plt.Axes, table: Table, scene: str, method: str, column: str) -> tuple[np.ndarray, np.ndarray]:
    rows = (np.array(table.text("scene")) == scene) & (np.array(table.text("method")) == method)
    return table["t"][rows], table[column][rows]


def draw(run: Path) -> plt.Figure:
    histories, work = Table(run / "histories.csv"), Table(run / "ball.csv")
    figure, ((ball, gap), (lost, cost)) = plt.subplots(2, 2, figsize=(10.2, 6.4))
    for method, label, colour, mark, line in METHODS:
        t, top = history(ball, histories, "ball", method, "top")
        ball.plot(t, 1000 * (top - 0.5), line, color=colour, label=label)
        t, gaps = history(gap, histories, "landing", method, "gap")
        gap.plot(t, 1000 * gaps, line, color=colour)
        t, seconds = history(lost, histories, "landing", method, "lost")
        lost.plot(t, seconds, line, color=colour)
        rows = np.flatnonzero([m == method for m in work.text("method")])
        cost.loglog(work["second_ns"][rows] / 1000, work["height_error"][rows], mark + line, color=colour, ms=4)
    for axes in (ball, gap, lost):  # the dashed line over the others
        axes.lines[0].set_zorder(3)
    ball.set(title="A ball's last bounces", ylabel="height [mm]", xlim=(0.9, 1.9), ylim=(-5, 75))
    ball.legend(loc="upper right")
    gap.set(title="Ten boxes land on each other", ylabel="smallest gap [mm]", xlim=(0, 0.6))
    lost.set(title="… and the time that they lose", ylabel="time lost [s]")
    for axes in (ball, gap, lost):
        axes.set_xlabel("t [s]")
    cost.set(title="The ball, frames from 1/15 to 1/1920 s", xlabel="µs for a simulated second", ylabel="worst error of its height [m]")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch05_methods", __doc__)
