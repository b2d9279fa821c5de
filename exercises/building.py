"""What check.py and see.py share: the list of exercises, and a build that reports its progress."""

import os
import re
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
COMPILED = re.compile(r"(?:\[ *(\S+)\] )?Building CXX object (\S+)")  # what CMake's generators print
EVERY = 15  # seconds between two reports of a long build, where there is no terminal


@dataclass
class Exercise:
    chapter: str  # ch01
    name: str  # ex01_door

    @property
    def number(self) -> str:
        return self.name.split("_")[0]

    @property
    def dotted(self) -> str:
        """Its number in the texts: 1.2."""
        return f"{int(self.chapter[2:])}.{int(self.number[2:])}"

    @property
    def file(self) -> str:
        return f"exercises/{self.chapter}/{self.name}.cpp"

    @property
    def task(self) -> str:
        return f"write {self.file}; the task is {self.dotted} in exercises/{self.chapter}/README.md"

    def target(self, kind: str) -> str:
        """CMake's name for it; kinds are exercise (the tests on the learner's file), tests and demo."""
        return f"{self.chapter}_{self.number}_{kind}"

    def __str__(self) -> str:
        return f"{self.chapter}/{self.number}"


def known_exercises(root: Path) -> list[Exercise]:
    return [Exercise(file.parent.name, file.stem) for file in sorted((root / "exercises").glob("ch*/ex*.hpp"))]


def select(exercises: list[Exercise], wanted: str | None) -> list[Exercise]:
    """The exercises that ch01 or ch01/ex01 (or ch01/ex01_door) names; without a name, all."""
    if wanted is None:
        return exercises
    chapter, _, number = wanted.strip("/").partition("/")
    return [e for e in exercises if e.chapter == chapter and number in ("", e.number, e.name)]


def what_is_built(object_file: str) -> str:
    """What an object file is part of, in words for a learner."""
    if chapter := re.match(r"chapters/ch0*(\d+)_", object_file):
        return f"chapter {chapter[1]}'s library (once, a minute or two)"
    if "fc_precompiled.dir" in object_file:
        return "headers that everything reads (once, about a minute)"
    if object_file.startswith("common/"):
        return "what all chapters share (once, about a minute)"
    if part := re.search(r"(ch\d+)_(ex\d+)_(tests|exercise|demo|piece)\.dir", object_file):
        return {"tests": f"the tests of {part[1]}/{part[2]} (once)", "exercise": "your file", "demo": "the demo", "piece": "your file for the programs"}[part[3]]
    return object_file


class Progress:
    """Reports a build on standard error as it goes on: a line for each part, and the progress of the whole (on a terminal
    always, in place; elsewhere every now and then)."""

    def __init__(self) -> None:
        self.terminal = sys.stderr.isatty()
        self.part, self.said = "", time.monotonic()

    def hear(self, line: str) -> None:
        compiled = COMPILED.match(line)
        if not compiled:
            return
        part = what_is_built(compiled[2])
        if part != self.part:
            self.part = part
            self.say(f"building {part} …\n")
        elif compiled[1] and self.terminal:
            self.say(f"  {compiled[1]}")
        elif compiled[1] and time.monotonic() - self.said > EVERY:
            self.say(f"  {compiled[1]}\n")

    def say(self, text: str) -> None:
        print(("\r\033[K" if self.terminal else "") + text, end="", file=sys.stderr, flush=True)
        self.said = time.monotonic()

    def end(self) -> None:
        if self.terminal:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def build(folder: Path, target: str) -> tuple[bool, str]:
    """Builds a target. Returns whether that succeeded, and all output."""
    command = ["cmake", "--build", folder, "--target", target, "--parallel", str(os.cpu_count() or 1)]
    progress, log = Progress(), []
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace") as running:
        for line in running.stdout:
            log.append(line)
            progress.hear(line)
    progress.end()
    return running.returncode == 0, "".join(log)


def from_root(text: str, root: Path, folder: Path) -> str:
    """The text with the name of each source file relative to the project's root, so that an editor finds it."""
    def named(match: re.Match) -> str:
        for start in (folder / "tests/exercises", folder, root):  # where compilers were started
            path = (start / match[0]).resolve()
            if path.is_relative_to(root.resolve()) and path.exists():
                return str(path.relative_to(root.resolve()))
        return match[0]
    return re.sub(r"[^\s:'\"()]+\.[ch]pp(?=:\d)", named, text)
