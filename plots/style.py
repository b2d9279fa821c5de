"""What every plot shares: colours, reading a run's tables, saving the same bytes each time, one-line errors."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import argparse
import csv
import json
import sys
from pathlib import Path
from typing import Callable

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter

# Okabe and Ito's palette: distinct for any kind of colour vision.
BLUE, ORANGE, GREEN, RED, SKY, PURPLE, GREY = "#0072B2 #E69F00 #009E73 #D55E00 #56B4E9 #CC79A7 #767676".split()

plt.rcParams.update({
    "figure.facecolor": "white",
    "figure.constrained_layout.use": True,
    "figure.constrained_layout.h_pad": 0.09,
    "figure.constrained_layout.w_pad": 0.09,
    "font.size": 9.5,
    "axes.titlesize": 10,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.titlepad": 8,
    "axes.labelcolor": "#333333",
    "axes.edgecolor": "#999999",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#E6E6E6",
    "grid.linewidth": 0.7,
    "axes.axisbelow": True,
    "xtick.color": "#555555",
    "ytick.color": "#555555",
    "lines.linewidth": 1.6,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "axes.formatter.use_mathtext": True,
    "axes.formatter.limits": (-3, 5),
    "svg.hashsalt": "first contact",  # the ids in an SVG then are the same in every run
    "svg.fonttype": "none",  # text stays text
    "savefig.dpi": 130,
})


class PlotError(Exception):
    """A plot cannot be drawn; the message is one line."""


class Table:
    """A CSV table of a run: table["kinetic"] is the column `kinetic [J]` as numbers, table.text(...) as it stands."""

    def __init__(self, file: Path):
        self.file = file
        try:
            with file.open(newline="", encoding="utf-8") as stream:
                rows = [row for row in csv.reader(stream) if row]
        except FileNotFoundError:
            raise PlotError(f"{file}: no such file; run a chapter with --out {file.parent} first") from None
        except (OSError, UnicodeDecodeError, csv.Error) as error:
            raise PlotError(f"{file}: cannot be read as a table: {error}") from None
        if not rows:
            raise PlotError(f"{file}: empty; expected a header row")
        self.names = [name.split("[")[0].strip() for name in rows[0]]
        self.rows = rows[1:]  # possibly none: a run without contacts
        for number, row in enumerate(self.rows, start=2):
            if len(row) != len(self.names):
                raise PlotError(f"{file}:{number}: {len(row)} cells, but the header names {len(self.names)} columns")

    def __len__(self) -> int:
        return len(self.rows)

    def text(self, name: str) -> list[str]:
        if name not in self.names:
            raise PlotError(f"{self.file}: no column '{name}'; it has: {', '.join(self.names)}")
        index = self.names.index(name)
        return [row[index] for row in self.rows]

    def __getitem__(self, name: str) -> np.ndarray:
        cells = self.text(name)
        try:
            return np.array([float(cell) for cell in cells])
        except ValueError as error:
            raise PlotError(f"{self.file}: column '{name}': {error}") from None

    def vectors(self, *names: str) -> np.ndarray:
        """Several columns side by side, one row each per row of the table."""
        return np.stack([self[name] for name in names], axis=1)


def table_if_there(file: Path) -> Table | None:
    return Table(file) if file.exists() else None


def read_summary(run: Path) -> dict:
    """The run's summary.json; empty if it has none."""
    file = run / "summary.json"
    if not file.exists():
        return {}
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except ValueError as error:
        raise PlotError(f"{file}: {error}") from None


def entry_of(run: Path, name: str) -> float | None:
    """A number of the run's summary; None if it has none."""
    value = read_summary(run).get("entries", {}).get(name, {}).get("value")
    return float(value) if isinstance(value, (int, float)) else None


def rests_of(contacts: Table) -> np.ndarray:
    """For each contact whether it lasts (chapter 5 on); tables without the column `kind` have impacts alone."""
    kinds = contacts.text("kind") if "kind" in contacts.names else []
    return np.array([kind == "rest" for kind in kinds] if kinds else [False] * len(contacts), bool)


