#!/usr/bin/env python3
"""Draws a run's energy over time, and how well it keeps momentum: energy.py RUN_DIR"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import numpy as np

from style import BLUE, GREEN, GREY, ORANGE, RED, PlotError, Table, plot_main, plt, say, table_if_there

ZERO_SHOWN_AT = 1e-18  # on the logarithmic axis; below every rounding error
ROUNDING = np.finfo(float).eps


def drift(values: np.ndarray, exchanged: float) -> np.ndarray:
    """The change of a vector since the start over the largest it was, or over what the impulses moved if that is more:
    two bodies that meet head on have no momentum in sum, but exchange some."""
    scale = max(np.linalg.norm(values, axis=1).max(), exchanged)
    change = np.linalg.norm(values - values[0], axis=1)
    return np.maximum(change / scale if scale > 0 else change, ZERO_SHOWN_AT)


def draw(run: Path) -> plt.Figure:
    steps = Table(run / "steps.csv")
    if not len(steps):
        raise PlotError(f"{steps.file}: no rows")
    contacts = table_if_there(run / "contacts.csv")
    figure, (energy, momentum) = plt.subplots(2, 1, figsize=(8, 5.4), sharex=True, height_ratios=[2.2, 1])
    t = steps["t"]

    energy.plot(t, steps["energy"], color="black", linewidth=2.2, label="total")
    energy.plot(t, steps["kinetic"], color=ORANGE, linestyle="--", label="kinetic")
    falling = np.any(steps["potential"] != 0)
    if falling:
        energy.plot(t, steps["potential"], color=BLUE, linestyle="-.", label="potential")
    energy.set(title="Energy", ylabel="energy [J]")
    low, high = energy.get_ylim()
    energy.set_ylim(min(0, low), high + 0.04 * (high - low))

    impulses = contacts["impulse"] if contacts is not None else np.zeros(0)
    points = contacts.vectors("x", "y", "z") if contacts is not None else np.zeros((0, 3))
    normals = contacts.vectors("nx", "ny", "nz") if contacts is not None else np.zeros((0, 3))
    times = np.unique(contacts["t"][impulses > 0]) if contacts is not None else t[steps["impacts"] > 0]
    for axes in (energy, momentum):
        for time in times:
            axes.axvline(time, color=RED, linewidth=0.8, alpha=max(0.08, 0.8 / (1 + len(times) / 20)), zorder=0)
    if len(times):
        energy.plot([], [], color=RED, linewidth=0.8, label=f"impact ({len(times)} instants)")
    energy.legend(loc="upper right", ncols=4, bbox_to_anchor=(1, 1.14))

    moved = impulses[:, None] * normals
    linear = drift(steps.vectors("px", "py", "pz"), np.linalg.norm(moved, axis=1).sum())
    angular = drift(steps.vectors("lx", "ly", "lz"), np.linalg.norm(np.cross(points, moved), axis=1).sum())
    momentum.plot(t, linear, color=BLUE, label="linear")
    momentum.plot(t, angular, color=GREEN, linestyle="--", label="angular, about the origin")
    decades = np.arange(-18.0, 1 + max(-11, np.ceil(np.log10(max(linear.max(), angular.max()))) + 1), 3)
    momentum.set(yscale="log", xlabel="time [s]", ylabel="drift [1]", ylim=(ZERO_SHOWN_AT / 5, 10 ** decades[-1]),
                 title="Momentum: relative change since the start")
    momentum.set_yticks(10.0 ** decades, ["0"] + [f"$10^{{{d:.0f}}}$" for d in decades[1:]])
    momentum.minorticks_off()
    momentum.axhline(ROUNDING, color=GREY, linewidth=0.8, linestyle=":")
    momentum.text(t[-1], ROUNDING, "one rounding ", ha="right", va="bottom", color=GREY, fontsize=8)
    if falling:
        say(momentum, "gravity and fixed bodies change it")
    elif angular.max() > 1e-9:
        say(momentum, "between impacts a body keeps its spin, not its angular momentum: no gyroscopic effect")
    momentum.legend(loc="upper right", ncols=2, bbox_to_anchor=(1, 1.3))
    momentum.set_xlim(t[0], t[-1] if t[-1] > t[0] else t[0] + 1)
    return figure


if __name__ == "__main__":
    plot_main(draw, "energy", __doc__)
