"""Exercise 3.2: what a product with the Delassus matrix costs, with the matrix and without it.

Reads RUN_DIR/cost.csv, which the target ch03_ex02_demo writes.
"""

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, ORANGE, Table, plot_main

SCENES = {"a row of balls": ("o-", "a row"), "balls on a free plate": ("s--", "on a free plate")}


def draw(run: Path) -> plt.Figure:
    table = Table(run / "cost.csv")
    scene, n, entries, kicks = table.text("scene"), table["contacts"], table["entries of A"], table["kicks"]
    figure, axes = plt.subplots(figsize=(6.2, 3.6))
    for name, (line, words) in SCENES.items():
        rows = [i for i, s in enumerate(scene) if s == name]
        axes.loglog(n[rows], entries[rows], line, ms=4, color=ORANGE, label=f"entries of A, {words}")
        axes.loglog(n[rows], kicks[rows], line, ms=4, color=BLUE, label=f"your kicks, {words}")
    axes.set(title="One product A z", xlabel="contacts", ylabel="count")
    axes.legend()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch03_ex02_without_the_matrix", __doc__)
