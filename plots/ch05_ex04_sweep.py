"""Exercise 5.4: what is left of the error after so many sweeps over a stack.

Reads RUN_DIR/sweep.csv, which the target ch05_ex04_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, ORANGE, Table, plot_main


def draw(run: Path) -> plt.Figure:
    table = Table(run / "sweep.csv")
    order, bodies = np.array(table.text("order")), table["bodies"]
    names = list(dict.fromkeys(order))
    figure, panels = plt.subplots(1, len(names), figsize=(10.6, 3.4), sharey=True)
    for axes, name in zip(panels, names):
        for count, colour in zip(sorted(set(bodies)), (BLUE, ORANGE, GREEN)):
            rows = (order == name) & (bodies == count)
            error = np.abs(table["error"][rows])
            shown = error > 1e-12
            axes.plot(table["sweep"][rows][shown], error[shown], color=colour, label=f"{int(count)} bodies")
        axes.set(title=name[0].upper() + name[1:], xlabel="sweeps", xscale="log", yscale="log", ylim=(1e-12, 2))
    panels[0].set_ylabel("of the weight, not yet on the floor")
    panels[0].legend(loc="lower left")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch05_ex04_sweep", __doc__)
