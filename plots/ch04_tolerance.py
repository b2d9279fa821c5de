"""Chapter 4's picture: how much sooner a loose tolerance stops the bodies, and what a tight one costs.

Reads RUN_DIR/sweep.csv of a sweep over ccd.tolerance; the chapter's text has the command that writes it.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREEN, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    sweep = Table(run / "sweep.csv")
    tolerance, time = sweep["ccd.tolerance"], sweep["first impact at"]
    best = tolerance.argmin()
    others = [i for i in range(len(sweep)) if i != best]
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.1))
    left.loglog(tolerance[others], (time[best] - time)[others], "o-", ms=4, color=BLUE)
    left.set(title="First impact: too early by", ylabel="seconds")
    right.semilogx(tolerance, sweep["pairs of nodes"], "o-", ms=4, color=ORANGE, label="pairs of nodes, whole run")
    right.semilogx(tolerance, sweep["contacts"], "o-", ms=4, color=GREEN, label="contacts, whole run")
    right.set(title="What it costs", ylabel="count", yscale="log", ylim=(1, 3e5))
    right.legend(loc="center right")
    for axes in (left, right):
        axes.set_xlabel("tolerance [m]")
        axes.invert_xaxis()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch04_tolerance", __doc__)
