"""Chapter 1's drawings, each from the tables that `ch01_pictures` wrote.

Reads the tables in RUN_DIR, and in RUN_DIR/coarse those of the flight with a tolerance large enough to see; the chapter's text has
the commands. Writes one picture for each name into the folder --out.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Rectangle

from drawing_program import draw
from sketch import DARK, PALE, arrow, bare, body, length, note, rotation
from style import BLUE, GREEN, GREY, ORANGE, RED, Table

SLAB = "#D6EAF8"


def hull(points) -> np.ndarray:
    """The corners of the convex hull of points in the plane, anticlockwise (Andrew's monotone chain)."""
    points = sorted(map(tuple, points))

    def half(ordered):
        chain = []
        for p in ordered:
            while len(chain) > 1 and np.cross(np.subtract(chain[-1], chain[-2]), np.subtract(p, chain[-2])) <= 0:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return np.array(half(points) + half(points[::-1]))


def two_bodies(file: Path) -> tuple[np.ndarray, np.ndarray]:
    table = Table(file)
    points = table.vectors("x", "y")
    of_a = np.array([name == "a" for name in table.text("body")])
    return points[of_a], points[~of_a]


def band(axes: plt.Axes, n, low: float, high: float, half: float, middle, **more) -> None:
    """The strip between two parallel lines, low <= n.x <= high, over some length to either side of `middle`."""
    n = np.asarray(n)
    along = np.array([-n[1], n[0]])
    centre = np.dot(middle, along) * along
    corners = [centre + high * n + half * along, centre + high * n - half * along, centre + low * n - half * along,
               centre + low * n + half * along]
    body(axes, corners, SLAB, "none", zorder=0)
    for value in (low, high):
        axes.plot(*np.array([centre + value * n + half * along, centre + value * n - half * along]).T, color=BLUE, lw=1.2, zorder=1)


# --- the flight -----------------------------------------------------------------------------------------------------


class Flight:
    """The rows of the scene's certificate, the true distance, and the bodies at each look."""

    def __init__(self, runs: Path):
        self.rows = Table(runs / "flight_rows.csv")
        self.distance = Table(runs / "flight_distance.csv")
        self.along = Table(runs / "flight_along.csv")
        poses = Table(runs / "flight_poses.csv")
        self.times = np.unique(poses["t"])
        points, names = poses.vectors("x", "y", "z"), np.array(poses.text("body"))
        self.corners = {(t, name): points[(poses["t"] == t) & (names == name)] for t in self.times for name in "ab"}

    @property
    def contact(self) -> float:
        return self.times[-1]

    def normal(self, row: int) -> np.ndarray:
        return self.rows.vectors("nx", "ny", "nz")[row]


def outline(axes: plt.Axes, corners: np.ndarray, face: str, edge: str, **more) -> None:
    """A box as it is seen: its outline, and the edges of it that lie inside."""
    body(axes, hull(corners), face, edge, **more)
    alpha = more.get("alpha", 1)
    for i in range(8):  # corner i of a box: its bits choose the side
        for bit in (1, 2, 4):
            if not i & bit:
                axes.plot(*corners[[i, i | bit]].T, color=edge, lw=0.5, alpha=0.6 * alpha, zorder=more.get("zorder", 2))


def first_slab(runs: Path) -> plt.Figure:
    flight = Flight(runs)
    n = flight.normal(0)
    up = np.array([0, 0, 1]) - n[2] * n
    up /= np.linalg.norm(up)
    view = np.stack([n, np.cross(up, n)])  # seen along a line in the plane: the slab is exactly as wide as it looks
    figure, axes = plt.subplots(figsize=(9.2, 3.5))
    bare(axes)
    cube = flight.corners[flight.times[0], "a"] @ view.T
    start = flight.corners[flight.times[0], "b"] @ view.T
    low, high = cube[:, 0].max(), start[:, 0].min()
    band(axes, (1, 0), low, high, 0.95, (0, 0))
    outline(axes, cube, PALE, DARK)
    for t in flight.times[1:3]:
        outline(axes, flight.corners[t, "b"] @ view.T, "none", GREY, alpha=0.6, lw=0.8, zorder=3)
    outline(axes, flight.corners[flight.contact, "b"] @ view.T, "none", RED, lw=1.4, zorder=4)
    outline(axes, start, "#FFE9BF", ORANGE, lw=1.4, zorder=4)
    bottom = -0.78
    length(axes, (low, bottom), (high, bottom), f"an empty slab, {flight.rows['gap_lower'][0]:.2f} m wide", (0.5 * (low + high), bottom + 0.1), BLUE)
    arrow(axes, (1.72, 0.78), (2.1, 0.78), BLUE)
    note(axes, (1.62, 0.78), "n", BLUE, style="italic", fontsize=11)
    centre = start.mean(axis=0)
    arrow(axes, centre + [0.62, 0.42], centre + [0.05, 0.42], ORANGE)
    note(axes, centre + [0.34, 0.53], "1.5 m/s, and it spins", ORANGE)
    note(axes, cube.mean(axis=0), "A", DARK, fontsize=13)
    note(axes, centre, "B", DARK, fontsize=13, zorder=6)
    note(axes, cube.mean(axis=0) + [0, -0.78], "cube, at rest", DARK)
    note(axes, centre + [0.1, -0.78], "brick, at t = 0", ORANGE)
    note(axes, (low + 0.06, 0.84), f"first contact: t = {flight.contact:.3f} s", RED, ha="left")
    axes.set(xlim=(-0.8, 3.8), ylim=(-0.95, 0.95))
    return figure


def staircase(runs: Path) -> plt.Figure:
    flight = Flight(runs / "coarse")
    rows, tolerance = flight.rows, 0.1
    figure, axes = plt.subplots(figsize=(9.2, 3.9))
    truth = lambda t: np.interp(t, flight.distance["t"], flight.distance["distance"])  # noqa: E731
    axes.axhspan(0, tolerance, color=PALE, lw=0)
    axes.axhline(tolerance / 2, color=GREEN, lw=1.1, ls="--")
    shown = flight.distance["t"] <= flight.contact + 0.06
    axes.plot(flight.distance["t"][shown], flight.distance["distance"][shown], color=DARK, lw=1.6)
    for t, gap, step in zip(rows["t"], rows["gap_lower"], rows["advance"]):
        axes.plot([t, t + step], [gap, tolerance / 2], color=BLUE, lw=1.6)
        axes.plot([t + step, t + step], [tolerance / 2, truth(t + step)], color=BLUE, lw=0.8, ls=":")
        axes.plot(t, gap, "o", color=BLUE, ms=5.5, zorder=5)
    axes.plot(flight.contact, truth(flight.contact), "s", color=RED, ms=6.5, zorder=6)
    point = {"arrowstyle": "-", "color": GREY, "lw": 0.8}
    axes.annotate("the true distance", (0.62, truth(0.62)), (0.72, 1.45), color=DARK, arrowprops=point)
    axes.annotate("a look: the gap is at least g", (rows["t"][0], rows["gap_lower"][0]), (0.08, 2.03), color=BLUE, va="center", arrowprops=point)
    axes.annotate("after h seconds\nit is at least g − μh", (0.24, rows["gap_lower"][0] - 0.24 * (rows["gap_lower"][0] - 0.05) / rows["advance"][0]), (0.02, 0.42),
                  color=BLUE, arrowprops=point)
    axes.annotate("used up, but for\nτ/2: look again", (rows["t"][1], 0.05), (0.51, 0.38), color=BLUE, va="center", arrowprops=point)
    axes.annotate("within τ:\ncontact", (flight.contact, truth(flight.contact)), (1.40, 0.42), color=RED, va="center", ha="center", arrowprops=point)
    right = flight.contact + 0.14
    note(axes, (right, tolerance), "τ = 0.1 m", GREY, ha="right", va="bottom")
    note(axes, (0.01, tolerance / 2 + 0.01), "τ/2", GREEN, ha="left", va="bottom")
    axes.set(xlabel="t [s]", ylabel="gap [m]", xlim=(0, right), ylim=(0, 2.15))
    axes.grid(False)
    return figure


def where_to_stop(runs: Path) -> plt.Figure:
    flight = Flight(runs / "coarse")
    rows, tolerance = flight.rows, 0.1
    figure, axes = plt.subplots(figsize=(9.2, 3.3))
    truth = lambda t: np.interp(t, flight.distance["t"], flight.distance["distance"])  # noqa: E731
    start = rows["t"][-2]
    t = np.linspace(start - 0.01, flight.contact + 0.045, 200)
    axes.axhspan(0, tolerance, color=PALE, lw=0)
    axes.axhline(tolerance, color=GREY, lw=1)
    axes.axhline(tolerance / 2, color=GREEN, lw=1.1, ls="--")
    axes.axhline(0, color=DARK, lw=1.2)
    axes.plot(t, truth(t), color=DARK, lw=1.6)
    for look, gap, step in list(zip(rows["t"], rows["gap_lower"], rows["advance"]))[-2:]:
        axes.plot([look, look + step], [gap, tolerance / 2], color=BLUE, lw=1.6)
        axes.plot([look + step, look + step], [tolerance / 2, truth(look + step)], color=BLUE, lw=0.9, ls=":")
        axes.plot(look, gap, "o", color=BLUE, ms=6, zorder=5)
        axes.plot(look + step, tolerance / 2, "o", color=BLUE, mfc="white", ms=6, zorder=5)
    axes.plot(flight.contact, truth(flight.contact), "s", color=RED, ms=7, zorder=6)
    point = {"arrowstyle": "-", "color": GREY, "lw": 0.8}
    axes.annotate("aimed at", (rows["t"][-1], tolerance / 2), (rows["t"][-1] + 0.006, 0.016), color=BLUE, ha="left", arrowprops=point)
    axes.annotate("found", (rows["t"][-1], rows["gap_lower"][-1]), (rows["t"][-1] + 0.008, 0.33), color=BLUE, arrowprops=point)
    axes.annotate("within τ: contact, and\nthere is still a plane", (flight.contact, truth(flight.contact)), (flight.contact + 0.008, 0.16), color=RED, arrowprops=point)
    left, right = start - 0.01, flight.contact + 0.06
    for y, text, colour in ((tolerance, "τ: near enough", GREY), (tolerance / 2, "τ/2: where each step aims", GREEN), (0, "0: no plane, no direction", DARK)):
        note(axes, (left + 0.001, y + 0.006), text, colour, ha="left", va="bottom")
    axes.set(xlim=(left, right), ylim=(-0.012, 0.43), xlabel="t [s]", ylabel="gap [m]")
    axes.grid(False)
    return figure


def certificate(runs: Path) -> plt.Figure:
    flight = Flight(runs / "coarse")
    rows, along = flight.rows, flight.along
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.5), width_ratios=(1, 1))
    row = 2
    mine = along["row"] == row
    h, gap = along["h"][mine], along["gap"][mine]
    g, mu, step = rows["gap_lower"][row], rows["speed_bound"][row], rows["advance"][row]
    left.axvspan(step, h[-1], color=PALE, lw=0)
    left.plot(h, gap, color=DARK, lw=1.6)
    inside = h <= step
    left.plot([0, step], [g, g - mu * step], color=BLUE, lw=1.8)
    left.plot(0, g, "o", color=BLUE, ms=6, zorder=5, clip_on=False)
    left.fill_between(h[inside], g - mu * h[inside], gap[inside], color=SLAB, lw=0)
    note(left, (0.62 * step, 0.535), "the gap along the row's n", DARK)
    note(left, (0.3 * step, 0.14), "the row's line, g − μh", BLUE)
    note(left, (1.25 * step, 0.48), "not\nclaimed", GREY)
    left.axhline(0, color=DARK, lw=1)
    left.set(title=f"1  A row is true if its line lies below (row {row})", xlabel="h, since the row's t [s]", ylabel="gap along n [m]", xlim=(0, h[-1]), ylim=(-0.02, 0.65))
    for k, (t, gap_k, advance) in enumerate(zip(rows["t"], rows["gap_lower"], rows["advance"])):
        right.plot([t, t + advance], [k, k], color=BLUE, lw=7, solid_capstyle="butt")
        right.plot([t + advance, t + advance], [k, k + 1], color=GREY, lw=0.8, ls=":")
        if k < 5:
            note(right, (t + advance + 0.03, k), f"row {k}", DARK, ha="left")
    end = rows["t"][-1] + rows["advance"][-1]
    right.axvline(end, color=RED, lw=1.2)
    note(right, (end - 0.02, -0.75), "toc", RED, ha="right")
    right.invert_yaxis()
    right.set(title="2  The rows chain, from 0 to toc", xlabel="t [s]", yticks=[], xlim=(0, end + 0.02), ylim=(len(rows) - 0.4, -1.1))
    for axes in (left, right):
        axes.grid(False)
    return figure


