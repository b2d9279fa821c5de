"""Exercise 3.3: a break shot, one contact after the other and all at once; the arrows are velocities.

Reads RUN_DIR/balls.csv, which the target ch03_ex03_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREY, ORANGE, Table, plot_main

METHODS = {"all at once": BLUE, "in turn": ORANGE, "the fastest first": ORANGE}
RADIUS = 0.0285  # m
SECONDS = 0.03  # an arrow is the distance covered in this time


def draw(run: Path) -> plt.Figure:
    table = Table(run / "balls.csv")
    method = table.text("method")
    places, velocities = table.vectors("x", "y"), table.vectors("vx", "vy")
    figure, axes = plt.subplots(1, len(METHODS), figsize=(9.2, 4.0), sharey=True, sharex=True)
    for panel, (name, colour) in zip(axes, METHODS.items()):
        rows = [i for i, m in enumerate(method) if m == name]
        for place, velocity in zip(places[rows], velocities[rows]):
            panel.add_patch(plt.Circle(place, RADIUS, facecolor="#EEEEEE", edgecolor=GREY, lw=0.8))
            panel.annotate("", place + SECONDS * velocity, place, arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.4,
                                                                             "shrinkA": 0, "shrinkB": 0})
        panel.set(title=name, xlabel="x [m]", aspect="equal", xlim=(-0.24, 0.24), ylim=(-0.14, 0.32))
    axes[0].set_ylabel("y [m]")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch03_ex03_one_by_one", __doc__)
