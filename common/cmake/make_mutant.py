#!/usr/bin/env python3
"""make_mutant.py ROOT CHANGE SOLUTION OUT: writes the mutant that a change describes.

A change describes a wrong version of a source by the lines that differ:

    // Caught by: Suite.Test
    // Changes: chapters/ch01_convex_advancement/clear/gjk.cpp
    <<<<
    as it stands in the source, once
    ====
    as the mistake has it
    >>>>

and further such blocks. Without the second line it changes the exercise's solution. A clear version of a chapter becomes the
learner's by its namespace: fc::….::clear turns into fc::mine. Ends with 1 and a line if the source has changed so that a
block does not fit."""

import re
import sys
from pathlib import Path

BLOCK = re.compile(r"^<<<<\n(.*?)^====\n(.*?)^>>>>$", re.M | re.S)
CLEAR = re.compile(r"^namespace (fc(?:::\w+)*)::clear \{$", re.M)


def mutant(root: Path, change: Path, solution: Path) -> str:
    text = change.read_text(encoding="utf-8")
    named = re.search(r"^// Changes: (\S+)$", text, re.M)
    source = root / named[1] if named else solution
    changed = source.read_text(encoding="utf-8")
    blocks = BLOCK.findall(text)
    if not blocks:
        raise ValueError(f"{change}: no block from <<<< over ==== to >>>>")
    for old, new in blocks:
        if changed.count(old) != 1:
            raise ValueError(f"{change}: these lines occur {changed.count(old)} times in {source}, but must occur once:\n{old}")
        changed = changed.replace(old, new)
    outer = CLEAR.search(changed)
    if outer:
        name = change.name.split(".")[0]
        changed = CLEAR.sub(f"namespace fc::mine {{\nusing namespace {outer[1]};\nusing namespace {outer[1]}::clear;", changed)
        changed = f'#include "{name}.hpp"\n{changed}'
    return changed


def main() -> int:
    root, change, solution, out = map(Path, sys.argv[1:])
    try:
        text = mutant(root, change, solution)
    except (OSError, ValueError) as error:
        print(f"make_mutant.py: {error}", file=sys.stderr)
        return 1
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
