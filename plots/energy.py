#!/usr/bin/env python3
"""Draws a run's energy over time, and how well it keeps momentum: energy.py RUN_DIR

Potential energy counts from the run's lowest. Energies that are small beside the others have a panel of their own. Where gravity or
fixed bodies change the momentum, it is not drawn."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import numpy as np

from crowds import Bins, thinned
from style import (BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY, PlotError, Table, fixed_bodies, no_sweep, plot_main, plt,
                   power_of_ten, rests_of, table_if_there)

ZERO_SHOWN_AT = 1e-18  # on the logarithmic axis; below every rounding error
ROUNDING = np.finfo(float).eps
SMALL = 0.1  # of the range of all energies: those that stay within have a panel of their own
FLAT = 1e-9  # of the energies: a range below this is rounding, and is not magnified to fill the panel
MOST_LINES = 60  # one for each instant with an impact; of more, bars show how many
# What a step adds to the total, by column (chapter 5 on): drawn as the sum so far.
ADDED = {"correction_energy": (PURPLE, "added by corrections"), "friction_work": (GREEN, "friction's work"),
         "fracture_energy": (SKY, "lost to breaks")}


def drift(values: np.ndarray, exchanged: float) -> np.ndarray:
    """The change of a vector since the start over the largest it was, or over what the impulses moved if that is more:
    two bodies that meet head on have no momentum in sum, but exchange some."""
    scale = max(np.linalg.norm(values, axis=1).max(), exchanged)
    change = np.linalg.norm(values - values[0], axis=1)
    return np.maximum(change / scale if scale > 0 else change, ZERO_SHOWN_AT)


def curves_of(steps: Table) -> tuple[list[tuple[str, np.ndarray, dict]], float]:
    """Name, values and look of every energy, and the potential that counts as zero."""
    potential = steps["potential"]
    zero = potential.min()
    curves = [("total", steps["energy"] - zero, {"color": "black", "linewidth": 2.2}),
              ("kinetic", steps["kinetic"], {"color": ORANGE, "linestyle": "--"})]
    if np.any(potential != 0):
        curves.append(("potential", potential - zero, {"color": BLUE, "linestyle": "-."}))
    for column, (color, name) in ADDED.items():
        if column in steps.names:
            curves.append((name, np.cumsum(steps[column]), {"color": color}))
    return curves, zero


def draw_curves(axes: plt.Axes, t: np.ndarray, curves: list, rounding: float) -> None:
    """`rounding`: a range of energies that counts as zero."""
    for name, values, look in curves:
        axes.plot(*thinned(t, values), label=name, **look)
    low, high = (how([how(values) for _, values, _ in curves] + [0]) for how in (min, max))
    span = max(high - low, rounding) or 1
    axes.set_ylim(low - 0.04 * span if low < -rounding else 0, max(high, low + span) + 0.06 * span)
    axes.set_ylabel("energy [J]")


def draw_impacts(panels: list[plt.Axes], times: np.ndarray, t: np.ndarray) -> None:
    if not len(times):
        return
    if len(times) <= MOST_LINES:
        for axes in panels:
            for time in times:
                axes.axvline(time, color=RED, linewidth=0.8, alpha=max(0.2, 0.8 / (1 + len(times) / 20)), zorder=0)
        panels[0].plot([], [], color=RED, linewidth=0.8, label=f"impact ({len(times)} instants)")
        return
    bins = Bins.between(np.linspace(t[0], t[-1], 61))
    count = np.bincount(bins.of(times), minlength=len(bins.ends))
    panels[0].stairs(0.14 * count / count.max(), bins.edges, fill=True, color=RED, alpha=0.35, zorder=0,
                     transform=panels[0].get_xaxis_transform(), label=f"impacts ({len(times)} instants): how many")


def draw_momentum(axes: plt.Axes, steps: Table, contacts: Table | None) -> float:
    """Returns the largest change of the angular momentum."""
    impulses = contacts["impulse"] if contacts is not None else np.zeros(0)
    points = contacts.vectors("x", "y", "z") if contacts is not None else np.zeros((0, 3))
    normals = contacts.vectors("nx", "ny", "nz") if contacts is not None else np.zeros((0, 3))
    moved, t = impulses[:, None] * normals, steps["t"]
    linear = drift(steps.vectors("px", "py", "pz"), np.linalg.norm(moved, axis=1).sum())
    angular = drift(steps.vectors("lx", "ly", "lz"), np.linalg.norm(np.cross(points, moved), axis=1).sum())
    axes.plot(*thinned(t, linear), color=BLUE, label="linear")
    axes.plot(*thinned(t, angular), color=GREEN, linestyle="--", label="angular, about the origin")
    decades = np.arange(-18.0, 1 + max(-11, np.ceil(np.log10(max(linear.max(), angular.max()))) + 1), 3)
    axes.set(yscale="log", ylabel="drift [1]", ylim=(ZERO_SHOWN_AT / 5, 10 ** decades[-1]),
             title="Momentum: relative change since the start")
    axes.set_yticks(10.0 ** decades, ["0", *map(power_of_ten, 10.0 ** decades[1:])])
    axes.minorticks_off()
    axes.axhline(ROUNDING, color=GREY, linewidth=0.8, linestyle=":")
    axes.text(t[-1], ROUNDING, "one rounding ", ha="right", va="bottom", color=GREY, fontsize=8)
    return angular.max()


def draw(run: Path) -> plt.Figure:
    no_sweep(run)
    steps, contacts = Table(run / "steps.csv"), table_if_there(run / "contacts.csv")
    if not len(steps):
        raise PlotError(f"{steps.file}: no rows")
    t = steps["t"]
    curves, zero = curves_of(steps)
    span = max(max(values.max(), 0) - min(values.min(), 0) for _, values, _ in curves)
    rounding = FLAT * max(abs(zero), span)
    small = [curve for curve in curves[1:] if rounding < np.abs(curve[1]).max() < SMALL * span]
    falls, fixed = bool(np.any(steps["potential"] != 0)), fixed_bodies(run)
    heights = [2.2] + [1] * bool(small) + [1] * (not falls and not fixed)
    figure, panels = plt.subplots(len(heights), 1, figsize=(8, 1 + 1.5 * sum(heights)), sharex=True, height_ratios=heights,
                                  squeeze=False)
    panels = list(panels[:, 0])
    draw_curves(panels[0], t, [curve for curve in curves if not any(curve is other for other in small)], rounding)
    panels[0].set_title("Energy" + (f"; zero is the lowest potential, {zero:.4g} J" if falls else ""))
    if small:
        draw_curves(panels[1], t, small, rounding)
        panels[1].set_title("The small ones among them")
    remark = " and ".join(["gravity"] * falls + ["fixed bodies"] * fixed)
    remark = f"momentum is not drawn: {remark} change{'' if ' and ' in remark or not falls else 's'} it" if remark else ""
    if not remark and draw_momentum(panels[-1], steps, contacts) > 1e-9:
        remark = "between impacts a body keeps its spin, not its angular momentum: no gyroscopic effect"
    if contacts is not None:
        times = np.unique(contacts["t"][(contacts["impulse"] > 0) & ~rests_of(contacts)])
    else:
        times = t[steps["impacts"] > 0]
    draw_impacts(panels, times, t)
    for axes in panels:  # the legend in a line of its own, between the title and the panel
        axes.set_title(axes.get_title("left"), pad=21)
        axes.legend(loc="lower left", ncols=5, bbox_to_anchor=(-0.01, 0.97), borderaxespad=0.2)
    panels[-1].set(xlabel="time [s]", xlim=(t[0], t[-1] if t[-1] > t[0] else t[0] + 1))
    panels[-1].annotate(remark, (1, 0), (0, -38), xycoords="axes fraction", textcoords="offset points", ha="right", va="top",
                        color=GREY, fontsize=8.5)
    return figure


if __name__ == "__main__":
    plot_main(draw, "energy", __doc__)
