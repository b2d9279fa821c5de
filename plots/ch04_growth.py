"""Chapter 4's picture of what a gas costs against the number of its bodies.

Reads RUN_DIR/growth.csv of ch04_study --part growth.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, GREY, ORANGE, Table, plot_main

KINDS = {"balls": BLUE, "blocks": ORANGE, "hulls": GREEN}


def draw(run: Path) -> plt.Figure:
    table = Table(run / "growth.csv")
    figure, (per_impact, per_frame, queried) = plt.subplots(1, 3, figsize=(10.2, 3.4))
    for kind, colour in KINDS.items():
        rows = np.flatnonzero([k == kind for k in table.text("kind")])
        n = table["bodies"][rows]
        per_impact.semilogx(n, table["impact_ns"][rows] / 1000, "o-", color=colour, ms=4, label=kind)
        per_frame.loglog(n, table["frame_ns"][rows] / 1e6, "o-", color=colour, ms=4)
        queried.semilogx(n, table["queries_per_impact"][rows], "o-", color=colour, ms=4)
        large = n >= 100
        slope, start = np.polyfit(np.log(n[large]), table["impact_ns"][rows][large] / 1000, 1)
        per_impact.semilogx(n[large], start + slope * np.log(n[large]), ":", color=GREY, lw=1.2)
    per_impact.semilogx([], [], ":", color=GREY, label="a + b log(bodies), fitted")
    for axes in (per_impact, per_frame, queried):
        axes.set_xlabel("bodies")
        axes.set_xticks([10, 100, 1000, 3000], ["10", "100", "1,000", "3,000"])
        axes.minorticks_off()
    per_impact.set_ylim(0, per_impact.get_ylim()[1] * 1.35)
    per_impact.set_title("Time for an impact [µs]")
    per_frame.set_title("Time for a frame [ms]")
    queried.set_ylim(0, queried.get_ylim()[1] * 1.1)
    queried.set_title("Pairs queried for an impact")
    per_impact.legend(loc="upper left")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch04_growth", __doc__)
