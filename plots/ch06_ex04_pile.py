"""Exercise 6.4: fifteen balls in a triangle after a while, and a ball that slips until it rolls.

Reads RUN_DIR/balls.csv and RUN_DIR/roll.csv, which the target ch06_ex04_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREY, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    balls, roll = Table(run / "balls.csv"), Table(run / "roll.csv")
    figure, (much, less, rolling) = plt.subplots(1, 3, figsize=(10.6, 3.2), width_ratios=(1, 1.4, 1.2))
    for axes, mu, limits in ((much, 0.8, (-0.2, 1)), (less, 0.5, (-0.45, 1.25))):
        for time, colour, style in ((0, GREY, ":"), (0.5, BLUE, "-")):
            for x, z in balls.vectors("x", "z")[(balls["mu"] == mu) & (np.abs(balls["t"] - time) < 1e-9)]:
                axes.add_patch(plt.Circle((x, z), 0.1, fill=False, color=colour, ls=style, lw=1.2))
        axes.axhline(0, color=GREY, lw=1)
        axes.set(title=f"µ = {mu:g}: after 0.5 s", xlabel="x [m]", ylabel="z [m]", aspect="equal", xlim=limits, ylim=(-0.05, 1.05))
    t = roll["t"]
    rolling.plot(t, roll["velocity"], color=BLUE, label="velocity")
    rolling.plot(t, roll["rim"], color=ORANGE, label="rim: spin × radius")
    rolling.axhline(3 * 5 / 7, color=GREY, ls=":", lw=1, label="5/7 of the start")
    rolling.axvline(2 * 3 / (7 * 0.2 * 9.81), color=GREY, ls=":", lw=1)
    rolling.set(title="A ball slips, then rolls", xlabel="t [s]", ylabel="[m/s]")
    rolling.legend()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch06_ex04_pile", __doc__)
