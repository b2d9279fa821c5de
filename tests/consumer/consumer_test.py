"""Installs First Contact into an empty folder, builds a program of somebody else's against it, and runs that. consumer_test.py BUILD"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(sys.argv.pop()).resolve()


def ok(command: list) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{command}:\n{done.stdout}{done.stderr}"
    return done.stdout


class ConsumerTest(unittest.TestCase):
    def test_an_installed_engine_is_found_and_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            prefix, build = Path(folder) / "prefix", Path(folder) / "build"
            ok(["cmake", "--install", BUILD, "--prefix", prefix])
            ok(["cmake", "-S", ROOT / "tests/consumer", "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release"])
            headers = (build / "CMakeCache.txt").read_text()
            self.assertIn(f"first_contact_DIR:PATH={prefix.resolve()}", headers)
            ok(["cmake", "--build", build])
            self.assertNotIn(str(ROOT), (prefix / "lib/cmake/first_contact/first_contact.cmake").read_text())
            printed = ok([build / "consumer", ROOT / "chapters/ch05_resting_contact/scenes/stack.yaml"])
        heights = [float(line.split()[2]) for line in printed.splitlines()]
        self.assertGreater(len(heights), 2)
        self.assertEqual(heights[1:], sorted(heights[1:]))  # the stack stands

    def test_another_version_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            prefix, wants = Path(folder) / "prefix", Path(folder) / "wants"
            ok(["cmake", "--install", BUILD, "--prefix", prefix])
            wants.mkdir()
            (wants / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.22)\nproject(w LANGUAGES CXX)\nfind_package(first_contact 9.0 REQUIRED)\n")
            done = subprocess.run(["cmake", "-S", wants, "-B", wants / "build", f"-DCMAKE_PREFIX_PATH={prefix}"],
                                  capture_output=True, text=True, check=False)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn("version: 0.1", done.stderr)


if __name__ == "__main__":
    os.environ.pop("CMAKE_CXX_COMPILER_LAUNCHER", None)
    unittest.main()
