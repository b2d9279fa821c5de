#!/usr/bin/env python3
"""Draws a run's contacts: contacts.py RUN_DIR

A stepped run (chapter 4 on): contacts, impulses, velocities, gaps and time per frame. A single solve (chapter 3): its
impulses and velocities. Queries (chapters 1 and 2): the gap and the features at each first contact."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from collections import Counter
from pathlib import Path

import numpy as np
from matplotlib.ticker import MaxNLocator

from style import (BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY, PlotError, Table, log_limits, nothing, plot_main,
                   plt, table_if_there, tolerance_of)

REAL_TIME_MS = 1000 / 30  # the paper's limit: 30 frames per second


def draw_counts(axes: plt.Axes, steps: Table) -> None:
    axes.vlines(steps["t"], 0, steps["contacts"], color=SKY, linewidth=2.5, label="given to the solver")
    axes.vlines(steps["t"], 0, steps["impacts"], color=BLUE, linewidth=1.2, label="with an impulse")
    axes.set(title="Contacts per frame", ylabel="count")
    axes.set_ylim(0, max(1.2, 1.15 * max(steps["contacts"].max(), steps["impacts"].max())))
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))


def draw_impulses(axes: plt.Axes, x: np.ndarray, contacts: Table) -> None:
    impulse = contacts["impulse"]
    axes.set(title="Impulse of each contact", ylabel="impulse [N s]")
    if not len(contacts):
        return nothing(axes, "no contact in this run")
    positive = impulse[impulse > 0]
    if len(positive) and positive.max() > 100 * positive.min():
        log_limits(axes, impulse)
    else:
        axes.set_ylim(0, 1.15 * impulse.max() or 1)
    axes.vlines(x, axes.get_ylim()[0], impulse, color=BLUE, linewidth=1, alpha=0.5)
    axes.plot(x, impulse, "o", color=BLUE, markersize=3.5)


def draw_velocities(axes: plt.Axes, x: np.ndarray, contacts: Table) -> None:
    axes.set(title="Velocity along the normal (below zero: approaching)", ylabel="velocity [m/s]")
    if not len(contacts):
        return nothing(axes, "no contact in this run")
    before, after = contacts["v_before"], contacts["v_after"]
    axes.vlines(x, before, after, color=GREY, linewidth=0.8, alpha=0.6)
    axes.plot(x, before, "v", color=RED, markersize=4, label="before", linestyle="none")
    axes.plot(x, after, "^", color=GREEN, markersize=4, label="after", linestyle="none")
    axes.axhline(0, color="#555555", linewidth=0.8)


def draw_gaps(axes: plt.Axes, steps: Table, tolerance: float | None) -> None:
    t, gap = steps["t"], steps["min_gap"]
    shown = np.isfinite(gap) & (gap > 0)
    axes.set(title="Smallest certified gap of each frame", ylabel="gap [m]")
    if not np.isfinite(gap).any():
        return nothing(axes, "no pair came close enough to be examined")
    log_limits(axes, gap, np.array([tolerance or np.inf]))
    axes.plot(t, np.where(shown, gap, np.nan), ".-", color=PURPLE, markersize=3, linewidth=1)
    touching = np.isfinite(gap) & (gap <= 0)
    if touching.any():
        axes.plot(t[touching], np.full(touching.sum(), axes.get_ylim()[0]), "v", color=RED, markersize=6,
                  clip_on=False, label="zero or less", linestyle="none")
    if tolerance:
        axes.axhline(tolerance, color=GREY, linestyle="--", linewidth=1, label=f"tolerance, {tolerance:g} m")


def draw_times(axes: plt.Axes, steps: Table) -> None:
    axes.set(title="Computing time of each frame", ylabel="time [ms]")
    series = (("step", "step_ns", "black", "-", 2.6), ("collision detection", "ccd_ns", ORANGE, "-", 1.2),
              ("LCP", "lcp_ns", BLUE, ".-", 1.2))
    values = []
    for label, name, color, line, width in series:
        values.append(steps[name][1:] / 1e6)  # row 0 is the start: nothing was computed
        shown = np.where(values[-1] > 0, values[-1], np.nan)
        axes.plot(steps["t"][1:], shown, line, color=color, label=label, markersize=6, linewidth=width)
    log_limits(axes, *values, np.array([REAL_TIME_MS]))
    axes.axhline(REAL_TIME_MS, color=RED, linestyle="--", linewidth=1, label="1/30 s")


def draw_run(steps: Table, contacts: Table, tolerance: float | None) -> plt.Figure:
    figure, panels = plt.subplots(5, 1, figsize=(8, 10.5), sharex=True)
    draw_counts(panels[0], steps)
    draw_impulses(panels[1], contacts["t"], contacts)
    draw_velocities(panels[2], contacts["t"], contacts)
    draw_gaps(panels[3], steps, tolerance)
    draw_times(panels[4], steps)
    t = steps["t"]
    margin = 0.01 * (t[-1] - t[0]) or 1
    panels[-1].set(xlabel="time [s]", xlim=(t[0] - margin, t[-1] + margin))
    return figure


def draw_solve(contacts: Table) -> plt.Figure:
    figure, panels = plt.subplots(2, 1, figsize=(8, 4.6), sharex=True)
    number = np.arange(len(contacts))
    draw_impulses(panels[0], number, contacts)
    draw_velocities(panels[1], number, contacts)
    panels[1].set(xlabel="contact", xlim=(-0.5, max(0.5, len(contacts) - 0.5)))
    panels[1].xaxis.set_major_locator(MaxNLocator(integer=True))
    return figure


def draw_queries(features: Table, tolerance: float | None) -> plt.Figure:
    figure, (gaps, kinds) = plt.subplots(2, 1, figsize=(8, 4.8), height_ratios=[1.6, 1])
    gaps.set(title="Gap at the first contact", xlabel="query", ylabel="gap [m]")
    kinds.set(title="Features that meet", xlabel="contacts")
    if not len(features):
        nothing(gaps, "no contact in these queries")
        nothing(kinds, "no contact in these queries")
        return figure
    gap = features["gap"]
    log_limits(gaps, gap, np.array([tolerance or np.inf]))
    gaps.plot(features["query"], np.where(gap > 0, gap, np.nan), "o", color=PURPLE, markersize=3)
    zero = gap <= 0
    if zero.any():
        gaps.plot(features["query"][zero], np.full(zero.sum(), gaps.get_ylim()[0]), "v", color=RED, clip_on=False,
                  label="zero or less")
    if tolerance:
        gaps.axhline(tolerance, color=GREY, linestyle="--", linewidth=1, label=f"tolerance, {tolerance:g} m")
    gaps.xaxis.set_major_locator(MaxNLocator(integer=True))
    count = Counter(f"{a} – {b}" for a, b in zip(features.text("kind_a"), features.text("kind_b")))
    names = sorted(count, key=lambda name: (count[name], name))
    bars = kinds.barh(names, [count[name] for name in names], color=BLUE, height=0.6)
    kinds.bar_label(bars, padding=3, fontsize=8.5)
    kinds.xaxis.set_major_locator(MaxNLocator(integer=True))
    kinds.grid(axis="y", visible=False)
    return figure


def draw(run: Path) -> plt.Figure:
    steps, contacts, features = (table_if_there(run / f"{name}.csv") for name in ("steps", "contacts", "features"))
    tolerance = tolerance_of(run)
    if steps is not None:
        if not len(steps):
            raise PlotError(f"{steps.file}: no rows")
        figure = draw_run(steps, contacts if contacts is not None else Table(run / "contacts.csv"), tolerance)
    elif contacts is not None:
        figure = draw_solve(contacts)
    elif features is not None:
        figure = draw_queries(features, tolerance)
    else:
        raise PlotError(f"{run}: none of steps.csv, contacts.csv, features.csv is there: not a run's folder?")
    for axes in figure.axes:
        if axes.get_legend_handles_labels()[1]:
            axes.legend(loc="lower right", ncols=4, bbox_to_anchor=(1.01, 0.97), borderaxespad=0.2)
    return figure


if __name__ == "__main__":
    plot_main(draw, "contacts", __doc__)