def fixed_bodies(run: Path) -> bool:
    """Whether any body of the run is fixed, as its motion.glb says."""
    file = run / "motion.glb"
    if not file.exists():
        return False
    try:
        with file.open("rb") as stream:  # a header of 12 bytes; the first chunk, after its size and kind, is JSON
            size = int.from_bytes(stream.read(20)[12:16], "little")
            nodes = json.loads(stream.read(size))["nodes"]
    except (ValueError, KeyError) as error:
        raise PlotError(f"{file}: not a recorded motion: {error}") from None
    return any(node.get("extras", {}).get("static") for node in nodes)


def no_sweep(run: Path) -> None:
    """Refuses the folder of a sweep: there is a run in each of its folders."""
    if not (run / "sweep.csv").exists() or (run / "steps.csv").exists():
        return
    runs = sorted(file.parent.name for file in run.glob("*/summary.json"))
    named = ", ".join(runs[:12]) + (f", … ({len(runs)} runs)" if len(runs) > 12 else "")
    raise PlotError(f"{run}: a sweep; give one of its runs: {named or 'none is there'}; all of them: plots/sweep.py {run}")


def power_of_ten(value: float, _: int = 0) -> str:
    """10⁻⁶ as plain text: mathematical text takes ten times as long to draw."""
    return "10" + str(round(np.log10(value))).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def log_limits(axes: plt.Axes, *series: np.ndarray) -> None:
    """A logarithmic y axis around those values of the series that are positive."""
    values = np.concatenate([s[np.isfinite(s) & (s > 0)] for s in series])
    axes.set_yscale("log")
    axes.yaxis.set_major_formatter(FuncFormatter(power_of_ten))
    if len(values):
        axes.set_ylim(10 ** np.floor(np.log10(values.min()) - 0.1), 10 ** np.ceil(np.log10(values.max()) + 0.1))


def say(axes: plt.Axes, text: str) -> None:
    """Writes a remark into a panel."""
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", color=GREY, fontsize=8.5)


def nothing(axes: plt.Axes, text: str) -> None:
    """Says why a panel has nothing to draw."""
    axes.grid(False)
    axes.set_yticks([])
    say(axes, text)


def plot_main(draw: Callable[..., plt.Figure], name: str, description: str, **more: dict) -> None:
    """The whole of a plot script: options, drawing, saving, errors (exit code 2). `more` are options of its own, which
    `draw` gets by name."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("run", type=Path, metavar="RUN_DIR", help="the folder that the run wrote (its --out)")
    parser.add_argument("--out", type=Path, metavar="FILE",
                        help=f"the picture, .svg, .png or .pdf; default: both RUN_DIR/{name}.svg and {name}.png")
    for option, settings in more.items():
        parser.add_argument(f"--{option}", metavar=option.upper(), **settings)
    options = parser.parse_args()
    try:
        if not options.run.is_dir():
            raise PlotError(f"{options.run}: no such folder")
        figure = draw(options.run, **{option: getattr(options, option) for option in more})
        for file in [options.out] if options.out else [options.run / f"{name}.svg", options.run / f"{name}.png"]:
            save(figure, file)
    except PlotError as error:
        print(f"{name}.py: {error}", file=sys.stderr)
        sys.exit(2)


def save(figure: plt.Figure, file: Path) -> None:
    """Writes the picture without a date or a version in it."""
    metadata = {".svg": {"Date": None, "Creator": None}, ".pdf": {"CreationDate": None}, ".png": {"Software": None}}
    if file.suffix not in metadata:
        raise PlotError(f"{file}: unknown kind of picture; use .svg, .png or .pdf")
    try:
        figure.savefig(file, metadata=metadata[file.suffix])
        figure.set_layout_engine("none")  # it has been laid out: the same picture in another format stays so
    except OSError as error:
        raise PlotError(f"{file}: cannot be written: {error.strerror}") from None
    print(file)
