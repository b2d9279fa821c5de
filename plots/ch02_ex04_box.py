"""Exercise 2.4: pairs of nodes against the gap, with your boxes and with boxes along x, y, z.

Reads RUN_DIR/pairs.csv, which the target ch02_ex04_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, ORANGE, Table, plot_main

COLOURS = {"along x, y, z": ORANGE, "yours": BLUE}


def draw(run: Path) -> plt.Figure:
    table = Table(run / "pairs.csv")
    whose, gap, pairs = table.text("boxes"), table["gap"], table["pairs of nodes"]
    figure, axes = plt.subplots(figsize=(6.2, 3.6))
    for name, colour in COLOURS.items():
        rows = [i for i, owner in enumerate(whose) if owner == name]
        axes.loglog(gap[rows], pairs[rows], "o-", ms=4, color=colour, label=name)
    axes.set(title="A ball comes down to a slanted plate", xlabel="gap [m]", ylabel="pairs of nodes")
    axes.invert_xaxis()
    axes.legend(title="boxes")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch02_ex04_box", __doc__)