# --- planes and GJK -------------------------------------------------------------------------------------------------


def slab(runs: Path) -> plt.Figure:
    a, b = two_bodies(runs / "slab_shapes.csv")
    planes, turned, closest = (Table(runs / f"slab_{name}.csv") for name in ("planes", "turned", "closest"))
    figure, panels = plt.subplots(1, 3, figsize=(9.2, 3.2), width_ratios=(1, 1, 0.95))
    for i, axes in enumerate(panels[:2]):
        bare(axes, "1  any n" if i == 0 else "2  the best n")
        n = planes.vectors("nx", "ny")[i]
        ahead, behind = planes.vectors("ax", "ay")[i], planes.vectors("bx", "by")[i]
        band(axes, n, n @ ahead, n @ behind, 1.5, (0.8, 0.2))
        body(axes, a, PALE)
        body(axes, b, PALE)
        note(axes, (-0.35, -0.05), "A", DARK, fontsize=12)
        note(axes, (2.1, 0.55), "B", DARK, fontsize=12)
        if i == 0:
            axes.plot(*np.array([ahead, behind]).T, "o", color=BLUE, ms=6, zorder=6)
        else:
            ends = np.array([[closest["ax"][0], closest["ay"][0]], [closest["bx"][0], closest["by"][0]]])
            axes.plot(*ends.T, "o-", color=RED, lw=1.4, ms=5.5, zorder=6)
            note(axes, ends[0] + [-0.13, -0.12], "a", RED, style="italic")
            note(axes, ends[1] + [0.02, 0.2], "b", RED, style="italic")
        along = np.array([-n[1], n[0]])
        foot = (0.8, 0.2) @ along * along - 1.25 * along
        length(axes, foot + (n @ ahead) * n, foot + (n @ behind) * n, f"g(n) = {planes['gap'][i]:.2f} m", foot + (n @ behind) * n + [0.75, 0.02], BLUE)
        top = (0.8, 0.2) @ along * along + 1.2 * along + (n @ ahead) * n + 0.15 * n
        arrow(axes, top, top + 0.5 * n, BLUE)
        note(axes, top + 0.62 * n, "n", BLUE, style="italic")
        axes.set(xlim=(-1.25, 2.95), ylim=(-1.45, 1.65))
    graph = panels[2]
    degrees = np.degrees(turned["angle"])
    graph.axhline(0, color=GREY, lw=0.8)
    graph.axhline(closest["distance"][0], color=RED, lw=1, ls="--")
    graph.plot(degrees, turned["gap"], color=BLUE)
    for i, angle in ((0, np.degrees(-0.55)), (1, 0)):
        graph.plot(angle, planes["gap"][i], "o", color=BLUE, ms=6)
        note(graph, (angle + (-7 if i == 0 else 7), planes["gap"][i] + (0.06 if i == 0 else 0.13)), str(i + 1), BLUE)
    note(graph, (88, closest["distance"][0] + 0.09), "d", RED, style="italic")
    note(graph, (0, -0.75), "below 0: this n\nproves nothing", GREY)
    graph.set(title="3  every n", xlabel="angle of n from the best one [°]", ylabel="g(n) [m]", xlim=(-95, 95), ylim=(-1.3, 1.25), xticks=[-90, -45, 0, 45, 90])
    graph.grid(False)
    return figure


