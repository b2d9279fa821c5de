"""Chapter 4's drawings, each from a run of a small scene.

Reads the tables that build/bin/ch04_pictures --part all has written into RUN_DIR. Writes one picture for each name into the
folder --out.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import numpy as np
from matplotlib.patches import Rectangle

from drawing_program import draw
from sketch import DARK, PALE, arrow, ball, bare, body, box, note
from style import BLUE, GREY, ORANGE, RED, SKY, Table, log_limits, plt

NAMES = "ABCDE"


def clocks(runs: Path) -> plt.Figure:
    """Four bodies' time lines in a frame of a second."""
    table = Table(runs / "clocks.csv")
    rows = list(zip(table.text("what"), table["now"], table["a"].astype(int), table["b"].astype(int), table["time"]))
    figure, axes = plt.subplots(figsize=(9.2, 4.1))
    axes.axis("off")
    y = {0: 3.0, 1: 2.0, 2: 1.0, 3: 0.0}
    new = {k: [0.0] + [now for what, now, a, _, _ in rows if what == "new" and a == k] + [1.0] for k in y}
    for k, times in new.items():
        note(axes, (-0.035, y[k]), f"ball {NAMES[k]}", ha="right", fontsize=10)
        for start, end in zip(times, times[1:]):
            axes.plot([start, end], [y[k], y[k]], color=BLUE, lw=2.6, solid_capstyle="butt", zorder=2)
        for t in times:
            axes.plot([t, t], [y[k] - 0.11, y[k] + 0.11], color=BLUE, lw=2.2, zorder=3)
    shift: dict[float, int] = {}
    void_noted = False
    happened = {(a, b, time) for what, _, a, b, time in rows if what == "contact"}
    for what, now, a, b, time in rows:
        if what in ("clear", "event"):
            x = now + 0.011 + 0.0125 * shift.setdefault(now, 0)
            shift[now] += 1
            axes.plot([x, x], [y[a], y[b]], color=GREY, lw=0.9, zorder=1)
            axes.plot([x, x], [y[a], y[b]], "o", ms=4, mfc="white", mec=GREY, zorder=4, lw=0)
        if what == "event" and (a, b, time) not in happened:
            axes.plot([time, time], [y[a], y[b]], color=ORANGE, lw=1.3, ls="--", zorder=1)
            axes.plot(time, y[a] - 0.62, "x", color=ORANGE, ms=9, mew=2, zorder=5)
            if not void_noted:
                note(axes, (time + 0.014, y[a] - 0.62), "void: A has\na new motion", ORANGE, ha="left")
                void_noted = True
        if what == "contact":
            axes.plot([time, time], [y[a], y[b]], color=RED, lw=2.4, zorder=4)
            axes.plot([time, time], [y[a], y[b]], "o", color=RED, ms=5.5, zorder=5)
            note(axes, (time, 3.34), f"{NAMES[a]} hits {NAMES[b]}\n{time:.3f} s", RED)
    note(axes, (0.5, -0.27), "D: its pairs are queried, it is never hit, and its state is moved once, at the frame's end", BLUE)
    for x, text in ((0, "frame begins"), (1, "frame ends")):
        axes.plot([x, x], [-0.5, 3.3], color="#BBBBBB", lw=0.8, zorder=0)
        note(axes, (x, -0.62), text, GREY)
    key = -1.0
    for x, mark, text in ((0.02, dict(marker="o", mfc="white", mec=GREY, ms=5), "pair queried"), (0.24, dict(marker="|", color=BLUE, ms=11, mew=2.2), "the body's state is moved to here"),
                          (0.6, dict(marker="o", color=RED, ms=6), "contact solved"), (0.83, dict(marker="x", color=ORANGE, ms=7, mew=2), "event that became void")):
        axes.plot(x, key, ls="none", clip_on=False, **mark)
        note(axes, (x + 0.015, key), text, ha="left", fontsize=8.5)
    axes.set(xlim=(-0.12, 1.06), ylim=(-1.15, 3.6))
    return figure


