#!/usr/bin/env python3
"""Draws a run's contacts: contacts.py RUN_DIR

A stepped run (chapter 4 on): contacts, impulses, velocities, gaps and time per frame. A single solve (chapter 3): its
impulses and velocities. Queries (chapters 1 and 2): the gap and the features at each first contact. For more than 2000
contacts the picture shows where most of them are: the median, 5 to 95 %, and the largest."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from collections import Counter
from pathlib import Path

import numpy as np
from matplotlib.ticker import MaxNLocator

from crowds import MOST_POINTS, Bins, draw_bands
from style import (BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY, PlotError, Table, entry_of, log_limits, no_sweep,
                   nothing, plot_main, plt, rests_of, table_if_there)

REAL_TIME_MS = 1000 / 30  # the paper's limit: 30 frames per second
ROUND_OFF = 1e-6  # of the largest impulse: smaller ones would stretch the axis for nothing


def draw_counts(axes: plt.Axes, bins: Bins, steps: Table, contacts: Table, rests: np.ndarray) -> None:
    given, impacts = (bins.reduced(steps[name], np.maximum) for name in ("contacts", "impacts"))
    resting = np.zeros(len(steps))  # those of a frame are reported at its start
    np.add.at(resting, np.minimum(np.searchsorted(steps["t"], contacts["t"][rests], side="right"), len(steps) - 1), 1)
    resting = bins.reduced(resting, np.maximum)
    axes.stairs(given, bins.edges, fill=True, color=SKY, alpha=0.6, label="given to the solver")
    if rests.any():
        axes.stairs(resting, bins.edges, fill=True, color=GREEN, label="at rest")
    axes.stairs(resting + impacts, bins.edges, baseline=resting, fill=True, color=BLUE,
                label="impacts" if rests.any() else "with an impulse")
    axes.set(title="Contacts per frame" + (f" (most in {bins.stride})" if bins.stride > 1 else ""), ylabel="count")
    axes.set_ylim(0, max(1.2, 1.15 * max(given.max(), (resting + impacts).max())))
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))


def draw_impulses(axes: plt.Axes, bins: Bins, x: np.ndarray, contacts: Table, rests: np.ndarray) -> None:
    impulse = contacts["impulse"]
    axes.set(title="Impulse of each contact", ylabel="impulse [N s]")
    if not len(contacts):
        return nothing(axes, "no contact in this run")
    seen = impulse > ROUND_OFF * impulse.max()
    if not seen.any():
        seen = np.ones(len(impulse), bool)
    hidden = np.count_nonzero((impulse > 0) & ~seen)
    if hidden:
        axes.set_title(f"Impulse of each contact ({hidden} less than a millionth of the largest are left out)")
    if impulse.max() > 100 * max(0, impulse[seen].min()):
        log_limits(axes, impulse[seen])
    else:
        axes.set_ylim(0, 1.15 * impulse.max() or 1)
    for chosen, color, name in ((seen & rests, GREEN, "at rest"), (seen & ~rests, BLUE, "impacts" if rests.any() else "")):
        if np.count_nonzero(chosen) > MOST_POINTS:
            draw_bands(axes, bins, x[chosen], impulse[chosen], color, name or "impulses")
        elif chosen.any():
            axes.vlines(x[chosen], axes.get_ylim()[0], impulse[chosen], color=color, linewidth=1, alpha=0.5)
            axes.plot(x[chosen], impulse[chosen], "o", color=color, markersize=3.5, label=name or None)


def draw_velocities(axes: plt.Axes, bins: Bins, x: np.ndarray, contacts: Table) -> None:
    axes.set(title="Velocity along the normal (below zero: approaching)", ylabel="velocity [m/s]")
    if not len(contacts):
        return nothing(axes, "no contact in this run")
    before, after = contacts["v_before"], contacts["v_after"]
    if len(contacts) > MOST_POINTS:
        draw_bands(axes, bins, x, before, RED, "before", farthest="smallest")
        draw_bands(axes, bins, x, after, GREEN, "after")
        low, high = min(before.min(), after.min(), 0), max(before.max(), after.max(), 0)
        axes.set_ylim(low - 0.06 * (high - low), high + 0.06 * (high - low))
    else:
        axes.vlines(x, before, after, color=GREY, linewidth=0.8, alpha=0.6)
        axes.plot(x, before, "v", color=RED, markersize=4, label="before", linestyle="none")
        axes.plot(x, after, "^", color=GREEN, markersize=4, label="after", linestyle="none")
    axes.axhline(0, color="#555555", linewidth=0.8)


def draw_levels(axes: plt.Axes, levels: dict[str, float]) -> None:
    """Lengths to compare gaps with."""
    for (name, value), style in zip(levels.items(), ("--", "-.", ":")):
        axes.axhline(value, color=GREY, linestyle=style, linewidth=1, label=f"{name}, {value:g} m")


def draw_gaps(axes: plt.Axes, bins: Bins, steps: Table, levels: dict[str, float]) -> None:
    t, gap = bins.ends, bins.reduced(steps["min_gap"], np.minimum)
    shown = np.isfinite(gap) & (gap > 0)
    axes.set(title="Smallest certified gap of each frame", ylabel="gap [m]")
    if not np.isfinite(gap).any():
        return nothing(axes, "no pair came close enough to be examined")
    log_limits(axes, gap, np.array(list(levels.values())))
    axes.plot(t, np.where(shown, gap, np.nan), ".-", color=PURPLE, markersize=3, linewidth=1)
    touching = np.isfinite(gap) & (gap <= 0)
    if touching.any():
        axes.plot(t[touching], np.full(touching.sum(), axes.get_ylim()[0]), "v", color=RED, markersize=6,
                  clip_on=False, label="zero or less", linestyle="none")
    draw_levels(axes, levels)


def draw_times(axes: plt.Axes, bins: Bins, steps: Table) -> None:
    axes.set(title="Computing time of each frame" + (f" (slowest of {bins.stride})" if bins.stride > 1 else ""),
             ylabel="time [ms]")
    series = (("step", "step_ns", "black", "-", 2.6), ("collision detection", "ccd_ns", ORANGE, "-", 1.2),
              ("LCP", "lcp_ns", BLUE, ".-", 1.2))
    values = []
    for label, name, color, line, width in series:
        values.append(bins.reduced(steps[name], np.maximum) / 1e6)  # row 0 is the start: nothing was computed
        shown = np.where(values[-1] > 0, values[-1], np.nan)
        axes.plot(bins.ends, shown, line, color=color, label=label, linewidth=width,
                  markersize=6 if np.count_nonzero(values[-1]) < 100 else 2)
    log_limits(axes, *values, np.array([REAL_TIME_MS]))
    axes.axhline(REAL_TIME_MS, color=RED, linestyle="--", linewidth=1, label="1/30 s")


def draw_run(steps: Table, contacts: Table, levels: dict[str, float]) -> plt.Figure:
    figure, panels = plt.subplots(5, 1, figsize=(8, 11.5), sharex=True)
    t, at, rests = steps["t"], contacts["t"], rests_of(contacts)
    bins = Bins.between(t)
    draw_counts(panels[0], bins, steps, contacts, rests)
    draw_impulses(panels[1], bins, at, contacts, rests)
    draw_velocities(panels[2], bins, at, contacts)
    draw_gaps(panels[3], bins, steps, levels)
    draw_times(panels[4], bins, steps)
    margin = 0.01 * (t[-1] - t[0]) or 1
    panels[-1].set(xlabel="time [s]", xlim=(t[0] - margin, t[-1] + margin))
    return figure


def draw_solve(contacts: Table) -> plt.Figure:
    figure, panels = plt.subplots(2, 1, figsize=(8, 5), sharex=True)
    number = np.arange(len(contacts))
    bins = Bins.between(np.arange(-0.5, max(1, len(contacts))))
    draw_impulses(panels[0], bins, number, contacts, rests_of(contacts))
    draw_velocities(panels[1], bins, number, contacts)
    panels[1].set(xlabel="contact", xlim=(-0.5, max(0.5, len(contacts) - 0.5)))
    panels[1].xaxis.set_major_locator(MaxNLocator(integer=True))
    return figure


def draw_queries(features: Table, levels: dict[str, float]) -> plt.Figure:
    figure, (gaps, kinds) = plt.subplots(2, 1, figsize=(8, 5), height_ratios=[1.6, 1])
    gaps.set(title="Gap at the first contact", xlabel="query", ylabel="gap [m]")
    kinds.set(title="Features that meet", xlabel="contacts")
    if not len(features):
        nothing(gaps, "no contact in these queries")
        nothing(kinds, "no contact in these queries")
        return figure
    gap, query = features["gap"], features["query"]
    log_limits(gaps, gap, np.array(list(levels.values())))
    zero = gap <= 0
    if np.count_nonzero(~zero) > MOST_POINTS:
        bins = Bins.between(np.arange(query.min() - 0.5, query.max() + 1))
        draw_bands(gaps, bins, query[~zero], gap[~zero], PURPLE, "gaps")
    else:
        gaps.plot(query, np.where(zero, np.nan, gap), "o", color=PURPLE, markersize=3)
    if zero.any():
        at = query[zero][:: max(1, int(np.ceil(zero.sum() / MOST_POINTS)))]
        gaps.plot(at, np.full(len(at), gaps.get_ylim()[0]), "v", color=RED, clip_on=False,
                  label=f"zero or less: {zero.sum()}", linestyle="none")
    draw_levels(gaps, levels)
    gaps.xaxis.set_major_locator(MaxNLocator(integer=True))
    count = Counter(f"{a} – {b}" for a, b in zip(features.text("kind_a"), features.text("kind_b")))
    names = sorted(count, key=lambda name: (count[name], name))
    bars = kinds.barh(names, [count[name] for name in names], color=BLUE, height=0.6)
    kinds.bar_label(bars, padding=3, fontsize=8.5)
    kinds.xaxis.set_major_locator(MaxNLocator(integer=True))
    kinds.grid(axis="y", visible=False)
    return figure


def levels_of(run: Path) -> dict[str, float]:
    tolerance, envelope = entry_of(run, "tolerance"), entry_of(run, "envelope")
    levels = {"envelope h": envelope, "h/2": envelope and envelope / 2, "tolerance": tolerance}
    return {name: value for name, value in levels.items() if value}


def draw(run: Path) -> plt.Figure:
    no_sweep(run)
    steps, contacts, features = (table_if_there(run / f"{name}.csv") for name in ("steps", "contacts", "features"))
    levels = levels_of(run)
    if steps is not None:
        if not len(steps):
            raise PlotError(f"{steps.file}: no rows")
        figure = draw_run(steps, contacts if contacts is not None else Table(run / "contacts.csv"), levels)
    elif contacts is not None:
        figure = draw_solve(contacts)
    elif features is not None:
        figure = draw_queries(features, levels)
    else:
        raise PlotError(f"{run}: none of steps.csv, contacts.csv, features.csv is there: not a run's folder?")
    for axes in figure.axes:
        if axes.get_legend_handles_labels()[1]:  # in a line of its own, between the title and the panel
            axes.set_title(axes.get_title("left"), pad=21)
            axes.legend(loc="lower left", ncols=6, bbox_to_anchor=(-0.01, 0.97), borderaxespad=0.2)
    return figure


if __name__ == "__main__":
    plot_main(draw, "contacts", __doc__)
