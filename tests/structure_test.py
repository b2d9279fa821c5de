"""Checks the tree: what stands at the top, and that includes point backwards only (design 1.2 and 2.1)."""

import re
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


class StructureTest(unittest.TestCase):
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
