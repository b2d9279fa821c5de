"""Chapter 3's performance profiles: the share of problems that a method solves within a factor of the best method's cost.

Reads RUN_DIR/profiles.csv of ch03_study --part profiles (Dolan and More 2002).
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from ch03_methods import METHODS
from style import Table, plot_main

FARTHEST = 1000  # the largest factor that is drawn


def profiles(axes: plt.Axes, table: Table, cost: np.ndarray) -> None:
    problems = list(zip(table.text("family"), table.text("rows"), table.text("seed")))
    methods = np.array(table.text("method"))
    good = table["good"] > 0
    cost = np.maximum(cost, cost[cost > 0].min())  # 0 pivots: there was nothing to do
    best: dict[tuple, float] = {}
    for problem, value, solved in zip(problems, cost, good):
        if solved:
            best[problem] = min(best.get(problem, np.inf), value)
    count = len(set(problems))
    for method, (label, colour, _) in METHODS.items():
        rows = np.flatnonzero((methods == method) & good)
        if not (methods == method).any():
            continue
        ratios = np.sort([cost[i] / best[problems[i]] for i in rows])
        share = np.arange(1, len(ratios) + 1) / count
        axes.step(np.concatenate([[1], ratios, [FARTHEST]]), 100 * np.concatenate([[np.sum(ratios <= 1) / count], share, share[-1:]]),
                  where="post", color=colour, label=f"{label}: {100 * len(rows) / count:.1f} % in the end")
    axes.set(xscale="log", xlim=(1, FARTHEST), ylim=(0, 103))
    axes.legend(loc="lower right")


def draw(run: Path) -> plt.Figure:
    table = Table(run / "profiles.csv")
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.9), sharey=True)
    profiles(left, table, table["median_ns"])
    profiles(right, table, table["products"])
    left.set(title="By time, on this machine", xlabel="time / time of the best method", ylabel="problems solved [%]")
    right.set(title="By operations", xlabel="operations / operations of the best method")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch03_profiles", __doc__)
