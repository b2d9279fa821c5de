"""The queries behind chapter 1's "What accuracy costs": the same files at every run (a fixed seed).

Writes into DIR: hulls.yaml with 200 random flights of two hulls (hulls.csv); grazing.yaml with a ball that meets a corner of a
spinning brick halfway through, at angles from 90 degrees down (hits.csv), or passes it at distances from 0.1 m down
(misses.csv); and angles.csv and distances.csv, which say at which.
"""

import argparse
import csv
import math
import random
from pathlib import Path

COLUMNS = [body + name for body in ("a_", "b_") for name in
           ("px", "py", "pz", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz")]
UNTURNED = (1, 0, 0, 0)


def direction(rng: random.Random, n: int = 3) -> list[float]:
    x = [rng.gauss(0, 1) for _ in range(n)]
    size = math.sqrt(sum(c * c for c in x))
    return [c / size for c in x]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def along(a, s, b):  # a + s b
    return [x + s * y for x, y in zip(a, b)]


def write_csv(file: Path, header: list[str], rows: list) -> None:
    with open(file, "w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([[repr(float(x)) for x in row] for row in rows])


def hulls(folder: Path, rng: random.Random) -> None:
    def points(n):
        return ", ".join("[" + ", ".join(f"{0.5 * c:.3f}" for c in direction(rng)) + "]" for _ in range(n))

    (folder / "hulls.yaml").write_text(f"""name: hulls
interval: 1.0
motions: hulls.csv
shapes:
  a: {{hull: {{points: [{points(40)}]}}}}
  b: {{hull: {{points: [{points(40)}]}}}}
bodies:
  - {{shape: a}}
  - {{shape: b}}
""")
    rows = []
    for _ in range(200):
        apart = [3 * c for c in direction(rng)]
        velocity = along([-1.5 * c for c in apart], 1.6, direction(rng))
        a = [0, 0, 0, *direction(rng, 4), 0, 0, 0, *(rng.uniform(0, 6) * c for c in direction(rng))]
        b = [*apart, *direction(rng, 4), *velocity, *(rng.uniform(0, 6) * c for c in direction(rng))]
        rows.append(a + b)
    write_csv(folder / "hulls.csv", COLUMNS, rows)


def grazing(folder: Path) -> None:
    """At t = 1/2 the brick is unturned, and the ball touches its first corner from outside."""
    half, radius, speed, spin = [0.6, 0.2, 0.15], 0.3, 2.0, [0.6, -0.8, 3.0]
    rate = math.sqrt(sum(c * c for c in spin))
    # The brick's orientation at t = 0: turned back by half a second's turn.
    back = [math.cos(-rate / 4), *(math.sin(-rate / 4) * c / rate for c in spin)]
    size = math.sqrt(sum(c * c for c in half))
    n = [c / size for c in half]  # from the centre through the corner: inside the corner's normal cone
    tangent = cross(n, direction(random.Random(5)))
    length = math.sqrt(sum(c * c for c in tangent))
    tangent = [c / length for c in tangent]
    corner_velocity = cross(spin, half)

    def row(angle, distance):
        velocity = along(along(corner_velocity, -speed * math.sin(angle), n), speed * math.cos(angle), tangent)
        there = along(half, radius + distance, n)
        return [0, 0, 0, *back, 0, 0, 0, *spin, *along(there, -0.5, velocity), *UNTURNED, *velocity, 0, 0, 0]

    (folder / "grazing.yaml").write_text(f"""name: grazing
interval: 1.0
motions: hits.csv
shapes:
  brick: {{box: {{size: {[2 * c for c in half]}}}}}
  ball: {{sphere: {{radius: {radius}}}}}
bodies:
  - {{shape: brick}}
  - {{shape: ball}}
""")
    angles = [90 * 10 ** (-k / 4) for k in range(29)]
    distances = [10 ** (-1 - k / 4) for k in range(19)]
    write_csv(folder / "hits.csv", COLUMNS, [row(math.radians(angle), 0) for angle in angles])
    write_csv(folder / "misses.csv", COLUMNS, [row(0, distance) for distance in distances])
    write_csv(folder / "angles.csv", ["angle [deg]"], [[angle] for angle in angles])
    write_csv(folder / "distances.csv", ["distance [m]"], [[distance] for distance in distances])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dir", type=Path, metavar="DIR")
    folder = parser.parse_args().dir
    folder.mkdir(parents=True, exist_ok=True)
    hulls(folder, random.Random(2008))
    grazing(folder)


if __name__ == "__main__":
    main()
