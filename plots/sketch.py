"""Shared parts of drawings that show objects, not measurements: bodies, arrows, lengths, on axes without a frame."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle, Polygon

DARK, PALE = "#333333", "#EDEDED"


def box(centre, size, angle: float = 0) -> np.ndarray:
    """The corners of a rectangle, anticlockwise; angle in rad."""
    half = 0.5 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * size
    return np.asarray(centre) + half @ rotation(angle).T


def rotation(angle: float) -> np.ndarray:
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def body(axes: plt.Axes, corners, face: str = PALE, edge: str = DARK, **more) -> None:
    axes.add_patch(Polygon(corners, closed=True, facecolor=face, edgecolor=edge, **{"lw": 1.1, **more}))


def ball(axes: plt.Axes, centre, radius: float, face: str = PALE, edge: str = DARK, **more) -> None:
    axes.add_patch(Circle(centre, radius, facecolor=face, edgecolor=edge, **{"lw": 1.1, **more}))


def arrow(axes: plt.Axes, start, end, colour: str = DARK, width: float = 1.6, style: str = "-|>", **more) -> None:
    axes.annotate("", xy=end, xytext=start, annotation_clip=False,
                  arrowprops={"arrowstyle": style, "color": colour, "lw": width, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 11, **more})


def length(axes: plt.Axes, start, end, text: str, where, colour: str = DARK, **more) -> None:
    """An arrow with two heads, and what it measures."""
    arrow(axes, start, end, colour, 1.0, "<|-|>", mutation_scale=8)
    note(axes, where, text, colour, **more)


def note(axes: plt.Axes, where, text: str, colour: str = DARK, **more) -> None:
    axes.text(*where, text, color=colour, **{"fontsize": 9, "ha": "center", "va": "center", **more})


def bare(axes: plt.Axes, title: str = "", equal: bool = True) -> None:
    """No frame, no ticks; with `equal` one metre is as long in x as in y."""
    axes.axis("off")
    axes.set_title(title)
    if equal:
        axes.set_aspect("equal")
