"""Chapter 2's picture of how tight volumes are, and of what leaves and hulls of few points cost.

Reads RUN_DIR/tightness.csv and RUN_DIR/leaves.csv of ch02_study.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY, Table, plot_main

VOLUMES = {"sphere": (RED, "o-"), "swept sphere": (ORANGE, "o-"), "box": (GREEN, "o-"), "hull of 8": (SKY, "x--"),
           "hull of 16": (BLUE, "x--"), "hull of 32": (PURPLE, "x--"), "hull of 64": (GREY, "x--")}


def draw(run: Path) -> plt.Figure:
    tightness, leaves = Table(run / "tightness.csv"), Table(run / "leaves.csv")
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(11.5, 3.5))
    names = np.array(tightness.text("volume"))
    for name, (colour, line) in VOLUMES.items():
        rows = names == name
        left.plot(tightness["nodes"][rows], tightness["overhang"][rows], line, ms=3.5, lw=1.3, color=colour, label=name)
    left.set(title="How loose a volume is", xscale="log", xlabel="nodes of the level (leaves excepted)",
             ylabel="mean overhang / node's radius", ylim=(0, None))
    left.legend(fontsize=7, ncols=2)
    motions, volumes, kinds, most = (np.array(leaves.text(c)) for c in ("motions", "volume", "leaves", "most_points"))
    for axes, column, title in ((middle, "node_pairs", "Hulls of few points"), (right, "leaf_pairs", "Leaves")):
        for kind, colour in (("pieces", BLUE), ("triangles", ORANGE)):
            for family, line in (("far", "o-"), ("close", "s--")):
                rows = (motions == family) & (kinds == kind) & (volumes == "hull")
                axes.plot(range(rows.sum()), leaves[column][rows], line, ms=4, lw=1.3, color=colour, label=f"{kind}, {family}")
        axes.set_xticks(range(rows.sum()), most[rows])
        axes.set(title=title, xlabel="points that an inner hull may have", ylim=(0, None),
                 ylabel=f"pairs of {'nodes' if column == 'node_pairs' else 'leaves'} per query, median")
    middle.legend(title="leaves, motions", title_fontsize=7.5, fontsize=7)
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch02_tightness", __doc__)