def gap_rule(runs: Path) -> plt.Figure:
    """A row of gaps: those of a ball that comes to rest, one impact upon the other."""
    table = Table(runs / "gaps.csv")
    rests = table["restitution"] == 0
    gaps = 1e6 * table["gap"][rests]
    bounces = 1e6 * table["gap"][~rests]
    figure, (row, plot) = plt.subplots(1, 2, figsize=(9.2, 3.7), width_ratios=(2.1, 1))
    row.axis("off")
    wide = 1.0
    shown = [1.45, *gaps[:4], gaps[6]]
    row.add_patch(Rectangle((-0.55, -0.25), 6.6, 0.25, fc=PALE, ec=DARK, lw=1))
    row.plot([-0.55, 6.0], [1, 1], color=GREY, lw=1, ls=":")
    note(row, (-0.6, 1), "τ", GREY, ha="right", fontsize=11)
    texts = ["far:\nstop at τ/2", "g = τ/2:\nstop at g/2", "g = τ/4:\nstop at g/2", "g = τ/8:\nstop at g/2", "g = τ/16:\nstop at g/2", "g = τ/128:\nspent, frozen"]
    angle = np.linspace(-0.9, 0.9, 60)
    for k, gap in enumerate(shown):
        x = k * 1.1
        arc = np.stack([x + 0.5 * np.sin(angle), gap + 0.36 * (1 - np.cos(angle)) / (1 - np.cos(0.9))], axis=1)
        corners = np.vstack([arc, [x + 0.39, gap + 0.4], [x - 0.39, gap + 0.4]])
        body(row, corners, "white", RED if k == 5 else DARK)
        target = 0.5 * min(gap, 1)
        if k < 5:
            arrow(row, (x, gap), (x, target), BLUE, 1.3, mutation_scale=9) if gap - target > 0.08 else None
            row.plot([x - 0.42, x + 0.42], [target, target], color=BLUE, lw=1.4)
        if k < 3:
            note(row, (x + 0.46, target + 0.03), f"{target:.2g}", BLUE, fontsize=8, ha="left")
        note(row, (x, -0.56), texts[k], RED if k == 5 else DARK, fontsize=8.5)
    row.text(-0.6, 2.05, "One impact upon the other, with τ = 1 µm (gaps in µm)", fontsize=10, fontweight="bold", color="black", va="center")
    row.set(xlim=(-0.75, 6.05), ylim=(-0.95, 2.15))
    plot.plot(np.arange(1, len(gaps) + 1), gaps, "o", color=BLUE, ms=5)
    plot.plot(np.arange(1, len(bounces) + 1), bounces, "s", mfc="white", mec=ORANGE, ms=6)
    log_limits(plot, np.array([0.005, 2.0]))
    plot.axhline(1, color=GREY, lw=1, ls=":")
    plot.axhline(0.01, color=RED, lw=1, ls="--")
    note(plot, (len(gaps) + 0.4, 1.25), "τ", GREY, ha="right", va="bottom")
    note(plot, (0.7, 0.0086), "τ/100: nothing left to spend", RED, ha="left", va="top", fontsize=8.5)
    note(plot, (6.1, 0.3), "bounces away\nin between", ORANGE, va="center")
    note(plot, (2.2, 0.05), "comes back\nat once", BLUE)
    plot.set(title="The gap at each impact [µm]", xlabel="impact", xlim=(0.5, len(gaps) + 0.6), ylim=(0.0045, 3))
    return figure


def bounce(runs: Path) -> plt.Figure:
    """A bouncing ball: from contact to contact, and in fixed steps."""
    table = Table(runs / "bounce.csv")
    what = np.array(table.text("what"))
    t, height = table["t"], table["height"]
    figure, panels = plt.subplots(1, 2, figsize=(9.2, 3.4), sharey=True)
    path, contact, steps = what == "path", what == "contact", what == "steps"
    for axes in panels:
        axes.axhspan(-1, 0, color=PALE, lw=0)
        axes.axhline(0, color=DARK, lw=1)
        axes.set(xlabel="t [s]", ylim=(-0.68, 2.1), xlim=(0, t[path][-1]))
        axes.grid(False)
    left, right = panels
    left.plot(t[path], height[path], color=BLUE)
    left.plot(t[contact], np.zeros(np.sum(contact)), "o", color=RED, ms=7, zorder=5)
    note(left, (0.5 * (t[contact][0] + t[contact][1]), -0.3), f"{np.sum(contact)} contacts at their own times, and no gap below 0", RED, ha="center")
    left.set(title="From contact to contact", ylabel="gap to the floor [m]")
    right.plot(t[path], height[path], color=BLUE, lw=1, alpha=0.5)
    right.plot(t[steps], height[steps], "o-", color=ORANGE, ms=4.5, lw=1)
    deep = np.argmin(height[steps])
    right.plot([t[steps][deep]] * 2, [0, height[steps][deep]], color=RED, lw=2.2)
    note(right, (t[steps][deep] + 0.07, -0.33), f"{-height[steps][deep]:.2f} m inside\nthe floor", RED, ha="left", va="center")
    last = np.abs(np.interp(t[steps][-1], t[path], height[path]) - height[steps][-1])
    note(right, (t[steps][-1] - 0.03, 1.45), f"off by {last:.2f} m\nafter {t[steps][-1]:.1f} s", ORANGE, ha="right")
    right.set_title("Fixed steps of 0.14 s (line: where it should be)")
    return figure


