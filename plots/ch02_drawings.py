"""Chapter 2's drawings: convex pieces, trees of hulls, what one look at a pair proves, the queue, and which features touch.

Reads RUN_DIR, the tables of ch02_pictures. Writes one picture for each name into the folder --out.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import argparse
import sys
from pathlib import Path

import ch02_feature_drawings
import ch02_piece_drawings
import ch02_queue_drawings
from style import PlotError, plt, save

DRAWINGS = {**ch02_piece_drawings.DRAWINGS, **ch02_queue_drawings.DRAWINGS, **ch02_feature_drawings.DRAWINGS}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=Path, metavar="RUN_DIR", help="the folder that ch02_pictures wrote")
    parser.add_argument("--out", type=Path, metavar="DIR", help="where the pictures go; default: RUN_DIR")
    parser.add_argument("--only", choices=sorted(DRAWINGS), nargs="+", default=sorted(DRAWINGS), metavar="NAME", help="these pictures alone")
    parser.add_argument("--kind", choices=("svg", "png", "pdf"), default="svg", help="default: svg")
    options = parser.parse_args()
    try:
        if not options.run.is_dir():
            raise PlotError(f"{options.run}: no such folder")
        folder = options.out or options.run
        folder.mkdir(parents=True, exist_ok=True)
        for name in options.only:
            figure = DRAWINGS[name](options.run)
            save(figure, folder / f"{name}.{options.kind}")
            plt.close(figure)
    except PlotError as error:
        print(f"ch02_drawings.py: {error}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
