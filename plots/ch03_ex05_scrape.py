"""Exercise 3.5: a ball scrapes over the floor: it sticks, or it slides.

Reads RUN_DIR/scrape.csv, which the target ch03_ex05_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREEN, GREY, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    table = Table(run / "scrape.csv")
    figure, (speeds, slips) = plt.subplots(1, 2, figsize=(7.6, 3.4))
    before = table["speed before"]
    for friction, color in ((0.1, BLUE), (0.3, ORANGE), (0.5, GREEN)):
        rows = abs(table["friction"] - friction) < 1e-9
        speeds.plot(before[rows], table["speed after"][rows] - before[rows], color=color, label=f"friction {friction}")
        slips.plot(before[rows], table["slip after"][rows], color=color, label=f"friction {friction}")
    speeds.plot([0, 8], [0, -8 * 2 / 7], color=GREY, linestyle=":", label="rolling: lost 2/7")
    speeds.set(title="What the ball loses", xlabel="speed along the floor before [m/s]", ylabel="change of its speed [m/s]")
    slips.set(title="Does the point stick?", xlabel="speed along the floor before [m/s]", ylabel="speed of the touching point after [m/s]")
    speeds.legend()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch03_ex05_scrape", __doc__)
