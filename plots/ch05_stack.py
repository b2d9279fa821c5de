"""Chapter 5's picture of a stack that comes to rest in its envelope: the smallest gap, the energy, and the time that is
lost, beside chapter 4's answer to the same scene.

Reads RUN_DIR/steps.csv of chapter 5's run, and --plain DIR/steps.csv of the run without the envelope.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREY, ORANGE, Table, plot_main


def draw(run: Path, plain: str) -> plt.Figure:
    ours, four = Table(run / "steps.csv"), Table(Path(plain) / "steps.csv")
    figure, (gap, energy, lost) = plt.subplots(1, 3, figsize=(10.2, 3.2))
    for table, colour, label in ((ours, BLUE, "with an envelope"), (four, ORANGE, "chapter 4")):
        t = table["t"]
        near = np.isfinite(table["min_gap"])
        gap.plot(t[near], 1000 * table["min_gap"][near], color=colour, label=label)
        energy.plot(t, table["energy"] - table["energy"][0], color=colour)
        lost.plot(t, np.cumsum(table["lost_time"]), color=colour)
    gap.axhline(0.25, color=GREY, ls=":", lw=1)
    gap.set(title="Smallest gap [mm]", xlabel="t [s]", ylim=(-0.02, 0.34))
    energy.set(title="Energy since the start [J]", xlabel="t [s]")
    lost.set(title="Time lost [s]", xlabel="t [s]")
    gap.legend(loc="center right")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch05_stack", __doc__, plain={"required": True, "help": "the folder of the run without the envelope"})
