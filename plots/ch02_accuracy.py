"""Chapter 2's picture of what accuracy costs: error and operations against the tolerance, and against the margin by which
bodies meet or miss.

Reads RUN_DIR/tolerance.csv and RUN_DIR/approach.csv of ch02_study.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, ORANGE, Table, plot_main

SEARCHES = {"FAST's": ("FAST's", ORANGE), "boxes in lanes": ("ours, boxes in lanes", BLUE), "hulls": ("ours, hulls", GREEN)}


def draw(run: Path) -> plt.Figure:
    tolerance, approach = Table(run / "tolerance.csv"), Table(run / "approach.csv")
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(9.2, 3.9))
    for column, label, line in (("early_p95", "95 %", "s--"), ("early", "median", "o-")):
        left.loglog(tolerance["tolerance"], tolerance[column], line, ms=4, color=BLUE, label=label)
    left.set(title="Error", ylabel="time of contact too early by [s]")
    for column, label, colour in (("node_pairs", "pairs of nodes", BLUE), ("leaf_pairs", "pairs of leaves", ORANGE)):
        middle.semilogx(tolerance["tolerance"], tolerance[column], "o-", ms=4, color=colour, label=label)
    middle.set(title="Operations", ylabel="per query, median", yscale="log")
    searches, answers = (np.array(approach.text(c)) for c in ("search", "answer"))
    for search, (label, colour) in SEARCHES.items():
        for answer, line in (("miss", "o-"), ("hit", "s--")):
            rows = (searches == search) & (answers == answer)
            right.loglog(approach["margin"][rows], (approach["node_pairs"] + approach["leaf_pairs"])[rows], line, ms=4,
                         color=colour, label=f"{label}, {answer}")
    right.set(title="Grazing", xlabel="margin / size of the model", ylabel="pairs per query, median")
    for axes in (left, middle):
        axes.set_xlabel("tolerance / size of the model")
    for axes in (left, middle, right):
        axes.invert_xaxis()
        axes.legend(fontsize=8, ncols=1)
    right.set_ylim(3, None)
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch02_accuracy", __doc__)
