"""Exercise 6.3: the residual by sweeps in three problems, and the loads of a block's feet while it brakes.

Reads RUN_DIR/sweeps.csv and RUN_DIR/block.csv, which the target ch06_ex03_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, GREY, ORANGE, Table, log_limits, plot_main


def draw(run: Path) -> plt.Figure:
    table, feet = Table(run / "sweeps.csv"), Table(run / "block.csv")
    figure, (sweeps, block) = plt.subplots(1, 2, figsize=(8.8, 3.6))
    names = (("easy", GREEN, "three contacts, µ = 0.3"), ("block", BLUE, "a block on two feet"), ("circles", ORANGE, "three contacts, µ = 1"))
    for name, colour, label in names:
        sweeps.plot(table["sweeps"], np.maximum(table[name], 1e-17), color=colour, lw=1.2, label=label)
    log_limits(sweeps, *(table[name] for name, _, _ in names))
    for halved in np.nonzero(np.diff(table["relaxation"]))[0]:
        sweeps.axvline(table["sweeps"][halved + 1], color=GREY, ls=":", lw=1)
    sweeps.set(title="Sweeps; dotted: ω is halved", xlabel="sweeps", ylabel="residual", ylim=(1e-17, 3))
    sweeps.legend(loc="upper right")
    mu = feet["mu"]
    block.plot(mu, feet["rear"], color=BLUE, label="rear foot")
    block.plot(mu, feet["front"], color=ORANGE, label="front foot")
    block.axvline(0.6, color=GREY, ls=":", lw=1, label="it tips: µ = b / H")
    block.set(title="A block of 2 kg brakes", xlabel="µ", ylabel="normal force [N]", ylim=(-1, None))
    block.legend()
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch06_ex03_many_contacts", __doc__)
