"""Chapter 5's drawings of bodies in contact, each from a run of a small scene. Drawn by ch05_drawings.py."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import FancyBboxPatch

from sketch import DARK, PALE, arrow, ball, bare, body, box, note
from style import BLUE, GREEN, GREY, ORANGE, RED, Table, rests_of

GRAVITY = 9.81


def arcs(contacts: Table, first: tuple[float, float], until: float) -> list[tuple[np.ndarray, np.ndarray]]:
    """A bouncing ball's height over each touch, from its contacts: time and gap of each flight. first: height and time."""
    flights = []
    height, start = first
    speed = 0.0
    for end, gap, after in zip([*contacts["t"], until], [*contacts["gap"], 0], [*contacts["v_after"], 0]):
        t = np.linspace(start, end, 60)
        flights.append((t, height + speed * (t - start) - 0.5 * GRAVITY * (t - start) ** 2))
        height, start, speed = gap, end, after
    return flights


def zeno(runs: Path) -> plt.Figure:
    contacts = Table(runs / "bounces/contacts.csv")
    end = Table(runs / "bounces/steps.csv")["t"][-1]
    lost = np.sum(Table(runs / "bounces/steps.csv")["lost_time"])
    fall = np.sqrt(2 / GRAVITY)
    limit = 3 * fall
    figure, (height, ticks) = plt.subplots(2, 1, figsize=(9.2, 3.9), height_ratios=(3, 1), sharex=True)
    for t, h in arcs(contacts, (1, 0), end)[:-1]:
        height.plot(t, h, color=BLUE)
    frozen = end - lost
    for axes in (height, ticks):
        axes.axvspan(frozen, end, color=PALE, lw=0)
        axes.axvline(limit, color=ORANGE, ls="--", lw=1.2)
    note(height, (0.5 * (frozen + end), 0.5), "frozen:\ntime is lost", GREY)
    note(height, (limit - 0.012, 0.86), f"Zeno's time, {limit:.3f} s", ORANGE, ha="right")
    height.set(title="A ball with ε = ½ that falls from a metre, in chapter 4", ylabel="height [m]", xlim=(0, end), ylim=(-0.03, 1.05))
    ticks.vlines(contacts["t"], 0, 1, color=BLUE, lw=1)
    ticks.set(xlabel="t [s]", yticks=[], ylim=(0, 1), title=f"Its {len(contacts)} impacts")
    ticks.grid(False)
    return figure


def last_bounce(runs: Path) -> plt.Figure:
    contacts, steps, poses = (Table(runs / f"ball/{name}.csv") for name in ("contacts", "steps", "poses"))
    rests = rests_of(contacts)
    width = 0.6  # mm: h
    figure, axes = plt.subplots(figsize=(9.2, 3.4))
    impacts = int(np.sum(~rests))
    rest = contacts["t"][rests][0]
    axes.axhspan(0, width, color=PALE, lw=0)
    axes.axhline(width / 2, color=GREEN, lw=1, ls="--")
    axes.axhline(width / 4, color=RED, lw=1, ls=":")
    flights = arcs(contacts, (1, 0), rest)
    for t, h in flights[1:impacts + 1]:
        axes.plot(t, 1000 * h, color=BLUE)
    moving = poses["body"] == 1
    t, gap = poses["t"][moving], 1000 * (poses["pz"][moving] - 0.5)
    later = t >= rest - 1e-6
    axes.plot(t[later], gap[later], "-", color=BLUE)
    axes.plot(t, gap, "o", color=BLUE, ms=3.5)
    for x in steps["t"]:
        axes.axvline(x, color="#E0E0E0", lw=0.7, zorder=0)
    limit = 3 * np.sqrt(2 / GRAVITY)
    axes.axvline(limit, color=ORANGE, ls="--", lw=1.2)
    note(axes, (limit + 0.001, 0.93), "Zeno's time", ORANGE, ha="left")
    right = 1.4495
    for y, text, colour in ((width, "h", DARK), (width / 2, "h/2: rest gap", GREEN), (width / 4, "h/4: stopped here", RED)):
        note(axes, (right, y + 0.035), text, colour, ha="right")
    last = contacts["t"][impacts - 1]
    note(axes, (last + 0.0015, 0.07), f"the last impact that bounces: the ball leaves with {contacts['v_after'][impacts - 1]:.3f} m/s", ha="left", bbox={"fc": PALE, "ec": "none", "pad": 0.8})
    axes.annotate("comes in slower than h/Δt:\na plan takes over", (rest, gap[later][0]), (rest + 0.024, 0.78), fontsize=9, color=DARK, ha="left",
                  va="center", arrowprops={"arrowstyle": "-", "color": GREY, "lw": 0.8})
    axes.set(xlim=(1.225, 1.45), ylim=(0, 1.1), xlabel="t [s]", ylabel="gap [mm]", title="The ball's last bounces with a margin h = 0.6 mm (lines: ends of frames)")
    axes.grid(False)
    return figure


