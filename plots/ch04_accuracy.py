"""Chapter 4's picture of what accuracy costs: a bouncing ball by events and by Moreau's time stepping, and tumbling
blocks against their most exact run.

Reads RUN_DIR/bounces.csv and RUN_DIR/trajectories.csv of ch04_study --part accuracy.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, GREY, ORANGE, PURPLE, RED, Table, plot_main


def bounces(work: plt.Axes, time: plt.Axes, table: Table) -> None:
    for method, label, colour, mark in [("events", "from contact to contact", BLUE, "o"), ("moreau", "Moreau's time stepping", ORANGE, "s")]:
        rows = np.flatnonzero([m == method for m in table.text("method")])
        error = np.maximum(table["error"][rows], 1e-16)
        work.loglog(table["work"][rows], error, mark + "-", color=colour, ms=4, label=label)
        time.loglog(table["median_ns"][rows] / 1000, error, mark + "-", color=colour, ms=4)
    work.set_xlabel("queries, or steps")
    time.set_xlabel("time on this machine [µs]")
    work.set_ylabel("error of the height after 2.5 s [m]")
    work.set_title("A bouncing ball: work")
    time.set_title("… and time")
    work.legend(loc="lower right")


def trajectories(axes: plt.Axes, table: Table) -> None:
    knobs = [("tolerance [m]", "tolerance: its value in m beside it", BLUE, "o"), ("frames", "frames in 0.8 s: their number", GREEN, "D"),
             ("motion", "constant spin, not free rotation", RED, "X"), ("solver", "four solvers, one upon the other", PURPLE, "^")]
    shown = {"1e-2": "1e-2", "1e-4": "1e-4 (45 impacts)", "1e-6": "1e-6", "1e-8": "1e-8", "1e-10": "1e-10", "1": "1", "4": "4", "768": "768"}
    for knob, label, colour, mark in knobs:
        rows = [i for i, (k, v) in enumerate(zip(table.text("knob"), table.text("value"))) if k == knob and v != "torque-free"]
        axes.loglog(table["advances"][rows], np.maximum(table["error"][rows], 1e-16), mark, color=colour, ms=5, label=label)
        for i in rows:
            if knob in ("tolerance [m]", "frames") and table.text("value")[i] in shown:
                axes.annotate(shown[table.text("value")[i]], (table["advances"][i], table["error"][i]), textcoords="offset points",
                              xytext=(6, 3), fontsize=7.5, color=GREY)
    axes.set_xlabel("proved steps of all searches")
    axes.set_ylabel("error of the worst place after 41 impacts [m]")
    axes.set_title("Eight tumbling blocks")
    axes.set_xticks([500, 1000, 2000, 4000], ["500", "1,000", "2,000", "4,000"])
    axes.minorticks_off()
    axes.set_ylim(1e-7, 1e5)  # room for the legend
    axes.legend(loc="upper right", fontsize=7.5)


def draw(run: Path) -> plt.Figure:
    figure, (work, time, blocks) = plt.subplots(1, 3, figsize=(11, 3.8))
    bounces(work, time, Table(run / "bounces.csv"))
    trajectories(blocks, Table(run / "trajectories.csv"))
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch04_accuracy", __doc__)
