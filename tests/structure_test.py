"""Checks the tree: what stands at the top, that includes point backwards only, that exercises are complete (design 1.2,
2.1 and 2.5)."""

import re
import shutil
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
AT_THE_TOP = {"CMakeLists.txt", "CMakePresets.json", "README.md", "LICENSE", "run", "common", "chapters", "exercises",
              "solutions", "tests", "plots"}
MADE_BY_USERS = {"build", "out", "CMakeUserPresets.json"}  # named in .gitignore
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')
CHAPTER = re.compile(r"ch(\d\d)_\w+")


def chapter_number(name: str) -> int:
    """4 of ch04_multibody_stepping; 0 of common; 100 of anything else."""
    match = CHAPTER.fullmatch(name)
    return int(match[1]) if match else 0 if name == "common" else 100


def wrong_includes(root: Path) -> list[str]:
    """Every include in common/ and chapters/ that is not of common/ or of the same or an earlier chapter, by its full
    path from there."""
    wrong = []
    files = [*(root / "common").rglob("*.[hc]pp"), *(root / "chapters").rglob("*.[hc]pp")]
    for file in sorted(files):
        parts = file.relative_to(root).parts
        own = chapter_number("common" if parts[0] == "common" else parts[1])
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), start=1):
            match = INCLUDE.match(line)
            if match and chapter_number(match[1].split("/")[0]) > own:
                wrong.append(f"{file.relative_to(root)}:{number}: {line.strip()}")
    return wrong


def exercise_faults(root: Path) -> list[str]:
    """What an exercise lacks (exercises/README.md), and files that belong to none."""
    faults, belonging = [], set()
    registered = (root / "tests/exercises/CMakeLists.txt").read_text(encoding="utf-8")
    for header in sorted((root / "exercises").glob("ch*/ex*.hpp")):
        chapter, name = header.parent.name, header.stem
        number = name.split("_")[0]
        dotted = f"{int(chapter[2:])}.{int(number[2:])}"
        tests = root / "tests/exercises" / chapter
        test = tests / f"{name}_test.cpp"
        parts = [header, header.with_suffix(".cpp"), test, root / "solutions" / chapter / f"{name}.cpp"]
        demo, piece = header.with_name(f"{name}.demo.cpp"), header.with_name(f"{name}.piece.cpp")
        if piece.exists():  # what it does is seen in the chapter's program
            belonging.add(piece)
            if not re.match(r"// See: chapters/\S+\.yaml\n", piece.read_text(encoding="utf-8")):
                faults.append(f"{piece.name}: its first line names no scene to see it in")
        if demo.exists() or not piece.exists():
            parts += [demo, root / "plots" / f"{chapter}_{name}.py"]
        mutants = sorted([*(tests / "mutants").glob(f"{name}.*.cpp"), *(tests / "mutants").glob(f"{name}.*.change")])
        belonging.update(parts, mutants)
        faults += [f"{name}: no {part.relative_to(root)}" for part in parts if not part.exists()]
        if f"fc_add_exercise({chapter} {name} " not in registered:
            faults.append(f"{name}: not in tests/exercises/CMakeLists.txt")
        if not mutants:
            faults.append(f"{name}: no mutant")
        source = test.read_text(encoding="utf-8") if test.exists() else ""
        for mutant in mutants:
            first = mutant.read_text(encoding="utf-8").splitlines()[0]
            caught = re.fullmatch(r"// Caught by: (\w+)\.(\w+)", first)
            if not caught or f"TEST({caught[1]}, {caught[2]})" not in source:
                faults.append(f"{mutant.name}: its first line names no test of {test.name}")
        statement = root / "exercises" / chapter / "README.md"
        text = statement.read_text(encoding="utf-8") if statement.exists() else ""
        section = re.search(rf"^## {re.escape(dotted)} .*?(?=^## |\Z)", text, re.M | re.S)
        if f"`{name}.cpp`" not in text.split("## ")[0]:
            faults.append(f"{name}: no row in {chapter}/README.md")
        if not section or "<details>" not in section[0]:
            faults.append(f"{name}: no section {dotted} with a hint in {chapter}/README.md")
    for folder in ("exercises", "solutions", "tests/exercises"):
        for file in sorted((root / folder).rglob("*.[hc]pp")):
            if file not in belonging:
                faults.append(f"{file.relative_to(root)}: belongs to no exercise")
    return faults


def nameless_enumerations(root: Path) -> list[str]:
    """Enumerations of common/ and chapters/ that a test compares and that have no operator<<: a failure would print bytes."""
    compared = set()
    for file in (root / "tests").rglob("*.[hc]pp"):
        for line in re.findall(r"\b(?:EXPECT|ASSERT)_(?:EQ|NE)\(.*?;", file.read_text(encoding="utf-8"), re.S):
            compared.update(re.findall(r"[(,]\s*(?:[a-z]\w*::)*([A-Z]\w*)::[a-z]\w*\s*[,)]", line))
    faults = []
    for header in sorted([*(root / "common").rglob("*.hpp"), *(root / "chapters").rglob("*.hpp")]):
        text = header.read_text(encoding="utf-8")
        for name in set(re.findall(r"^enum class (\w+)", text, re.M)) & compared:
            if not re.search(rf"operator<<\(std::ostream& out, (\w+::)?{name} ", text):
                faults.append(f"{header.relative_to(root)}: {name}")
    return faults


