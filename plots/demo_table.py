#!/usr/bin/env python3
"""Prints the paper's numbers beside a run's, as a Markdown table: demo_table.py RUN_DIR

They are the summary's entries `paper: QUANTITY` and `ours: QUANTITY`."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import argparse
import sys
from pathlib import Path

from style import PlotError, read_summary


def rows(run: Path) -> list[str]:
    if not (run / "summary.json").exists():
        raise PlotError(f"{run / 'summary.json'}: no such file; run the demo first")
    values: dict[str, dict[str, str]] = {}
    for name, entry in read_summary(run).get("entries", {}).items():
        whose, colon, quantity = name.partition(":")
        if colon and whose in ("paper", "ours"):
            values.setdefault(quantity.strip(), {})[whose] = f"{entry['value']} {entry['unit']}".strip()
    if not values:
        raise PlotError(f"{run / 'summary.json'}: has no entries 'paper: …'; this is not a run of the demo")
    header = ["| quantity | the paper | First Contact |", "|---|---|---|"]
    return header + [f"| {quantity} | {value.get('paper', '–')} | {value.get('ours', '–')} |"
                     for quantity, value in values.items()]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=Path, metavar="RUN_DIR", help="the demo's folder")
    try:
        print("\n".join(rows(parser.parse_args().run)))
    except PlotError as error:
        print(f"demo_table.py: {error}", file=sys.stderr)
        sys.exit(2)
