"""Chapter 2's pictures of a hierarchy of hulls, level by level, and, with --visits, of the pairs that a query looks at.

Reads RUN_DIR/hulls.csv and RUN_DIR/visits.csv of ch02_study --part pictures.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

from style import BLUE, GREEN, GREY, ORANGE, RED, Table, plot_main

FATES = {"opened": (ORANGE, "too near: opened"), "advanced": (BLUE, "proved clear for longer"), "clear": (GREY, "proved clear until the end"),
         "reached": (RED, "the contact")}
SEARCHES = {"FAST's": "One step for all pairs (FAST's)", "ours": "Each pair at its own time, best first"}


def outline(points: np.ndarray) -> np.ndarray:
    """The convex hull of points in the plane, counter-clockwise (Andrew's monotone chain)."""
    def half(ordered):
        chain: list[np.ndarray] = []
        for p in ordered:
            while len(chain) > 1 and np.cross(chain[-1] - chain[-2], p - chain[-2]) <= 0:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    ordered = points[np.lexsort((points[:, 1], points[:, 0]))]
    return np.array(half(ordered) + half(ordered[::-1]))


def draw_levels(run: Path) -> plt.Figure:
    """Seen from the front: x to the right, y up; what is nearer is drawn later and lighter."""
    table = Table(run / "hulls.csv")
    levels, nodes, points = table["level"], table["node"], table.vectors("x", "y", "z")
    shown = sorted(set(levels))
    figure, panels = plt.subplots(1, len(shown), figsize=(9.2, 2.3), sharex=True, sharey=True)
    near, far = points[:, 2].max(), points[:, 2].min()
    for axes, level in zip(panels, shown):
        hulls = [points[(levels == level) & (nodes == n)] for n in sorted(set(nodes[levels == level]))]
        hulls.sort(key=lambda hull: hull[:, 2].mean())
        shade = [(hull[:, 2].mean() - far) / (near - far) for hull in hulls]
        colours = [plt.cm.YlGnBu_r(0.15 + 0.75 * s) for s in shade]
        axes.add_collection(PolyCollection([np.round(outline(hull[:, :2]), 3) for hull in hulls], facecolors=colours,
                                           edgecolors="#333333", linewidths=0.35))
        axes.set_title(f"{len(hulls)} hull{'s' if len(hulls) > 1 else ''}")
        axes.autoscale_view()
        axes.set_aspect("equal")
        axes.axis("off")
    return figure


def draw_visits(run: Path) -> plt.Figure:
    """Over the time that is left until the contact that each search finds, on a logarithmic axis: zero is at its right end."""
    table = Table(run / "visits.csv")
    searches, fates = np.array(table.text("search")), np.array(table.text("fate"))
    left = np.zeros(len(table))
    for search in SEARCHES:
        rows = searches == search
        left[rows] = np.maximum(table["time"][rows & (fates == "reached")][0] - table["time"][rows], 1e-9)
    figure, panels = plt.subplots(1, len(SEARCHES), figsize=(9.2, 3.9), sharex=True, sharey=True)
    for axes, (search, title) in zip(panels, SEARCHES.items()):
        for fate, (colour, label) in FATES.items():
            rows = (searches == search) & (fates == fate)
            star = fate == "reached"
            if not rows.any():
                continue
            axes.plot(left[rows], table["radii"][rows], "*" if star else "o", ms=12 if star else 3.2, color=colour,
                      alpha=1 if star else 0.7, mew=0, label=f"{label} ({rows.sum()})")
        axes.set(title=f"{title}: {(searches == search).sum():,} pairs", xscale="log", yscale="log",
                 xlabel="time left until the contact [s]", ylabel="radii of both nodes together [m]")
    panels[0].legend(fontsize=8, loc="lower right")
    panels[1].legend(fontsize=8, loc="lower left")
    panels[0].set_xlim(2, 5e-10)
    panels[0].set_xticks([1, 1e-2, 1e-4, 1e-6, 1e-9], ["1", "0.01", "$10^{-4}$", "$10^{-6}$", "0"])
    return figure


if __name__ == "__main__":
    if "--visits" in sys.argv:
        sys.argv.remove("--visits")
        plot_main(draw_visits, "ch02_visits", __doc__)
    else:
        plot_main(draw_levels, "ch02_hierarchy", __doc__)
