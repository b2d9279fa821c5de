"""The command line of a chapter's drawings: which folder to read, which pictures to draw, and where to put them."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import argparse
import sys
from pathlib import Path
from typing import Callable

from style import PlotError, plt, save


def draw(description: str, drawings: dict[str, Callable[[Path], plt.Figure]]) -> None:
    """Draws each picture that is asked for; each drawing reads its tables from the folder that it is given."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=Path, metavar="RUN_DIR", help="the folder with the runs, or with the tables")
    parser.add_argument("--out", type=Path, metavar="DIR", help="where the pictures go; default: RUN_DIR")
    parser.add_argument("--only", choices=sorted(drawings), nargs="+", default=sorted(drawings), metavar="NAME", help="these pictures alone")
    parser.add_argument("--kind", choices=("svg", "png", "pdf"), default="svg", help="default: svg")
    options = parser.parse_args()
    try:
        if not options.run.is_dir():
            raise PlotError(f"{options.run}: no such folder")
        folder = options.out or options.run
        folder.mkdir(parents=True, exist_ok=True)
        for name in options.only:
            figure = drawings[name](options.run)
            save(figure, folder / f"{name}.{options.kind}")
            plt.close(figure)
    except PlotError as error:
        print(f"{Path(sys.argv[0]).name}: {error}", file=sys.stderr)
        sys.exit(2)
