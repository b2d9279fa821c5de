"""Errors of chapter 6's slide and orbit against the frames in a second: RUN_DIR/slide_N and orbit_N, runs as the text makes them.
Writes a table."""

import drawing_python  # noqa: F401  first: it finds a Python that has what plots need

import argparse
import csv
import re
from pathlib import Path

import numpy as np

from style import Table


def paths(run: Path) -> list[np.ndarray]:
    """Of each body but the first, which does not move or is a table, its place in the plane frame by frame."""
    poses = Table(run / "poses.csv")
    number, places = poses["body"].astype(int), poses.vectors("px", "py")
    return [places[number == k] for k in range(1, number.max() + 1)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=Path, metavar="RUN_DIR")
    parser.add_argument("--out", type=Path, required=True, metavar="FILE")
    options = parser.parse_args()
    exact = 3**2 / (2 * 0.5 * 9.81)  # of slide.yaml
    rows = []
    for folder in options.run.glob("slide_*"):
        frames = int(re.sub(r"\D", "", folder.name))
        stop = max(abs(np.linalg.norm(path[-1] - path[0]) - exact) for path in paths(folder))
        radius = np.linalg.norm(paths(options.run / f"orbit_{frames}")[0][-1]) - 0.5
        rows.append((frames, stop, radius))
    with options.out.open("w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(["frames", "stop_error [m]", "radius_error [m]"])
        table.writerows(sorted(rows))
    print(options.out)


if __name__ == "__main__":
    main()