def clipped(polygon: np.ndarray, by: np.ndarray, sides: int) -> np.ndarray:
    """Sutherland and Hodgman: what of a convex polygon lies inside the first `sides` sides of another one, anticlockwise."""
    for i in range(sides):
        start, along = by[i], by[(i + 1) % len(by)] - by[i]
        inside = along[0] * (polygon[:, 1] - start[1]) - along[1] * (polygon[:, 0] - start[0])
        kept = []
        for k in range(len(polygon)):
            j = (k + 1) % len(polygon)
            if inside[k] >= 0:
                kept.append(polygon[k])
            if (inside[k] >= 0) != (inside[j] >= 0):
                kept.append(polygon[k] + inside[k] / (inside[k] - inside[j]) * (polygon[j] - polygon[k]))
        polygon = np.array(kept)
    return polygon


def clipping(runs: Path) -> plt.Figure:
    contacts, poses = Table(runs / "turned/contacts.csv"), Table(runs / "turned/poses.csv")
    row = 1  # the upper cube's first
    upper = box((poses["px"][row], poses["py"][row]), (1, 1), 2 * np.arctan2(poses["qz"][row], poses["qw"][row]))
    lower = box((0, 0), (1, 1))
    figure, panels = plt.subplots(1, 3, figsize=(9.2, 3.5))
    for axes, sides, title in zip(panels, (0, 2, 4), ("1  two faces, seen from above", "2  cut by two sides", "3  cut by all four")):
        bare(axes, title)
        body(axes, lower, "none", BLUE, lw=1.8)
        body(axes, upper, "none", ORANGE, lw=1.8, ls="-" if sides == 0 else ":")
        if sides:
            cut = clipped(upper, lower, sides)
            body(axes, cut, "#FFE9BF", ORANGE, lw=1.6)
            for i in range(sides):
                axes.plot(*np.array([lower[i], lower[(i + 1) % 4]]).T, color=BLUE, lw=3)
        axes.set(xlim=(-0.72, 0.8), ylim=(-0.82, 0.76))
    note(panels[0], (0.16, -0.58), "lower face", BLUE, ha="left")
    note(panels[0], (0.3, 0.66), "upper face", ORANGE, ha="left")
    corners = clipped(upper, lower, 4)
    panels[2].plot(*corners.T, "o", mfc="white", mec=DARK, ms=6, zorder=5)
    start = contacts["t"] == 0
    for x, y, push in zip(contacts["x"][start], contacts["y"][start], contacts["impulse"][start]):
        panels[2].plot(x, y, "o", color=DARK, ms=6, zorder=6)
        nearest = np.array([x, y])
        note(panels[2], nearest + 0.13 * np.sign(nearest) * np.array([1.1, 0]) + np.array([0, 0.05 if y > 0 else -0.05]), f"{push:.2f}", DARK, fontsize=8.5)
    note(panels[2], (0.04, -0.76), "● pushes (N s in a frame)    ○ does not", DARK, fontsize=8)
    return figure