def difference(runs: Path) -> plt.Figure:
    a, b = two_bodies(runs / "gjk_shapes.csv")
    points = Table(runs / "gjk_difference.csv").vectors("x", "y")
    last = Table(runs / "gjk_steps.csv").vectors("x", "y")[-1]
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.9))
    bare(left, "1  two bodies")
    body(left, a, "#DCEBF5", BLUE)
    body(left, b, "#FFE9BF", ORANGE)
    note(left, a.mean(axis=0) + [0.15, -0.05], "A", BLUE, fontsize=12)
    note(left, b.mean(axis=0) + [0.05, 0], "B", ORANGE, fontsize=12)
    pairs = [(a[2], b[2], GREEN)]
    for start, end, colour in pairs:
        arrow(left, start, end, colour)
        left.plot(*start, "o", color=colour, ms=5)
        note(left, start + [-0.12, 0.1], "a", colour, style="italic")
        note(left, end + [0.14, 0.08], "b", colour, style="italic")
    left.set(xlim=(-1.4, 3.0), ylim=(-1.6, 1.75))
    bare(right, "2  all differences b − a: one body, B − A")
    body(right, hull(points), "#EAF3EC", GREEN)
    right.plot(*points.T, ".", color=GREEN, ms=5)
    arrow(right, (0, 0), b[2] - a[2], GREEN)
    note(right, 0.72 * (b[2] - a[2]) + [0.12, -0.14], "b − a", GREEN, style="italic", ha="left")
    right.plot(0, 0, "+", color=DARK, ms=11, mew=1.6)
    note(right, (-0.1, -0.17), "0", DARK)
    arrow(right, (0, 0), last, RED)
    note(right, 0.5 * last + [-0.12, 0.1], f"d = {np.linalg.norm(last):.2f} m", RED, ha="right")
    note(right, (1.2, 1.85), "B − A", GREEN, fontsize=12)
    right.set(xlim=(-1.1, 3.7), ylim=(-0.6, 2.9))
    return figure


