"""Exercise 4.3: pairs of swept boxes that overlap in a gas of spinning blocks.

Reads RUN_DIR/swept.csv, which the target ch04_ex03_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, ORANGE, Table, plot_main

PAIRS = (500, 1000, 2000, 5000)  # marks of the axis; powers of ten alone would be one


def draw(run: Path) -> plt.Figure:
    table = Table(run / "swept.csv")
    figure, axes = plt.subplots(figsize=(5.2, 3.4))
    at = range(len(table["dt"]))  # the lengths are chosen, not measured: evenly apart they are easier to read
    axes.semilogy(at, table["pairs of balls"], "s-", color=ORANGE, ms=4, label="balls around the blocks (the chapter)")
    axes.semilogy(at, table["pairs of boxes"], "o-", color=BLUE, ms=4, label="your boxes")
    axes.set(title="Pairs to be queried, of 1,000 blocks", xlabel="length of the frame [ms]", ylabel="pairs")
    axes.set_xticks(at, [f"{1000 * dt:.0f}" for dt in table["dt"]])
    axes.set_yticks(PAIRS, [f"{pairs:,}" for pairs in PAIRS])
    axes.minorticks_off()
    axes.legend()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch04_ex03_swept_box", __doc__)
