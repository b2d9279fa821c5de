"""Chapter 5's drawings of the margin, of plans and of the instant's law, from the formulas of its text; `halves` has a run's
points beside them. Drawn by ch05_drawings.py."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import FancyBboxPatch

from sketch import DARK, PALE, arrow, ball, bare, body, box, length, note, rotation
from style import BLUE, GREEN, GREY, ORANGE, RED, Table


def margin(_: Path) -> plt.Figure:
    h = 1.0
    figure, axes = plt.subplots(figsize=(9.2, 3.3))
    bare(axes, equal=False)
    axes.add_patch(plt.Rectangle((0, -0.75), 10.2, 0.75, fc="#D8D8D8", ec="none"))
    axes.plot([0, 10.2], [0, 0], color=DARK, lw=1.3)
    axes.add_patch(plt.Rectangle((0, 0), 10.2, h, fc=PALE, ec="none"))
    for y, text, colour, dashes in ((h, "h, the margin", DARK, "-"), (h / 2, "h/2, the rest gap", GREEN, "--"), (h / 4, "h/4", RED, ":")):
        axes.plot([0, 10.2], [y, y], color=colour, lw=1.2, ls=dashes)
        note(axes, (10.3, y), text, colour, ha="left")
    for x, gap, text in ((0.4, 1.3, "no contact:\nflies"), (2.9, 0.8, "in contact,\ngap above h/2:\nmay come nearer"), (5.4, 0.5, "in contact,\nat rest"),
                         (7.9, 0.25, "came in flying:\nstopped here,\nthen in contact")):
        body(axes, np.array([[x, gap], [x + 1.9, gap], [x + 1.9, 2.25], [x, 2.25]]), "white", zorder=2.5)
        note(axes, (x + 0.95, 0.5 * (gap + 2.25)), text, fontsize=8.5)
        arrow(axes, (x + 0.2, 0), (x + 0.2, gap), GREY, 0.9, "<|-|>", mutation_scale=7)
    note(axes, (5.1, -0.38), "one body of the pair")
    note(axes, (5.1, 2.5), "the other one, at four gaps")
    axes.set(xlim=(-0.1, 12.6), ylim=(-0.75, 2.65))
    return figure


def free_flight(_: Path) -> plt.Figure:
    v, g, end = 1.4, -2.0, 1.0
    t = np.linspace(0, end, 100)
    u = v + 0.5 * end * g
    figure, (place, speed) = plt.subplots(1, 2, figsize=(9.2, 3.3))
    place.plot(t, v * t + 0.5 * g * t**2, color=GREY)
    place.plot([0, end], [0, u * end], color=BLUE)
    place.plot([0, end], [0, u * end], "o", color=DARK, ms=5)
    note(place, (0.22, 0.36), "free flight", GREY, ha="right")
    note(place, (0.74, 0.2), "straight, with u", BLUE)
    place.set(title="Height", xlim=(-0.03, 1.08), ylim=(-0.05, 0.58))
    speed.plot(t, v + g * t, color=GREY)
    speed.plot([0, end], [u, u], color=BLUE)
    speed.fill_between(t, v + g * t, u, where=t <= 0.5, color=ORANGE, alpha=0.25, lw=0)
    speed.fill_between(t, v + g * t, u, where=t >= 0.5, color=ORANGE, alpha=0.25, lw=0)
    note(speed, (0.1, 1.4), "v", GREY, ha="left")
    note(speed, (0.93, -0.64), "v + Tg", GREY, ha="right")
    note(speed, (0.8, 0.53), "u = v + ½Tg", BLUE)
    note(speed, (0.02, 0.66), "u is too small\nby this area …", DARK, fontsize=8.5, ha="left")
    note(speed, (0.985, 0.16), "… and too large\nby the same", DARK, fontsize=8.5, ha="right")
    speed.set(title="Velocity", xlim=(-0.03, 1.08), ylim=(-0.75, 1.65))
    for axes in (place, speed):
        axes.set(xticks=[0, 1], xticklabels=["now", "now + T"], yticks=[])
        axes.grid(False)
    return figure


def push(_: Path) -> plt.Figure:
    figure, panels = plt.subplots(1, 3, figsize=(9.2, 3.2), sharey=True)
    for axes, title, gap, free, end, names in ((panels[0], "pushed to the rest gap", 0.85, 0.2, 0.5, ((0.5, 0.8), (0.36, 0.44))),
                                               (panels[1], "not pushed", 0.65, 0.9, 0.9, ((0.55, 0.66), None)),
                                               (panels[2], "pushed: it may not shrink", 0.3, -0.1, 0.3, ((0.45, 0.37), (0.3, 0.06)))):
        axes.axhspan(0, 1, color=PALE, lw=0)
        axes.axhline(0.5, color=GREEN, lw=1, ls="--")
        axes.axhline(0, color=DARK, lw=1.3)
        axes.plot([0, 1], [gap, end], color=BLUE, lw=2)
        if free != end:
            axes.plot([0, 1], [gap, free], color=GREY, ls="--")
            arrow(axes, (1, free), (1, end), ORANGE, 2)
            note(axes, (1.04, 0.5 * (free + end)), "by z", ORANGE, ha="left")
            note(axes, names[1], "with u", GREY)
        axes.plot([0, 1], [gap, end], "o", color=DARK, ms=5)
        note(axes, names[0], "with w" if free != end else "with w = u", BLUE)
        axes.set(title=title, xlim=(-0.06, 1.28), ylim=(-0.18, 1.2), xticks=[0, 1], xticklabels=["now", "now + T"], yticks=[0, 0.5, 1],
                 yticklabels=["0", "h/2", "h"])
        axes.grid(False)
    panels[0].set_ylabel("gap of a point")
    for axes, text in zip(panels, ("z > 0", "z = 0", "z > 0")):
        note(axes, (0.02, 1.1), text, ORANGE if text == "z > 0" else DARK, ha="left")
    return figure


def bend(_: Path) -> plt.Figure:
    figure, (scene, gap) = plt.subplots(1, 2, figsize=(9.2, 3.7))
    bare(scene, "A plank turns under a ball (drawn with ωT = 0.35)")
    turn, thick, radius, rest = 0.35, 0.16, 0.42, 0.01
    distance = 0.5 * thick + rest + radius
    body(scene, box((0, 0), (3.6, thick)), PALE, GREY, ls=":")
    body(scene, box((0, 0), (3.6, thick), turn), "#CFE3F1", BLUE)
    ball(scene, (0, distance), radius, "#FFFFFFAA")
    scene.plot([0, 0], [0, distance], "o", color=DARK, ms=4)
    normal = rotation(turn) @ [0, 1]
    arrow(scene, (0, 0), 1.35 * normal, BLUE)
    note(scene, 1.35 * normal + [-0.32, 0.05], "n at the end", BLUE)
    arrow(scene, (0, 0), (0, 1.5), GREY)
    note(scene, (0.08, 1.45), "n now", GREY, ha="left")
    foot = distance * np.cos(turn) * normal
    scene.plot([0, foot[0]], [distance, foot[1]], color=RED, lw=1, ls="--")
    note(scene, (0.08, 0.5 * distance - 0.02), "ℓ", DARK, ha="left")
    scene.plot([0, foot[0]], [0, foot[1]], color=RED, lw=3.5, zorder=6)
    note(scene, foot + [-0.16, -0.3], "ℓ cos ωT", RED, ha="right")
    arrow(scene, (1.45, 0.05), 1.48 * (rotation(turn) @ [1, 0]), BLUE, 1.2, connectionstyle="arc3,rad=0.15")
    note(scene, (1.66, 0.26), "ω", BLUE)
    scene.set(xlim=(-1.95, 1.95), ylim=(-0.75, 1.65))
    arm, spin, end = 0.1, 3.0, 1 / 60
    t = np.linspace(0, end, 200)
    s = 0.5 * arm * spin**2 * end
    stays = 1000 * (arm * np.cos(spin * t) - arm)
    parts = 1000 * ((arm + s * t) * np.cos(spin * t) - arm)
    ms = 1000 * t
    gap.axhline(0, color=GREEN, lw=1, ls="--")
    gap.plot(ms, stays, color=RED)
    gap.plot(ms, parts, color=BLUE)
    gap.plot(ms[[0, -1]], [0, parts[-1]], "o", color=DARK, ms=5)
    gap.plot(ms[-1], stays[-1], "o", color=RED, ms=5)
    length(gap, (ms[-1] + 0.7, 0), (ms[-1] + 0.7, stays[-1]), "β", (ms[-1] + 1.3, 0.5 * stays[-1]), RED)
    note(gap, (8.2, -0.065), "the ball stays", RED)
    note(gap, (8.3, 0.043), "the ball parts with s = −β/T", BLUE)
    step = 3.2e-3
    arrow(gap, (0, 0), (1000 * step, 1000 * s * step), ORANGE)
    arrow(gap, (ms[-1] - 1000 * step, 1000 * s * step), (ms[-1], 0), ORANGE)
    note(gap, (0.6, 0.036), "+s", ORANGE)
    note(gap, (16.2, 0.036), "−s", ORANGE)
    gap.set(title="Change of its gap [mm] (ℓ = 0.1 m, ω = 3 rad/s)", xlabel="t [ms]", xlim=(-0.6, 18.7), ylim=(-0.14, 0.07))
    return figure


def halves(runs: Path) -> plt.Figure:
    poses = Table(runs / "slope/poses.csv")
    figure, (rest, speed, place) = plt.subplots(1, 3, figsize=(9.2, 3.4), width_ratios=(1.7, 1, 1))
    half = -10 / 120
    x = [0, 1, 2, 6, 7, 8]
    v = [0, half, 0, 0, half, 0]
    labels = [("½Tg", GREY), ("push", BLUE), ("", DARK), ("½Tg", GREY), ("instant", ORANGE)]
    rest.axhline(0, color="#CCCCCC", lw=1)
    for k, (text, colour) in enumerate(labels):
        if text:
            arrow(rest, (x[k] + 0.5, v[k]), (x[k] + 0.5, v[k + 1]), colour, 2.4)
            note(rest, (x[k] + 0.5, -0.098), text, colour)
    rest.plot([2.2, 5.8], [0, 0], color=DARK, lw=2)
    note(rest, (4, 0.011), "the straight path: T = 1/60 s")
    note(rest, (1.72, -0.04), "1/6 N s", BLUE, ha="left", fontsize=8.5)
    note(rest, (7.72, -0.04), "1/6 N s", ORANGE, ha="left", fontsize=8.5)
    rest.set(title="A box of 2 kg at rest: its velocity [m/s]", xlim=(-0.2, 9.2), ylim=(-0.11, 0.025), xticks=[], yticks=[0, half], yticklabels=["0", "−1/12"])
    rest.grid(False)
    pull, dt = 0.5 * 9.81, 0.25
    t = np.linspace(0, 2, 100)
    speed.plot(t[t <= 1], pull * t[t <= 1], color=GREY)
    for k in range(4):
        speed.plot([k * dt, (k + 1) * dt], [pull * (k + 0.5) * dt] * 2, color=BLUE, lw=2)
    note(speed, (0.62, 1.25), "paths", BLUE)
    note(speed, (0.42, 3.5), "v", GREY)
    speed.set(title="On a slope: velocity [m/s]", xlabel="t [s]", xlim=(0, 1))
    moving = poses["body"] == 1
    place.plot(t, 0.5 * pull * t**2, color=GREY)
    place.plot(poses["t"][moving], poses["px"][moving], "o", color=BLUE, ms=4.5)
    note(place, (0.1, 8.2), "closed form", GREY, ha="left")
    note(place, (0.1, 7.2), "ends of frames\nof ¼ s", BLUE, ha="left", va="top")
    place.set(title="… and its place [m]", xlabel="t [s]", xlim=(0, 2.05))
    return figure


def turning_plane(_: Path) -> plt.Figure:
    size_a, size_b = np.array([2.0, 1.0]), np.array([1.0, 0.7])
    spin_a, spin_b, start, velocity = 0.3, -0.4, np.array([0.3, 1.15]), np.array([-0.65, 0.1])
    def gap(x):  # along A's upper face, which turns with A
        corners = box(start + x * velocity, size_b, spin_b * x)
        return np.min(corners @ (rotation(spin_a * x) @ [0, 1])) - 0.5 * size_a[1]
    x = np.linspace(0, 1, 200)
    true = np.array([gap(v) for v in x])
    reach = 0.5 * np.hypot(*size_b)
    turning = abs(spin_b - spin_a)
    seen = np.linalg.norm(velocity - spin_a * np.array([-start[1], start[0]])) + spin_a * np.linalg.norm(velocity) + turning * reach
    bent = turning * (abs(spin_a) + abs(spin_b)) * reach + spin_a**2 * (np.linalg.norm(start) + np.linalg.norm(velocity)) + 2 * spin_a * seen
    line = (1 - x) * true[0] + x * true[-1]
    figure, (scene, axes) = plt.subplots(1, 2, figsize=(9.2, 3.7))
    bare(scene, "Two boxes at both ends of their paths, and A's plane")
    for t, face, edge, ls in ((0, "none", GREY, ":"), (1, "#CFE3F1", BLUE, "-")):
        body(scene, box((0, 0), size_a, spin_a * t), face, edge, ls=ls)
        body(scene, box(start + t * velocity, size_b, spin_b * t), "none" if t == 0 else "#FFE9BF", GREY if t == 0 else ORANGE, ls=ls)
        along, normal = rotation(spin_a * t) @ [1, 0], rotation(spin_a * t) @ [0, 1]
        middle = 0.5 * size_a[1] * normal
        scene.plot(*np.array([middle - 1.75 * along, middle + 1.45 * along]).T, color=GREY if t == 0 else RED, lw=1.2, ls=":" if t == 0 else "--")
    arrow(scene, start, start + velocity, DARK, 1.2)
    note(scene, (0.05, -0.1), "A", BLUE)
    note(scene, start + velocity + [0.0, 0.14], "B", ORANGE)
    note(scene, (1.4, 1.3), "the plane\nat the end", RED)
    note(scene, (1.62, 0.38), "now", GREY)
    scene.set(xlim=(-1.85, 1.8), ylim=(-0.9, 1.95))
    axes.plot(x, true, color=BLUE)
    axes.plot(x, line, color=GREY, ls=":")
    axes.plot(x, line - 0.5 * bent * x * (1 - x), color=RED, ls="--")
    axes.axhline(0, color=DARK, lw=1.2)
    axes.plot([0, 1], [true[0], true[-1]], "o", color=DARK, ms=5)
    length(axes, (0.5, line[100]), (0.5, line[100] - bent / 8), "", (0, 0))
    note(axes, (0.48, line[100] - 0.016), "the sag", ha="right")
    note(axes, (0.03, true[0] + 0.006), "σ₀", ha="left")
    note(axes, (0.985, true[-1] + 0.02), "σ₁", ha="right")
    note(axes, (0.78, true[155] - 0.014), "the gap", BLUE)
    note(axes, (0.13, line[40] - 0.08 * bent - 0.02), "proved", RED)
    axes.set(title="Gap along that plane", xlabel="part x of the time", xlim=(-0.03, 1.03), ylim=(-0.015, true[0] + 0.03))
    return figure


def unproved(_: Path) -> plt.Figure:
    figure, axes = plt.subplots(figsize=(9.2, 4.3))
    bare(axes, equal=False)
    def cell(x, y, text, colour=DARK, face="white", width=2.5, height=0.86):
        axes.add_patch(FancyBboxPatch((x - 0.5 * width, y - 0.5 * height), width, height, boxstyle="round,pad=0,rounding_size=0.12", fc=face, ec=colour, lw=1.3))
        note(axes, (x, y), text, fontsize=8.7)
    def to(start, end, text="", where=(0, 0), **more):
        arrow(axes, start, end, GREY, 1.2)
        if text:
            note(axes, where, text, GREY, fontsize=8.5, **more)
    cell(1.35, 4.3, "1  too slow to meet\nin the time T")
    cell(4.35, 4.3, "2  one plane keeps\nthem apart")
    cell(7.35, 4.3, "3  conservative\nadvancement")
    to((2.6, 4.3), (3.1, 4.3), "no", (2.85, 4.48))
    to((5.6, 4.3), (6.1, 4.3), "no", (5.85, 4.48))
    cell(1.35, 2.75, "clear", GREEN, "#E3F4EE", 1.5, 0.6)
    for x in (1.35, 4.35, 7.35):
        if x == 1.35:
            to((x, 3.87), (x, 3.05), "yes", (x + 0.1, 3.45), ha="left")
    axes.plot([4.35, 4.35], [3.87, 2.87], color=GREY, lw=1.2)
    axes.plot([6.9, 6.9], [3.87, 2.63], color=GREY, lw=1.2)
    to((4.35, 2.87), (2.1, 2.87), "yes", (4.45, 3.45), ha="left")
    to((6.9, 2.63), (2.1, 2.63), "yes", (6.8, 3.45), ha="right")
    to((7.6, 3.87), (7.6, 2.18), "no", (7.7, 3.45), ha="left")
    cell(7.35, 1.75, "the points at the path's end:\nare there new ones?", width=3.1)
    cell(11.75, 1.75, "an event: the plan ends\nwhere they meet, at h/4", ORANGE, "#FFF4DC", 2.7)
    to((8.9, 1.75), (10.4, 1.75), "fast, and not\nin contact", (9.64, 2.13))
    cell(7.35, 0.3, "they become rows: solve\nagain, up to four rounds", BLUE, "#E3EEF6", 3.1)
    to((7.35, 1.32), (7.35, 0.73), "yes", (7.45, 1.02), ha="left")
    cell(2.35, 1.0, "not proved: halve the plan;\nin a pile, shorten the paths", ORANGE, "#FFF4DC", 3.4)
    to((5.8, 1.65), (4.05, 1.2), "no", (4.9, 1.62))
    to((5.8, 0.4), (4.05, 0.8), "still not clear", (4.9, 0.28))
    axes.set(xlim=(-0.1, 13.2), ylim=(-0.2, 4.8))
    return figure


def cut(_: Path) -> plt.Figure:
    x = np.linspace(0, 1, 100)
    v0, v1 = np.array([2.0, 0.0]), np.array([0.4, 1.9])
    energy = np.array([0.5 * np.sum(((1 - s) * v0 + s * v1) ** 2) + 0.7 * s for s in x])
    figure, axes = plt.subplots(figsize=(5.6, 2.9))
    axes.plot(x, energy, color=BLUE)
    axes.plot([0, 1], energy[[0, -1]], color=GREY, ls=":")
    axes.plot([0, 1], energy[[0, -1]], "o", color=DARK, ms=5)
    axes.plot(0.45, energy[45], "o", color=RED, ms=5)
    note(axes, (0.45, energy[45] - 0.13), "cut here", RED)
    note(axes, (0.46, 2.42), "the chord", GREY, ha="right")
    note(axes, (0.02, 2.1), "E(0)", ha="left")
    note(axes, (0.985, 2.7), "E(T)", ha="right")
    axes.set(title="Energy in a plan [J]", xticks=[0, 1], xticklabels=["0", "T"], xlim=(-0.03, 1.03), ylim=(1.3, 2.8))
    return figure


def impact(_: Path) -> plt.Figure:
    A, before, restitution = np.array([[2.0, -1], [-1, 2]]), np.array([-3.0, 0]), np.array([1.0, 0])
    J = np.array([[-1.0, 1, 0], [0, -1, 1]])
    z = np.linalg.solve(A, -before)
    r = restitution * z
    cap = min(1, np.sqrt(z @ A @ z / (r @ A @ r)))
    start = np.array([3.0, 0, 0])
    middle = start + J.T @ z
    rows = [("before", start, GREY), ("compressed", middle, GREY), ("expanded, k = 1", middle + J.T @ r, RED),
            (f"expanded, k = {cap:.2f}", middle + cap * (J.T @ r), BLUE)]
    figure, axes = plt.subplots(figsize=(9.2, 4.0))
    bare(axes, "Three balls of 1 kg that touch: velocities in m/s, and their energy")
    for y, (name, velocity, colour) in zip((4.5, 3, 1.5, 0), rows):
        note(axes, (-2.4, y), name, colour if colour != GREY else DARK, ha="right")
        for x, v in zip((0, 2, 4), velocity):
            ball(axes, (x, y), 0.5, "white")
            if abs(v) > 0.005:
                arrow(axes, (x, y), (x + 0.45 * v, y), colour, 2.2)
            note(axes, (x, y - 0.68), f"{v:.2f}".rstrip("0").rstrip(".").replace("-", "−"), fontsize=8.5)
        energy = 0.5 * velocity @ velocity
        note(axes, (6.1, y), f"{energy:.1f} J" + ("  more than before" if energy > 4.51 else ""), colour if colour != GREY else DARK, ha="left")
    axes.plot([0.95, 1.05], [5.25, 5.25], alpha=0)
    note(axes, (1, 5.28), "ε = 1", ORANGE)
    note(axes, (3, 5.28), "ε = 0", ORANGE)
    axes.set(xlim=(-5.2, 9.2), ylim=(-0.85, 5.5))
    return figure


def shortened(_: Path) -> plt.Figure:
    """Four boxes on a line: A stands, B is a way ahead of it, C and D behind. The rule of the text, pair by pair."""
    figure, axes = plt.subplots(figsize=(9.2, 3.2))
    bare(axes)
    side, places = 1.0, np.array([0.0, 1.35, 5.0, 8.6])
    asked = np.array([3.0, 3.4, 0.0, -0.9])  # m, the paths
    share = np.ones(4)
    waiting = [(0, 1), (1, 2), (2, 3)]
    while waiting:
        i, j = waiting.pop(0)
        before = share.copy()
        while True:
            free, closing = places[j] - places[i] - side, share[i] * asked[i] - share[j] * asked[j]
            if closing <= free:
                break
            part = 0.9 * free / closing
            moving = [k for k in (i, j) if asked[k] != 0]
            least = min(share[k] for k in moving)
            if all(share[k] == least for k in moving):
                least *= part
            for k in moving:
                share[k] = min(share[k], least)
        if (share != before).any():
            waiting += [p for p in ((0, 1), (1, 2), (2, 3)) if p != (i, j) and p not in waiting]
    for y, factors, colour, face in ((1.9, np.ones(4), GREY, "#F4F4F4"), (0, share, BLUE, "#CFE3F1")):
        for k in range(4):
            body(axes, box((places[k], y), (side, side)), "none", "#BBBBBB", ls=":")
        for k, (x, path, factor) in enumerate(zip(places, asked, factors)):
            end = x + factor * path
            body(axes, box((end, y), (side, side)), face, colour, alpha=0.85)
            note(axes, (end - 0.32 * np.sign(path), y + 0.3), "ABCD"[k], fontsize=8.5)
        for x, path, factor, low in zip(places, asked, factors, (-0.15, 0.05, 0, -0.05)):
            if path:
                arrow(axes, (x, y + low), (x + factor * path, y + low), DARK, 1.6)
    for k, (x, path, part) in enumerate(zip(places, asked, share)):
        note(axes, (x + part * path, -0.75), f"{part:.2f}" if part < 1 else "1" if path else "stands", BLUE if part < 1 else DARK, fontsize=8.5)
    note(axes, (-0.75, -0.75), "shares", BLUE, ha="right")
    note(axes, (-0.75, 1.9), "asked for", ha="right")
    note(axes, (-0.75, 0), "shortened", BLUE, ha="right")
    axes.set(xlim=(-2.4, 9.3), ylim=(-1.0, 2.6))
    return figure


DRAWINGS = {"margin": margin, "free_flight": free_flight, "push": push, "bend": bend, "halves": halves, "turning_plane": turning_plane,
            "unproved": unproved, "cut": cut, "impact": impact, "shortened": shortened}
