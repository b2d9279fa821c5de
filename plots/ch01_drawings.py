"""Chapter 1's drawings, each from the tables that `ch01_pictures` wrote.

Reads RUN_DIR/slab_*.csv, gjk_*.csv, corners_*.csv, turned*.csv and flight_*.csv, which the chapter's text says how to make.
Writes one picture for each name into the folder --out.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import argparse
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Rectangle

from sketch import DARK, PALE, arrow, bare, body, length, note, rotation
from style import BLUE, GREEN, GREY, ORANGE, RED, SKY, PlotError, Table, save

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
    """What lies between two parallel lines: low <= n.x <= high, for some way to either side of `middle`."""
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
    for t in flight.times[1:-1]:
        outline(axes, flight.corners[t, "b"] @ view.T, "none", GREY, alpha=0.45, lw=0.8, zorder=3)
    outline(axes, flight.corners[flight.contact, "b"] @ view.T, "none", RED, lw=1.4, zorder=4)
    outline(axes, start, "#FFE9BF", ORANGE, lw=1.4, zorder=4)
    bottom = -0.80
    length(axes, (low, bottom), (high, bottom), f"nothing of either body: {flight.rows['gap_lower'][0]:.2f} m along n", (0.5 * (low + high), bottom + 0.1), BLUE)
    arrow(axes, (low + 0.55, 0.74), (low + 0.9, 0.74), BLUE)
    note(axes, (low + 0.72, 0.84), "n", BLUE, style="italic")
    centre = start.mean(axis=0)
    arrow(axes, centre + [0.72, 0.42], centre + [0.15, 0.42], ORANGE)
    note(axes, centre + [0.45, 0.55], "1.5 m/s, and it spins", ORANGE)
    note(axes, cube.mean(axis=0) + [0, 0], "A", DARK, fontsize=12)
    note(axes, centre, "B", DARK, fontsize=12)
    note(axes, cube.mean(axis=0) + [0, -0.86], "the cube, at rest", DARK)
    note(axes, centre + [0.1, -0.6], "the brick at t = 0", ORANGE)
    note(axes, (0.62, 0.84), f"first contact, t = {flight.contact:.3f} s", RED, ha="left", fontsize=9)
    axes.set(xlim=(-0.75, 3.9), ylim=(-1, 1))
    return figure


def staircase(runs: Path) -> plt.Figure:
    flight = Flight(runs)
    rows = flight.rows
    tolerance = 0.1
    figure, axes = plt.subplots(figsize=(9.2, 3.9))
    shown = flight.distance["t"] <= flight.contact + 0.1
    axes.plot(flight.distance["t"][shown], flight.distance["distance"][shown], color=GREY, lw=1.3)
    for t, gap, step in zip(rows["t"], rows["gap_lower"], rows["advance"]):
        axes.plot([t, t + step], [gap, tolerance / 2], color=BLUE, lw=1.4)
        axes.plot([t + step, t + step], [tolerance / 2, np.interp(t + step, flight.distance["t"], flight.distance["distance"])], color=BLUE, lw=0.7, ls=":")
        axes.plot(t, gap, "o", color=BLUE, ms=5, zorder=5)
    axes.plot(flight.contact, np.interp(flight.contact, flight.distance["t"], flight.distance["distance"]), "s", color=RED, ms=6, zorder=6)
    axes.axhspan(0, tolerance, color=PALE, lw=0)
    axes.axhline(tolerance / 2, color=GREEN, lw=1, ls="--")
    axes.set(xlabel="t [s]", ylabel="gap [m]", xlim=(0, flight.contact + 0.1), ylim=(0, 2.1))
    return figure


DRAWINGS = {"first_slab": first_slab, "staircase": staircase}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=Path, metavar="RUN_DIR", help="the folder with the tables")
    parser.add_argument("--out", type=Path, metavar="DIR", help="where the pictures go; default: RUN_DIR")
    parser.add_argument("--only", choices=sorted(DRAWINGS), nargs="+", default=sorted(DRAWINGS), metavar="NAME", help="these pictures alone")
    parser.add_argument("--kind", choices=("svg", "png", "pdf"), default="svg", help="default: svg")
    options = parser.parse_args()
    try:
        if not options.run.is_dir():
            raise PlotError(f"{options.run}: no such folder")
        folder = options.out or options.run
        folder.mkdir(parents=True, exist_ok=True)
        for name in options.only:
            figure = DRAWINGS[name](options.run)
            save(figure, folder / f"{name}.{options.kind}")
            plt.close(figure)
    except PlotError as error:
        print(f"ch01_drawings.py: {error}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
