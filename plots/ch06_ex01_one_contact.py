"""Exercise 6.1: the normal impulse of a leaning rod that slides, and where friction points at an oblique contact.

Reads RUN_DIR/rod.csv and RUN_DIR/directions.csv, which the target ch06_ex01_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, GREY, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    rods, directions = Table(run / "rod.csv"), Table(run / "directions.csv")
    figure, (rod, cone) = plt.subplots(1, 2, figsize=(8.6, 3.9))
    for mu, colour in zip(sorted(set(rods["mu"])), (GREY, BLUE, ORANGE)):
        rows = rods["mu"] == mu
        rod.plot(rods["slip"][rows], rods["normal"][rows], color=colour, label=f"µ = {mu:g}")
    rod.set(title="A rod closes in with 1 cm/s", xlabel="slip before the impulse [m/s]", ylabel="normal impulse [N s]",
            yscale="log")
    rod.legend()
    turn = np.linspace(0, 2 * np.pi, 200)
    cone.plot(0.5 * np.cos(turn), 0.5 * np.sin(turn), color=GREY, lw=1, ls=":", label="the cone, µ = 0.5")
    for slip, colour in zip(sorted(set(directions["slip"])), (GREEN, BLUE, ORANGE)):
        rows = directions["slip"] == slip
        cone.plot(directions["friction 1"][rows], directions["friction 2"][rows], ".", color=colour, ms=4, label=f"slip of {slip:g} m/s")
    cone.set(title="Friction, by directions of slip", xlabel="tangent 1, of the normal impulse", ylabel="tangent 2, of the normal impulse",
             aspect="equal", xlim=(-0.6, 0.6), ylim=(-0.6, 0.6))
    cone.legend(loc="upper left", bbox_to_anchor=(1, 1))
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch06_ex01_one_contact", __doc__)
