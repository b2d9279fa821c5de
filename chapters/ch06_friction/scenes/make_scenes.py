#!/usr/bin/env python3
"""Writes the scenes of this folder whose numbers come from geometry: arch.yaml, arch_25.yaml, card_house.yaml, slide.yaml, slope.yaml,
mixed_slope.yaml.

    python3 chapters/ch06_friction/scenes/make_scenes.py
"""

import math
from pathlib import Path

HERE = Path(__file__).resolve().parent
FRAME = "{dt: 0.016666666666666666, duration: %s}"


def vector(*numbers: float) -> str:
    return "[" + ", ".join(f"{round(x, 9) + 0:.9g}" for x in numbers) + "]"


def write(name: str, text: str) -> None:
    (HERE / f"{name}.yaml").write_text(text, encoding="utf-8")


def arch(name: str, stones: int, thick: float, least: float, radius: float = 5, deep: float = 1, margin: float = 1e-3, smaller: float = 0.002) -> None:
    """The joints are open by the rest gap, half of the margin: nothing has to be put right at the start. Every second stone is a
    little smaller all round, so that a joint has four points, and not the eight of two equal squares."""
    half, inset = 0.5 * math.pi / stones, 0.25 * margin

    def corners(less: float) -> str:
        points = []
        for side in (-1, 1):
            for r in (radius - 0.5 * thick + less, radius + 0.5 * thick - less):
                # The joint's plane goes through the arch's axis; the stone's face lies a quarter of the margin beside it.
                x = (r * math.sin(half) - inset / math.cos(half)) * side
                z = r * math.cos(half) - radius
                points += [vector(x, less - 0.5 * deep, z), vector(x, 0.5 * deep - less, z)]
        return ", ".join(points)

    bodies = []
    for k in range(stones):
        angle = -0.5 * math.pi + (2 * k + 1) * half  # from the vertical
        place = vector(radius * math.sin(angle), 0, radius * math.cos(angle))
        shape = "smaller" if k % 2 else "stone"
        bodies.append(f"  - {{shape: {shape}, position: {place}, rotation: {{axis: [0, 1, 0], degrees: {math.degrees(angle):.9g}}}}}")
    write(name, f"""# An arch of {stones} stones without mortar: a semicircle, {thick / radius:g} of its radius thick. It needs µ >= {least:.3f} (by linear programming, for forces
# at the joints' inner and outer edges); here µ is 0.5. The joints are open by half of the margin, and every second stone is smaller by 2 mm.
name: {name}
step: {FRAME % 1}
gravity: [0, 0, -9.81]
envelope: {margin:g}
friction: 0.5
shapes:
  stone: {{hull: {{points: [{corners(0)}]}}, density: 2400}}
  smaller: {{hull: {{points: [{corners(smaller)}]}}, density: 2400}}
  floor: {{box: {{size: [16, 4, 1]}}}}
bodies:
  - {{shape: floor, static: true, position: [0, 0, {-0.5 - inset:g}]}}
""" + "\n".join(bodies) + "\n")


def card_house(long: float = 1, wide: float = 0.7, thick: float = 0.02, degrees: float = 65, margin: float = 4e-4) -> None:
    """Two tents, a card across them, and a tent on top; cards that touch are half of the margin apart."""
    angle, gap = math.radians(degrees), 0.5 * margin
    high = long * math.sin(angle) + thick * math.cos(angle)
    top = 0.5 * (long * math.cos(angle) + thick * math.sin(angle))  # from a card's centre to the corner that leans
    bodies = []

    def tent(x: float, floor: float) -> None:
        for side in (-1, 1):
            turn = -side * degrees  # a turn about y takes x to -z
            place = vector(x + side * (top + 0.5 * gap), 0, floor + gap + 0.5 * high)
            bodies.append(f"  - {{shape: card, position: {place}, rotation: {{axis: [0, 1, 0], degrees: {-turn:g}}}}}")

    apart = 1.06
    tent(-0.5 * apart, 0)
    tent(0.5 * apart, 0)
    level = high + 2 * gap
    bodies.append(f"  - {{shape: roof, position: {vector(0, 0, level + 0.5 * thick)}}}")
    tent(0, level + thick)
    write("card_house", f"""# A house of seven cards: two tents, a card across, and a tent on top. A tent alone needs a floor of µ >= 1/(2 tan {degrees:g}°) = {0.5 / math.tan(angle):.3f};
# one that carries something needs up to twice that.
name: card_house
step: {FRAME % 3}
gravity: [0, 0, -9.81]
envelope: {margin:g}
friction: 0.6
shapes:
  card: {{box: {{size: [{long:g}, {wide:g}, {thick:g}]}}, density: 700}}
  roof: {{box: {{size: [{1.5 * long:g}, {wide:g}, {thick:g}]}}, density: 700}}
  floor: {{box: {{size: [6, 4, 1]}}}}
bodies:
  - {{shape: floor, static: true, position: [0, 0, -0.5]}}
""" + "\n".join(bodies) + "\n")


