"""Chapter 1's `linear` queries on the public "Sample-Queries" of Wang et al., "A Large Scale Benchmark and an
Inclusion-Based Algorithm for Continuous Collision Detection" (2021).

Reads DATA/SCENE/{vertex-face,edge-edge}/*.csv as they are published: eight rows for each query, the corners at t = 0
and at t = 1, six integers each (numerator and denominator of x, y, z) and the truth. Writes linear files, runs the
chapter's executable on them, and compares: a query that collides must never be missed. If DATA/reference.csv is there,
with brackets of the first time and of the smallest distance, late and false contacts are counted too.

Example: python3 tests/ch01/public_queries.py DATA --bin build/bin --tolerance 1e-6
"""

import argparse
import csv
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

HEADER = ["kind"] + [f"p{i}_{axis}{end}" for end in (0, 1) for i in range(4) for axis in "xyz"]


def read_queries(folder: Path, root: Path):
    """(name, collides, 24 coordinates) of each query."""
    for file in sorted(folder.glob("*.csv")):
        rows = [line.split(",") for line in file.read_text().split()]
        for first in range(0, len(rows), 8):
            eight = rows[first:first + 8]
            numbers = [float(Fraction(int(r[2 * k]), int(r[2 * k + 1]))) for r in eight for k in range(3)]
            yield f"{file.relative_to(root).with_suffix('')}#{first // 8}", eight[0][6] == "1", numbers


def run(binaries: Path, kind: str, queries: list, tolerance: str, out: Path) -> list[dict]:
    out.mkdir(parents=True, exist_ok=True)
    with open(out / "queries_in.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADER)
        writer.writerows([kind] + [repr(x) for x in numbers] for _, _, numbers in queries)
    scene = out / "scene.yaml"
    scene.write_text(f"linear: queries_in.csv\nccd: {{tolerance: {float(tolerance)!r}}}\n")
    subprocess.run([binaries / "ch01_convex_advancement", scene, "--quiet", "--certificate", "--out", out], check=True)
    subprocess.run([binaries / "ch01_replay", scene, out, "--quiet"], check=True)
    with open(out / "queries.csv") as file:
        return list(csv.DictReader(file))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", type=Path, help="the folder of the scenes")
    parser.add_argument("--bin", type=Path, default=Path("build/bin"), help="the executables' folder")
    parser.add_argument("--tolerance", default="1e-6", help="in metres")
    parser.add_argument("--out", type=Path, default=Path("out/public_queries"), help="where the runs are written")
    args = parser.parse_args()
    reference = {}
    if (args.data / "reference.csv").exists():
        with open(args.data / "reference.csv") as file:
            reference = {row["query"]: row for row in csv.DictReader(file)}
    folders = [f for kind in ("vertex-face", "edge-edge") for f in sorted(args.data.glob(f"*/{kind}"))]
    if not folders:
        parser.error(f"{args.data} has no SCENE/vertex-face or SCENE/edge-edge")
    wrong = 0
    print(f"{'set':42}{'queries':>8}{'hits':>6}{'missed':>8}{'late':>6}{'false':>7}{'unresolved':>12}{'advances':>10}{'most':>7}")
    for folder in folders:
        name = str(folder.relative_to(args.data))
        queries = list(read_queries(folder, args.data))
        kind = "vf" if folder.name == "vertex-face" else "ee"
        answers = run(args.bin, kind, queries, args.tolerance, args.out / name)
        missed = late = false = unresolved = 0
        for (query, collides, _), answer in zip(queries, answers, strict=True):
            hit = answer["status"] in ("contact", "touching_at_start")
            missed += collides and answer["status"] == "separated"
            unresolved += answer["status"] == "unresolved"
            known = reference.get(query)
            if known and hit:
                late += collides and float(answer["toc [1]"]) > float(known["toi_upper"])
                false += not collides and float(known["min_distance_lower"]) > float(args.tolerance)
        advances = [int(answer["iterations"]) for answer in answers]
        print(f"{name:42}{len(queries):8}{sum(c for _, c, _ in queries):6}{missed:8}{late:6}{false:7}{unresolved:12}"
              f"{sum(advances) / len(advances):10.2f}{max(advances):7}")
        wrong += missed + late + false
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
