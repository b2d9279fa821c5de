"""Exercise 5.2: bounces that an envelope leaves, when the ball rests, and the time that is cut.

Reads RUN_DIR/last_bounce.csv, which the target ch05_ex02_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREEN, GREY, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    table = Table(run / "last_bounce.csv")
    figure, (count, rest, cut) = plt.subplots(1, 3, figsize=(10.6, 3.4))
    for e, colour in zip(sorted(set(table["restitution"])), (BLUE, ORANGE, GREEN)):
        rows = table["restitution"] == e
        width = 1000 * table["width"][rows]
        count.plot(width, table["bounces"][rows], color=colour, drawstyle="steps-mid", label=f"e = {e:g}")
        rest.plot(width, table["time"][rows], color=colour, drawstyle="steps-mid")
        rest.plot(width, table["engine"][rows], color=colour, ls="", marker=".")
        cut.plot(width, table["cut"][rows], color=colour, drawstyle="steps-mid")
        cut.axvline(1000 * table["widest"][rows][0], color=colour, ls=":", lw=1)
    cut.axhline(table["frame"][0], color=GREY, ls="--", lw=1, label="a frame")
    rest.plot([], [], color=GREY, ls="", marker=".", label="the engine lies")
    count.set(title="Bounces that are events", xlabel="envelope [mm]", xscale="log")
    rest.set(title="At rest from", xlabel="envelope [mm]", ylabel="t [s]", xscale="log")
    cut.set(title="Cut (dotted: the widest)", xlabel="envelope [mm]", ylabel="[s]", xscale="log", yscale="log")
    for axes in (count, rest, cut):
        axes.legend()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch05_ex02_last_bounce", __doc__)
