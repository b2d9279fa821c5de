"""Chapter 2's drawing of which features touch. Drawn by ch02_drawings.py."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from ch02_toy import COLOURS, PALES
from sketch import DARK, arrow, bare, body, note
from style import GREY, RED


def features(_: Path) -> plt.Figure:
    figure, panels = plt.subplots(1, 3, figsize=(9.2, 3.0))
    titles = ("vertex and face", "edge and edge", "vertex and vertex?")
    for axes, title in zip(panels, titles):
        bare(axes, title)
        axes.set(xlim=(-1.2, 1.2), ylim=(-0.95, 1.1))

    face, edge_, wedge = panels
    body(face, [[-1.1, -0.75], [0.75, -0.75], [1.1, -0.1], [-0.75, -0.1]], PALES["B"], COLOURS["B"])
    body(face, [[-0.7, 0.95], [0.6, 0.95], [0, -0.3]], PALES["A"], COLOURS["A"])
    face.plot([0.06, 0.6], [0.95 * 0 - 0.3, 0.95], color=COLOURS["A"], lw=0)
    face.plot(0, -0.36, "o", color=RED, ms=6)
    arrow(face, (0, -0.36), (0, -0.9), RED)
    note(face, (0.14, -0.86), "n", RED, fontsize=12)

    edge_.plot([-1, 1], [-0.45, 0.25], color=COLOURS["A"], lw=5, solid_capstyle="round")
    edge_.plot([-0.9, 0.8], [0.45, -0.65], color="white", lw=8)
    edge_.plot([-0.9, 0.8], [0.45, -0.65], color=COLOURS["B"], lw=5, solid_capstyle="round")
    edge_.plot(-0.1, -0.1, "o", color=RED, ms=6)
    note(edge_, (0.75, 0.38), "$e_A$", COLOURS["A"], fontsize=12)
    note(edge_, (0.95, -0.55), "$e_B$", COLOURS["B"], fontsize=12)
    note(edge_, (0, 0.85), "n along $e_A \\times e_B$,\ntowards you", RED)

    body(wedge, [[-1.1, 1], [-0.15, 0.12], [0.9, 1]], PALES["A"], COLOURS["A"])
    body(wedge, [[-1.1, -0.9], [-1.1, -0.25], [0.12, -0.05], [0.9, -0.9]], PALES["B"], COLOURS["B"])
    direction = np.array([1.22, 0.2]) / np.hypot(1.22, 0.2)
    tip = np.array([-0.15, 0.12])
    on_face = np.array([0.12, -0.05]) - direction * np.dot(np.array([0.12, -0.05]) - tip, direction)
    wedge.plot(*zip(tip, [0.12, -0.05]), color=GREY, lw=1.4, ls="--")
    wedge.plot(*zip(tip, on_face), color=RED, lw=2.4)
    arrow(wedge, (0.12, -0.05), np.array([0.12, -0.05]) - 0.45 * direction, DARK, 1.3)
    note(wedge, (0.36, 0.14), "to the vertex", GREY, ha="left")
    note(wedge, (-0.5, -0.45), "this way it gets nearer:\nthe face is the contact", DARK, fontsize=8.5)
    return figure


DRAWINGS = {"features": features}
