#!/usr/bin/env python3
"""Reports the state of the exercises: one row each, the message of the first failing test, and the total.

Each exercise is built on its own, and its tests run on the learner's file; where nothing has changed since, the last
result is repeated (last_result.py). Ends with 0 if all the exercises named are done, 1 if not, 2 for an unknown name."""

import argparse
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path

import last_result
import pieces
from building import ROOT, Exercise, build, from_root, known_exercises, select

LIMIT = 20  # seconds for the tests of one exercise: they take a fraction of one
ERROR = re.compile(r"(\S+\.[ch]pp:\d+:\d+): (?:fatal )?error: (.*)")
NOT_STARTED = "not started"


@dataclass
class State:
    text: str
    done: bool = False
    detail: str = ""
    ran: bool = False  # the tests ran to their end: on the same files they would give the same result
    recalled: bool = False  # this is the last result, repeated: nothing that could change it has changed


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
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GTEST_")}
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        try:
            done = subprocess.run([program, f"--gtest_output=json:{report}", "--gtest_color=no"], capture_output=True,
                                  text=True, errors="replace", timeout=limit, check=False, env=environment)
        except subprocess.TimeoutExpired as stopped:
            output = stopped.stdout or b""
            running = test_that_ran(output if isinstance(output, str) else output.decode(errors="replace"))
            return State(f"crashed: stopped after {limit:g} s; an endless loop?", detail=f"in {running}")
        if not report.exists():
            last = done.stderr.strip().splitlines()
            return State(f"crashed: {why_it_ended(done.returncode)}",
                         detail=f"in {test_that_ran(done.stdout)}" + (f"\n{last[-1]}" if last else ""))
        suites = json.loads(report.read_text(encoding="utf-8"))["testsuites"]
    return verdict([test for suite in suites for test in suite["testsuite"]])


def why_it_ended(code: int) -> str:
    if code >= 0:
        return f"exit code {code}"
    name = signal.Signals(-code).name
    return {"SIGSEGV": "memory that is not yours (SIGSEGV)", "SIGABRT": "abort or a failed assert (SIGABRT)"}.get(name, name)


def test_that_ran(output: str) -> str:
    names = re.findall(r"\[ RUN\s+\] (\S+)", output)
    return names[-1] if names else "its first test"


def verdict(tests: list[dict]) -> State:
    """The exercise's state, from GoogleTest's report on each test."""
    failed = [test for test in tests if test.get("failures")]
    if not tests:
        return State("crashed: its tests did not run")
    if not failed:
        return State("done", done=True, ran=True)
    messages = [failure["failure"] for test in failed for failure in test["failures"]]
    if len(failed) == len(tests) and all("TODO: exercise" in message for message in messages):
        return State(NOT_STARTED, ran=True)
    first = next((test for test in failed if "TODO: exercise" not in test["failures"][0]["failure"]), failed[0])
    detail = f"{first['classname']}.{first['name']}\n{first['failures'][0]['failure'].strip()}"
    others = [test["name"] for test in failed if test is not first]
    if others:
        detail += f"\nfailing, too: {', '.join(others)}"
    return State(f"{len(tests) - len(failed)}/{len(tests)} tests pass", detail=detail, ran=True)


def check(exercise: Exercise, folder: Path, root: Path, limit: float) -> State:
    """The exercise's state; a piece of the engine that is done is also compiled for the programs."""
    state = tested(exercise, folder, root, limit)
    if pieces.is_piece(exercise, root):
        if state.done:
            state.detail = pieces.hand_over(exercise, folder, root, unchanged=state.recalled)
        elif state.text == NOT_STARTED:
            pieces.take_back(exercise, root)
        else:
            pieces.refuse(exercise, root, state.text)
    return state


def is_begun(exercise: Exercise, root: Path) -> bool:
    """False for a file with an FC_TODO that is as it was committed (copy_stub.cmake has the same rule): nothing need be built."""
    try:
        status = subprocess.run(["git", "-C", root, "status", "--porcelain", "--ignored", "--", exercise.file], capture_output=True, check=False)
    except OSError:  # no git here
        return True
    return status.returncode != 0 or status.stdout != b"" or "FC_TODO(" not in (root / exercise.file).read_text(encoding="utf-8", errors="replace")


