"""Chapter 1's picture: what each advance gains, and what a smaller tolerance costs.

Reads RUN_DIR/BOUND/certificate.csv and RUN_DIR/BOUND_sweep/sweep.csv for three motion bounds; the chapter's text lists
the four commands that write them.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt

from style import BLUE, GREEN, ORANGE, Table, plot_main

BOUNDS = {"naive": ORANGE, "directional": GREEN, "second_order": BLUE}


def draw(run: Path) -> plt.Figure:
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.3))
    for bound, colour in BOUNDS.items():
        certificate = Table(run / bound / "certificate.csv")
        left.semilogy(range(len(certificate)), certificate["gap_lower"], "o-", ms=4, color=colour, label=bound.replace("_", " "))
        sweep = Table(run / f"{bound}_sweep" / "sweep.csv")
        right.semilogx(sweep["ccd.tolerance"], sweep["advances"], "o-", ms=4, color=colour, label=bound)
    left.set(title="What each advance leaves of the gap", xlabel="advance", ylabel="certified gap [m]")
    right.set(title="What digits cost", xlabel="tolerance [m]", ylabel="advances until contact",
              ylim=(0, None))
    right.invert_xaxis()
    left.legend(title="motion bound")
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch01_advancement", __doc__)