def slide(directions: int = 16, speed: float = 3, start: float = 1.5) -> None:
    bodies = []
    for k in range(directions):
        c, s = math.cos(2 * math.pi * k / directions), math.sin(2 * math.pi * k / directions)
        bodies.append(f"  - {{shape: block, position: {vector(start * c, start * s, 0.10025)}, velocity: {vector(speed * c, speed * s, 0)}}}")
    write("slide", f"""# Sixteen blocks start on a circle and slide outwards at {speed:g} m/s, all turned alike. Each stops after v²/(2µ|g|) = {speed**2 / 9.81:.4f} m,
# in the direction in which it started: the dots lie on a circle again.
name: slide
step: {FRAME % 1}
gravity: [0, 0, -9.81]
envelope: 5.0e-4
friction: 0.5
shapes:
  block: {{box: {{size: [0.3, 0.3, 0.2]}}, mass: 1}}
  floor: {{box: {{size: [8, 8, 1]}}}}
bodies:
  - {{shape: floor, static: true, position: [0, 0, -0.5]}}
""" + "\n".join(bodies) + "\n")


def on_slope(tilt: float, along: float, across: float, up: float) -> str:
    """A place on a plane through the origin that falls towards +x."""
    return vector(along * math.cos(tilt) + up * math.sin(tilt), across, -along * math.sin(tilt) + up * math.cos(tilt))


def slope() -> None:
    tilt = math.atan(0.5)
    turn = f"rotation: {{axis: [0, 1, 0], degrees: {math.degrees(tilt):.12g}}}"
    blocks = [("a", 0.08), ("b", 0.32), ("c", 0.48), ("d", 0.52), ("e", 1.28)]
    shapes = "\n".join(f"  {name}: {{box: {{size: [0.5, 0.5, 0.5]}}, mass: 1, friction: {value:g}}}  # µ = {math.sqrt(0.5 * value):.4f}" for name, value in blocks)
    bodies = "\n".join(f"  - {{shape: {name}, position: {on_slope(tilt, 0, k - 2, 0.25025)}, {turn}}}" for k, (name, _) in enumerate(blocks))
    write("slope", f"""# Five blocks on a slope with tan α = 0.5. A pair's µ is the geometric mean of its two shapes' values. Those below 0.5 slide with
# |g| (sin α - µ cos α), the others stay for ever.
name: slope
step: {FRAME % 2}
gravity: [0, 0, -9.81]
envelope: 5.0e-4
shapes:
{shapes}
  slope: {{box: {{size: [20, 8, 1]}}, friction: 0.5}}
bodies:
  - {{shape: slope, static: true, position: {on_slope(tilt, 8, 0, -0.5)}, {turn}}}
{bodies}
""")


def mixed_slope() -> None:
    tilt = math.atan(0.3)
    turn = f"rotation: {{axis: [0, 1, 0], degrees: {math.degrees(tilt):.12g}}}"
    sledges = []
    for k, (below, above) in enumerate((("ice", "rubber"), ("rubber", "ice"), ("wood", "wood"), ("ice", "ice"), ("ice", "ball"), ("rubber", "ball"))):
        sledges.append(f"  - {{shape: {below}, position: {on_slope(tilt, 0, 1.2 * k - 3, 0.10025)}, {turn}}}")
        sledges.append(f"  - {{shape: {above}, position: {on_slope(tilt, 0, 1.2 * k - 3, 0.3005 if above != 'ball' else 0.4005)}, {turn}}}")
    write("mixed_slope", f"""# Sledges of ice, wood and rubber, each with a load, on a board with tan α = 0.3: which pair slides is said pair by pair.
# What is not named takes the geometric mean. Balls roll.
name: mixed_slope
step: {FRAME % 2}
gravity: [0, 0, -9.81]
envelope: 5.0e-4
shapes:
  ice: {{box: {{size: [0.6, 0.5, 0.2]}}, density: 900, friction: 0.05}}
  wood: {{box: {{size: [0.6, 0.5, 0.2]}}, density: 600, friction: 0.4}}
  rubber: {{box: {{size: [0.6, 0.5, 0.2]}}, density: 1100, friction: 0.9}}
  ball: {{sphere: {{radius: 0.2}}, density: 900, friction: 0.9}}
  board: {{box: {{size: [24, 10, 1]}}, friction: 0.4}}
pairs:
  - {{a: ice, b: board, friction: 0.02}}
  - {{a: ice, b: rubber, friction: 0.15}}
  - {{a: ice, b: ball, friction: 0.4}}
bodies:
  - {{shape: board, static: true, position: {on_slope(tilt, 9, 0, -0.5)}, {turn}}}
""" + "\n".join(sledges) + "\n")


if __name__ == "__main__":
    arch("arch", 13, 1.0, 0.306)
    arch("arch_25", 25, 0.75, 0.350)
    card_house()
    slide()
    slope()
    mixed_slope()
