"""Exercise 5.6: a box that bounces, one that rests while another falls on it, one that touches, and its energy account.

Reads RUN_DIR/hopping.csv, which the target ch05_ex06_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREY, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    table = Table(run / "hopping.csv")
    t = table["t"]
    figure, ((height, resting), (touching, accounts)) = plt.subplots(2, 2, figsize=(8.4, 6))
    height.plot(t, table["closed form"], color=GREY, lw=3, alpha=0.4, label="closed form")
    height.plot(t, table["height"], color=BLUE, marker=".", ms=3, lw=0.8, label="your step")
    height.set(title="A box falls, bounces and rests", xlabel="t [s]", ylabel="gap below it [m]")
    height.legend()
    speed = 1000 * table["resting velocity"]
    resting.plot(t, speed, color=BLUE, marker=".", ms=4, lw=0.8, label="your step, at ends of frames")
    resting.axhline(0, color=GREY, ls=":", lw=1, label="at rest")
    resting.set(title="A box rests; another one falls on it", xlabel="t [s]", ylabel="velocity of the lower one [mm/s]",
                xlim=(-0.01, 0.3), ylim=(-20, max(100, 1.1 * max(speed))))
    resting.legend()
    gap = 1000 * table["touching gap"]
    touching.plot(t, gap, color=BLUE, label="your step")
    touching.axhline(0.5, color=GREY, ls=":", lw=1, label="h / 2")
    touching.set(title="A box touches, without gravity", xlabel="t [s]", ylabel="gap below it [mm]", ylim=(0, max(1.0, 1.1 * max(gap))))
    touching.legend()
    accounts.plot(t, table["momentum"], color=ORANGE)
    accounts.set(title="Five boxes fall: the account of momentum", xlabel="t [s]", ylabel="unexplained up to now [N s]",
                 ylim=(-0.01, 1.1 * max(0.1, max(table["momentum"]))))
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch05_ex06_hopping", __doc__)
