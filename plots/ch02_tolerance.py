"""Chapter 2's picture: what a smaller tolerance costs, and how many features it leaves in contact.

Reads RUN_DIR/sweep.csv of a sweep over ccd.tolerance; the chapter's text has the command that writes it.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREEN, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    sweep = Table(run / "sweep.csv")
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.1))
    left.semilogx(sweep["ccd.tolerance"], sweep["pairs of nodes"], "o-", ms=4, color=BLUE, label="pairs of nodes")
    left.semilogx(sweep["ccd.tolerance"], sweep["advances"], "o-", ms=4, color=ORANGE, label="advances")
    left.set(title="Digits cost next to nothing", ylabel="operations per query", ylim=(0, None))
    left.legend()
    right.loglog(sweep["ccd.tolerance"], sweep["features"], "o-", ms=4, color=GREEN)
    right.set(title="A loose tolerance touches everywhere", ylabel="contact features")
    for axes in (left, right):
        axes.set_xlabel("tolerance [m]")
        axes.invert_xaxis()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch02_tolerance", __doc__)
