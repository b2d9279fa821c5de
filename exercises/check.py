#!/usr/bin/env python3
"""Says how far the exercises are: one row each, what the first failing test says, and the total.

Each exercise is built on its own and its tests are run on the learner's file; nothing is stored. Ends with 0 if all that were
asked for are done, 1 if not, 2 for a name that is none."""

import argparse
import json
import re
import signal
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LIMIT = 20  # seconds for the tests of one exercise: they take a fraction of one
ERROR = re.compile(r"(\S+\.[ch]pp:\d+:\d+): (?:fatal )?error: (.*)")


@dataclass
class Exercise:
    chapter: str  # ch01
    name: str  # ex01_door

    @property
    def number(self) -> str:
        return self.name.split("_")[0]

    @property
    def target(self) -> str:
        return f"{self.chapter}_{self.number}_exercise"

    @property
    def file(self) -> str:
        return f"exercises/{self.chapter}/{self.name}.cpp"

    def __str__(self) -> str:
        return f"{self.chapter}/{self.number}"


@dataclass
class State:
    text: str
    done: bool = False
    detail: str = ""


def known_exercises(root: Path) -> list[Exercise]:
    return [Exercise(file.parent.name, file.stem) for file in sorted((root / "exercises").glob("ch*/ex*.hpp"))]


def select(exercises: list[Exercise], wanted: str | None) -> list[Exercise]:
    """Those that ch01 or ch01/ex01 (or ch01/ex01_door) names; all without a name."""
    if wanted is None:
        return exercises
    chapter, _, number = wanted.strip("/").partition("/")
    return [e for e in exercises if e.chapter == chapter and number in ("", e.number, e.name)]


def build(folder: Path, target: str) -> subprocess.CompletedProcess:
    return subprocess.run(["cmake", "--build", folder, "--target", target], capture_output=True, text=True, check=False)


def first_error(log: str, file: str) -> tuple[str, bool]:
    """The compiler's or linker's first complaint, and whether it is about the learner's file."""
    errors = ERROR.findall(log)
    own = [(where, what) for where, what in errors if Path(where.split(":")[0]).name == Path(file).name]
    if own or errors:
        where, what = (own or errors)[0]
        line = where.split(":", 1)[1]
        return (f"{file}:{line}: {what}" if own else f"{where}: {what}"), bool(own)
    missing = re.search(r"undefined reference to [`‘'](.*?)'", log)
    if missing:
        return f"{file}: {missing[1]} is declared in the header, but not defined", True
    return (log.strip().splitlines() or ["the build failed"])[-1], False


def run_tests(program: Path, limit: float) -> State:
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        try:
            done = subprocess.run([program, f"--gtest_output=json:{report}", "--gtest_color=no"], capture_output=True,
                                  text=True, errors="replace", timeout=limit, check=False)
        except subprocess.TimeoutExpired as stopped:
            output = stopped.stdout or b""
            running = test_that_ran(output if isinstance(output, str) else output.decode(errors="replace"))
            return State(f"crashed: stopped after {limit:g} s; an endless loop?", detail=f"in {running}")
        if not report.exists():
            if done.returncode < 0:
                why = signal.Signals(-done.returncode).name
                why = {"SIGSEGV": "memory that is not yours (SIGSEGV)", "SIGABRT": "abort or a failed assert (SIGABRT)"}.get(why, why)
            else:
                why = f"exit code {done.returncode}"
            last = done.stderr.strip().splitlines()
            return State(f"crashed: {why}", detail=f"in {test_that_ran(done.stdout)}" + (f"\n{last[-1]}" if last else ""))
        suites = json.loads(report.read_text(encoding="utf-8"))["testsuites"]
    tests = [test for suite in suites for test in suite["testsuite"]]
    failed = [test for test in tests if test.get("failures")]
    if not tests:
        return State("crashed: its tests did not run")
    if not failed:
        return State("done", done=True)
    messages = [failure["failure"] for test in failed for failure in test["failures"]]
    if len(failed) == len(tests) and all("TODO: exercise" in message for message in messages):
        return State("not started")
    first = next((test for test in failed if "TODO: exercise" not in test["failures"][0]["failure"]), failed[0])
    text = first["failures"][0]["failure"].strip()
    return State(f"{len(tests) - len(failed)}/{len(tests)} tests pass", detail=f"{first['classname']}.{first['name']}\n{text}")


def test_that_ran(output: str) -> str:
    names = re.findall(r"\[ RUN\s+\] (\S+)", output)
    return names[-1] if names else "its first test"


def check(exercise: Exercise, folder: Path, root: Path, limit: float) -> State:
    built = build(folder, exercise.target)
    if built.returncode != 0:
        message, own = first_error(built.stdout + built.stderr, exercise.file)
        return State("does not compile", detail=message if own else f"{message}\n(not in your file: {exercise.file})")
    state = run_tests(folder / "bin" / exercise.target, limit)
    if state.done:
        state.detail = f"compare with solutions/{exercise.chapter}/{exercise.name}.cpp"
    return state


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="example: ./run check ch01/ex01")
    parser.add_argument("which", nargs="?", metavar="chNN[/exMM]", help="a chapter's exercises, or one; default: all")
    parser.add_argument("--build", type=Path, default=ROOT / "build/verify", metavar="DIR", help="a configured build folder with the tests (default: build/verify)")
    parser.add_argument("--root", type=Path, default=ROOT, help=argparse.SUPPRESS)
    parser.add_argument("--limit", type=float, default=LIMIT, metavar="SECONDS", help=f"for the tests of one exercise (default: {LIMIT})")
    options = parser.parse_args()
    exercises = known_exercises(options.root)
    chosen = select(exercises, options.which)
    if not chosen:
        print(f"check: no exercise '{options.which}'; there are: {', '.join(map(str, exercises)) or 'none'}", file=sys.stderr)
        return 2
    if not (options.build / "CMakeCache.txt").exists():
        print(f"check: {options.build} is not configured; use ./run check, or cmake --preset verify", file=sys.stderr)
        return 2
    done = 0
    for exercise in chosen:
        if sys.stderr.isatty():
            print(f"\r{exercise}: building …", end="", file=sys.stderr, flush=True)
        state = check(exercise, options.build, options.root, options.limit)
        if sys.stderr.isatty():
            print("\r\033[K", end="", file=sys.stderr, flush=True)
        done += state.done
        print(f"{str(exercise):<10} {exercise.name:<24} {state.text}", flush=True)
        for line in state.detail.splitlines():
            print(f"           {line}")
    print(f"{done} of {len(chosen)} exercises done")
    return 0 if done == len(chosen) else 1


if __name__ == "__main__":
    sys.exit(main())
