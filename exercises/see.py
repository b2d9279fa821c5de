#!/usr/bin/env python3
"""Shows what the learner's code of one exercise does: builds its demo, runs it, draws its output, and prints where. A piece of
the engine without a demo is shown in its chapter's program, run with --mine.

Ends with 0 if there is a picture, 1 if not (the exercise is not started, does not compile, or its demo fails), 2 for an
unknown name."""

import subprocess
import sys
from pathlib import Path

import pieces
from building import Exercise, build, from_root
from check import NOT_STARTED, check, chosen_of, first_error, options_of, show, why_it_ended

DEMO_LIMIT = 120  # seconds


def run(command: list, root: Path) -> tuple[int, str, str]:
    try:
        done = subprocess.run(command, cwd=root, capture_output=True, text=True, errors="replace", timeout=DEMO_LIMIT, check=False)
    except subprocess.TimeoutExpired:
        return 1, "", f"stopped after {DEMO_LIMIT} s; an endless loop?"
    return done.returncode, done.stdout, done.stderr.strip()


def see(exercise: Exercise, folder: Path, root: Path, limit: float) -> int:
    state = check(exercise, folder, root, limit)
    if state.text == NOT_STARTED:
        print(f"{exercise} is not started: {exercise.task}")
        return 1
    show(exercise, state, "")
    if state.text == "does not compile":
        return 1
    if not (root / "exercises" / exercise.chapter / f"{exercise.name}.demo.cpp").exists():
        return see_in_program(exercise, folder, root)
    demo = exercise.target("demo")
    built, log = build(folder, demo)
    if not built:
        print(f"the demo does not compile: {from_root(first_error(log, exercise.file)[0], root, folder)}")
        return 1
    out = f"out/{exercise.chapter}_{exercise.number}"
    code, said, wrong = run([folder.resolve() / "bin" / demo, out], root)
    # The demo's last line is the command that draws it, which runs now.
    print("".join(f"{line}\n" for line in said.splitlines() if not line.startswith("draw it: ")), end="", flush=True)
    if code != 0:
        print(f"the demo ended with {why_it_ended(code)}: {wrong.splitlines()[-1] if wrong else 'it gives no reason'}")
        return 1
    code, said, wrong = run([sys.executable, f"plots/{exercise.chapter}_{exercise.name}.py", out], root)
    if code != 0:
        print(f"cannot be drawn: {wrong}")
        return 1
    print("".join(f"drawn: {line}\n" for line in said.splitlines()), end="")
    return 0


def see_in_program(exercise: Exercise, folder: Path, root: Path) -> int:
    """Runs the chapter's program on the learner's pieces."""
    scene = pieces.scene_of(exercise, root)
    program = Path(scene).parts[1]
    built, log = build(folder, program)
    if not built:
        print(f"{program} does not compile: {from_root(first_error(log, exercise.file)[0], root, folder)}")
        return 1
    out = f"out/{exercise.chapter}_{exercise.number}"
    code, said, wrong = run([folder.resolve() / "bin" / program, scene, "--mine", "--out", out], root)
    print("".join(f"{line}\n" for line in [*said.splitlines(), *wrong.splitlines()]), end="", flush=True)
    if code != 0:
        return 1
    motion = root / out / "motion.html"
    print(f"look at it: {out}/motion.html" if motion.exists() else f"its results: {out}")
    return 0


def main() -> int:
    parser = options_of("see", __doc__, "./run see ch01/ex01")
    parser.add_argument("which", nargs="?", metavar="chNN/exMM", help="an exercise")
    options = parser.parse_args()
    chosen = chosen_of(options, "see")
    if len(chosen) > 1:
        print(f"see: name one exercise of: {', '.join(map(str, chosen))}", file=sys.stderr)
        return 2
    return see(chosen[0], options.build, options.root, options.limit)


if __name__ == "__main__":
    sys.exit(main())