def gjk(runs: Path) -> plt.Figure:
    outline_of = hull(Table(runs / "gjk_difference.csv").vectors("x", "y"))
    steps, corners = Table(runs / "gjk_steps.csv"), Table(runs / "gjk_simplex.csv")
    figure, panels = plt.subplots(1, 4, figsize=(9.2, 2.75))
    before = np.empty((0, 2))
    best = -np.inf
    for k, axes in enumerate(panels):
        kept = corners.vectors("x", "y")[corners["iteration"] == k + 1]
        x, s = steps.vectors("x", "y")[k], steps.vectors("sx", "sy")[k]
        n = x / np.linalg.norm(x)
        lower = n @ s
        best = max(best, lower)
        bare(axes, f"{k + 1}:  {best:.2f} ≤ d ≤ {np.linalg.norm(x):.2f}")
        body(axes, outline_of, "#F2F2F2", "#BBBBBB", lw=0.8)
        for corner in before:  # of the simplex before: what is not kept
            if not any(np.allclose(corner, other) for other in kept):
                axes.plot(*corner, "x", color=GREY, ms=7, mew=1.6, zorder=5)
        if len(kept) > 1:
            axes.plot(*kept.T, color=BLUE, lw=2.4, zorder=4)
        axes.plot(*kept.T, "o", color=BLUE, ms=6, zorder=6)
        arrow(axes, (0, 0), x, RED, shrinkB=1)
        note(axes, 0.55 * x + np.array([n[1], -n[0]]) * 0.2, "x", RED, style="italic")
        along = np.array([-n[1], n[0]])
        axes.plot(*np.array([lower * n - 2.2 * along, lower * n + 2.2 * along]).T, color=GREEN, lw=1.1, ls="--")
        fresh = not any(np.allclose(s, other) for other in kept)
        axes.plot(*s, "s", mfc="white" if fresh else GREEN, mec=GREEN, ms=9 if not fresh else 7, mew=1.6, zorder=5)
        note(axes, s + np.array([-0.22, -0.24]), "s", GREEN, style="italic")
        axes.plot(0, 0, "+", color=DARK, ms=9, mew=1.5)
        axes.set(xlim=(-0.5, 3.4), ylim=(-0.95, 2.65))
        before = np.vstack([kept, s])
    words = (("● the simplex", BLUE), ("× dropped", GREY), ("x: its point closest to 0 (+)", RED), ("□ s: the farthest point against x, and its line", GREEN))
    for at, (text, colour) in zip((0.02, 0.17, 0.28, 0.56), words):
        figure.text(at, 0.02, text, color=colour, fontsize=9)
    return figure


