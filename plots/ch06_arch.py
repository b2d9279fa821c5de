#!/usr/bin/env python3
"""The least coefficient of friction with which a half-circle of stones stands: statics, no simulation.

    python3 plots/ch06_arch.py --stones 13 --inner 4.5 --outer 5.5

It stands if there are forces at the joints that balance the weights, act inside the joints, and lie in their cones. By
symmetry two numbers suffice: the thrust H at the crown, and its moment about the centre. With both, the force at every joint
is known, and every condition is linear in them."""

import argparse
import math


def half_arch(stones: int, inner: float, outer: float) -> list[tuple[float, float, float]]:
    """For each joint from the crown down: its angle from the vertical, the weight above it up to the crown, and the moment of
    that weight about the centre. The stones are straight, and weigh 1."""
    half = 0.5 * math.pi / stones
    # A trapezoid with a corner at each of the radii: its centroid's distance from the centre, and that of half of it from the
    # middle line.
    top, bottom = outer * math.sin(half), inner * math.sin(half)
    radius = math.cos(half) * (inner + (outer - inner) * (bottom + 2 * top) / (3 * (bottom + top)))
    side = (top**2 + top * bottom + bottom**2) / (3 * (top + bottom))
    joints, weight, moment = [], 0.5, 0.5 * side
    for k in range((stones + 1) // 2):
        joints.append(((2 * k + 1) * half, weight, moment))
        weight += 1
        moment += radius * math.sin(2 * (k + 1) * half)
    return joints


def room(thrust: float, joints: list[tuple[float, float, float]], inner: float, outer: float) -> float:
    """How much the thrust's moment may vary so that all forces act inside the joints; negative: there is none."""
    low, high = -math.inf, math.inf
    for angle, weight, moment in joints:
        push = thrust * math.cos(angle) + weight * math.sin(angle)
        low, high = max(low, inner * push - moment), min(high, outer * push - moment)
    return high - low


def least_friction(stones: int, inner: float, outer: float) -> float:
    joints = half_arch(stones, inner, outer)

    def friction(thrust: float) -> float:
        return max(abs(thrust * math.sin(a) - w * math.cos(a)) / (thrust * math.cos(a) + w * math.sin(a)) for a, w, _ in joints)

    thrusts = [0.001 * stones * k / 100 for k in range(1, 100_001)]
    standing = [friction(h) for h in thrusts if room(h, joints, inner, outer) >= 0]
    return min(standing, default=math.inf)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--stones", type=int, default=13, help="odd (default: 13)")
    parser.add_argument("--inner", type=float, default=4.5, help="inner radius, m (default: 4.5)")
    parser.add_argument("--outer", type=float, default=5.5, help="outer radius, m (default: 5.5)")
    options = parser.parse_args()
    print(f"least friction {least_friction(options.stones, options.inner, options.outer):.4f}")


if __name__ == "__main__":
    main()
