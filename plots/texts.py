#!/usr/bin/env python3
"""Makes every figure, table, number and excerpt in the texts again, from the commands that the texts themselves show.

    python3 plots/texts.py            # in place: what ./run figures does after a build
    python3 plots/texts.py --check    # in a copy, and compares: what CTest does; changes nothing

The marks are explained in plots/README.md. Ends with 1 if something is stale or wrong, a line for each."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import argparse
import os
import shutil
import sys
import tempfile
from pathlib import Path

import matplotlib

import text_lint
import text_words
from text_compare import difference
from text_marks import MarkError, fill

ROOT = Path(__file__).resolve().parents[1]
PINNED = "3.6.3"  # of matplotlib, Debian 12's: others draw the same picture with other bytes


def texts(root: Path) -> list[Path]:
    """All pages: the chapters in their order, and last the front page, which shows what a chapter's commands made."""
    pages = [page for folder in ("chapters", "common", "exercises", "plots", "solutions") for page in sorted((root / folder).rglob("*.md"))]
    return [*pages, root / "README.md"]


def make(root: Path, quiet: bool) -> list[str]:
    """Fills all marks under root. Faults, if any."""
    faults = []
    for page in texts(root):
        try:
            before = page.read_text(encoding="utf-8")
            after = fill(before, root, lambda what: None if quiet else print(f"  {what}", file=sys.stderr))
        except MarkError as error:
            faults.append(f"{page.relative_to(root)}:{error}")
            continue
        if after != before:
            page.write_text(after, encoding="utf-8")
            if not quiet:
                print(page.relative_to(root))
    return faults


def copy_of(root: Path, bin_dir: Path, into: Path) -> Path:
    """The tree without build products and output, and with the executables where the texts' commands expect them."""
    shutil.copytree(root, into, ignore=shutil.ignore_patterns("build", "out", ".git", "__pycache__"))
    (into / "build").mkdir()
    (into / "build/bin").symlink_to(bin_dir.resolve())
    return into


def compare(fresh: Path, root: Path) -> list[str]:
    """The differences between the copy's fresh texts and pictures and the tree's."""
    faults = []
    for page in texts(root):
        name = page.relative_to(root)
        told = difference(page.read_text(encoding="utf-8"), (fresh / name).read_text(encoding="utf-8"))
        if told:
            faults.append(f"{name}:{told}; make it again with ./run figures")
    for figure in text_lint.figures(root):
        name = figure.relative_to(root)
        if figure.suffix != ".svg":
            continue
        if matplotlib.__version__ != PINNED:
            print(f"{name}: drawn, but not compared: matplotlib is {matplotlib.__version__}, not {PINNED}")
            continue
        told = difference(figure.read_text(encoding="utf-8"), (fresh / name).read_text(encoding="utf-8"), picture=True)
        if told:
            faults.append(f"{name}:{told}; make it again with ./run figures, and look at it")
    return faults


def lint(root: Path) -> list[str]:
    """What is wrong without running anything."""
    return text_lint.faults(root, texts(root)) + text_words.faults(root, texts(root))


def check(root: Path, bin_dir: Path) -> list[str]:
    faults = lint(root)
    os.environ["TEXTS_CHECK"] = "yes"  # plots/live_pictures.py then leaves its pictures as they are
    with tempfile.TemporaryDirectory() as folder:
        fresh = copy_of(root, bin_dir, Path(folder) / "copy")
        stale = [figure for figure in text_lint.figures(fresh) if figure.suffix == ".svg"]
        for figure in stale:  # so that one that nothing draws is seen
            figure.unlink()
        faults += make(fresh, quiet=True)
        undrawn = [figure for figure in stale if not figure.exists()]
        faults += [f"{figure.relative_to(fresh)}: no text's commands draw it" for figure in undrawn]
        return faults if undrawn else faults + compare(fresh, root)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare only; changes nothing")
    parser.add_argument("--bin", type=Path, default=ROOT / "build/bin", metavar="DIR", help="the executables (default: build/bin)")
    options = parser.parse_args()
    if not options.bin.is_dir():
        print(f"texts.py: {options.bin}: no such folder; build first, or use ./run figures", file=sys.stderr)
        return 2
    os.environ["PYTHON"] = sys.executable  # the texts' commands say python3: see text_marks.shell
    faults = check(ROOT, options.bin) if options.check else make(ROOT, quiet=False) + lint(ROOT)
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
