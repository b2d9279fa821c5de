"""Chapter 1's pictures of what accuracy costs: cost.svg and, with --grazing, grazing.svg.

Reads the runs that the chapter's text lists: RUN_DIR/plank.BOUND and RUN_DIR/hulls.BOUND (sweeps over the tolerance),
RUN_DIR/hulls.cold, RUN_DIR/hits.BOUND and RUN_DIR/misses.BOUND, and the files of plots/ch01_motions.py.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import math
import sys
from pathlib import Path

import matplotlib.pyplot as plt

from sketch import DARK, arrow, ball, bare, body, note
from style import BLUE, GREEN, GREY, ORANGE, PURPLE, RED, Table, plot_main

BOUNDS = {"naive": (ORANGE, "o-"), "directional": (GREEN, "s-"), "projected": (PURPLE, "x--"), "second_order": (BLUE, "o-")}


def first_touch() -> float:
    """When the plank of scenes/tumbling_plank.yaml is on the floor, in seconds: its lowest corner is at `height`."""
    def height(t):
        return 3 - 3 * t - abs(math.sin(5 * t)) - 0.1 * abs(math.cos(5 * t))

    high = next(k for k in range(10_000) if height(k * 1e-4) <= 0) * 1e-4
    low = high - 1e-4
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (middle, high) if height(middle) > 0 else (low, middle)
    return high


def draw_cost(run: Path) -> plt.Figure:
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(9.2, 3.5))
    exact = first_touch()
    for bound, (colour, line) in BOUNDS.items():
        plank = Table(run / f"plank.{bound}" / "sweep.csv")
        errors = [max(exact - t, 1e-17) for t in plank["time of contact"]]
        left.semilogy(plank["advances"], errors, line, ms=4, color=colour, label=bound.replace("_", " "))
        hulls = Table(run / f"hulls.{bound}" / "sweep.csv")
        middle.semilogx(hulls["ccd.tolerance"], [n / 200 for n in hulls["advances"]], line, ms=4, color=colour)
    for name, label, colour in (("second_order", "warm", BLUE), ("cold", "cold", ORANGE)):
        hulls = Table(run / f"hulls.{name}" / "sweep.csv")
        right.semilogx(hulls["ccd.tolerance"], [g / d for g, d in zip(hulls["GJK iterations"], hulls["distance calls"])],
                       "o-", ms=4, color=colour, label=label)
    left.set(title="A tumbling plank", xlabel="advances", ylabel="time of contact too early by [s]", xlim=(0, None))
    middle.set(title="200 pairs of hulls", xlabel="tolerance [m]", ylabel="mean number of advances", ylim=(0, None))
    right.set(title="The same 200 pairs", xlabel="tolerance [m]", ylabel="GJK iterations per distance", ylim=(0, None))
    for axes in (middle, right):
        axes.invert_xaxis()
    left.legend(title="motion bound", loc="upper right", handlelength=1.4, borderaxespad=0)
    left.set_xlim(0, 27)
    right.legend(title="first simplex")
    return figure


def draw_corner(axes: plt.Axes) -> None:
    """The subject of the two tables: the brick's corner, and the ball's path as seen from it."""
    bare(axes, "The ball's path")
    body(axes, [(0, 0), (-0.75, -0.85), (0.75, -0.85)])
    note(axes, (0, -0.55), "corner of\nthe brick", DARK)
    axes.plot([-1, 1], [0, 0], color=GREY, lw=1, ls=":")
    ball(axes, (0, 0.3), 0.3, "none", RED)
    angle = math.radians(35)
    start = (-0.85 * math.cos(angle), 0.3 + 0.85 * math.sin(angle))
    arrow(axes, start, (0, 0.3), RED)
    axes.plot([-0.95, 0], [0.3, 0.3], color=GREY, lw=0.8, ls=":")
    note(axes, (-0.62, 0.43), "angle", RED)
    note(axes, (start[0], start[1] + 0.1), "a hit", RED)
    ball(axes, (0.05, 1.5), 0.3, "none", DARK)
    arrow(axes, (-0.8, 1.5), (0.9, 1.5), DARK)
    note(axes, (-0.6, 1.62), "a miss", DARK)
    axes.set(xlim=(-1.05, 1.05), ylim=(-0.95, 1.9))


def draw_grazing(run: Path) -> plt.Figure:
    figure, (scene, left, right) = plt.subplots(1, 3, figsize=(9.2, 3.4), width_ratios=(0.62, 1, 1))
    draw_corner(scene)
    angles = Table(run / "angles.csv")["angle"]
    distances = Table(run / "distances.csv")["distance"]
    for bound, (colour, line) in BOUNDS.items():
        left.loglog(angles, Table(run / f"hits.{bound}" / "queries.csv")["iterations"], line, ms=3.5, color=colour,
                    label=bound.replace("_", " "))
        right.loglog(distances, Table(run / f"misses.{bound}" / "queries.csv")["iterations"], line, ms=3.5, color=colour)
    left.set(title="Hits", xlabel="angle between path and surface [deg]", ylabel="advances")
    right.set(title="Misses", xlabel="closest distance [m]", ylabel="advances")
    for axes in (left, right):
        axes.invert_xaxis()
        axes.set_ylim(1, 3000)
    left.legend(title="motion bound", handlelength=1.6)
    return figure


if __name__ == "__main__":
    if "--grazing" in sys.argv:
        sys.argv.remove("--grazing")
        plot_main(draw_grazing, "ch01_grazing", __doc__)
    else:
        plot_main(draw_cost, "ch01_cost", __doc__)