def boxes(runs: Path) -> plt.Figure:
    """Swept boxes of a frame, and after the first impact in it."""
    table, pairs = Table(runs / "boxes.csv"), Table(runs / "pairs.csv")
    figure, panels = plt.subplots(1, 2, figsize=(9.2, 4.0), sharex=True, sharey=True)
    for moment, axes in enumerate(panels):
        here = table["moment"] == moment
        now = table["now"][here][0]
        bare(axes, "At the frame's start" if moment == 0 else f"After the impact at {now:.2f} s")
        start, end, low, high = (table.vectors(*names)[here] for names in (("x", "y"), ("x_end", "y_end"), ("x_low", "y_low"), ("x_high", "y_high")))
        before = table.vectors("x_end", "y_end")[table["moment"] == 0]
        for k in range(len(start)):
            hit = moment == 1 and not np.allclose(end[k], before[k])
            colour = BLUE if moment == 0 or hit else SKY
            axes.add_patch(Rectangle(low[k], *(high[k] - low[k]), fc=colour, ec=colour, alpha=0.10, lw=0))
            axes.add_patch(Rectangle(low[k], *(high[k] - low[k]), fill=False, ec=colour, lw=1.6 if colour == BLUE else 1, ls="-" if colour == BLUE else "--"))
            if k == 3:  # a rod that turns: 3 rad/s
                body(axes, box(start[k], (1.2, 0.2), 3 * now), "white")
                body(axes, box(end[k], (1.2, 0.2), 3.0), "none", GREY, ls=":")
            else:
                ball(axes, start[k], 0.4, "white")
                ball(axes, end[k], 0.4, "none", GREY, ls=":")
            arrow(axes, start[k], end[k], DARK, 1.1)
            note(axes, start[k] + np.array([-0.16, 0.17]) * (k != 3) + np.array([-0.35, -0.3]) * (k == 3), NAMES[k], fontsize=9, fontweight="bold")
        chosen = pairs["moment"] == moment
        for a, b in zip(pairs["a"][chosen].astype(int), pairs["b"][chosen].astype(int)):
            bend = 0.18 if b - a > 1 else 0
            axes.annotate("", xy=start[b], xytext=start[a], arrowprops={"arrowstyle": "-", "color": ORANGE, "lw": 2.2, "connectionstyle": f"arc3,rad={bend}", "shrinkA": 9, "shrinkB": 9})
        names = ", ".join(f"{NAMES[a]}{NAMES[b]}" for a, b in zip(pairs["a"][chosen].astype(int), pairs["b"][chosen].astype(int)))
        note(axes, (0.5 * (table["x_low"].min() + table["x_high"].max()), table["y_low"].min() - 0.45),
             f"boxes overlap, pairs queried: {names}" if moment == 0 else f"new boxes of A and B; open pairs: {names}", ORANGE)
        axes.set(xlim=(table["x_low"].min() - 0.1, table["x_high"].max() + 0.1), ylim=(table["y_low"].min() - 0.75, table["y_high"].max() + 0.1))
    return figure


