"""Chapter 5's picture of its two lengths, the envelope's width and the frame's: what errors they make, and what they cost.

The distance down the slope is exact, and so the slope appears only in the costs.

Reads RUN_DIR/envelope.csv and RUN_DIR/step.csv of ch05_study --part knobs.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, ORANGE, PURPLE, RED, Table, plot_main

LEAST = 1e-7  # of errors: smaller ones are negligible beside the others


def errors(axes: plt.Axes, table: Table, x: str, columns: list[tuple[str, str, str, str]]) -> None:
    for name, label, colour, mark in columns:
        axes.loglog(table[x], np.maximum(np.abs(table[name]), LEAST), mark + "-", color=colour, ms=4, label=label)
    axes.set(ylabel="error (less stands at the bottom)", ylim=(0.5 * LEAST, 3))


def times(axes: plt.Axes, table: Table, x: str) -> None:
    for name, label, colour, mark in [("heap", "heap of 36, landing", RED, "^"), ("stack", "stack of ten", BLUE, "o"), ("slope", "slope", GREEN, "s")]:
        axes.loglog(table[x], table[f"{name}_ns"] / 1e6, mark + "-", color=colour, ms=4, label=label)
    axes.set(ylabel="ms for a simulated second")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncol=3, columnspacing=1, handlelength=1.4)


def draw(run: Path) -> plt.Figure:
    envelope, step = Table(run / "envelope.csv"), Table(run / "step.csv")
    figure, ((wide, long), (wide_time, long_time)) = plt.subplots(2, 2, figsize=(10.2, 8.2))
    lift = ("stack_lift", "stack: place of the top box [m]", BLUE, "o")
    ball, rest = ("ball_error", "ball: height [m]", ORANGE, "D"), ("rest_error", "ball: time of rest [s]", PURPLE, "v")
    errors(wide, envelope, "envelope", [lift, ball, rest])
    wide.set_title("Errors, frames of 1/60 s")
    errors(long, step, "dt", [lift, (*rest[:1], "ball: time of rest [s], margin of 0.5 mm", *rest[2:]),
                              ("narrow_rest_error", "… margin of 0.9 |g| Δt² (1 − ε) / 2", RED, "^")])
    long.set_title("Errors, margin of 0.5 mm")
    for axes in (wide, long):
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncol=2 if axes is wide else 1, columnspacing=1)
    times(wide_time, envelope, "envelope")
    times(long_time, step, "dt")
    wide_time.set_title("Time, frames of 1/60 s")
    long_time.set_title("Time, margin of 0.5 mm")
    rates = [15, 60, 240, 960]
    for axes in (long, long_time):
        axes.set_xticks([1 / rate for rate in rates], [f"1/{rate}" for rate in rates])
        axes.minorticks_off()
        axes.set_xlabel("length of a frame [s]")
    for axes in (wide, wide_time):
        axes.set_xlabel("margin h [m]")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch05_knobs", __doc__)
