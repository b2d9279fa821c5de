"""The exercises that are pieces of the engine: those that pass are compiled for the chapters' programs, which use them with
--mine (common/pieces.hpp describes the files)."""

import re
from pathlib import Path

from building import Exercise, build

BUNNIES = "build/bin/ch04_multibody_stepping chapters/ch04_multibody_stepping/scenes/two_bunnies.yaml --mine"


def handed_over(exercise: Exercise, root: Path) -> Path:
    return root / "exercises" / exercise.chapter / f"{exercise.name}.piece.cpp"


def is_piece(exercise: Exercise, root: Path) -> bool:
    return handed_over(exercise, root).exists()


def scene_of(exercise: Exercise, root: Path) -> str:
    """The scene that shows the piece."""
    return re.match(r"// See: (\S+)", handed_over(exercise, root).read_text(encoding="utf-8"))[1]


def place(exercise: Exercise, root: Path, end: str) -> Path:
    return root / "build/mine" / f"{exercise.chapter}_{exercise.number}{end}"


def take_back(exercise: Exercise, root: Path) -> None:
    for end in (".so", ".source", ".refused"):
        place(exercise, root, end).unlink(missing_ok=True)


def refuse(exercise: Exercise, root: Path, why: str) -> None:
    take_back(exercise, root)
    place(exercise, root, ".refused").parent.mkdir(parents=True, exist_ok=True)
    place(exercise, root, ".refused").write_text(f"{why}\n", encoding="utf-8")


def hand_over(exercise: Exercise, folder: Path, root: Path, unchanged: bool) -> str:
    """Compiles the learner's file for the programs. Returns what is wrong, or "". `unchanged`: neither the file nor anything that
    it is compiled with has changed since its last check."""
    source = (root / exercise.file).resolve()
    checked = f"{source}\n{source.read_text(encoding='utf-8')}"
    kept = place(exercise, root, ".source")
    if unchanged and place(exercise, root, ".so").exists() and kept.exists() and kept.read_text(encoding="utf-8") == checked:
        return ""
    built, log = build(folder, exercise.target("piece"))
    module = folder / "pieces" / f"{exercise.chapter}_{exercise.number}.so"
    take_back(exercise, root)
    if not built or not module.exists():
        return "it passes, but cannot be compiled for the programs: " + (log.strip().splitlines() or ["no module"])[-1]
    place(exercise, root, ".so").parent.mkdir(parents=True, exist_ok=True)
    # A new file, not the old one overwritten: a running program may use that.
    temporary = place(exercise, root, ".new")
    temporary.write_bytes(module.read_bytes())
    temporary.replace(place(exercise, root, ".so"))
    kept.write_text(checked, encoding="utf-8")
    return ""


def count(exercises: list[Exercise], root: Path) -> str:
    """The last line of the report: on how many of the learner's pieces the bunnies collide."""
    pieces = [exercise for exercise in exercises if is_piece(exercise, root)]
    mine = [exercise for exercise in pieces if place(exercise, root, ".so").exists()]
    if not pieces:
        return ""
    line = f"the bunnies collide on {len(mine)} of {len(pieces)} pieces of yours"
    return f"{line}: {BUNNIES}" if mine else f"{line}; the first is {pieces[0].dotted}"
