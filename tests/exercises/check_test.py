"""Tests exercises/check.py and see.py on a small project of its own, with real compilations: each state of an exercise, the
names, when the last result holds and when not, and what is to be seen."""

import contextlib
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "exercises"))
import building  # noqa: E402
import check  # noqa: E402

PROJECT = """
cmake_minimum_required(VERSION 3.22)
project(tiny LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
list(APPEND CMAKE_MODULE_PATH ${CMAKE_SOURCE_DIR}/common/cmake)
find_package(GTest REQUIRED)
include(GoogleTest)
include(Exercises)
enable_testing()
add_library(fc_settings INTERFACE)
target_compile_options(fc_settings INTERFACE -Wall -Wextra -Werror)
fc_add_exercise(ch07 ex01_double)
fc_add_exercise(ch07 ex02_half)
fc_add_exercise(ch08 ex01_triple)
add_executable(chapter chapter.cpp)
add_executable(ch08_triples program.cpp)
"""
HEADER = "#pragma once\nnamespace fc::exercises {{\ndouble twice(double x);  // 2 x\n}}\n"
STUB = '#include "{name}.hpp"\n\n#include "common/todo.hpp"\n\nnamespace fc::exercises {{\ndouble twice(double x) {{ FC_TODO("7.1"); }}\n}}\n'
TESTS = """
#include <gtest/gtest.h>
#include "{name}.hpp"
using fc::exercises::twice;
TEST(Double, OfOne) {{ EXPECT_EQ(twice(1), 2) << "metres: twice the way is longer"; }}
TEST(Double, OfTwo) {{ EXPECT_EQ(twice(2), 4) << "metres"; }}
TEST(Double, OfThree) {{ EXPECT_EQ(twice(3), 6) << "metres"; }}
"""
SOLUTION = '#include "{name}.hpp"\n\nnamespace fc::exercises {{\ndouble twice(double x) {{ return 2 * x; }}\n}}\n'
MUTANT = '// Caught by: Double.OfThree\n#include "{name}.hpp"\n\nnamespace fc::exercises {{\ndouble twice(double x) {{ return x * x; }}\n}}\n'
NAMES = ("ex01_double", "ex02_half")
PIECE_STUB = '#include "ex01_triple.hpp"\n#include "common/todo.hpp"\nnamespace fc::mine {\ndouble triple(double) { FC_TODO("8.1"); }\n}\n'
# A piece of the engine: no demo, a mutant that is a change of the solution, and a program that says how it was called.
PIECE = {
    "exercises/ch08/ex01_triple.hpp": "#pragma once\nnamespace fc::mine {\ndouble triple(double x);  // 3 x\n}\n",
    "exercises/ch08/ex01_triple.cpp": PIECE_STUB,
    "exercises/ch08/ex01_triple.piece.cpp":
        '// See: chapters/ch08_triples/scenes/three.yaml\n#include "common/pieces.hpp"\n#include "ex01_triple.hpp"\nFC_PIECE(fc::mine::triple);\n',
    "tests/exercises/ch08/ex01_triple_test.cpp":
        '#include <gtest/gtest.h>\n#include "ex01_triple.hpp"\nTEST(Triple, OfTwo) { EXPECT_EQ(fc::mine::triple(2), 6); }\n',
    "solutions/ch08/ex01_triple.cpp": '#include "ex01_triple.hpp"\n\nnamespace fc::mine {\ndouble triple(double x) { return 3 * x; }\n}\n',
    "tests/exercises/ch08/mutants/ex01_triple.added.change":
        "// Caught by: Triple.OfTwo\n<<<<\ndouble triple(double x) { return 3 * x; }\n====\ndouble triple(double x) { return 3 + x; }\n>>>>\n",
    "program.cpp": '#include <cstdio>\nint main(int count, char** words) { for (int k = 1; k < count; ++k) std::puts(words[k]); }\n',
}
NONE = "the bunnies collide on 0 of 1 pieces of yours; the first is 8.1"
TASK = "write exercises/ch07/ex01_double.cpp; the task is 7.1 in exercises/ch07/README.md"
DEMO = """
#include <cstdio>
#include <fstream>
#include "common/todo.hpp"
#include "{name}.hpp"
int main(int, char** argv) {{
  try {{
    std::ofstream(std::string(argv[1]) + ".txt") << fc::exercises::twice(21);
  }} catch (const fc::TodoError& todo) {{
    std::fprintf(stderr, "%s\\n", todo.what());
    return 2;
  }}
  std::printf("twice 21 is %g\\ndraw it: by hand\\n", fc::exercises::twice(21));
}}
"""
PLOT = """
import shutil, sys
shutil.copy(sys.argv[1] + ".txt", sys.argv[1] + ".png")
print(sys.argv[1] + ".png")
"""


