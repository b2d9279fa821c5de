"""Writes the meshes of interlocked_rings.yaml and bolt_in_nut.yaml: ring.obj, bolt.obj and nut.obj.

    python3 chapters/ch02_hull_hierarchy/scenes/make_meshes.py [FOLDER]     # default: beside this file
"""

import math
import sys
from pathlib import Path

Outline = list[tuple[float, float]]  # (r, z) in m


def lathe(columns: list[Outline], ring: bool) -> str:
    """A closed surface of columns about the z axis, as OBJ. A ring's column is a closed outline, up on the outside and
    down on the inside; another one goes up, and both its ends are closed towards the axis."""
    around, height = len(columns), len(columns[0])
    lines = []
    for i, column in enumerate(columns):
        phi = 2 * math.pi * i / around
        lines += [f"v {r * math.cos(phi):.9f} {r * math.sin(phi):.9f} {z:.9f}" for r, z in column]

    def at(i: int, k: int) -> int:
        return i % around * height + k % height + 1

    for i in range(around):
        for k in range(height if ring else height - 1):
            lines.append(f"f {at(i, k)} {at(i + 1, k)} {at(i + 1, k + 1)}")
            lines.append(f"f {at(i, k)} {at(i + 1, k + 1)} {at(i, k + 1)}")
    if not ring:
        low = around * height + 1
        lines += [f"v 0 0 {columns[0][0][1]:.9f}", f"v 0 0 {columns[0][-1][1]:.9f}"]
        for i in range(around):
            lines.append(f"f {low} {at(i + 1, 0)} {at(i, 0)}")
            lines.append(f"f {low + 1} {at(i, height - 1)} {at(i + 1, height - 1)}")
    return "\n".join(lines).replace("-0.000000000", "0.000000000") + "\n"


def ring(big: float, small: float, around: int, across: int) -> str:
    angles = [2 * math.pi * (k + 0.5) / across for k in range(across)]
    return lathe([[(big + small * math.cos(v), small * math.sin(v)) for v in angles]] * around, ring=True)


RADIUS, DEPTH, PITCH, STEPS = 1.0, 0.2, 0.6, 12  # of the thread: m, m, m, and points of a turn


def thread(phase: int) -> float:
    """The radius in m after so many steps along the thread's profile: root, flank, crest, flank."""
    k, quarter = phase % STEPS, STEPS // 4
    rise = [0, (k - quarter) / quarter, 1, (STEPS - k) / quarter][k // quarter]
    return RADIUS + DEPTH * rise


def heights(turns: int) -> list[tuple[int, float]]:
    return [(k, PITCH * (k / STEPS - turns / 2)) for k in range(turns * STEPS + 1)]


def bolt(turns: int) -> str:
    return lathe([[(thread(k - i), z) for k, z in heights(turns)] for i in range(STEPS)], ring=False)


def nut(turns: int, clearance: float, rim: float) -> str:
    half = turns * PITCH / 2
    outside = [(rim, -half), (rim, half)]
    return lathe([outside + [(thread(k - i) + clearance, z) for k, z in reversed(heights(turns))]
                  for i in range(STEPS)], ring=True)


def main() -> None:
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
    for name, text in (("ring.obj", ring(1, 0.2, 24, 8)), ("bolt.obj", bolt(3)), ("nut.obj", nut(1, 0.1, 1.6))):
        (folder / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
