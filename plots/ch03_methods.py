"""What the pictures of ch03_study share: the methods' names, colours and marks, and how a residual of 0 is drawn."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import numpy as np

from style import BLUE, GREEN, ORANGE, RED

METHODS = {  # as the tables name them: label, colour, mark
    "dantzig": ("Dantzig", BLUE, "o"),
    "lemke": ("Lemke", GREEN, "s"),
    "pgs": ("projected Gauss-Seidel", ORANGE, "^"),
    "interior_point": ("interior point", RED, "D"),
}
FAMILIES = {
    "random_spd": "random, well conditioned",
    "spd_1e8": "condition $10^8$",
    "rank_deficient": "rank n/2",
    "box_heap": "heap of boxes and balls",
    "stack": "stack, equal masses",
    "stack_1e8": "stack, heavy on light $10^8$",
}
LEAST = 1e-17  # below round-off: where a 0 is drawn
RESIDUAL_TICKS = [LEAST, 1e-12, 1e-8, 1e-4, 1], ["0", "$10^{-12}$", "$10^{-8}$", "$10^{-4}$", "1"]


def break_before_zero(axis: str, axes) -> None:
    """Two strokes on a residual's axis: the range between 0 and round-off is left out."""
    at = 5e-17
    stroke = {"marker": [(-1, -0.6), (1, 0.6)], "ms": 9, "mec": "#555555", "mew": 1, "clip_on": False, "ls": ""}
    for shift in (0.8, 1.25):
        if axis == "y":
            axes.plot(0, at * shift, transform=axes.get_yaxis_transform(), **stroke)
        else:
            axes.plot(at * shift, 0, transform=axes.get_xaxis_transform(), **{**stroke, "marker": [(-0.6, -1), (0.6, 1)]})


def at_least(residual: np.ndarray) -> np.ndarray:
    return np.maximum(residual, LEAST)