class Project(unittest.TestCase):
    """The small project, built by Ninja where there is one, as ./run builds."""

    generator = "Ninja" if shutil.which("ninja") else "Unix Makefiles"

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.root = root = Path(cls.temporary.name)
        for folder in ("common/cmake", "exercises/ch07", "solutions/ch07", "tests/exercises/ch07/mutants", "plots", "out",
                       "exercises/ch08", "solutions/ch08", "tests/exercises/ch08/mutants"):
            (root / folder).mkdir(parents=True)
        for file in ("common/todo.hpp", "common/pieces.hpp", "common/cmake/Exercises.cmake", "common/cmake/copy_stub.cmake",
                     "common/cmake/make_mutants.py"):
            shutil.copy(ROOT / file, root / file)
        (root / "CMakeLists.txt").write_text(PROJECT)
        (root / "chapter.cpp").write_text("int main() {}\n")
        for file, text in PIECE.items():
            (root / file).write_text(text)
        for name in NAMES:
            for file, text in {f"exercises/ch07/{name}.hpp": HEADER, f"exercises/ch07/{name}.cpp": STUB,
                               f"exercises/ch07/{name}.demo.cpp": DEMO, f"plots/ch07_{name}.py": PLOT,
                               f"tests/exercises/ch07/{name}_test.cpp": TESTS, f"solutions/ch07/{name}.cpp": SOLUTION, f"tests/exercises/ch07/mutants/{name}.square.cpp": MUTANT}.items():
                (root / file).write_text(text.format(name=name))
        cls.build = root / "build"
        configured = subprocess.run(["cmake", "-G", cls.generator, "-S", root, "-B", cls.build], capture_output=True, text=True, check=False)
        assert configured.returncode == 0, configured.stdout + configured.stderr

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def tearDown(self):
        for name in NAMES:
            self.write(STUB.format(name=name), name)

    def write(self, text: str, name: str = "ex01_double") -> None:
        (self.root / f"exercises/ch07/{name}.cpp").write_text(text)

    def solve(self, body: str) -> None:
        self.write(f'#include "ex01_double.hpp"\n#include <cstdlib>\n\nnamespace fc::exercises {{ double twice(double x) {{ {body} }} }}\n')

    def run_tool(self, tool: str, *arguments: str, build: bool = True, **environment: str) -> subprocess.CompletedProcess:
        """Runs check.py or see.py as a user does; all that goes to standard error is what is being built."""
        folder = ["--build", self.build] if build else []
        done = subprocess.run([sys.executable, "-B", ROOT / f"exercises/{tool}.py", "--root", self.root, *folder, *arguments],
                              capture_output=True, text=True, check=False, env={**os.environ, **environment})
        if build:
            self.assertEqual([line for line in done.stderr.splitlines() if not line.startswith("building ")], [])
        return done

    def check(self, *arguments: str, **environment: str) -> tuple[int, str]:
        """The exit code, and what was printed."""
        done = self.run_tool("check", *arguments, **environment)
        return done.returncode, done.stdout

    def mine(self) -> set[str]:
        return {file.name for file in (self.root / "build/mine").glob("*")}

    @contextlib.contextmanager
    def no_cmake(self):
        """An environment whose cmake builds nothing."""
        with tempfile.TemporaryDirectory() as folder:
            cmake = Path(folder) / "cmake"
            cmake.write_text("#!/bin/sh\necho no build was wanted\nexit 1\n")
            cmake.chmod(0o755)
            yield {"PATH": f"{folder}:{os.environ['PATH']}"}


