"""Chapter 5's picture of what sweeps are worth: the forces under a stack of ten boxes, and a heap.

Reads RUN_DIR/forces.csv and RUN_DIR/heap.csv of ch05_study --part solvers.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, GREY, ORANGE, Table, plot_main

LEAST = 1e-14  # what is exactly 0 stands at the bottom


def stack(axes: plt.Axes, table: Table) -> None:
    solver = np.array(table.text("solver"))
    rows = solver == "gauss-seidel"
    for name, label, colour, mark in [("first_error", "force, first frame [1]", BLUE, "o"), ("force_error", "force, at rest [1]", GREEN, "s"),
                                      ("drift", "drift in a second [m]", ORANGE, "D")]:
        axes.loglog(table["knob"][rows], np.maximum(table[name][rows], LEAST), mark + "-", color=colour, ms=4, label=label)
    axes.axhline(table["first_error"][solver == "dantzig"][0], color=GREY, ls=":", lw=1.2, label="force, Dantzig's method [1]")
    axes.set(title="A stack of ten, by Gauss–Seidel", xlabel="sweeps in a plan", ylabel="error (0 stands at the bottom)", ylim=(0.5 * LEAST, 1))
    axes.legend(loc="upper center", bbox_to_anchor=(0.45, -0.19))


def heap(residual: plt.Axes, time: plt.Axes, table: Table) -> None:
    sweeps, exact = table["sweeps"], table["sweeps"] == 0
    residual.loglog(sweeps[~exact], table["mean_residual"][~exact], "o-", ms=4, color=BLUE, label="mean of all frames")
    residual.loglog(sweeps[~exact], table["worst_residual"][~exact], "s-", ms=4, color=ORANGE, label="worst frame")
    residual.set(title="A heap of 36: what is left", ylabel="residual")
    residual.legend(loc="upper center", bbox_to_anchor=(0.45, -0.19))
    ms = table["second_ns"] / 1e6
    time.semilogx(sweeps[~exact], ms[~exact], "o-", ms=4, color=BLUE, label="sweeps")
    time.axhline(ms[exact][0], color=GREY, ls=":", lw=1.2, label="Dantzig's method")
    time.set(title="… and what it takes", ylabel="ms for a simulated second", ylim=(0, 1.25 * ms.max()))
    time.legend(loc="upper center", bbox_to_anchor=(0.45, -0.19))
    ticks = [2, 8, 32, 128]
    for axes in (residual, time):
        axes.set_xlabel("sweeps in a plan")
        axes.set_xticks(ticks, [str(t) for t in ticks])
        axes.minorticks_off()


def draw(run: Path) -> plt.Figure:
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(10.2, 4.2))
    stack(left, Table(run / "forces.csv"))
    heap(middle, right, Table(run / "heap.csv"))
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch05_accuracy", __doc__)
