"""Exercise 5.5: the gaps of a column while they are corrected, and the energy that it costs.

Reads RUN_DIR/column.csv and RUN_DIR/energy.csv, which the target ch05_ex05_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREY, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    frames, costs = Table(run / "column.csv"), Table(run / "energy.csv")
    scene = np.array(frames.text("scene"))
    figure, (touching, wide, energy) = plt.subplots(1, 3, figsize=(10.6, 3.4))
    for axes, name, title in ((touching, "touching", "Eight boxes that touch"), (wide, "a wide gap", "One gap is wide")):
        for box in sorted(set(frames["box"])):
            rows = (scene == name) & (frames["box"] == box)
            axes.plot(frames["frame"][rows], 1000 * frames["gap"][rows], color=plt.cm.viridis(box / 8), lw=1.2,
                      label=f"below box {int(box) + 1}" if box in (0, 4, 7) else None)
        axes.axhline(0.25, color=GREY, ls=":", lw=1)
        axes.set(title=title, xlabel="frames", ylabel="gap [mm]")
        axes.legend()
    energy.plot(costs["boxes"], costs["touching"], color=BLUE, marker=".", label="all touch")
    positive = costs["every fourth wide"] > 0
    energy.plot(costs["boxes"][positive], costs["every fourth wide"][positive], color=ORANGE, marker=".", label="every fourth gap is wide")
    energy.set(title="What it costs", xlabel="boxes", ylabel="energy [J]", xscale="log", yscale="log")
    energy.legend()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch05_ex05_column", __doc__)