class CheckTest(Project):
    def test_after_a_piece_comes_the_next_piece(self):
        exercises = building.known_exercises(ROOT)
        after = {str(exercise): str(check.next_of(exercise, exercises, ROOT)) for exercise in exercises}
        self.assertEqual(after["ch03/ex06"], "ch04/ex06")
        self.assertEqual(after["ch03/ex01"], "ch03/ex02")
        self.assertEqual(after["ch06/ex01"], "ch06/ex02")  # the last piece: what is left are variants

    def test_a_piece_that_passes_is_handed_over(self):
        piece = self.root / "exercises/ch08/ex01_triple.cpp"
        self.addCleanup(lambda: piece.write_text(PIECE_STUB))
        self.assertIn(NONE, self.check("ch08")[1])
        self.assertEqual(self.mine(), set())
        shutil.copy(self.root / "solutions/ch08/ex01_triple.cpp", piece)
        code, out = self.check("ch08")
        self.assertEqual(code, 0, out)
        self.assertTrue(out.splitlines()[-1].startswith("the bunnies collide on 1 of 1 pieces of yours: build/bin/ch04"), out)
        self.assertEqual(self.mine(), {"ch08_ex01.so", "ch08_ex01.source"})
        self.assertEqual((self.root / "build/mine/ch08_ex01.source").read_text(), f"{piece.resolve()}\n{piece.read_text()}")
        with self.no_cmake() as environment:  # it is there, and what it was made from has not changed
            self.assertEqual(self.check("ch08", **environment), (code, out))
        done = self.run_tool("see", "ch08/ex01")
        self.assertIn("chapters/ch08_triples/scenes/three.yaml\n--mine\n--out\nout/ch08_ex01\nits results: out/ch08_ex01\n", done.stdout)
        piece.write_text(piece.read_text().replace("3 *", "2 *"))
        self.assertIn(NONE, self.check("ch08")[1])
        self.assertEqual(self.mine(), {"ch08_ex01.refused"})
        self.assertEqual((self.root / "build/mine/ch08_ex01.refused").read_text(), "0/1 tests pass\n")
        piece.write_text("this is no C++\n")
        self.check("ch08")
        self.assertEqual((self.root / "build/mine/ch08_ex01.refused").read_text(), "does not compile\n")
        piece.write_text(PIECE_STUB)
        self.check("ch08")
        self.assertEqual(self.mine(), set())

    def test_a_change_that_does_not_fit_is_told(self):
        change = self.root / "tests/exercises/ch08/mutants/ex01_triple.added.change"
        made = [sys.executable, ROOT / "common/cmake/make_mutants.py", self.root, self.root / "exercises/ch08/ex01_triple.hpp",
                self.root / "solutions/ch08/ex01_triple.cpp", self.root / "mutants.cpp", change]
        self.assertEqual(subprocess.run(made, check=False).returncode, 0)
        self.assertIn("return 3 + x;", (self.root / "mutants.cpp").read_text())
        former = change.read_text()
        self.addCleanup(lambda: change.write_text(former))
        change.write_text(former.replace("return 3 *", "return x *"))
        done = subprocess.run(made, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("stands 0 times in", done.stderr)

    def test_not_started(self):
        code, out = self.check("ch07/ex01")
        self.assertEqual(code, 1)
        self.assertEqual(out, f"ch07/ex01  ex01_double              not started\n           {TASK}\n0 of 1 exercise done\n{NONE}\n")

    @unittest.skipUnless(shutil.which("git"), "needs git")
    def test_what_is_as_it_was_committed_is_not_built(self):
        git = ["git", "-C", self.root, "-c", "user.name=one", "-c", "user.email=one@example.org"]
        self.addCleanup(lambda: shutil.rmtree(self.root / ".git"))
        for command in (["init", "--quiet"], ["add", "exercises"], ["commit", "--quiet", "--message", "stubs"]):
            subprocess.run([*git, *command], check=True)
        asked = self.run_tool("check", "ch07/ex01")
        self.assertIn("not started", asked.stdout)
        self.assertEqual(asked.stderr, "")
        self.solve("return x * x;")
        self.assertIn("1/3 tests pass", self.check("ch07/ex01")[1])
        subprocess.run([*git, "commit", "--quiet", "--all", "--message", "mine"], check=True)
        self.assertIn("1/3 tests pass", self.check("ch07/ex01")[1])

    def test_some_tests_pass(self):
        self.solve("return x * x;")
        code, out = self.check("ch07/ex01")
        self.assertEqual(code, 1)
        self.assertIn("1/3 tests pass", out)
        self.assertIn("Double.OfOne", out)
        self.assertIn("metres: twice the way is longer", out)
        self.assertIn("0 of 1 exercise done", out)
        self.assertRegex(out, r"(?m)^ +tests/exercises/ch07/ex01_double_test\.cpp:\d+$")  # where an editor finds it
        self.assertIn("failing, too: OfThree\n", out)
        self.solve("return 7 * x;")
        self.assertIn("failing, too: OfTwo, OfThree\n", self.check("ch07/ex01")[1])

    def test_done(self):
        self.solve("return 2 * x;")
        code, out = self.check("ch07/ex01")
        self.assertEqual(code, 0)
        self.assertIn("ex01_double              done\n", out)
        self.assertIn("compare with solutions/ch07/ex01_double.cpp", out)
        self.assertEqual((self.build / "bin/this_exercise").resolve(), (self.build / "bin/ch07_ex01_exercise").resolve())
        self.assertIn("see what it does: ./run see ch07/ex01\n", out)
        self.assertIn("next, ch07/ex02: write exercises/ch07/ex02_half.cpp; the task is 7.2 in exercises/ch07/README.md\n", out)
        code, out = self.check()  # the other one is not
        self.assertEqual(code, 1)
        self.assertIn("1 of 3 exercises done", out)

    def test_the_pasted_solution_is_done(self):
        shutil.copy(self.root / "solutions/ch07/ex01_double.cpp", self.root / "exercises/ch07/ex01_double.cpp")
        self.assertEqual(self.check("ch07/ex01")[0], 0)

    def test_does_not_compile_and_breaks_nothing_else(self):
        self.solve("return 2 * y;")
        code, out = self.check("ch07/ex01")
        self.assertEqual(code, 1)
        self.assertIn("does not compile", out)
        self.assertRegex(out, r"exercises/ch07/ex01_double\.cpp:4:\d+: .*y")
        self.write("double unrelated;\n")
        self.assertRegex(self.check("ch07/ex01")[1], r"does not compile\n +exercises/ch07/ex01_double.cpp: fc::exercises::twice.* is declared")
        self.write("this is no C++\n")
        stub = self.build / "stubs/ch07/ex01_double.cpp"
        self.assertEqual(stub.read_text(), STUB.format(name="ex01_double"))  # the proof has a copy of its own
        built = subprocess.run(["cmake", "--build", self.build], capture_output=True, text=True, check=False)
        self.assertEqual(built.returncode, 0, built.stdout + built.stderr)  # solutions, mutants and the chapter
        proof = subprocess.run(["ctest", "--test-dir", self.build], capture_output=True, text=True, check=False)
        self.assertEqual(proof.returncode, 0, proof.stdout)

    def test_unused_things_are_no_errors(self):
        self.solve("int unused = 0; return 2 * x;")
        self.assertEqual(self.check("ch07/ex01")[0], 0)

    def test_crashed(self):
        self.solve("if (x > 1) abort(); return 2 * x;")
        code, out = self.check("ch07/ex01")
        self.assertEqual(code, 1)
        self.assertIn("crashed: abort or a failed assert (SIGABRT)", out)
        self.assertIn("in Double.OfTwo", out)
        self.solve("if (x > 2) exit(3); return 2 * x;")
        out = self.check("ch07/ex01")[1]
        self.assertIn("crashed: exit code 3", out)
        self.assertIn("in Double.OfThree", out)

    def test_an_endless_loop_is_stopped(self):
        self.solve("volatile bool on = true; while (on && x == 2) {} return 2 * x;")
        code, out = self.check("ch07/ex01", "--limit", "1")
        self.assertEqual(code, 1)
        self.assertIn("crashed: stopped after 1 s; an endless loop?", out)

    def test_names(self):
        self.assertIn("0 of 2 exercises done", self.check("ch07")[1])
        self.assertIn("0 of 1 exercise done", self.check("ch07/ex02_half")[1])
        for wrong in ("ch09", "ch07/ex03", "ex01"):
            for tool in ("check", "see"):
                done = self.run_tool(tool, wrong, build=False)
                self.assertEqual((done.returncode, done.stderr),
                                 (2, f"{tool}: no exercise '{wrong}'; there are: ch07/ex01, ch07/ex02, ch08/ex01\n"))
        for several in ([], ["ch07"]):
            done = self.run_tool("see", *several, build=False)
            self.assertEqual(done.returncode, 2)

    def test_the_last_result_holds_until_something_changes(self):
        self.solve("return 2 * x;")
        first = self.check("ch07/ex01")
        with self.no_cmake() as environment:  # whoever builds now fails
            self.assertEqual(self.check("ch07/ex01", **environment), first)
            self.solve("return 3 * x;")
            self.assertNotEqual(self.check("ch07/ex01", **environment), first)
        self.assertIn("0/3 tests pass", self.check("ch07/ex01")[1])
        self.solve("return 2 * x;")
        self.assertEqual(self.check("ch07/ex01"), first)
        header, test = self.root / "exercises/ch07/ex01_double.hpp", self.root / "tests/exercises/ch07/ex01_double_test.cpp"
        program, cache = self.build / "bin/ch07_ex01_exercise", self.build / "CMakeCache.txt"
        beside = self.root / "exercises/ch07/mine.inc"  # a file that only the compiler knows of
        self.write('#include "ex01_double.hpp"\n#include "mine.inc"\nnamespace fc::exercises { double twice(double x) { return factor * x; } }\n')
        beside.write_text("constexpr double factor = 2;\n")
        self.addCleanup(beside.unlink)
        for file, text in ((header, None), (test, None), (program, None), (cache, None), (self.root / "common/todo.hpp", None),
                           (beside, "constexpr double factor = 3;\n")):
            with self.subTest(file.name):
                self.assertEqual(self.check("ch07/ex01"), first)
                with self.no_cmake() as environment:
                    self.assertEqual(self.check("ch07/ex01", **environment), first)
                    file.write_bytes(file.read_bytes()) if text is None else file.write_text(text)
                    self.assertNotEqual(self.check("ch07/ex01", **environment), first)
        self.assertIn("0/3 tests pass", self.check("ch07/ex01")[1])

    def test_a_crash_is_tried_again(self):
        """A time limit that was too short on a busy machine must not stick."""
        self.solve("volatile double sum = 0; for (int k = 0; k < 300'000'000; ++k) sum = sum + 1; return 2 * x;")
        self.assertIn("crashed: stopped after 0.01 s", self.check("ch07/ex01", "--limit", "0.01")[1])
        self.assertIn("1 of 1 exercise done", self.check("ch07/ex01", "--limit", "100")[1])

    def test_what_filters_tests_does_not_filter_these(self):
        self.solve("return x * x;")
        self.assertIn("1/3 tests pass", self.check("ch07/ex01", GTEST_FILTER="Double.OfTwo")[1])

    def test_it_says_what_it_builds(self):
        self.solve("return 2 * x;")
        self.assertIn("building your file …\n", self.run_tool("check", "ch07/ex01").stderr)
        self.assertEqual(self.run_tool("check", "ch07/ex01").stderr, "")
        self.assertNotIn(".gch", building.what_is_built("CMakeFiles/fc_precompiled.dir/cmake_pch.hxx.gch"))  # in a learner's words

    def test_see(self):
        done = self.run_tool("see", "ch07/ex01")
        self.assertEqual((done.returncode, done.stdout), (1, f"ch07/ex01 is not started: {TASK}\n"))
        self.solve("return y;")
        done = self.run_tool("see", "ch07/ex01")
        self.assertEqual(done.returncode, 1)
        self.assertIn("does not compile\n           exercises/ch07/ex01_double.cpp:4:", done.stdout)
        self.solve("if (x > 20) abort(); return 2 * x;")
        done = self.run_tool("see", "ch07/ex01")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the demo ended with abort", done.stdout)
        self.solve("return 3 * x;")  # a wrong answer is to be seen, too
        done = self.run_tool("see", "ch07/ex01")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("0/3 tests pass", done.stdout)
        self.assertTrue(done.stdout.endswith("twice 21 is 63\ndrawn: out/ch07_ex01.png\n"), done.stdout)
        self.assertEqual((self.root / "out/ch07_ex01.png").read_text(), "63")

    def test_proofs_see_a_bad_test(self):
        """A test that the stub passes, a mutant that passes, and a solution that fails make CTest fail."""
        build = self.root / "proof"
        subprocess.run(["cmake", "-S", self.root, "-B", build], capture_output=True, check=True)

        def failing() -> set[str]:
            built = subprocess.run(["cmake", "--build", build, "--parallel", "2"], capture_output=True, text=True, check=False)
            self.assertEqual(built.returncode, 0, built.stdout + built.stderr)
            out = subprocess.run(["ctest", "--test-dir", build], capture_output=True, text=True, check=False).stdout
            listed = out.partition("The following tests FAILED:")[2]
            return {line.split()[2] for line in listed.splitlines() if " - " in line}

        self.assertEqual(failing(), set())
        for mistake, code in (("square", 1), ("nobody", 0)):  # a mutant that is none fails no test, so its CTest test fails
            done = subprocess.run([build / "bin/ch07_ex01_mutants"], env={**os.environ, "FC_MUTANT": mistake}, capture_output=True, check=False)
            self.assertEqual(done.returncode, code, mistake)
        test = self.root / "tests/exercises/ch07/ex01_double_test.cpp"
        mutant = self.root / "tests/exercises/ch07/mutants/ex01_double.square.cpp"
        solution = self.root / "solutions/ch07/ex01_double.cpp"
        for file, text, failed in (
                (test, TESTS + "TEST(Double, Vacuous) {{ EXPECT_LT(1, 2); }}\n", {"stub_must_fail.ch07.Double.Vacuous"}),
                (mutant, MUTANT.replace("x * x", "x + x"), {"mutant_must_fail.ch07.ex01.square"}),
                (solution, SOLUTION.replace("2 *", "3 *"), {f"solution.ch07.Double.Of{n}" for n in ("One", "Two", "Three")})):
            former = file.read_text()
            file.write_text(text.format(name="ex01_double"))
            try:
                self.assertEqual(failing(), failed)
            finally:
                file.write_text(former)


class CheckByMakeTest(Project):
    generator = "Unix Makefiles"  # tells otherwise than Ninja what the compiler read
    test_the_last_result_holds_until_something_changes = CheckTest.test_the_last_result_holds_until_something_changes


if __name__ == "__main__":
    os.environ.pop("CMAKE_CXX_COMPILER_LAUNCHER", None)  # these compilations are nobody else's
    unittest.main()
