"""Plants each kind of rot in a small book of its own, and sees plots/texts.py tell it."""

import contextlib
import io
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

PLOTS = Path(__file__).resolve().parents[2] / "plots"
sys.path.insert(0, str(PLOTS))
sys.dont_write_bytecode = True
import text_compare  # noqa: E402
import text_lint  # noqa: E402
import text_words  # noqa: E402
import texts  # noqa: E402

TEXT = """# Chapter 1

See [the other page](other.md#how-it-ends) and ![a curve](curve.svg). The speed is $v$, and $`2\\,v`$ is twice that.

```math
v = \\frac{1}{2}
```

<!-- run -->
```sh
build/bin/engine > out.csv
cp out.csv chapters/ch01_x/curve.svg
```

It takes <!-- value: out.csv steps where tolerance=1e-6 -->12<!-- /value --> steps, or <!-- value: out.csv time row 2 as %.3f -->0.667<!-- /value --> s.

<!-- snippet: chapters/ch01_x/a.cpp#sum -->
```cpp
int sum = a + b;
return sum;
```

<!-- output: head -1 out.csv -->
```
tolerance,steps,time [s]
```

<!-- table: out.csv tolerance, time as %.2f -->
| tolerance | time |
|---|---|
| 1e-3 | 0.33 |
| 1e-6 | 0.67 |
<!-- /table -->

<!-- times: date +%N -->
123
<!-- /times -->

## Symbols

| symbol | is | unit |
|---|---|---|
| $v$ | the speed | m/s |
"""
ENGINE = "#!/bin/sh\nprintf 'tolerance,steps,time [s]\\n1e-3,6,0.33333333333\\n1e-6,12,0.66666666667\\n'\n"
SOURCE = """int add(int a, int b) {
  // ANCHOR: sum
  int sum = a + b;
  return sum;
  // ANCHOR_END: sum
}
"""


class TextsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name) / "book"
        self.chapter = self.root / "chapters/ch01_x"
        self.bin = Path(folder.name) / "bin"
        self.chapter.mkdir(parents=True)
        self.bin.mkdir()
        (self.root / "README.md").write_text("# Book\n\n[chapter](chapters/ch01_x)\n")
        (self.chapter / "README.md").write_text(TEXT)
        (self.chapter / "other.md").write_text("# Other\n\n## How it ends\n\nWell.\n")
        (self.chapter / "a.cpp").write_text(SOURCE)
        self.engine(ENGINE)
        (self.chapter / "curve.svg").write_text("tolerance,steps,time [s]\n1e-3,6,0.33333333333\n1e-6,12,0.66666666667\n")
        pinned = mock.patch.object(texts, "PINNED", texts.matplotlib.__version__)
        pinned.start()
        self.addCleanup(pinned.stop)

    def engine(self, script: str) -> None:
        (self.bin / "engine").write_text(script)
        (self.bin / "engine").chmod(0o755)

    def replace(self, old: str, new: str, file: str = "README.md") -> None:
        text = (self.chapter / file).read_text()
        self.assertIn(old, text)
        (self.chapter / file).write_text(text.replace(old, new, 1))

    def assert_told(self, *parts: str) -> None:
        """One fault, which says all of this; and the check changed nothing."""
        before = {file: file.read_bytes() for file in self.root.rglob("*") if file.is_file()}
        faults = texts.check(self.root, self.bin)
        self.assertEqual(len(faults), 1, faults)
        for part in parts:
            self.assertIn(part, faults[0])
        self.assertEqual(before, {file: file.read_bytes() for file in self.root.rglob("*") if file.is_file()})

    def test_a_right_book_has_no_faults(self):
        self.assertEqual(texts.check(self.root, self.bin), [])

    def test_making_it_anew_mends_what_is_stale(self):
        for old, new in (("-->12<", "-->9<"), ("int sum = a + b;", "int sum = a;"), ("| 1e-6 | 0.67 |\n", ""), ("time [s]\n```", "old\n```")):
            self.replace(old, new)
        (self.root / "build").mkdir()
        (self.root / "build/bin").symlink_to(self.bin)
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            self.assertEqual(texts.make(self.root, quiet=True) + texts.make(self.root, quiet=False), [])
        shutil.rmtree(self.root / "build", ignore_errors=True)
        fresh = (self.chapter / "README.md").read_text()
        self.assertEqual(text_compare.difference(TEXT, fresh), "")

    def test_a_stale_excerpt(self):
        self.replace("int sum = a + b;", "int sum = b + a;", "a.cpp")
        self.assert_told("ch01_x/README.md:19", "int sum = b + a;", "./run figures")

    def test_a_number_that_moved(self):
        self.engine(ENGINE.replace("1e-6,12", "1e-6,13"))
        shutil.copy(self.chapter / "curve.svg", self.root / "curve")
        faults = texts.check(self.root, self.bin)
        self.assertTrue(any("README.md:15: has the number 12, but would have 13" in fault for fault in faults), faults)
        self.assertTrue(any("curve.svg:3: has the number 12" in fault for fault in faults), faults)

    def test_a_number_that_moved_by_less_than_it_shows(self):
        self.engine(ENGINE.replace("0.66666666667", "0.66666666668"))
        self.assertEqual(texts.check(self.root, self.bin), [])

    def test_a_stale_table_and_output(self):
        self.replace("| 1e-6 | 0.67 |", "| 1e-6 | 0.69 |")
        self.assert_told("has the number 0.69, but would have 0.67")
        self.replace("| 1e-6 | 0.69 |", "| 1e-6 | 0.67 |")
        self.replace("time [s]\n```", "time [h]\n```")
        self.assert_told("has 'tolerance,steps,time [h]'")

    def test_a_table_in_another_unit(self):
        self.replace("time as %.2f -->", "time as %.1f/1e-3 titled time [ms] -->")
        self.replace("| tolerance | time |", "| tolerance | time [ms] |")
        self.replace("| 1e-3 | 0.33 |", "| 1e-3 | 333.3 |")
        self.replace("| 1e-6 | 0.67 |", "| 1e-6 | 666.7 |")
        self.assertEqual(texts.check(self.root, self.bin), [])

    def test_a_picture_that_changed(self):
        (self.chapter / "curve.svg").write_text("tolerance,steps,time [s]\n1e-3,6,0.5\n1e-6,12,0.66666666667\n")
        self.assert_told("curve.svg:2", "look at it")

    def test_names_of_a_picture_that_are_digests(self):
        committed = '<path id="p0123456789"/><path id="pabcdef0123"/><use href="#p0123456789" x="1.25"/>'
        other = committed.replace("p0123456789", "p9876543210")
        self.assertEqual(text_compare.difference(committed, other, picture=True), "")
        swapped = committed.replace("#p0123456789", "#pabcdef0123")
        self.assertIn("1: has ", text_compare.difference(committed, swapped, picture=True))
        self.assertIn("1.25", text_compare.difference(committed, other.replace("1.25", "1.35"), picture=True))

    def test_a_missing_figure(self):
        self.replace("(curve.svg)", "(curved.svg)")
        faults = texts.check(self.root, self.bin)
        self.assertTrue(any("no figure curved.svg" in fault for fault in faults), faults)
        self.assertTrue(any("curve.svg: no text shows this figure" in fault for fault in faults), faults)

    def test_an_orphaned_figure(self):
        (self.chapter / "old.png").write_bytes(b"\x89PNG")
        self.assert_told("old.png: no text shows this figure")

    def test_a_figure_that_no_command_draws(self):
        self.replace("cp out.csv chapters/ch01_x/curve.svg\n", "")
        self.assert_told("curve.svg: no text's commands draw it")

    def test_a_command_that_fails(self):
        self.engine("#!/bin/sh\necho it is broken >&2\nexit 3\n")
        faults = texts.check(self.root, self.bin)
        self.assertTrue(any("README.md:9" in fault and "exit code 3" in fault and "it is broken" in fault for fault in faults), faults)

    def test_anchors(self):
        self.replace("#sum -->", "#product -->")
        faults = texts.check(self.root, self.bin)
        self.assertTrue(any("no pair of ANCHOR: product" in fault for fault in faults), faults)
        self.assertTrue(any("no text shows this anchor: sum" in fault for fault in faults), faults)
        self.replace("a.cpp#product", "b.cpp#sum")
        self.assertTrue(any("no file chapters/ch01_x/b.cpp" in fault for fault in texts.check(self.root, self.bin)))

    def test_marks_that_are_wrong(self):
        for old, new, told in (("<!-- output:", "<!-- ouput:", "unknown mark"), ("<!-- /table -->", "", "no <!-- /table -->"),
                               ("steps where", "stairs where", "no column 'stairs'"), ("tolerance=1e-6", "tolerance=1e-9", "no such row"),
                               ("<!-- run -->\n", "<!-- run -->\n\n", "a fenced block must follow"),
                               ("12<!-- /value -->", "12<!-- value -->", "no <!-- /value -->")):
            with self.subTest(new):
                (self.chapter / "README.md").write_text(TEXT)
                self.replace(old, new)
                faults = texts.check(self.root, self.bin)
                self.assertTrue(any(told in fault for fault in faults), faults)

    def test_links(self):
        for old, new, told in (("other.md#", "another.md#", "a link to nothing: another.md"), ("#how-it-ends", "#how-it-began", "a heading that is not there")):
            with self.subTest(new):
                (self.chapter / "README.md").write_text(TEXT)
                self.replace(old, new)
                self.assert_told("README.md:3", told)

    def test_a_symbol_that_the_table_lacks(self):
        self.replace("The speed is $v$", "The speed is $v$ at $`t_{i}^{2}`$ in $\\Omega$")
        faults = texts.check(self.root, self.bin)
        self.assertEqual([fault.partition("README.md")[2] for fault in faults],
                         [":3: Omega is in no row of the chapter's ## Symbols", ":3: t is in no row of the chapter's ## Symbols"])
        self.replace("| $v$ |", "| $v$, $t_0$, $\\Omega$ |")
        self.assertEqual(texts.check(self.root, self.bin), [])
        (self.chapter / "MORE.md").write_text("# More\n\n$q$\n")
        self.assert_told("MORE.md:3: q is in no row")
        self.replace("## Symbols", "## Letters")
        self.assert_told("README.md: no table under ## Symbols")

    def test_a_core_path_that_is_too_long(self):
        readme = (self.chapter / "README.md").read_text()
        room = text_words.MOST_WORDS - text_words.core_words(readme)
        self.replace("The speed is", "word " * room + "The speed is")
        self.assertEqual(texts.check(self.root, self.bin), [])
        for free in ("<details>\n<summary>Ours</summary>\n\nmore words\n\n</details>\n", "```\nsome code\n```\n", "<!-- a comment -->\n",
                     "| a | b |\n|---|---|\n| in a | table |\n", "![a drawing of](curve.svg)\n"):
            self.replace("## Symbols", f"{free}\n## Symbols")
        self.assertEqual(texts.check(self.root, self.bin), [])
        self.replace("word word", "word word word")
        self.assert_told(f"README.md: {text_words.MOST_WORDS + 1} words")

    def test_words_that_the_glossary_calls_old(self):
        (self.root / "chapters/GLOSSARY.md").write_text("# Glossary\n\n## Not these\n\n| not | but |\n|---|---|\n| crowd | pile |\n")
        self.assertEqual(texts.check(self.root, self.bin), [])
        self.replace("The speed is", "`crowd`, crowded; the speed is")
        self.assertEqual(texts.check(self.root, self.bin), [])
        self.replace("the speed is", "A Crowd, whose speed is")
        self.assert_told("README.md:3: 'Crowd': the glossary says pile")

    def test_mathematics_that_github_mangles(self):
        for wrong, told in (("$$v$$", "use a ```math block"), ("$2\\,v$", "eats the backslash"), ("$\\{v\\}$", "eats the backslash"),
                            ("$ v$", "a blank inside"), ("$v*w*x$", "reads * and tags"), ("a$v$", "touches a word"), ("$v", "without its other one"),
                            ("x\n\n| a | b |\n|---|---|\n| $|v|$ | 1 |\n", "ends the table's cell")):
            with self.subTest(wrong):
                (self.chapter / "README.md").write_text(TEXT.replace("$v$", wrong, 1))
                faults = text_lint.faults(self.root, texts.texts(self.root))
                self.assertTrue(any(told in fault for fault in faults), faults)
        (self.chapter / "README.md").write_text(TEXT.replace("$v$", "`$$not$math` and $|v| < 1$, $v_1$, $a_i b_i$", 1))
        self.assertEqual(text_lint.faults(self.root, texts.texts(self.root)), [])

    def test_numbers(self):
        for old, new, same in (("1.234", "1.235", True), ("1.234", "1.236", False), ("12", "13", False), ("1.5e-06", "1.6e-06", True),
                               ("1.5e-06", "1.5e-07", False), ("0.123456789012", "0.123456789013", True), ("0.123456789012", "0.123456799012", False),
                               ("x 1", "y 1", False), ("-0.5", "0.5", False)):
            with self.subTest(f"{old} and {new}"):
                self.assertEqual(text_compare.difference(old, new) == "", same)


if __name__ == "__main__":
    unittest.main()
