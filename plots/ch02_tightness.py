"""Chapter 2's picture of how tight volumes are, and of what leaves and hulls of few points cost.

Reads RUN_DIR/tightness.csv and RUN_DIR/leaves.csv of ch02_study.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY, Table, plot_main

VOLUMES = {"sphere": (RED, "o-"), "swept sphere": (ORANGE, "o-"), "box": (GREEN, "o-"), "hull of 8": (SKY, "x--"),
           "hull of 16": (BLUE, "x--"), "hull of 32": (PURPLE, "x--"), "hull of 64": (GREY, "x--")}


def draw(run: Path) -> plt.Figure:
    tightness, leaves = Table(run / "tightness.csv"), Table(run / "leaves.csv")
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(9.2, 4.1))
    names = np.array(tightness.text("volume"))
    for axes, column, title in ((left, "overhang", "In all directions"), (middle, "across", "Across the surface")):
        for name, (colour, line) in VOLUMES.items():
            rows = names == name
            axes.plot(tightness["level"][rows], tightness[column][rows], line, ms=3.5, lw=1.3, color=colour, label=name)
        axes.set(title=f"How loose: {title.lower()}", xlabel="level (0: the root; leaves excepted)",
                 ylabel="mean overhang / node's radius", ylim=(0, None),
                 xticks=range(0, int(tightness["level"].max()) + 1, 2))
    middle.legend(fontsize=8)
    middle.set_ylim(0, 1.7)  # room for the legend
    motions, volumes, kinds, most = (np.array(leaves.text(c)) for c in ("motions", "volume", "leaves", "most_points"))
    for kind, colour in (("pieces", BLUE), ("triangles", ORANGE)):
        for family, line in (("far", "o-"), ("close", "s--")):
            rows = (motions == family) & (kinds == kind) & (volumes == "hull")
            pairs = (leaves["node_pairs"] + leaves["leaf_pairs"])[rows]
            right.semilogy(range(rows.sum()), pairs, line, ms=4, lw=1.3, color=colour, label=f"{kind}, {family}")
    right.set_xticks(range(rows.sum()), most[rows])
    right.set(title="Hulls of few points", xlabel="points that an inner hull may have", ylabel="pairs per query, median")
    right.legend(title="leaves, motions", title_fontsize=8, fontsize=8)
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch02_tightness", __doc__)
