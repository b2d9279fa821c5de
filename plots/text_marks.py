"""The marks in the texts, and what they are filled with (plots/README.md explains them)."""

import csv
import json
import os
import re
import subprocess
import tempfile
import textwrap
from pathlib import Path
from typing import Callable

MARK = re.compile(r"(?<!`)<!-- (/?)(\w+)(?::\s*(.*?))? -->")
KINDS = {"run", "output", "snippet", "value", "table", "times"}
PAIRED = {"value", "table", "times"}
VALUE = re.compile(r"(\S+) (.+?)(?: where (.+?)=(\S+)| row (\d+))?(?: as (%\S+))?")
ANCHOR = re.compile(r"^\s*// ANCHOR(_END)?: (\w+)\s*$")
FENCE = re.compile(r"```(\w*)\n(.*?)^```$", re.M | re.S)


class MarkError(Exception):
    """A fault in a mark: `line: what`."""


def shell(command: str, root: Path) -> str:
    """The output of a command of the texts; `python3` is the Python that runs this."""
    with tempfile.TemporaryDirectory() as folder:
        if "PYTHON" in os.environ:
            (Path(folder) / "python3").symlink_to(os.environ["PYTHON"])
        env = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "PYTHONDONTWRITEBYTECODE": "1"}
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", command], cwd=root, env=env, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise ValueError(f"exit code {done.returncode} of: {command.strip().splitlines()[0]}: {done.stderr.strip()[-300:]}")
    return done.stdout


def snippet(where: str, root: Path) -> str:
    """The lines between the anchors, without indentation and without other anchors."""
    name, _, anchor = where.partition("#")
    if not (root / name).is_file():
        raise ValueError(f"no file {name}")
    lines, inside, found = [], False, 0
    for line in (root / name).read_text(encoding="utf-8").splitlines():
        match = ANCHOR.match(line)
        if match and match[2] == anchor:
            inside, found = match[1] is None, found + 1
        elif inside and not match:
            lines.append(line)
    if found != 2 or inside:
        raise ValueError(f"{name} has no pair of ANCHOR: {anchor} and ANCHOR_END: {anchor}")
    return textwrap.dedent("\n".join(lines)).strip("\n") + "\n"


def read_rows(file: Path) -> tuple[list[str], list[list[str]]]:
    with file.open(newline="", encoding="utf-8") as stream:
        rows = [row for row in csv.reader(stream) if row]
    return [name.split(" [")[0] for name in rows[0]], rows[1:]


def formatted(cell: str, form: str | None) -> str:
    """A cell as the text shows it: `%.3f` and the like; `%,d` for 17,913; `%.1f/1e3` for another unit."""
    if form is None:
        return cell
    form, _, divisor = form.partition("/")
    if divisor:
        return form % (float(cell) / float(divisor))
    if form == "%,d":
        return f"{int(cell):,}"
    return form % (int(cell) if form.endswith("d") else float(cell))


def value(what: str, root: Path) -> str:
    match = VALUE.fullmatch(what)
    if not match:
        raise ValueError(f"'{what}' is not FILE NAME [where COLUMN=CELL | row K] [as %FORMAT]")
    file, name, column, cell, row, form = match.groups()
    if file.endswith(".json"):
        entries = json.loads((root / file).read_text(encoding="utf-8"))["entries"]
        if name not in entries:
            raise ValueError(f"{file} has no entry '{name}'")
        return formatted(str(entries[name]["value"]), form)
    names, rows = read_rows(root / file)
    for wanted in filter(None, (name, column)):
        if wanted not in names:
            raise ValueError(f"{file} has no column '{wanted}'; it has: {', '.join(names)}")
    if column:
        rows = [r for r in rows if r[names.index(column)] == cell]
    rows = rows[int(row or 1) - 1:]
    if not rows:
        raise ValueError(f"{file} has no such row: {what}")
    return formatted(rows[0][names.index(name)], form)


def table(what: str, root: Path) -> str:
    """FILE COLUMN[ as %FORMAT[ titled TITLE]], COLUMN, ...: a Markdown table of all rows."""
    file, _, columns = what.partition(" ")
    names, rows = read_rows(root / file)
    chosen = []
    for column in columns.split(", "):
        name, _, form = column.partition(" as ")
        if name not in names:
            raise ValueError(f"{file} has no column '{name}'; it has: {', '.join(names)}")
        form, _, title = form.partition(" titled ")
        chosen.append((title or name, names.index(name), form or None))
    lines = ["| " + " | ".join(name for name, _, _ in chosen) + " |", "|" + "---|" * len(chosen)]
    lines += ["| " + " | ".join(formatted(row[i], form) for _, i, form in chosen) + " |" for row in rows]
    return "\n" + "\n".join(lines) + "\n"


def fill(text: str, root: Path, progress: Callable[[str], None]) -> str:
    """The text with every mark filled anew: first all its commands run, from top to bottom, then what they wrote is read."""
    _walk(text, root, progress, running=True)
    return _walk(text, root, progress, running=False)


def _walk(text: str, root: Path, progress: Callable[[str], None], running: bool) -> str:
    out, at = [], 0
    while match := MARK.search(text, at):
        line = text.count("\n", 0, match.start()) + 1
        closing, kind, what = match.groups()
        out.append(text[at:match.end()])
        at = match.end()
        if kind not in KINDS or closing:
            raise MarkError(f"{line}: {'a closing mark without its opening one' if kind in KINDS else 'unknown mark'}: {match[0]}")
        try:
            if kind in PAIRED:
                end = text.find(f"<!-- /{kind} -->", at)
                if end < 0 or MARK.search(text, at, end):
                    raise ValueError(f"no <!-- /{kind} -->")
                old, at = text[at:end], end + len(f"<!-- /{kind} -->")
                fresh = old if running else "\n" + shell(what, root) if kind == "times" else (value if kind == "value" else table)(what, root)
                out.append(fresh + f"<!-- /{kind} -->")
                continue
            fence = FENCE.match(text, at + 1)
            if text[at:at + 1] != "\n" or not fence:
                raise ValueError("a fenced block must follow in the next line")
            at, body = fence.end(), fence[2]
            if running and kind == "run":
                progress(body.strip().splitlines()[0])
                shell(body, root)
            elif not running and kind != "run":
                body = shell(what, root) if kind == "output" else snippet(what, root)
            out.append(f"\n```{fence[1]}\n{body}```")
        except (ValueError, OSError, KeyError) as error:
            raise MarkError(f"{line}: {match[0]}: {error}") from None
    out.append(text[at:])
    return "".join(out)
