"""The last result of an exercise's tests, as long as nothing that could change it has changed.

Kept in BUILD/check/, with a key: a digest of the learner's file, of all sources and build files of the project that its
tests can see, of the files that the compiler read (by its dependency files), of the test program and of the installed
packages. A file counts as changed by its size and times, the learner's by its content. If any of these has changed, or is not
known, there is no last result."""

import hashlib
import json
import re
import subprocess
from pathlib import Path

from building import Exercise

PACKAGES = Path("/var/lib/dpkg/status")  # changes whenever a package does: compiler, Eigen, GoogleTest
NO_INPUTS = {".md", ".svg", ".png", ".yaml", ".pyc"}


def stamp(file: Path) -> str:
    try:
        found = file.stat()
    except OSError:
        return f"{file}: none"
    return f"{file}: {found.st_size} {found.st_mtime_ns} {found.st_ctime_ns} {found.st_ino}"


def sources(exercise: Exercise, root: Path) -> list[str]:
    """The learner's file as it is, and a digest of all that its tests are built from."""
    own = root / exercise.file
    files = [root / "tests/exercises" / exercise.chapter / f"{exercise.name}_test.cpp", root / "tests/CMakeLists.txt",
             root / "tests/exercises/CMakeLists.txt", PACKAGES, *root.glob("CMake*"), *(root / "exercises").rglob("*.hpp"),
             *(root / "exercises").glob("*.py")]
    for folder in ("common", "chapters"):
        files += [file for file in (root / folder).rglob("*") if file.suffix not in NO_INPUTS and file.is_file()]
    text = own.read_text(encoding="utf-8", errors="replace") if own.exists() else "none"
    return [text, *map(stamp, sorted(files))]


def told_to_make(objects: list[Path], start: Path) -> list[Path]:
    """What the compiler read for these, by the file that it wrote for each: "object: file file …", with folded lines."""
    found = []
    for file in objects:
        text = Path(f"{file}.d").read_text(encoding="utf-8", errors="replace").replace("\\\n", " ")
        found += [start / name.replace("\\ ", " ") for name in re.split(r"(?<!\\)\s+", text.partition(": ")[2].strip()) if name]
    return found


def told_to_ninja(objects: list[Path], folder: Path) -> list[Path]:
    """The same by Ninja's record, which it keeps in place of those files: below each object a line for each file."""
    asked = ["ninja", "-C", folder, "-t", "deps", *(file.relative_to(folder) for file in objects)]
    said = subprocess.run(asked, capture_output=True, text=True, errors="replace", check=False).stdout
    if said.count(": #deps ") != len(objects):
        return []
    return [folder / line.strip() for line in said.splitlines() if line.startswith(" ")]


def read_by_the_compiler(exercise: Exercise, folder: Path) -> list[Path]:
    """All files that the compiler read for the learner's file and for the tests; empty if that is not known."""
    found = []
    for kind in ("exercise", "tests"):
        for start in (folder / "tests/exercises", folder):
            objects = list((start / "CMakeFiles" / f"{exercise.target(kind)}.dir").rglob("*.o"))
            if objects:
                read = told_to_ninja(objects, folder) if (folder / "build.ninja").exists() else told_to_make(objects, start)
                break
        else:
            return []
        if not read:
            return []
        found += read
    return found


def key_of(exercise: Exercise, folder: Path, seen: list[str]) -> str | None:
    read = read_by_the_compiler(exercise, folder)
    program = folder / "bin" / exercise.target("exercise")
    if not read or not program.exists():
        return None
    stamps = [stamp(file) for file in sorted({*read, folder / "CMakeCache.txt", program})]
    return hashlib.sha256("\n".join([*seen, *stamps]).encode()).hexdigest()


def place(exercise: Exercise, folder: Path) -> Path:
    return folder / "check" / f"{exercise.target('exercise')}.json"


def recall(exercise: Exercise, folder: Path, root: Path) -> dict | None:
    try:
        kept = json.loads(place(exercise, folder).read_text(encoding="utf-8"))
        key = key_of(exercise, folder, sources(exercise, root))
        return kept["state"] if key and kept["key"] == key else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def keep(exercise: Exercise, folder: Path, root: Path, seen: list[str], state: dict) -> None:
    """Keeps the result of a run that began when the sources were as `seen`, unless they have changed since."""
    key = key_of(exercise, folder, seen)
    if key is None or sources(exercise, root) != seen:
        return
    file = place(exercise, folder)
    file.parent.mkdir(exist_ok=True)
    file.write_text(json.dumps({"key": key, "state": state}), encoding="utf-8")
