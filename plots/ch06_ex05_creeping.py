"""Exercise 6.5: a cube that should stand on a slope, one that slides down, one whose gaps are corrected, and a rod that is thrown.

Reads RUN_DIR/creeping.csv, which the target ch06_ex05_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREY, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    table = Table(run / "creeping.csv")
    t = table["t"]
    figure, ((stands, slides), (walks, thrown)) = plt.subplots(2, 2, figsize=(8.4, 6))
    way = 1000 * table["stands"]
    stands.axhline(0, color=GREY, lw=3, alpha=0.4, label="it stands: tan = 0.75, µ = 0.9")
    stands.plot(t, way, color=BLUE, label="your step")
    stands.set(title="A cube stands on a slope", xlabel="t [s]", ylabel="way down [mm]", ylim=(min(-10, 1.1 * min(way)), max(100, 1.1 * max(way))))
    stands.legend()
    slides.plot(t, 1 + 9.81 * (0.6 - 0.5 * 0.8) * t, color=GREY, lw=3, alpha=0.4, label="g (sin − µ cos): µ = 0.5")
    slides.plot(t, table["slides"], color=BLUE, label="your step")
    slides.set(title="A cube slides down", xlabel="t [s]", ylabel="velocity [m/s]", ylim=(0, None))
    slides.legend()
    walk = 1000 * table["walks"]
    walks.axhline(0, color=GREY, lw=3, alpha=0.4, label="it stands")
    walks.plot(t, walk, color=BLUE, label="your step")
    walks.set(title="Gaps on one side are put right, again and again", xlabel="t [s]", ylabel="a foot has moved [mm]",
              ylim=(min(-1, 1.1 * min(walk)), max(1, 1.1 * max(walk))))
    walks.legend()
    thrown.plot(t, table["made"], color=ORANGE)
    thrown.set(title="A leaning rod bounces, e = 1", xlabel="t [s]", ylabel="energy from nowhere, up to now [J]",
               ylim=(-0.01, 1.1 * max(0.2, max(table["made"]))))
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch06_ex05_creeping", __doc__)
