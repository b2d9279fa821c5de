"""Chapter 3's picture of what a fixed time buys: the residual that each method has reached after 0.1, 1 and 10 ms.

Reads RUN_DIR/budget.csv of ch03_study --part accuracy. Medians of the problems of one family and size.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from ch03_methods import FAMILIES, METHODS, RESIDUAL_TICKS, at_least, break_before_zero
from style import GREY, Table, plot_main

BUDGETS = {"residual_in_100000_ns": "within 0.1 ms", "residual_in_1000000_ns": "within 1 ms", "residual_in_10000000_ns": "within 10 ms"}
SIZES = [96, 256]


def panel(axes: plt.Axes, table: Table, rows: int, column: str) -> None:
    """Each method's residual by family; a small cross at the right where it has nothing yet: that is the residual of z = 0."""
    names, families = np.array(table.text("method")), np.array(table.text("family"))
    for k, (method, (label, colour, mark)) in enumerate(METHODS.items()):
        for y, family in enumerate(FAMILIES):
            at = np.flatnonzero((names == method) & (families == family) & (table["rows"] == rows))
            if not len(at):
                continue
            reached = table[column][at[0]]
            begun = reached < table["residual_at_0"][at[0]]
            axes.plot(at_least(reached), y + 0.17 * (k - 1.5), mark if begun else "x", ms=5.5 if begun else 4, color=colour, clip_on=False)
    axes.axvline(2.2e-16, color=GREY, lw=0.8, ls=":")
    for y in range(1, len(FAMILIES)):
        axes.axhline(y - 0.5, color="#E6E6E6", lw=0.7)
    axes.set_yticks(range(len(FAMILIES)), FAMILIES.values(), fontsize=8)
    axes.set(xscale="log", xlim=(3e-18, 3), ylim=(len(FAMILIES) - 0.5, -0.5))
    axes.set_xticks(*RESIDUAL_TICKS)
    axes.grid(False, axis="y")
    break_before_zero("x", axes)


def draw(run: Path) -> plt.Figure:
    table = Table(run / "budget.csv")
    figure, panels = plt.subplots(len(SIZES), 3, figsize=(11.5, 6.6), sharex=True, sharey=True)
    for row, rows in zip(panels, SIZES):
        for axes, (column, title) in zip(row, BUDGETS.items()):
            panel(axes, table, rows, column)
            axes.set_title(f"{rows} rows, {title}")
    for axes in panels[-1]:
        axes.set_xlabel("residual reached")
    present = set(table.text("method"))
    marks = [plt.Line2D([], [], ls="", marker=mark, color=colour, label=label) for m, (label, colour, mark) in METHODS.items() if m in present]
    marks.append(plt.Line2D([], [], ls="", marker="x", ms=4, color=GREY, label="nothing yet: z = 0"))
    figure.get_layout_engine().set(rect=(0, 0.05, 1, 0.95))
    figure.legend(handles=marks, loc="lower center", ncols=len(marks))
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch03_budget", __doc__)