def islands(runs: Path) -> plt.Figure:
    contacts, poses = Table(runs / "islands/contacts.csv"), Table(runs / "islands/poses.csv")
    sizes = {0: (12, 1), 1: (1, 1), 2: (1, 1), 3: (1, 1), 4: (1, 1), 5: (3.4, 0.5)}  # m, as the scene has them
    radius = 0.5
    count = int(np.max(poses["body"])) + 1
    place = np.stack([poses["px"][:count], poses["pz"][:count]], axis=1)
    start = contacts["t"] == 0
    pairs = {(int(a), int(b)) for a, b in zip(contacts["body_a"][start], contacts["body_b"][start])}
    island = list(range(count))
    for a, b in pairs:  # body 0, the floor, connects nothing
        if a != 0:
            island = [island[a] if i == island[b] else i for i in island]
    figure, axes = plt.subplots(figsize=(9.2, 3.7))
    bare(axes)
    for number, size in sizes.items():
        body(axes, box(place[number], size), "white" if number else PALE)
        if number:
            note(axes, place[number], str(number))
    ball(axes, place[6], radius, "white")
    note(axes, place[6], "6")
    for number, colour in zip(sorted(set(island[1:])), (BLUE, ORANGE, GREY)):
        members = [i for i in range(1, count) if island[i] == number]
        if len(members) == 1:
            continue
        low = np.min([place[i] - 0.5 * np.array(sizes[i]) for i in members], axis=0) - 0.17
        high = np.max([place[i] + 0.5 * np.array(sizes[i]) for i in members], axis=0) + 0.17
        low[1] = 0.05
        axes.add_patch(FancyBboxPatch(low, *(high - low), boxstyle="round,pad=0,rounding_size=0.2", fill=False, ec=colour, lw=2, ls="--"))
        note(axes, (0.5 * (low[0] + high[0]), high[1] + 0.22), "island of " + ", ".join(str(i) for i in members), colour)
    for x, z, a in zip(contacts["x"][start], contacts["z"][start], contacts["body_a"][start]):
        axes.plot(x, z, "o", color=GREEN if a else GREY, ms=5, zorder=5)
    arrow(axes, place[6] - [0, 0.55], place[6] - [0, 1.15], GREY)
    note(axes, place[6] + [0, 0.78], "flies", GREY)
    note(axes, (0, -0.3), "0: the floor, a member of both islands, connects nothing")
    axes.set(xlim=(-6.1, 6.1), ylim=(-0.6, 2.75))
    return figure


def knocked(runs: Path) -> plt.Figure:
    events, plans = Table(runs / "knocked/events/poses.csv"), Table(runs / "knocked/plans/poses.csv")
    hit, struck, boxes, size = 7, 2, 6, np.array([1.2, 0.5])  # the numbers of the ball and of the box that it hits
    figure = plt.figure(figsize=(9.2, 4.7))
    grid = figure.add_gridspec(2, 4, height_ratios=(1.25, 1))
    for column, (poses, time, title) in enumerate(((events, 1.2, "Chapter 4, after 1.2 s"), (plans, 0.2, "With plans, after 0.2 s"),
                                                   (plans, 0.45, "0.45 s"), (plans, 1.2, "1.2 s"))):
        axes = figure.add_subplot(grid[0, column])
        bare(axes, title)
        axes.add_patch(plt.Rectangle((-2, -0.2), 6, 0.2, fc="#D8D8D8", ec="none"))
        axes.plot([-2, 4], [0, 0], color=DARK, lw=1.3)
        now = np.abs(poses["t"] - time) < 1e-6
        for number in range(1, boxes + 1):
            this = now & (poses["body"] == number)
            # A turn about y is clockwise, as seen with x to the right and z up.
            angle = -2 * np.arctan2(poses["qy"][this][0], poses["qw"][this][0])
            face, edge = ("#FFE9BF", ORANGE) if number == struck else ("#CFE3F1", BLUE)
            body(axes, box((poses["px"][this][0], poses["pz"][this][0]), size, angle), face, edge)
        this = now & (poses["body"] == hit)
        ball(axes, (poses["px"][this][0], poses["pz"][this][0]), 0.25, "white", RED)
        axes.set(xlim=(-1.95, 2.35), ylim=(-0.2, 3.1))
    for column, title, table, name in ((0, "Height of the top box [m]", "poses.csv", "pz"), (2, "Lost time, summed up [s]", "steps.csv", "lost_time")):
        axes = figure.add_subplot(grid[1, column:column + 2])
        for run, colour in (("events", GREY), ("plans", BLUE)):
            data = Table(runs / "knocked" / run / table)
            of_top = data["body"] == boxes if name == "pz" else np.ones(len(data), bool)
            axes.plot(data["t"][of_top], data[name][of_top] if name == "pz" else np.cumsum(data[name]), color=colour, lw=2)
        axes.set(title=title, xlabel="t [s]", xlim=(0, 1.22))
        if name == "pz":
            axes.set(ylim=(2.15, 2.85))
            note(axes, (0.9, 2.69), "chapter 4", GREY)
            note(axes, (0.9, 2.31), "with plans", BLUE)
        else:
            axes.set(ylim=(-0.1, 1.3))
            note(axes, (0.62, 0.85), "chapter 4", GREY, ha="right")
            note(axes, (0.9, 0.1), "with plans", BLUE)
    return figure


