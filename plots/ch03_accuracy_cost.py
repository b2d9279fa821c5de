"""Chapter 3's picture of what accuracy costs: the residual against time, and against operations.

Reads RUN_DIR/accuracy.csv of ch03_study --part accuracy. Medians of the problems of one family with 96 rows.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from ch03_methods import FAMILIES, METHODS, RESIDUAL_TICKS, at_least, break_before_zero
from style import GREY, Table, plot_main

ROWS = 96
SHOWN = ["random_spd", "box_heap", "stack", "stack_1e8"]


def curves(axes: plt.Axes, table: Table, family: str, cost: np.ndarray) -> None:
    """Pivoting methods are one mark; the others have a mark for each limit, from left to right."""
    names, families = np.array(table.text("method")), np.array(table.text("family"))
    for method, (label, colour, mark) in METHODS.items():
        rows = (names == method) & (families == family) & (table["rows"] == ROWS)
        single = rows.sum() == 1
        axes.plot(cost[rows], at_least(table["residual"][rows]), mark if single else f"{mark}-", ms=8 if single else 3.5, lw=1.3,
                  color=colour, label=label, zorder=3 if single else 2)
    axes.axhline(2.2e-16, color=GREY, lw=0.8, ls=":")
    axes.set(xscale="log", yscale="log", ylim=(3e-18, 2))
    axes.set_yticks(*RESIDUAL_TICKS)
    break_before_zero("y", axes)


def draw(run: Path) -> plt.Figure:
    table = Table(run / "accuracy.csv")
    figure, panels = plt.subplots(2, len(SHOWN), figsize=(11.5, 6), sharey=True, sharex="row")
    for column, family in enumerate(SHOWN):
        curves(panels[0][column], table, family, table["median_ns"] / 1000)
        curves(panels[1][column], table, family, table["products"])
        panels[0][column].set(title=FAMILIES[family], xlabel="time [µs], on this machine")
        panels[1][column].set(xlabel="operations / $2n^2$")
    for row in panels:
        row[0].set(ylabel="residual")
    panels[0][-1].text(1.01, 2.2e-16, "round-\noff", transform=panels[0][-1].get_yaxis_transform(), va="center", fontsize=7.5, color=GREY)
    handles, labels = panels[0][0].get_legend_handles_labels()
    figure.get_layout_engine().set(rect=(0, 0.055, 1, 0.945))
    figure.legend(handles, labels, loc="lower center", ncols=len(labels))
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch03_accuracy_cost", __doc__)