class StructureTest(unittest.TestCase):
    def test_whatever_a_test_compares_prints_its_name(self):
        self.assertEqual(nameless_enumerations(ROOT), [])
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for file, text in {"tests/a_test.cpp": "EXPECT_EQ(x,\n          Colour::red) << 1;\nEXPECT_EQ(f(), Limits::max());\n",
                               "common/a.hpp": "enum class Colour { red };\n", "chapters/c/b.hpp": "enum class Taste { red };\n"}.items():
                (root / file).parent.mkdir(parents=True, exist_ok=True)
                (root / file).write_text(text)
            self.assertEqual(nameless_enumerations(root), ["common/a.hpp: Colour"])

    def test_exercises_are_complete(self):
        self.assertEqual(exercise_faults(ROOT), [])

    def test_the_exercise_check_sees_what_is_missing(self):
        name = "ch01/ex01_door"
        for lost, fault in {
                "exercises/ch01/ex01_door.cpp": "no exercises", "exercises/ch01/ex01_door.demo.cpp": "no exercises",
                "solutions/ch01/ex01_door.cpp": "no solutions", "tests/exercises/ch01/ex01_door_test.cpp": "no tests",
                "plots/ch01_ex01_door.py": "no plots", "tests/exercises/ch01/mutants/ex01_door.*": "no mutant"}.items():
            with self.subTest(lost), tempfile.TemporaryDirectory() as folder:
                root = self.exercise_tree(Path(folder))
                for file in root.glob(lost):
                    file.unlink()
                self.assertTrue(any(fault in f for f in exercise_faults(root)), exercise_faults(root))
        statement, listed = "exercises/ch01/README.md", "tests/exercises/CMakeLists.txt"
        mutant = "tests/exercises/ch01/mutants/ex01_door.from_the_origin.cpp"
        for file, old, new, fault in (
                (statement, "`ex01_door.cpp`", "it", "no row"), (statement, "<details>", "", "with a hint"),
                (statement, "## 1.1 ", "## 1.7 ", "no section 1.1"), (listed, "ex01_door", "ex01_gate", "not in tests"),
                (mutant, "Ex01Door.", "Ex01Gate.", "names no test")):
            with self.subTest(f"{file}: {fault}"), tempfile.TemporaryDirectory() as folder:
                root = self.exercise_tree(Path(folder))
                text = (root / file).read_text(encoding="utf-8")
                self.assertIn(old, text)
                (root / file).write_text(text.replace(old, new), encoding="utf-8")
                self.assertTrue(any(fault in f for f in exercise_faults(root)), exercise_faults(root))
        for stray in ("solutions/ch01/ex09_old.cpp", "tests/exercises/ch01/mutants/ex09_old.wrong.cpp", "exercises/ch01/notes.cpp"):
            with self.subTest(stray), tempfile.TemporaryDirectory() as folder:
                root = self.exercise_tree(Path(folder))
                (root / stray).write_text("// nobody's\n")
                self.assertEqual(exercise_faults(root), [f"{stray}: belongs to no exercise"])
        self.assertTrue((ROOT / f"exercises/{name}.hpp").exists())

    def exercise_tree(self, root: Path) -> Path:
        """A copy of the exercises; nothing is wrong with it."""
        for folder in ("exercises", "solutions", "tests/exercises"):
            shutil.copytree(ROOT / folder, root / folder)
        (root / "plots").mkdir()
        for plot in (ROOT / "plots").glob("ch*_ex*.py"):
            shutil.copy(plot, root / "plots")
        self.assertEqual(exercise_faults(root), [])
        return root

    def test_nothing_else_stands_at_the_top(self):
        there = {path.name for path in ROOT.iterdir() if not path.name.startswith(".")}
        self.assertEqual(there - AT_THE_TOP - MADE_BY_USERS, set())

    def test_includes_point_backwards(self):
        self.assertEqual(wrong_includes(ROOT), [])

    def test_the_include_check_sees_mistakes(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for file, text in {"common/a.hpp": '#include "ch01_x/b.hpp"\n', "chapters/ch01_x/b.hpp": '#include "ch02_y/c.hpp"\n',
                               "chapters/ch02_y/c.hpp": '#include "ch01_x/b.hpp"\n#include <vector>\n#include "c.hpp"\n',
                               "chapters/ch02_y/d.cpp": '#include "ch02_y/c.hpp"\n#  include "common/a.hpp"\n'}.items():
                (root / file).parent.mkdir(parents=True, exist_ok=True)
                (root / file).write_text(text)
            self.assertEqual(wrong_includes(root), [
                'chapters/ch01_x/b.hpp:1: #include "ch02_y/c.hpp"', 'chapters/ch02_y/c.hpp:3: #include "c.hpp"',
                'common/a.hpp:1: #include "ch01_x/b.hpp"'])

    def test_bounds_stay_bounds(self):
        settings = (ROOT / "common/cmake/FirstContact.cmake").read_text()
        self.assertIn("-ffp-contract=off", settings)
        for file in [*ROOT.glob("CMake*"), *ROOT.glob("*/**/CMakeLists.txt"), *ROOT.glob("common/cmake/*")]:
            self.assertNotIn("-ffast-math", file.read_text(encoding="utf-8"), file)


if __name__ == "__main__":
    unittest.main()
