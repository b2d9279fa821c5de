"""Chapter 2's picture of what each idea of the search gains, in pairs of nodes that a query looks at.

Reads RUN_DIR/ideas.csv of ch02_study --part ideas.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, ORANGE, Table, plot_main

FAMILIES = {"far": ("from afar", BLUE), "close": ("from close by", ORANGE)}
LADDER = {  # as the table names them: what the figure says
    "one step for all": "one step for all pairs, boxes",
    "directional bound": "+ directional bound",
    "second-order bound": "+ second-order bound",
    "own time per pair": "+ each pair has its own time",
    "best first": "+ best first",
    "points' own velocities": "+ points' own velocities",
    "hulls": "+ hulls instead of boxes",
    "pieces": "+ pieces instead of triangles",
    "hulls of 64 points": "hulls of 64 points at most:\nmore pairs, a third of the time",
}
OTHERS = {
    "C2A's": "C2A's: controlled steps,\nswept spheres",
    "C2A's on boxes": "C2A's on boxes",
    "FAST's": "FAST's: one step for all\npairs, hulls of pieces",
    "ours with the naive bound": "best first on hulls,\nnaive bound",
    "ours with the directional bound": "best first on hulls,\ndirectional bound",
    "spheres": "best first on spheres",
    "swept spheres": "best first on swept spheres",
    "four in lanes": "best first on boxes,\nfour in lanes",
}


def bars(axes: plt.Axes, table: Table, rows: dict[str, str], title: str) -> None:
    """For each idea the median as a bar, and the 95 % quantile of the queries as a line."""
    families, ideas = table.text("motions"), table.text("idea")
    median = table["node_pairs"] + table["leaf_pairs"]
    high = table["node_pairs_p95"] + table["leaf_pairs_p95"]
    for k, (family, (label, colour)) in enumerate(FAMILIES.items()):
        places = [next(i for i, (f, d) in enumerate(zip(families, ideas)) if f == family and d == idea) for idea in rows]
        y = np.arange(len(rows)) + 0.36 * (k - 0.5)
        axes.barh(y, median[places], 0.34, color=colour, label=label)
        axes.hlines(y, median[places], high[places], color=colour, lw=1)
        for at, i in zip(y, places):
            axes.text(median[i] * 0.93, at, f"{int(median[i]):,}", va="center", ha="right", fontsize=8, color="white" if colour == BLUE else "black")
    axes.set_yticks(range(len(rows)), rows.values(), fontsize=9)
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    axes.set(xscale="log", title=title, xlabel="pairs of nodes and leaves per query")


def draw(run: Path, rows: dict[str, str], title: str) -> plt.Figure:
    figure, axes = plt.subplots(figsize=(9.2, 0.9 + 0.42 * len(rows)))
    bars(axes, Table(run / "ideas.csv"), rows, title)
    axes.set_xlim(10, 2e6)
    axes.legend(title="bar: median, line: 95 %", title_fontsize=8.5, loc="lower right")
    return figure


if __name__ == "__main__":
    if "--ancestors" in sys.argv:
        sys.argv.remove("--ancestors")
        plot_main(lambda run: draw(run, OTHERS, "FAST's and C2A's searches, and best first with one idea exchanged"), "ch02_ancestors", __doc__)
    else:
        plot_main(lambda run: draw(run, LADDER, "One idea after the other"), "ch02_ideas", __doc__)