# --- how fast -------------------------------------------------------------------------------------------------------


def corners(runs: Path) -> plt.Figure:
    speeds, bound = Table(runs / "corners_speed.csv"), Table(runs / "corners_bound.csv")
    spin = bound["spin"][0]
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(9.2, 3.3), width_ratios=(1, 1, 1.15))
    times = np.unique(speeds["t"])
    fastest = np.array([np.max(speeds["speed"][speeds["t"] == t]) for t in times])
    for axes, t, title in ((left, times[0], "1  now"), (middle, times[np.argmax(fastest)], "2  soon after")):
        bare(axes, title)
        here = speeds["t"] == t
        places = speeds.vectors("x", "y")[here]
        body(axes, places, PALE)
        axes.axvspan(0.95, 1.15, color=SLAB, lw=0)
        note(axes, (1.05, 0), "B", BLUE)
        for place, speed in zip(places, speeds["speed"][here]):
            if speed > 1e-9:
                arrow(axes, place, place + [0.55 * speed, 0], RED)
                low = place[1] <= np.min(places[:, 1]) + 1e-9
                note(axes, place + [0.28 * speed, -0.1 if low else 0.1], f"{speed:.2f} m/s", RED, fontsize=8.5)
        angles = np.linspace(0.4, 1.6, 40)
        axes.plot(0.14 * np.cos(angles * 2), 0.14 * np.sin(angles * 2), color=ORANGE, lw=1.2)
        arrow(axes, (0.14 * np.cos(3.15), 0.14 * np.sin(3.15)), (0.14 * np.cos(3.3), 0.14 * np.sin(3.3)), ORANGE, 1.2)
        note(axes, (0.02, 0), "ω", ORANGE)
        arrow(axes, (0.3, -0.85), (0.75, -0.85), BLUE)
        note(axes, (0.22, -0.85), "n", BLUE, style="italic")
        axes.set(xlim=(-0.8, 1.2), ylim=(-0.95, 0.85))
    for i in range(4):
        corner = speeds["corner"] == i
        right.plot(speeds["t"][corner], speeds["speed"][corner], color=GREY, lw=1)
    right.plot(times, fastest, color=RED, lw=2)
    right.axhline(bound["bound"][0], color=BLUE, lw=1.4)
    right.axhline(bound["now"][0], color=ORANGE, lw=1.4, ls="--")
    note(right, (times[-1], bound["bound"][0] + 0.09), "the bound, |n × ω| R", BLUE, ha="right")
    note(right, (0.79, bound["now"][0] - 0.1), "the fastest corner now", ORANGE)
    note(right, (0.79, 0.8), "the fastest\nat each time", RED)
    right.set(title="3  each corner's speed along n", xlabel="t [s]", ylabel="[m/s]", xlim=(0, times[-1]), ylim=(-0.3, 1.55))
    right.grid(False)
    return figure