def tested(exercise: Exercise, folder: Path, root: Path, limit: float) -> State:
    if not is_begun(exercise, root):
        return State(NOT_STARTED)
    kept = last_result.recall(exercise, folder, root)
    if kept:
        return State(**{**kept, "recalled": True})
    seen = last_result.sources(exercise, root)
    built, log = build(folder, exercise.target("exercise"))
    if not built:
        message, own = first_error(log, exercise.file)
        message = from_root(message, root, folder)
        return State("does not compile", detail=message if own else f"{message}\n(not in your file: {exercise.file})")
    state = run_tests(folder / "bin" / exercise.target("exercise"), limit)
    state.detail = from_root(state.detail, root, folder)
    if state.ran:
        last_result.keep(exercise, folder, root, seen, asdict(state))
    return state


def advice(exercise: Exercise, state: State, following: Exercise | None) -> str:
    """What to do next, for an exercise that is not started, or done."""
    if state.text == NOT_STARTED:
        return exercise.task
    if not state.done:
        return ""
    lines = [f"compare with solutions/{exercise.chapter}/{exercise.name}.cpp", f"see what it does: ./run see {exercise}"]
    return "\n".join(lines + ([f"next, {following}: {following.task}"] if following else []))


def next_of(exercise: Exercise, exercises: list[Exercise], root: Path) -> Exercise | None:
    """What to write after an exercise: after a piece the next piece, in the order of the chapters' texts."""
    after = exercises[exercises.index(exercise) + 1:]
    own = [later for later in after if pieces.is_piece(later, root)] if pieces.is_piece(exercise, root) else []
    return next(iter(own or after), None)


def show(exercise: Exercise, state: State, advised: str) -> None:
    print(f"{str(exercise):<10} {exercise.name:<24} {state.text}", flush=True)
    for line in [*state.detail.splitlines(), *advised.splitlines()]:
        print(f"           {line}", flush=True)


def options_of(program: str, description: str, example: str) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog=program, description=description, epilog=f"example: {example}",
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build/verify", metavar="DIR",
                        help="a configured build folder with the tests (default: build/verify)")
    parser.add_argument("--root", type=Path, default=ROOT, help=argparse.SUPPRESS)
    parser.add_argument("--limit", type=float, default=LIMIT, metavar="SECONDS", help=f"for the tests of one exercise (default: {LIMIT})")
    return parser


def chosen_of(options: argparse.Namespace, program: str) -> list[Exercise]:
    """The exercises that the options name; ends the program with 2 if there are none, or no build folder."""
    exercises = known_exercises(options.root)
    chosen = select(exercises, options.which)
    wrong = ""
    if not chosen:
        wrong = f"no exercise '{options.which}'; there are: {', '.join(map(str, exercises)) or 'none'}"
    elif not (options.build / "CMakeCache.txt").exists():
        wrong = f"{options.build} is not configured; use ./run {program}, or cmake --preset verify"
    if wrong:
        print(f"{program}: {wrong}", file=sys.stderr)
        sys.exit(2)
    return chosen


def name_program(exercise: Exercise, folder: Path) -> None:
    """Gives the tests of the one exercise that was checked a name that an editor's debugger knows (.vscode/launch.json)."""
    program, link = folder / "bin" / exercise.target("exercise"), folder / "bin/this_exercise"
    if program.exists():
        link.unlink(missing_ok=True)
        link.symlink_to(program.name)


def main() -> int:
    parser = options_of("check", __doc__, "./run check ch01/ex01")
    parser.add_argument("which", nargs="?", metavar="chNN[/exMM]", help="a chapter's exercises, or one; default: all")
    options = parser.parse_args()
    chosen, exercises, done = chosen_of(options, "check"), known_exercises(options.root), 0
    for exercise in chosen:
        state = check(exercise, options.build, options.root, options.limit)
        done += state.done
        show(exercise, state, advice(exercise, state, next_of(exercise, exercises, options.root) if len(chosen) == 1 else None))
    if len(chosen) == 1:
        name_program(chosen[0], options.build)
    print(f"{done} of {len(chosen)} exercise{'s' if len(chosen) > 1 else ''} done")
    if told := pieces.count(exercises, options.root):
        print(told)
    return 0 if done == len(chosen) else 1


if __name__ == "__main__":
    sys.exit(main())
