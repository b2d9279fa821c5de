"""Chapter 2's picture of cost against the number of triangles, with fitted powers.

Reads RUN_DIR/triangles.csv of ch02_study for the counts; the times come from such a table that was measured before (--times).
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, ORANGE, Table, plot_main

SEARCHES = {"FAST's": ("FAST's: one step for all pairs", ORANGE, "s-"), "boxes in lanes": ("ours, boxes in lanes", BLUE, "o-"),
            "hulls": ("ours, hulls of pieces", GREEN, "o-")}


def power(x: np.ndarray, y: np.ndarray) -> float:
    """k of the best y = c x^k, by least squares of the logarithms."""
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def curves(axes: plt.Axes, table: Table, values: np.ndarray, title: str, what: str) -> None:
    motions, searches = np.array(table.text("motions")), np.array(table.text("search"))
    for search, (label, colour, line) in SEARCHES.items():
        rows = (motions == "far") & (searches == search)
        x, y = table["triangles"][rows], values[rows]
        axes.loglog(x, y, line, ms=4, color=colour, label=f"{label}: power {power(x, y):.2f}")
    axes.set(title=title, xlabel="triangles of each model", ylabel=what)
    axes.legend(fontsize=8)


def draw(run: Path, times: str | None = None) -> plt.Figure:
    table = Table(run / "triangles.csv")
    figure, panels = plt.subplots(1, 2 if times else 1, figsize=(8.6 if times else 4.6, 3.4), squeeze=False)
    curves(panels[0][0], table, table["node_pairs"] + table["leaf_pairs"], "Operations", "pairs per query, median")
    if times:
        measured = Table(Path(times))
        curves(panels[0][1], measured, measured["median_ns"] / 1000, "Time, on this machine", "time per query, median [µs]")
    for axes in panels[0]:
        low, high = axes.get_ylim()
        axes.set_ylim(low, high * 3)
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch02_growth", __doc__, times={"help": "a triangles.csv whose times are drawn, too"})
