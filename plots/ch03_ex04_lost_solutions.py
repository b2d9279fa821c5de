"""Exercise 3.4: how your drives end, on 200 problems each of six families.

Reads RUN_DIR/ends.csv, which the target ch03_ex04_demo writes.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, GREY, ORANGE, RED, Table, plot_main

ENDS = {"right": BLUE, "solved wrongly": RED, "a solution lost": ORANGE, "limit": GREY}


def draw(run: Path) -> plt.Figure:
    table = Table(run / "ends.csv")
    family, end, problems = table.text("family"), table.text("end"), table["problems"]
    names = list(dict.fromkeys(family))
    figure, axes = plt.subplots(figsize=(6.6, 3.2))
    left = np.zeros(len(names))
    for name, colour in ENDS.items():
        width = np.array([problems[[i for i, e in enumerate(end) if e == name and family[i] == f][0]] for f in names])
        axes.barh([n.replace("_", " ") for n in names], width, left=left, color=colour, label=name)
        left += width
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    axes.set(title="How your drives end", xlabel="problems of 12 rows")
    axes.legend(ncol=len(ENDS), loc="upper center", bbox_to_anchor=(0.5, -0.2))
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch03_ex04_lost_solutions", __doc__)