def frame(runs: Path) -> plt.Figure:
    contacts = Table(runs / "frame/contacts.csv")
    end = Table(runs / "frame/steps.csv")["t"][-1]
    hit = contacts["t"][~rests_of(contacts)][0]
    assert {int(contacts["body_a"][0]), int(contacts["body_b"][0])} == {2, 4}
    figure, axes = plt.subplots(figsize=(9.2, 3.7))
    rows = ["the ball that falls", "upper box", "lower box", "a box beside them", "a ball that passes"]
    for y, name in zip(range(4, -1, -1), rows):
        note(axes, (-0.002, y), name, ha="right")
    def bar(y0, y1, t0, t1, colour, text):
        axes.add_patch(FancyBboxPatch((t0 + 0.0005, y0 - 0.3), t1 - t0 - 0.001, y1 - y0 + 0.6, boxstyle="round,pad=0,rounding_size=0.0012", mutation_aspect=200,
                                      fc=colour, ec="none", alpha=0.28))
        note(axes, (0.5 * (t0 + t1), 0.5 * (y0 + y1)), text)
    def flight(y, t0, t1):
        t = np.linspace(t0, t1, 200)
        axes.plot(t, y + 0.1 * np.sin(2 * np.pi * (t - t0) / 0.01), color=GREY, lw=1.2)
    flight(4, 0, hit)
    flight(4, hit, end)
    flight(0, 0, end)
    note(axes, (0.03, 4.33), "flies", GREY)
    note(axes, (0.08, 4.33), "flies, with another velocity", GREY)
    note(axes, (0.05, 0.36), "flies, with no new query", GREY)
    bar(2, 3, 0, hit, BLUE, "plan 1: cut here, it has given\nthis share of its impulses")
    bar(2, 3, hit, end, GREEN, "plan 3")
    bar(1, 1, 0, end, ORANGE, "plan 2: undisturbed to the frame's end")
    axes.plot([hit, hit], [1.65, 4.15], color=RED, lw=1.6)
    note(axes, (hit, 1.52), f"they meet at {1000 * hit:.1f} ms: the instant's law", RED, ha="center", va="top", fontsize=8.5,
         bbox={"fc": "white", "ec": "none", "pad": 0.6})
    axes.set(xlim=(-0.0005, end + 0.0005), ylim=(-0.5, 4.6), yticks=[], xlabel="t [s], in one frame of 0.1 s")
    axes.spines["left"].set_visible(False)
    axes.grid(False)
    for x in (0, end):
        axes.axvline(x, color="#BBBBBB", lw=0.8)
    return figure


