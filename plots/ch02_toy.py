"""The two flat bodies of chapter 2's drawings, as ch02_pictures writes them: their nodes, and where they are at a time."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ch02_hierarchy import outline
from sketch import body, rotation
from style import BLUE, GREEN, Table

COLOURS = {"A": BLUE, "B": GREEN}
PALES = {"A": "#CFE3F1", "B": "#CDEBE1"}


@dataclass
class Node:
    name: str
    left: int
    right: int
    radius: float
    points: np.ndarray

    @property
    def leaf(self) -> bool:
        return self.left < 0


class Toy:
    def __init__(self, run: Path):
        table, motions = Table(run / "nodes.csv"), Table(run / "motions.csv")
        self.nodes: dict[str, list[Node]] = {}
        bodies, names = np.array(table.text("body")), np.array(table.text("name"))
        number, left, right, radius, points = table["node"], table["left"], table["right"], table["radius"], table.vectors("x", "y")
        for which in COLOURS:
            self.nodes[which] = []
            for k in range(int(number[bodies == which].max()) + 1):
                rows = (bodies == which) & (number == k)
                first = np.flatnonzero(rows)[0]
                self.nodes[which].append(Node(names[first], int(left[first]), int(right[first]), radius[first], points[rows]))
        self.motion = {which: row for which, row in zip(motions.text("body"), motions.vectors("x", "y", "vx", "vy", "spin"))}

    def named(self, name: str) -> tuple[str, Node]:
        for which, nodes in self.nodes.items():
            for node in nodes:
                if node.name == name:
                    return which, node
        raise KeyError(name)

    def placed(self, which: str, points: np.ndarray, t: float) -> np.ndarray:
        x, y, vx, vy, spin = self.motion[which]
        return points @ rotation(spin * t).T + [x + vx * t, y + vy * t]

    def hull(self, name: str, t: float) -> np.ndarray:
        which, node = self.named(name)
        return outline(self.placed(which, node.points, t))

    def draw(self, axes, t: float, names=None, hulls: bool = False, **more) -> None:
        """The pieces of both bodies at time t; of `names`, or of all leaves."""
        for which, nodes in self.nodes.items():
            for node in nodes:
                if node.name in names if names else node.leaf:
                    style = {"face": "none", "lw": 1.3, "ls": "--"} if hulls else {"face": PALES[which]}
                    body(axes, outline(self.placed(which, node.points, t)), edge=COLOURS[which], **{**style, **more})


def look_at(axes, *clouds: np.ndarray, margin: float = 0.1) -> None:
    points = np.concatenate(clouds)
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
