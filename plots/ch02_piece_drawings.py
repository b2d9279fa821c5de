"""Chapter 2's drawings of bodies in pieces, and of their tree of hulls. Drawn by ch02_drawings.py."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from ch02_hierarchy import outline
from ch02_toy import COLOURS, PALES, Toy, look_at
from sketch import DARK, bare, body, note
from style import ORANGE, RED, Table


def pieces(run: Path) -> plt.Figure:
    toy = Toy(run)
    figure, panels = plt.subplots(1, 2, figsize=(9.2, 3.6))
    for axes, title in zip(panels, ("No line separates the two hulls …", "… but each pair of pieces has one")):
        bare(axes, title)
        toy.draw(axes, 0.78)
    for name in ("abcd", "123"):
        body(panels[0], toy.hull(name, 0.78), "#F4C9B055", RED, ls="--", lw=1.5, zorder=0.5)
    everything = np.concatenate([toy.hull(name, 0.78) for name in ("abcd", "123")])
    for axes in panels:
        look_at(axes, everything)
    note(panels[0], toy.hull("c", 0.78).mean(axis=0) + [-0.02, 0.06], "A", COLOURS["A"], fontsize=13)
    note(panels[0], toy.hull("2", 0.78).mean(axis=0), "B", COLOURS["B"], fontsize=13)
    for name in "abcd123":
        note(panels[1], toy.hull(name, 0.78).mean(axis=0), name, fontsize=11)
    return figure


def dish(run: Path) -> plt.Figure:
    shells, parts = Table(run / "dish.csv"), Table(run / "dish_pieces.csv")
    shell, points = shells["shell"], shells.vectors("x", "y")
    outer, inner = points[shell == 0], points[shell == 1]
    plate = np.concatenate([outer, inner[::-1]])
    figure, panels = plt.subplots(1, 2, figsize=(9.2, 2.9))
    for axes, title in zip(panels, ("Grown as long as its triangles stay faces", "Cut until each hull is inside the plate")):
        bare(axes, title)
        body(axes, plate)
        look_at(axes, plate, margin=0.08)
    body(panels[0], outer, "#F4C9B0AA", RED, ls="--")
    panels[0].plot(*outer.T, color=RED, lw=2.6)
    note(panels[0], (0, -0.7), "the hull comes out\non the other side", RED)
    note(panels[0], (0.02, -1.035), "one piece", RED)
    number, corners = parts["piece"], parts.vectors("x", "y")
    steps = np.unique(np.round(np.arctan2(outer[:, 0], -outer[:, 1]), 6))
    drawn = 0
    for k in range(int(number.max()) + 1):
        hull = outline(corners[number == k])
        if len({int(np.argmin(np.abs(steps - np.arctan2(x, -y)))) for x, y in hull}) > 2:  # longer than a step of the arc
            colour = (COLOURS["A"], ORANGE)[drawn % 2]
            body(panels[1], hull, colour + "66", colour, lw=1.4)
            drawn += 1
    note(panels[1], (0.02, -0.62), "every other of its pieces", DARK)
    return figure


def middle(polygon: np.ndarray) -> np.ndarray:
    """The centre of a polygon's area."""
    following = np.roll(polygon, -1, axis=0)
    cross = polygon[:, 0] * following[:, 1] - polygon[:, 1] * following[:, 0]
    return ((polygon + following) * cross[:, None]).sum(axis=0) / (3 * cross.sum())


def tree(run: Path) -> plt.Figure:
    toy = Toy(run)
    figure, panels = plt.subplots(1, 4, figsize=(9.2, 3.1), width_ratios=(1, 1, 1, 1.25))
    levels = [["abcd"], [toy.nodes["A"][toy.nodes["A"][0].left].name, toy.nodes["A"][toy.nodes["A"][0].right].name], list("abcd")]
    whole = outline(toy.nodes["A"][0].points)
    for axes, names, title in zip(panels, levels, ("the root", "its children", "the leaves")):
        bare(axes, title)
        for name in "abcd":
            body(axes, outline(toy.named(name)[1].points), PALES["A"], "#8FB9D6", lw=0.8)
        for name, colour in zip(names, (COLOURS["A"], ORANGE, COLOURS["A"], ORANGE)):
            body(axes, outline(toy.named(name)[1].points), "none", colour, lw=2, ls="-")
        look_at(axes, whole)
        for name in names:
            centre = middle(outline(toy.named(name)[1].points))
            note(axes, centre, name, fontsize=11)
    axes = panels[3]
    bare(axes, "the tree")
    size = whole.max(axis=0) - whole.min(axis=0) + 0.2
    tall = 4.0 * size[1] / size[0] / 1.25  # as high as the others
    places = {"abcd": (1.5, 0.82 * tall), levels[1][0]: (0.5, 0.5 * tall), levels[1][1]: (2.5, 0.5 * tall)}
    leaves = [name for parent in levels[1] for name in parent]
    for k, name in enumerate(leaves):
        places[name] = (k, 0.18 * tall)
    for parent, children in (("abcd", levels[1]), *((parent, list(parent)) for parent in levels[1])):
        for child in children:
            axes.plot(*zip(places[parent], places[child]), color=DARK, lw=1.1, zorder=1)
    for name, place in places.items():
        note(axes, place, name, fontsize=11, bbox={"boxstyle": "round,pad=0.35", "fc": PALES["A"], "ec": COLOURS["A"]})
    axes.set(xlim=(-0.5, 3.5), ylim=(0, tall))
    return figure


DRAWINGS = {"pieces": pieces, "dish": dish, "tree": tree}
