"""Chapter 3's picture of how pivots, sweeps, steps and time grow with the number of rows, with fitted powers.

Reads RUN_DIR/growth.csv and RUN_DIR/exponents.csv of ch03_study --part growth.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from ch03_methods import FAMILIES, METHODS
from style import GREY, Table, plot_main

GROWN = ["random_spd", "box_heap"]


def curves(axes: plt.Axes, growth: Table, exponents: Table, family: str, values: np.ndarray, power: str) -> None:
    """Filled marks: all problems were solved to the target; hollow: some ran into the limit."""
    for method, (label, colour, mark) in METHODS.items():
        targets = sorted({t for m, t in zip(growth.text("method"), growth["target"]) if m == method}, reverse=True)
        for k, target in enumerate(targets):
            rows = np.flatnonzero([f == family and m == method and t == target for f, m, t in
                                   zip(growth.text("family"), growth.text("method"), growth["target"])])
            fit = [x for f, m, t, x in zip(exponents.text("family"), exponents.text("method"), exponents["target"], exponents[power])
                   if f == family and m == method and t == target]
            what = label + (f" to {target:.0e}" if target > 0 else "") + (f": power {fit[0]:.2f}" if fit else "")
            x, y = growth["rows"][rows], values[rows]
            axes.loglog(x, y, "--" if k else "-", color=colour, lw=1.3, marker=mark, ms=4, label=what)
            short = growth["residual"][rows] > max(target, 1e-10)
            axes.loglog(x[short], y[short], mark, ms=4, color=colour, mfc="white", zorder=4)
    axes.set_xticks([8, 32, 128, 512, 1024], ["8", "32", "128", "512", "1024"])
    axes.minorticks_off()
    axes.legend(fontsize=7.5, loc="upper left")


def draw(run: Path) -> plt.Figure:
    growth, exponents = Table(run / "growth.csv"), Table(run / "exponents.csv")
    figure, panels = plt.subplots(2, 2, figsize=(9.6, 7.2), sharex=True, sharey="row")
    for column, family in enumerate(GROWN):
        top, bottom = panels[0][column], panels[1][column]
        curves(top, growth, exponents, family, growth["work"], "work_exponent")
        curves(bottom, growth, exponents, family, growth["median_ns"] / 1000, "time_exponent_ns")
        top.set_title(FAMILIES[family])
        bottom.set_xlabel("rows")
    panels[0][0].text(0.98, 0.03, "hollow: stopped at the limit", transform=panels[0][0].transAxes, ha="right", fontsize=7.5, color=GREY)
    panels[0][0].set_ylabel("pivots, sweeps or steps, median")
    panels[1][0].set_ylabel("time [µs], median, on this machine")
    for row in panels:
        low, high = row[0].get_ylim()
        row[0].set_ylim(low, high * 60)  # room for the legends
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch03_growth", __doc__)