def turned(runs: Path) -> plt.Figure:
    table, places = Table(runs / "turned.csv"), Table(runs / "turned_corners.csv")
    now = places.vectors("x", "y")
    spin = places["spin"][0]
    k = 30
    h = table["h"][k]
    direction = np.array([table["dx"][k], table["dy"][k]])
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.9), width_ratios=(1, 1.15))
    bare(left, f"1  which corner is ahead after h = {h:.1f} s?")
    later = now @ rotation(spin * h).T
    body(left, later, "none", GREY, ls=":", lw=1.2)
    body(left, now, PALE)
    first, second = int(table["corner"][0]), int(table["corner"][k])
    for place in now:
        velocity = spin * np.array([-place[1], place[0]])
        arrow(left, place, place + 0.16 * velocity, RED, 1.1)
    reach = now[first][0]
    left.plot([reach, reach], [-0.75, 0.75], color=BLUE, lw=1.2, ls="--")
    unit = direction / np.linalg.norm(direction)
    across = np.array([-unit[1], unit[0]])
    foot = now[second] @ unit * unit
    left.plot(*np.array([now[second] - 0.28 * across, now[second] + 0.75 * across]).T, color=GREEN, lw=1.2, ls="--")
    left.plot(*now[first], "o", color=BLUE, ms=7, zorder=6)
    left.plot(*now[second], "o", color=GREEN, ms=7, zorder=6)
    start = np.array([-0.55, -0.45])
    arrow(left, start, start + [0.38, 0], BLUE)
    note(left, start + [0.46, 0.03], "n", BLUE, style="italic")
    arrow(left, start, start + 0.38 * direction, GREEN)
    note(left, start + 0.38 * direction + [0.02, -0.09], "n + h n × ω", GREEN, style="italic")
    note(left, (reach + 0.02, 0.68), "ahead now", BLUE, ha="left")
    note(left, (reach + 0.03, now[second][1] - 0.03), "ahead later", GREEN, ha="left")
    left.set(xlim=(-0.85, 1.05), ylim=(-0.95, 0.8))
    t, foretold, rest, true = (table[name] for name in ("h", "foretold", "rest", "true"))
    shown = t <= 0.32
    t, foretold, rest, true = t[shown], foretold[shown], rest[shown], true[shown]
    reach_of_bar = np.max(np.linalg.norm(now, axis=1))
    right.plot(t, true[0] + spin * reach_of_bar * t, color=ORANGE, lw=1.5)
    right.plot(t, foretold + rest, color=BLUE, lw=1.8)
    right.plot(t, foretold, color=GREEN, lw=1.4, ls="--")
    right.plot(t, true, color=DARK, lw=1.6)
    for y, text, colour in ((true[0] + spin * reach_of_bar * t[-1], "speed bound", ORANGE), ((foretold + rest)[-1], "with what the\nturn can bend", BLUE), (foretold[-1], "turned normal", GREEN),
                            (true[-1] - 0.005, "the bar", DARK)):
        note(right, (t[-1] + 0.005, y), text, colour, ha="left")
    right.set(title="2  how far the bar reaches along n", xlabel="h [s]", ylabel="[m]", xlim=(0, t[-1] + 0.095), ylim=(0.58, 1.08))
    right.grid(False)
    return figure


DRAWINGS = {drawing.__name__: drawing for drawing in (first_slab, staircase, where_to_stop, certificate, slab, difference, gjk, corners, turned)}


if __name__ == "__main__":
    draw(__doc__, DRAWINGS)