def correction(runs: Path) -> plt.Figure:
    poses, steps = Table(runs / "touching/poses.csv"), Table(runs / "touching/steps.csv")
    moving = poses["body"] == 1
    gap = 1000 * (poses["pz"][moving] - 0.5)
    frames = np.arange(len(gap))
    dt, width, mass = steps["t"][1], 0.5, 2.0
    # Baumgarte: a fifth of what is missing becomes a velocity, which the body keeps.
    velocity, wrong, energy = 0.0, [0.0], [0.0]
    for _ in frames[1:]:
        velocity = max(velocity, 0.2 * (width / 2 - wrong[-1]) / dt)
        wrong.append(wrong[-1] + dt * velocity)
        energy.append(0.5 * mass * (1e-3 * velocity) ** 2)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.2))
    left.axhspan(0, width, color=PALE, lw=0)
    left.axhline(width / 2, color=GREEN, lw=1, ls="--")
    left.plot(frames, wrong, "-", color=ORANGE)
    left.plot(frames, gap, "o", color=BLUE, ms=4)
    note(left, (15.8, 0.175), "the plan's displacements", BLUE, ha="right")
    note(left, (7.6, 0.44), "a velocity\nout of the gap", ORANGE, ha="right")
    note(left, (15.8, 0.285), "h/2", GREEN, ha="right")
    note(left, (15.8, 0.47), "h", DARK, ha="right")
    left.set(title="Gap [mm]", xlabel="frame", xlim=(-0.3, 16), ylim=(-0.02, 0.62))
    right.plot(frames, 1e6 * np.array(energy), "-", color=ORANGE)
    right.plot(frames, 1e6 * steps["kinetic"], "o", color=BLUE, ms=4)
    right.set(title="Kinetic energy [µJ]", xlabel="frame", xlim=(-0.3, 16), ylim=(-0.6, 1.15e6 * max(energy)))
    note(right, (8, 0.8), "0 J", BLUE)
    return figure


def balance(runs: Path) -> plt.Figure:
    contacts = Table(runs / "stack/contacts.csv")
    last = contacts["t"] == contacts["t"][-1]
    dt, mass, count = 1 / 60, 1.0, 10
    under = np.array([np.sum(contacts["impulse"][last][contacts["body_b"][last] == i]) for i in range(1, count + 1)])
    weight = mass * GRAVITY * dt
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.7), width_ratios=(1, 1.5))
    bare(left, "The fourth box from the top, one frame")
    body(left, box((0, 0), (1, 1)), "white")
    scale = 1.0 / under[6]
    for x, start, push, colour, text, side in ((-0.25, -0.5, under[6], BLUE, f"from below\n{under[6]:.4f} N s", "bottom"),
                                             (-0.25, 0.5, -under[7], ORANGE, f"from above\n{under[7]:.4f} N s", "top"),
                                             (0.25, 0, -weight, GREY, f"weight × Δt\n{weight:.4f} N s", "in")):
        if side == "bottom":
            arrow(left, (x, start - scale * push), (x, start), colour, 2.2)
            note(left, (x + 0.12, start - 0.55), text, colour, ha="left")
        elif side == "top":
            arrow(left, (x, start - scale * push), (x, start), colour, 2.2)
            note(left, (x + 0.12, start + 0.55), text, colour, ha="left")
        else:
            arrow(left, (x, start), (x, start + scale * push), colour, 2.2)
            note(left, (x + 0.42, start - 0.1), text, colour, ha="left")
    left.set(xlim=(-0.8, 1.7), ylim=(-1.65, 1.5))
    levels = np.arange(1, count + 1)
    right.barh(levels, under, color=BLUE, height=0.6, alpha=0.75)
    right.plot(weight * (count + 1 - levels), levels, "D", color=ORANGE, ms=5)
    note(right, (0.85, 9.3), "bars: what contacts.csv says", BLUE, ha="left")
    note(right, (0.85, 8.2), "diamonds: the weight above × Δt", ORANGE, ha="left")
    right.set(title="Impulse under each box of the stack, one frame [N s]", ylabel="box, from below", yticks=levels[::3])
    return figure


DRAWINGS = {"knocked": knocked, "zeno": zeno, "last_bounce": last_bounce, "clipping": clipping, "islands": islands, "frame": frame,
            "correction": correction, "balance": balance}
