#!/usr/bin/env python3
"""Draws any column of a sweep against the key that was swept: sweep.py DIR… [--x KEY] [--y COLUMN]…

DIR is a folder with a sweep.csv. Several are parts of one sweep (--part 1/4, 2/4, …): their rows are put together and
sorted. Without --y it draws whichever of these change: gaps, energies, impacts, residual, lost time, time of a frame.
The picture is sweep.svg and sweep.png in the first DIR.

    build/bin/ch05_resting_contact chapters/ch05_resting_contact/scenes/stack.yaml --sweep envelope=1e-4,3e-4,1e-3 --out out/h
    python3 plots/sweep.py out/h --x envelope --y "smallest certified gap"
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import argparse
import csv
import math
import sys
from pathlib import Path

import numpy as np

from style import BLUE, RED, PlotError, Table, plt, save

DECADES = 1  # values that span as many stand on a logarithmic axis
USUAL = ("smallest certified gap", "largest penetration", "total energy at the end", "impacts", "worst LCP residual", "lost time",
         "median frame with contact_ns", "advances", "exit_code")
MOST_NAMED = 40  # values of a swept key that are words


class Sweep:
    """The rows of all parts: names with units, and cells by name."""

    def __init__(self, folders: list[Path]):
        self.headers: dict[str, str] = {}
        rows: list[dict[str, str]] = []
        for folder in folders:
            table = self._read(folder)
            rows += [dict(zip(table.names, row)) for row in table.rows]
        self.key = next(iter(self.headers))
        self.rows = self._together(rows)
        if not self.rows:
            raise PlotError(f"{folders[0] / 'sweep.csv'}: no rows")

    def _read(self, folder: Path) -> Table:
        file = folder / "sweep.csv"
        if not file.exists() and (folder / "summary.json").exists():
            raise PlotError(f"{folder}: a run, not a sweep; plots/energy.py and plots/contacts.py draw it")
        table = Table(file)
        with file.open(newline="", encoding="utf-8") as stream:
            headers = next(csv.reader(stream))
        if len(set(table.names)) != len(table.names):
            twice = next(name for name in table.names if table.names.count(name) > 1)
            raise PlotError(f"{file}: two columns are called '{twice}'; make the sweep again")
        for name, header in zip(table.names, headers):
            self.headers.setdefault(name, header)
        if table.names[0] != next(iter(self.headers)):
            raise PlotError(f"{file}: sweeps '{table.names[0]}', not '{next(iter(self.headers))}': not a part of the same sweep")
        return table

    def _together(self, rows: list[dict[str, str]]) -> list[dict[str, str]]:
        """Sorted by the swept value. Rows of the same value must be equal, except for measured times."""
        found: dict[object, dict[str, str]] = {}
        for row in rows:
            value = number(row[self.key])
            other = found.setdefault(row[self.key] if value is None else value, row)
            for name in row:
                if name != self.key and not name.endswith("_ns") and row[name] != other.get(name, row[name]):
                    raise PlotError(f"{self.key} = {row[self.key]} is there twice, with two values of '{name}': {other[name]} and "
                                    f"{row[name]}; leave one of the folders out")
        return [found[value] for value in sorted(found, key=lambda v: (isinstance(v, str), v))]

    def column(self, name: str) -> list[str]:
        if name not in self.headers:
            raise PlotError(f"no column '{name}'; the sweep has: {', '.join(self.headers)}")
        return [row.get(name, "none") for row in self.rows]


def number(cell: str) -> float | None:
    try:
        return float(cell)
    except ValueError:
        return None


def numbers(cells: list[str]) -> np.ndarray:
    """NaN where there is no number: `none`, or a word."""
    return np.array([math.nan if number(cell) is None else float(cell) for cell in cells])


def spans_decades(values: np.ndarray) -> bool:
    seen = values[np.isfinite(values) & (values != 0)]
    return len(seen) > 1 and bool((seen > 0).all()) and math.log10(seen.max() / seen.min()) > 0.99 * DECADES


def place_x(axes: plt.Axes, sweep: Sweep, key: str) -> np.ndarray:
    """The runs' places on the x axis: the key's values, or side by side if these are not numbers."""
    cells = sweep.column(key)
    x = numbers(cells)
    axes.set_xlabel(sweep.headers[key])
    if np.isfinite(x).all():
        if spans_decades(x):
            axes.set_xscale("log" if (x > 0).all() else "symlog", **({} if (x > 0).all() else {"linthresh": x[x > 0].min()}))
        return x
    if len(cells) > MOST_NAMED:
        raise PlotError(f"'{key}' has {len(cells)} values that are no numbers: too many to name; sweep fewer")
    axes.set_xticks(np.arange(len(cells)), cells, rotation=0 if sum(map(len, cells)) < 60 else 25)
    return np.arange(len(cells), dtype=float)


def draw_panel(axes: plt.Axes, sweep: Sweep, key: str, name: str) -> None:
    y, header = numbers(sweep.column(name)), sweep.headers[name]
    if not np.isfinite(y).any():
        raise PlotError(f"column '{name}' has no numbers: {', '.join(sorted(set(sweep.column(name))))[:80]}")
    if name.endswith("_ns"):
        y, header = y / 1e6, name[:-3] + " [ms]"
    x = place_x(axes, sweep, key)
    axes.set_title(header)
    order = np.argsort(x, kind="stable")
    axes.plot(x[order], y[order], "o-", color=BLUE, markersize=4)
    if spans_decades(y):  # zeros and smaller values are drawn under the axis
        axes.set_yscale("log")
        zero = np.isfinite(y) & (y <= 0)
        if zero.any():
            axes.plot(x[zero], np.full(zero.sum(), 0.02), "v", color=BLUE, markersize=5, clip_on=False,
                      transform=axes.get_xaxis_transform())
            axes.set_title(header + " (triangle: 0)")
    failed = np.array([cell not in ("0", "none") for cell in sweep.column("exit_code")]) if "exit_code" in sweep.headers else np.zeros(len(y), bool)
    if (failed & np.isfinite(y)).any():
        axes.plot(x[failed], y[failed], "x", color=RED, markersize=9, label="failed (exit code)")
        axes.legend()
    axes.margins(y=0.12)


def usual(sweep: Sweep, key: str) -> list[str]:
    """What to draw: of the usual columns, those that are numbers and vary."""
    names = [name for name in USUAL if name in sweep.headers]
    changing = [name for name in names if len(set(sweep.column(name))) > 1 and np.isfinite(numbers(sweep.column(name))).any()]
    if not changing:
        raise PlotError(f"no usual column changes; name one with --y: {', '.join(name for name in sweep.headers if name != key)}")
    return changing


def draw(folders: list[Path], key: str | None, columns: list[str] | None) -> plt.Figure:
    sweep = Sweep(folders)
    key = key or sweep.key
    columns = columns or usual(sweep, key)
    across = 1 if len(columns) == 1 else 2
    down = -(-len(columns) // across)
    figure, panels = plt.subplots(down, across, figsize=(4.2 * across + 1, 0.4 + 2.9 * down), squeeze=False)
    for axes, name in zip(panels.flat, columns):
        draw_panel(axes, sweep, key, name)
    for axes in panels.flat[len(columns):]:
        axes.set_axis_off()
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", type=Path, nargs="+", metavar="DIR", help="the folders that the sweep, or its parts, wrote")
    parser.add_argument("--x", metavar="KEY", help="the column along the axis; default: the first, which is the swept key")
    parser.add_argument("--y", metavar="COLUMN", action="append", help="what to draw, without its unit; may be given several times")
    parser.add_argument("--out", type=Path, metavar="FILE", help="the picture, .svg, .png or .pdf")
    options = parser.parse_args()
    try:
        figure = draw(options.folders, options.x, options.y)
        first = options.folders[0]
        for file in [options.out] if options.out else [first / "sweep.svg", first / "sweep.png"]:
            save(figure, file)
    except PlotError as error:
        print(f"sweep.py: {error}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
