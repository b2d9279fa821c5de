"""Chapter 2's picture of continuous against discrete detection, for the paper's two claims.

Reads RUN_DIR/discrete.csv of ch02_study for the counts; the times come from such a table that was measured before (--times).
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREEN, ORANGE, RED, Table, plot_main

LINES = {"far": "o-", "close": "s--"}


def draw(run: Path, times: str | None = None) -> plt.Figure:
    table = Table(run / "discrete.csv")
    figure, panels = plt.subplots(2, 3 if times else 2, figsize=(9.2 if times else 8.6, 7.0), layout="constrained")
    (missed, late), (contacts, cost) = panels[0][:2], panels[1][:2]

    def curve(axes, source, values, family, colour, label):
        rows = np.array(source.text("motions")) == family
        axes.plot(source["frames"][rows], values[rows], LINES[family], ms=4, lw=1.3, color=colour, label=f"{label}, {family}")

    for family in LINES:
        curve(missed, table, 100 * table["missed"] / table["hits"], family, ORANGE, "discrete")
        curve(late, table, table["depth"], family, ORANGE, "median")
        curve(late, table, table["depth_p95"], family, RED, "95 %")
        curve(contacts, table, table["crossing_pairs"], family, ORANGE, "discrete: crossing triangles")
        curve(contacts, table, table["features"], family, BLUE, "continuous: features")
        curve(cost, table, table["discrete_node_pairs"] + table["discrete_leaf_pairs"], family, ORANGE, "discrete")
        curve(cost, table, table["continuous_node_pairs"] + table["continuous_leaf_pairs"], family, BLUE, "continuous")
    missed.set(title="Contacts that checks miss", ylabel="missed [%]", ylim=(-2, 100))
    missed.axhline(0, color=BLUE, lw=1.6, label="continuous")
    late.set(title="How deep the bodies are by then", ylabel="overlap / size of the model", yscale="log")
    contacts.set(title="What the solver gets", ylabel="contacts, median", yscale="log")
    cost.set(title="Cost: operations", ylabel="pairs of nodes and leaves per frame", yscale="log")
    if times:
        measured = Table(Path(times))
        for family in LINES:
            curve(panels[0][2], measured, measured["discrete_ns"] / 1000, family, ORANGE, "discrete")
            curve(panels[0][2], measured, measured["continuous_ns"] / 1000, family, BLUE, "continuous")
            curve(panels[1][2], measured, measured["continuous_ns"] / measured["discrete_ns"], family, GREEN, "ratio")
        panels[0][2].set(title="Cost: time", ylabel="time per frame, mean [µs]", yscale="log")
        panels[1][2].set(title="Continuous over discrete", ylabel="ratio of times per frame", yscale="log")
        panels[1][2].set_yticks([1, 2, 5, 10, 20, 50], ["1", "2", "5", "10", "20", "50"])
        panels[1][2].minorticks_off()
    for axes in [cost, *([panels[0][2]] if times else [])]:  # room for the legend
        axes.set_ylim(top=6 * axes.get_ylim()[1])
    for axes in panels.flat:
        axes.set_xscale("log", base=2)
        axes.set_xticks([1, 4, 16, 64, 256], ["1", "4", "16", "64", "256"])
        axes.set_xlabel("frames that the second is cut into")
        axes.legend(fontsize=8)
    contacts.legend(fontsize=8, loc="lower left", bbox_to_anchor=(0, 0.08))
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch02_discrete", __doc__, times={"help": "a discrete.csv whose times are drawn, too"})
