"""Exercise 6.2: where a block thrown in each direction stops, and by how much its path is turned.

Reads RUN_DIR/stops.csv, which the target ch06_ex02_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, GREY, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    table = Table(run / "stops.csv")
    frictions = np.array(table.text("friction"))
    figure, (stops, angles) = plt.subplots(1, 2, figsize=(9, 4.2))
    for name, colour in (("cone", GREY), ("box", BLUE), ("4 corners", ORANGE), ("8 corners", GREEN)):
        rows = frictions == name
        stops.plot(table["x"][rows], table["y"][rows], color=colour, marker=".", ms=3, lw=0.8, label=name)
        angles.plot(table["direction"][rows], table["angle"][rows], color=colour, label=name)
    stops.plot(0, 0, "+", color=GREY)
    stops.set(title="Stop points of blocks that start at +", xlabel="x [m]", ylabel="y [m]", aspect="equal")
    angles.set(title="The way is turned by", xlabel="direction of the throw [degrees]", ylabel="[degrees]", xlim=(0, 90), xticks=range(0, 91, 15))
    stops.legend(loc="lower center", bbox_to_anchor=(0.5, 0.14))
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch06_ex02_stop_points", __doc__)
