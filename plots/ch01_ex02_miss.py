"""Exercise 1.2: the rod's true gap over time, and where your advancement looked.

Reads RUN_DIR/miss.csv, which the target ch01_ex02_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREY, RED, Table, plot_main


def draw(run: Path) -> plt.Figure:
    table = Table(run / "miss.csv")
    what, t, gap = table.text("what"), table["t"], table["gap"]
    rows = {name: [i for i, kind in enumerate(what) if kind == name] for name in ("truth", "visited")}
    figure, axes = plt.subplots(figsize=(6.2, 3.4))
    axes.axhspan(min(0, gap.min()), 0, color=RED, alpha=0.12, lw=0)
    axes.plot(t[rows["truth"]], gap[rows["truth"]], color=GREY, label="true gap")
    axes.plot(t[rows["visited"]], gap[rows["visited"]], "o", ms=4, color=BLUE, label="where you looked")
    axes.set(title="A rod tumbles to the floor (red: under it)", xlabel="time [s]", ylabel="gap [m]")
    axes.legend()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch01_ex02_miss", __doc__)