def island(runs: Path) -> plt.Figure:
    """One instant's impact: which bodies it reaches, and with which impulses."""
    bodies, contacts = Table(runs / "island.csv"), Table(runs / "island_contacts.csv")
    figure, axes = plt.subplots(figsize=(9.2, 3.9))
    bare(axes)
    place, velocity = bodies.vectors("x", "y"), bodies.vectors("vx", "vy")
    for k, (x, y) in enumerate(place):
        member = bodies["member"][k] > 0
        ball(axes, (x, y), 0.5, "#FFE9BF" if member else PALE, ORANGE if member else GREY, lw=1.6)
        if np.linalg.norm(velocity[k]) > 0.05:
            arrow(axes, (x, y), (x, y) + 0.45 * velocity[k], BLUE if member else GREY, 1.5)
    largest = contacts["impulse"].max()
    for x, y, impulse, a, b in zip(contacts["x"], contacts["y"], contacts["impulse"], contacts["a"].astype(int), contacts["b"].astype(int)):
        if impulse > 1e-9:
            along = (place[b] - place[a]) / np.linalg.norm(place[b] - place[a]) * 0.42 * (impulse / largest) ** 0.5
            axes.plot(*np.stack([[x, y] - along, [x, y] + along]).T, color=RED, lw=5 * impulse / largest + 1, solid_capstyle="round", zorder=4)
        axes.plot(x, y, "o", ms=5.5, mfc=RED if impulse > 1e-9 else "white", mec=RED, zorder=5)
    right = 5.0
    for y, mark, text in ((1.5, dict(marker="o", mfc="#FFE9BF", mec=ORANGE, ms=11), f"in the island ({int(bodies['member'].sum())} bodies)"),
                          (0.95, dict(marker="o", mfc=PALE, mec=GREY, ms=11), "touches nothing: left alone"),
                          (0.4, dict(marker="o", mfc=RED, mec=RED, ms=6), "contact; the bar is its impulse"),
                          (-0.15, dict(marker="o", mfc="white", mec=RED, ms=6), "contact without an impulse"),
                          (-0.7, dict(marker=r"$\rightarrow$", color=BLUE, ms=12), "velocity afterwards")):
        axes.plot(right, y, ls="none", **mark)
        note(axes, (right + 0.22, y), text, ha="left")
    axes.set(xlim=(-2.3, 8.3), ylim=(-2.55, 1.95))
    return figure


def frozen(runs: Path) -> plt.Figure:
    """The end of a bouncing ball: arcs, frozen parts of frames, lost time."""
    frames, impacts = Table(runs / "frozen.csv"), Table(runs / "frozen_impacts.csv")
    dt, gravity = frames["t"][0], 9.81
    fall = np.sqrt(0.6 / gravity)
    limit = fall * (1 + 0.7) / (1 - 0.7)
    begin = 1.1
    figure, (height, lost) = plt.subplots(2, 1, figsize=(9.2, 4.2), height_ratios=(2.2, 1), sharex=True)
    for t, lost_time in zip(frames["t"], frames["lost_time"]):
        for axes in (height, lost):
            axes.axvline(t, color="#DDDDDD", lw=0.8, zorder=0)
            if lost_time > 0:
                axes.axvspan(t - lost_time, t, color="#FBE3D6", lw=0, zorder=0)
    ends = [*impacts["t"][1:], frames["t"][-1]]
    for start, end, gap, speed in zip(impacts["t"], ends, impacts["gap"], impacts["v_after"]):
        frame_end = dt * np.ceil((start + 1e-12) / dt)
        lost_here = frames["lost_time"][min(int(round(frame_end / dt)) - 1, len(frames) - 1)]
        stop = min(end, frame_end - lost_here) if lost_here > 0 else end
        if stop <= start:
            continue
        t = np.linspace(start, stop, 40)
        height.plot(t, 1000 * (gap + speed * (t - start) - 0.5 * gravity * (t - start) ** 2), color=BLUE, lw=1.4)
    height.plot(impacts["t"], 1000 * impacts["gap"], "o", color=BLUE, ms=3)
    for axes in (height, lost):
        axes.axvline(limit, color=ORANGE, ls="--", lw=1.3)
        axes.grid(False)
    note(height, (limit - 0.006, 5.6), f"infinitely many bounces\nend here: {limit:.3f} s", ORANGE, ha="right")
    first = int(np.argmax(frames["lost_time"] > 0))
    note(height, (0.5 * (frames["t"][-1] + limit), 5.6), "frozen: it keeps its velocity,\nand does not follow it", RED)
    height.set(ylabel="gap [mm]", ylim=(-0.3, 7.2), title="A ball with ε = 0.7 that falls from 0.3 m (grey lines: ends of frames)")
    lost.bar(frames["t"] - dt / 2, 1000 * frames["lost_time"], width=0.86 * dt, color=RED, alpha=0.75)
    lost.axhline(1000 * dt, color=GREY, lw=1, ls=":")
    note(lost, (begin + 0.005, 1000 * dt - 5.5), "a whole frame", GREY, ha="left")
    lost.set(xlabel="t [s]", ylabel="lost time [ms]", xlim=(begin, frames["t"][-1]), ylim=(0, 1150 * dt),
             title=f"Lost: {frames['lost_time'].sum():.2f} s in all, from the frame that ends at {frames['t'][first]:.2f} s on")
    return figure


DRAWINGS = {"clocks": clocks, "gap_rule": gap_rule, "bounce": bounce, "boxes": boxes, "island": island, "frozen": frozen}


if __name__ == "__main__":
    draw(__doc__, DRAWINGS)
