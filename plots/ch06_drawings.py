"""Chapter 6's drawings. Some are of runs, the others from the formulas of the text.

Reads RUN_DIR/slide, stop, card_house, arch, pencil and billiards: runs of the chapter's scenes, as its text makes them; and RUN_DIR/towers.csv. Writes one picture for each name into the folder --out.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Arc, Circle, Polygon

from drawing_program import draw
from sketch import DARK, PALE, arrow, ball, bare, body, box, length, note
from style import BLUE, GREEN, GREY, ORANGE, PURPLE, RED, Table

MU, G, SPEED = 0.5, 9.81, 3.0  # of slide.yaml


def cone(_: Path) -> plt.Figure:
    figure, (side, top) = plt.subplots(1, 2, figsize=(9.2, 3.7), width_ratios=(1.35, 1))
    bare(side, "From the side")
    mu = 0.6
    side.add_patch(Polygon([[0, 0], [mu * 2.3, 2.3], [-mu * 2.3, 2.3]], fc="#E4F0F8", ec="none"))
    for sign in (-1, 1):
        side.plot([0, sign * mu * 2.3], [0, 2.3], color=BLUE, lw=1.5)
    side.plot([-3, 3.4], [0, 0], color=DARK, lw=1.3)
    side.add_patch(plt.Rectangle((-3, -0.3), 6.4, 0.3, fc="#D8D8D8", ec="none"))
    side.plot([0, 0], [0, 2.45], color=GREY, lw=0.9, ls=":")
    note(side, (0, 2.62), "normal", GREY)
    side.add_patch(Arc((0, 0), 2.2, 2.2, theta1=90 - np.degrees(np.arctan(mu)), theta2=90, color=DARK, lw=1))
    note(side, (1.5, 0.98), "angle: arctan µ", fontsize=8.5, ha="left")
    arrow(side, (1.47, 0.98), (0.3, 1.07), DARK, 0.7)
    arrow(side, (0, 0), (-0.45, 1.6), GREEN, 2)
    note(side, (-0.58, 1.98), "inside: sticks", GREEN)
    arrow(side, (0, 0), (mu * 1.5, 1.5), ORANGE, 2)
    note(side, (1.02, 1.45), "on the cone: may slip", ORANGE, ha="left")
    arrow(side, (0, 0), (2.2, 0.6), RED, 1.4, ls="--")
    note(side, (2.28, 0.52), "outside:\nnot allowed", RED, ha="left")
    note(side, (0.05, -0.16), "r = 0 at the tip: open", DARK)
    side.set(xlim=(-3, 3.4), ylim=(-0.35, 2.75))
    bare(top, "From above, at one normal impulse")
    top.add_patch(Circle((0, 0), 1, fc="#E4F0F8", ec=BLUE, lw=1.5))
    length(top, (0, 0), (0, -1), r"µ $r_N$", (0.27, -0.62), DARK)
    arrow(top, (0, 0), (-0.45, 0.28), GREEN, 2)
    note(top, (-0.42, 0.42), "sticks: $r_T$", GREEN)
    angle = np.radians(25)
    tip = np.array([np.cos(angle), np.sin(angle)])
    arrow(top, (0, 0), tip, ORANGE, 2)
    note(top, (1.0, 0.52), "slips: $r_T$", ORANGE, ha="left")
    arrow(top, (0, 0), -0.8 * tip, GREY, 1.6)
    note(top, (-0.5, -0.56), "$u_T$: its slip", GREY)
    top.plot(0, 0, "o", color=DARK, ms=4)
    top.set(xlim=(-1.4, 1.9), ylim=(-1.2, 1.2))
    return figure


def stick_slip(_: Path) -> plt.Figure:
    """A contact with A = 1/m: without friction it would slip with d; friction can take up to µ r_N/m of it."""
    figure, panels = plt.subplots(1, 3, figsize=(9.2, 3.0))
    for axes, title, d in ((panels[0], "sticks", (0.6, 0.35)), (panels[1], "slips", (1.25, 0.9)), (panels[2], "opens", None)):
        bare(axes, title)
        if d is None:
            body(axes, box((0, 0.55), (1.5, 0.7)))
            axes.plot([-1.4, 1.4], [-0.55, -0.55], color=DARK, lw=1.3)
            arrow(axes, (0, 0.55), (0.5, 1.25), GREY)
            note(axes, (0, -0.8), "it parts without help:\nno impulse, though it slips", DARK, fontsize=8.5)
            axes.set(xlim=(-1.5, 1.5), ylim=(-1.25, 1.4))
            continue
        d = np.array(d)
        axes.add_patch(Circle((0, 0), 1, fc="#E4F0F8", ec=BLUE, lw=1.3))
        size = np.hypot(*d)
        takes = d * min(1, 1 / size)
        arrow(axes, (0, 0), d, GREY)
        note(axes, d + [0.05, 0.18] if size > 1 else (0, 0.68), "without friction", GREY)
        offset = np.array([0.07, -0.1])
        arrow(axes, takes + offset, offset, ORANGE, 2)
        note(axes, 0.5 * takes + [-0.1, -0.36], "friction", ORANGE, ha="left")
        if size > 1:
            arrow(axes, takes, d, RED, 2.4)
            note(axes, 0.5 * (takes + d) + [0.12, -0.14], "left: $u_T$", RED, ha="left")
        else:
            axes.plot(0, 0, "o", color=GREEN, ms=6)
            note(axes, (-0.1, 0.12), "$u_T = 0$", GREEN, ha="right")
        note(axes, (0, -1.15), "radius: 1/m times µ $r_N$", BLUE, fontsize=8.5)
        axes.set(xlim=(-1.5, 2.0), ylim=(-1.25, 1.25))
    return figure


def box_stop(angle: np.ndarray) -> np.ndarray:
    """Where a slide of unit length ends if each axis is braked by itself: v² = 2 µ g s on each."""
    return np.sign([np.cos(angle), np.sin(angle)]) * np.array([np.cos(angle) ** 2, np.sin(angle) ** 2])


def diamond_stop(angle: np.ndarray) -> np.ndarray:
    """Only the larger component is braked, until both are equal; then both, each with half."""
    c, s = np.abs(np.cos(angle)), np.abs(np.sin(angle))
    large, small = np.maximum(c, s), np.minimum(c, s)
    first = large - small  # the time, in v/(µ g)
    along = large**2 - small**2 + 2 * small**2  # then from `small` on each, braked by 1/2
    across = 2 * small * first + 2 * small**2
    x, y = np.where(c >= s, along, across), np.where(c >= s, across, along)
    return np.array([np.sign(np.cos(angle)) * x, np.sign(np.sin(angle)) * y])


def isotropy(runs: Path) -> plt.Figure:
    poses = Table(runs / "slide/poses.csv")
    number = poses["body"].astype(int)
    places = poses.vectors("px", "py")
    moved = []
    for k in range(1, number.max() + 1):
        mine = places[number == k]
        moved.append(mine[-1] - mine[0])
    moved = np.array(moved) / (SPEED**2 / (2 * MU * G))
    figure, (stops, wrong) = plt.subplots(1, 2, figsize=(9.2, 4.2), width_ratios=(1.15, 1))
    bare(stops, "Where a slide ends (exact: 1 from the start)")
    angle = np.linspace(0, 2 * np.pi, 721)
    stops.plot(np.cos(angle), np.sin(angle), color=BLUE, lw=1.2)
    stops.plot(*box_stop(angle), color=RED, lw=1.4, ls="--")
    stops.plot(*diamond_stop(angle), color=PURPLE, lw=1.4, ls="-.")
    stops.plot(*moved.T, "o", color=BLUE, ms=5)
    start = np.radians(22.5)
    tip = np.array([np.cos(start), np.sin(start)])
    arrow(stops, (0, 0), tip, BLUE, 1.2)
    arrow(stops, (0, 0), box_stop(start), RED, 1.2)
    arrow(stops, (0, 0), diamond_stop(start), PURPLE, 1.2)
    note(stops, (0, 1.13), "four sides: 1.414 at 45°", PURPLE)
    note(stops, (0, -0.32), "box: 0.707 at 45°", RED)
    note(stops, (0, -1.16), "circle: the cone; dots: sixteen runs", BLUE)
    stops.set(xlim=(-1.3, 1.3), ylim=(-1.25, 1.22))
    degrees = np.linspace(0, 90, 181)
    radians = np.radians(degrees)
    off = {}
    for name, stop, colour, style in (("box", box_stop, RED, "--"), ("four sides", diamond_stop, PURPLE, "-.")):
        x, y = np.abs(stop(radians))
        off[name] = np.degrees(np.arctan2(y, x)) - degrees
        wrong.plot(degrees, off[name], color=colour, ls=style)
    wrong.axhline(0, color=BLUE)
    run = np.degrees(np.arctan2(moved[:, 1], moved[:, 0]))
    first = (run > -1) & (run < 91)
    wrong.plot(run[first], np.zeros(first.sum()), "o", color=BLUE, ms=5)
    note(wrong, (67, 14), "box", RED)
    note(wrong, (21.5, 14), "four sides", PURPLE)
    note(wrong, (33, 1.0), "cone", BLUE)
    wrong.set(title="Its direction is wrong by [°]", xlabel="direction of the push, from an axis [°]", xticks=[0, 22.5, 45, 67.5, 90], xlim=(-2, 92), ylim=(-14.5, 15.5))
    return figure


def slip_root(_: Path) -> plt.Figure:
    figure, panels = plt.subplots(1, 2, figsize=(9.2, 3.4))
    rod = np.array([[1.6, -1.2], [-1.2, 3.4]])  # Painlevé's, tan θ = 2: normal, tangent
    for axes, A, q, mu, title, last in ((panels[0], np.diag([1.0, 3.5]), (-1.0, 1.6), 0.2, "A ball that hits a floor (µ = 0.2)", 8.0),
                                        (panels[1], rod, (0.01, -1.0), 1.5, "Painlevé's rod that parts slowly (µ = 1.5)", 14.0)):
        alpha = np.linspace(0, last, 600)
        D = A[1, 1] - A[0, 1] ** 2 / A[0, 0]
        d = q[1] - A[0, 1] * q[0] / A[0, 0]
        tangent = -d / (D + alpha)
        normal = -(q[0] + A[0, 1] * tangent) / A[0, 0]
        f = np.abs(tangent) - mu * normal
        axes.axhline(0, color=DARK, lw=1)
        axes.plot(alpha, f, color=BLUE)
        axes.plot(0, f[0], "s", color=DARK if f[0] > 0 else GREEN, ms=6)
        for k in np.nonzero(f[:-1] * f[1:] < 0)[0]:
            root = alpha[k] - f[k] * (alpha[k + 1] - alpha[k]) / (f[k + 1] - f[k])
            axes.plot(root, 0, "o", color=ORANGE, ms=7)
            note(axes, (root + 0.07 * last, 0.06 * (f.max() - f.min())), f"α = {root:.2f}", ORANGE)
        axes.set(title=title, xlabel="α [1/kg]", xlim=(-0.03 * last, last), ylim=(f.min() - 0.12 * np.ptp(f), f.max() + 0.15 * np.ptp(f)))
    panels[0].set_ylabel("f(α)  [N s]")
    note(panels[0], (0.3, panels[0].get_ylim()[1] * 0.93), "f(0) > 0: it cannot stick", DARK, ha="left", fontsize=8.5)
    note(panels[1], (0.5, -0.0405), "f(0) < 0: it can stick", GREEN, ha="left", fontsize=8.5)
    note(panels[1], (8.2, -0.022), "and it can open, and slip: three answers", DARK, fontsize=8.5)
    return figure


def rod(_: Path) -> plt.Figure:
    figure, (scene, push) = plt.subplots(1, 2, figsize=(9.2, 3.4), width_ratios=(1, 1.2))
    bare(scene, "A rod slides on its lower end")
    angle = np.arctan(2)
    along = np.array([np.cos(angle), np.sin(angle)])
    scene.add_patch(plt.Rectangle((-1.2, -0.25), 3.4, 0.25, fc="#D8D8D8", ec="none"))
    scene.plot([-1.2, 2.2], [0, 0], color=DARK, lw=1.3)
    body(scene, box(along, (2, 0.07), angle))
    scene.plot(*along, "o", color=DARK, ms=4)
    arrow(scene, (-0.15, -0.12), (-0.8, -0.12), GREY)
    note(scene, (-0.9, 0.12), "its slip", GREY)
    arrow(scene, (0, 0), (0, 0.62), BLUE, 2)
    note(scene, (-0.08, 0.4), "normal", BLUE, ha="right")
    arrow(scene, (0, 0), (0.85, 0), ORANGE, 2)
    note(scene, (0.6, 0.16), "friction", ORANGE, ha="left")
    scene.add_patch(Arc(along, 1.1, 1.1, theta1=100, theta2=200, color=RED, lw=1.8))
    tip = along + 0.55 * np.array([np.cos(np.radians(200)), np.sin(np.radians(200))])
    arrow(scene, tip + [-0.012, 0.05], tip + [0.03, -0.09], RED, 1.8)
    note(scene, (-0.35, 1.25), "friction turns it\nthis way: the end\ngoes down", RED, ha="right", fontsize=8.5)
    scene.set(xlim=(-1.9, 2.2), ylim=(-0.3, 2.0))
    mu = np.linspace(0, 2.5, 100)
    push.axhline(0, color=DARK, lw=1)
    push.plot(mu, 1.6 - 1.2 * mu, color=BLUE)
    push.plot(4 / 3, 0, "o", color=ORANGE, ms=7)
    note(push, (1.38, 0.16), "µ = 4/3", ORANGE, ha="left")
    note(push, (0.62, 0.33), "a push lifts the end", GREEN)
    note(push, (1.05, -0.95), "a push, with its friction,\npulls the end down", RED)
    push.set(title="What 1 N s of normal impulse does to the end [m/s]", xlabel="µ, while it slides", xlim=(0, 2.5), ylim=(-1.6, 1.8))
    return figure


def stages(_: Path) -> plt.Figure:
    """The rod of the text: A, u before, compression r1, expansion by discs, velocities."""
    A = np.array([[2.5, -1.5], [-1.5, 2.5]])
    before, mu, e = np.array([-1.0, 0.625]), 0.5, 1.0
    r1 = -np.linalg.solve(A, before)
    assert abs(r1[1]) <= mu * r1[0]
    normal = e * r1[0]
    k = min(1.0, np.sqrt((r1 @ A @ r1) / (A[0, 0] * normal**2)))
    normal *= k
    middle = A @ r1 + before
    tangent = np.clip(-(middle[1] + A[1, 0] * normal) / A[1, 1], -mu * normal, mu * normal)
    r2 = np.array([normal, tangent])
    after = middle + A @ r2
    energy = [0.5 * u @ np.linalg.solve(A, u) for u in (before, middle, after)]
    newton_r = np.linalg.solve(A, np.array([-before[0] * e, 0.0]) - before)
    newton = A @ newton_r + before
    figure, (impulses, bars) = plt.subplots(1, 2, figsize=(9.2, 3.6), width_ratios=(1.35, 1))
    impulses.add_patch(Polygon([[0, 0], [1.2, 1.2 * mu], [1.2, -1.2 * mu]], fc="#E4F0F8", ec="none"))
    for sign in (-1, 1):
        impulses.plot([0, 1.2], [0, sign * 1.2 * mu], color=BLUE, lw=1.2)
    arrow(impulses, (0, 0), r1, GREEN, 2)
    arrow(impulses, r1, r1 + r2, ORANGE, 2)
    arrow(impulses, (0, 0), newton_r, RED, 1.3, ls="--")
    note(impulses, (0.41, -0.07), "1. compression", GREEN, ha="left")
    note(impulses, (0.66, 0.03), "2. expansion", ORANGE, ha="left")
    note(impulses, (0.33, 0.4), "Newton's law", RED)
    arrow(impulses, (0.45, 0.36), 0.55 * newton_r, RED, 0.7)
    note(impulses, (0.98, -0.2), "the cone, µ = ½", BLUE)
    impulses.set(title="Impulses of one impact", xlabel="normal [N s]", ylabel="tangent [N s]", xlim=(-0.08, 1.25), ylim=(-0.5, 0.62))
    values = [*energy, 0.5 * newton @ np.linalg.solve(A, newton)]
    names = ["before", "after 1", "after 2", "Newton"]
    bars.bar(names, np.array(values) / energy[0], color=[GREY, GREEN, ORANGE, RED], width=0.62)
    for x, v in enumerate(values):
        note(bars, (x, v / energy[0] + 0.06), f"{v / energy[0]:.3f}", DARK)
    bars.axhline(1, color=DARK, lw=0.8, ls=":")
    bars.set(title="Its energy, before = 1", ylim=(0, 1.75))
    bars.grid(False)
    return figure


def stop(runs: Path) -> plt.Figure:
    """The first sliding block of slide.yaml, in frames of a quarter of a second."""
    poses = Table(runs / "stop/poses.csv")
    mine = poses["body"] == 1
    t, v = poses["t"][mine], poses["vx"][mine]
    figure, axes = plt.subplots(figsize=(9.2, 3.3))
    end = SPEED / (MU * G)
    fine = np.linspace(0, 1, 400)
    axes.plot(fine, np.maximum(0, SPEED - MU * G * fine), color=BLUE, lw=2)
    for edge in np.arange(0, 1.01, 0.25):
        axes.axvline(edge, color=GREY, lw=0.8, ls=":")
    axes.plot(t, v, "o", color=DARK, ms=6, zorder=4)
    axes.plot(end, 0, "s", color=ORANGE, ms=8, zorder=5)
    note(axes, (0.575, 1.65), f"an event: the slip\nends at {end:.4f} s,\nand the plan with it", ORANGE, ha="left")
    arrow(axes, (0.64, 1.15), (end + 0.002, 0.14), ORANGE, 0.9)
    at = 0.5
    axes.plot([at, at + 0.25], [SPEED - MU * G * at, SPEED - MU * G * (at + 0.25)], color=RED, lw=1.2, ls="--")
    note(axes, (0.765, -0.47), "the same push for the\nwhole frame would send\nthe block back", RED, ha="left")
    axes.plot([at, at + 0.25], [SPEED - MU * G * at, 0], color=PURPLE, lw=1.2, ls="-.")
    note(axes, (0.765, 0.62), "a push that stops it in\nthe frame is too weak:\nthe slide gets too long", PURPLE, ha="left")
    note(axes, (0.1, 2.75), "$v_0$ − µ|g|t", BLUE, ha="left")
    axes.set(title="A block's velocity [m/s], frames of 1/4 s: the dots are the run's", xlabel="t [s]", xlim=(-0.02, 1.02), ylim=(-1.0, 3.2), xticks=[0, 0.25, 0.5, 0.75, 1])
    axes.grid(False)
    return figure


def patch(_: Path) -> plt.Figure:
    figure, (points, law) = plt.subplots(1, 2, figsize=(9.2, 3.8), width_ratios=(1.25, 1))
    bare(points, "A pair's points, and its patch")
    corners = np.array([[-1.3, -0.8], [1.3, -0.8], [1.3, 0.8], [-1.3, 0.8]])
    loads = np.array([1.0, 2.2, 1.6, 0.8])
    body(points, 1.15 * corners, "#F5F5F5", GREY)
    centre = (loads[:, None] * corners).sum(0) / loads.sum()
    for place, load in zip(corners, loads):
        points.plot([centre[0], place[0]], [centre[1], place[1]], color=GREY, lw=0.8, ls=":")
        ball(points, place, 0.07 * np.sqrt(load) * 1.4, "#CFE3F1", BLUE, zorder=3)
    note(points, (-1.3, 1.13), "λ₁ … λ₄: the points' normal impulses", BLUE, ha="left", va="bottom")
    note(points, (0.92, 0.28), "ρ", GREY)
    points.plot(*centre, "o", color=DARK, ms=6, zorder=4)
    arrow(points, centre, centre + [0.62, 0], ORANGE, 2)
    arrow(points, centre, centre + [0, 0.62], ORANGE, 2)
    note(points, centre + [0.75, -0.02], "t₁", ORANGE)
    note(points, centre + [0.0, 0.75], "t₂", ORANGE)
    points.add_patch(Arc(centre, 0.75, 0.75, theta1=120, theta2=330, color=PURPLE, lw=2))
    tip = centre + 0.375 * np.array([np.cos(np.radians(330)), np.sin(np.radians(330))])
    arrow(points, tip - [0.045, 0.09], tip + [0.01, 0.03], PURPLE, 2)
    note(points, centre + [-0.52, -0.2], "twist", PURPLE, ha="right")
    note(points, centre + [0.06, -0.14], "centre", DARK, ha="left")
    points.set(xlim=(-1.75, 1.75), ylim=(-1.1, 1.45))
    # The law in the plane (force along one tangent, twist), of a ring of equal points: exact limit curve and the patch's.
    law.add_patch(plt.Rectangle((-1, -1), 2, 2, fc="#FBEFE0", ec=ORANGE, lw=1.6))
    angle = np.linspace(0, 2 * np.pi, 360, endpoint=False)
    force, torque = [], []
    for phi in np.linspace(0, 2 * np.pi, 241):
        u, spin = np.cos(phi), np.sin(phi)
        slip = np.stack([u - spin * np.sin(angle), spin * np.cos(angle)])
        size = np.maximum(np.hypot(*slip), 1e-12)
        force.append(np.mean(slip[0] / size))
        torque.append(np.mean((-slip[0] * np.sin(angle) + slip[1] * np.cos(angle)) / size))
    law.plot(force, torque, color=BLUE)
    note(law, (0, 0.42), "true limit of a\nring of points", BLUE)
    note(law, (0, -1.17), "the patch's: a disc times an interval", ORANGE)
    law.set(title="What it may do", xlabel="push along a tangent, by µΣλ", ylabel="twist, by µΣλρ", xlim=(-1.4, 1.4), ylim=(-1.35, 1.25), xticks=[-1, 0, 1], yticks=[-1, 0, 1])
    law.set_aspect("equal")
    law.grid(False)
    return figure


def outline(points: np.ndarray, pose: np.ndarray) -> np.ndarray:
    """Points (x, z) of a body that turns about y alone, at a pose (px, pz, qw, qy)."""
    angle = 2 * np.arctan2(pose[3], pose[2])
    c, s = np.cos(angle), np.sin(angle)
    return pose[:2] + points @ np.array([[c, -s], [s, c]])


def gallery(runs: Path) -> plt.Figure:
    figure, panels = plt.subplots(2, 2, figsize=(9.2, 5.6), width_ratios=(1, 1.25))
    (cards, arch), (pencils, table) = panels

    def last(name: str, body_number: int, frame: int = -1) -> np.ndarray:
        poses = Table(runs / name / "poses.csv")
        return poses.vectors("px", "pz", "qw", "qy")[poses["body"] == body_number][frame]

    bare(cards, "A house of cards after 3 s")
    cards.plot([-1.4, 1.4], [0, 0], color=DARK, lw=1.3)
    for k in range(1, 8):
        half = 0.75 if k == 5 else 0.5
        body(cards, outline(np.array([[-half, -0.01], [half, -0.01], [half, 0.01], [-half, 0.01]]), last("card_house", k)), BLUE, BLUE, lw=0.8)
    bare(arch, "An arch of thirteen stones after 1 s")
    arch.plot([-6.2, 6.2], [0, 0], color=DARK, lw=1.3)
    half = 0.5 * np.pi / 13
    stone = np.array([[r * np.sin(s * half), r * np.cos(half) - 5] for s, r in ((-1, 4.5), (1, 4.5), (1, 5.5), (-1, 5.5))])
    for k in range(1, 14):
        body(arch, outline(stone, last("arch", k)), "#E9E2D6")
    bare(pencils, "Three pencils, µ of 0, 0.2 and 0.8, as they fall")
    frames = range(0, 481, 24)
    pencils.plot([-0.6, 3.8], [0, 0], color=DARK, lw=1.3)
    for number, colour, shift in ((1, GREY, 0.0), (2, BLUE, 1.35), (3, ORANGE, 2.7)):
        poses = Table(runs / "pencil/poses.csv")
        mine = poses.vectors("px", "pz", "qw", "qy")[poses["body"] == number]
        for frame in frames:
            points = outline(np.array([[0, -0.5], [0, 0.5]]), mine[frame])
            pencils.plot(points[:, 0] + shift, points[:, 1], color=colour, lw=1.1)
            pencils.plot(points[0, 0] + shift, points[0, 1], "o", color=colour, ms=2.5)
    pencils.set_ylim(-0.15, 1.1)
    bare(table, "Four billiard balls from above, 1.1 s")
    poses = Table(runs / "billiards/poses.csv")
    for number, colour, text in ((1, GREY, "no spin"), (2, RED, "draw"), (3, BLUE, "massé"), (4, GREEN, "massé and draw")):
        places = poses.vectors("px", "py")[poses["body"] == number]
        table.plot(*places.T, color=colour, lw=1.4)
        table.plot(*places[::12].T, "o", color=colour, ms=3.5)
        note(table, places[0] + [-0.04, 0], text, colour, ha="right")
    table.set_xlim(-0.85, 1.0)
    return figure


def towers(run: Path) -> plt.Figure:
    table = Table(run / "towers.csv")
    boxes, looks, error = table["boxes"].astype(int), table["looks at each contact"], table["force error"]
    together = np.array([method == "together" for method in table.text("method")])
    figure, axes = plt.subplots(figsize=(7.2, 3.9))
    for count, colour in ((5, BLUE), (20, ORANGE), (50, GREEN)):
        for at_once, line in ((False, "o--"), (True, "s-")):
            rows = (boxes == count) & (together == at_once)
            axes.loglog(looks[rows], np.maximum(error[rows], 1e-13), line, ms=3.5, lw=1.2, color=colour)
    for place, text, colour in (((160, 1e-4), "5", BLUE), ((3.2e3, 2e-4), "20", ORANGE), ((3.2e3, 0.25), "50 boxes", GREEN)):
        note(axes, place, text, colour, ha="left")
    axes.plot([], [], "o--", color=GREY, ms=3.5, label="sweeps")
    axes.plot([], [], "s-", color=GREY, ms=3.5, label="40 sweeps, then all at once")
    axes.set(xlabel="looks at each contact", ylabel="error of the force under the lowest box", ylim=(3e-13, 3))
    axes.legend(loc="lower left", frameon=False)
    axes.grid(True, alpha=0.3)
    return figure


DRAWINGS = {f.__name__: f for f in (cone, stick_slip, isotropy, slip_root, rod, stages, stop, patch, towers, gallery)}


if __name__ == "__main__":
    draw(__doc__, DRAWINGS)
