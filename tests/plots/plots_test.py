"""Runs the plot scripts on closed-form runs: what they write, that they write it the same twice, how they fail."""

import contextlib
import io
import os
import re
import runpy
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import synthetic

PLOTS = Path(__file__).resolve().parents[2] / "plots"
sys.path.insert(0, str(PLOTS))
sys.dont_write_bytecode = True
import bunnies  # noqa: E402
from style import Table, plt  # noqa: E402


def plot(script: str, *arguments: object, **environment: str) -> subprocess.CompletedProcess:
    """Runs a script as a user does."""
    command = [sys.executable, "-B", PLOTS / f"{script}.py", *arguments]
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False,
                          env={**os.environ, **environment})


def plot_here(script: str, *arguments: object) -> subprocess.CompletedProcess:
    """The same in this process: sooner done."""
    argv, code, out, err = [f"{script}.py", *map(str, arguments)], 0, io.StringIO(), io.StringIO()
    with mock.patch("sys.argv", argv), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            runpy.run_path(str(PLOTS / argv[0]), run_name="__main__")
        except SystemExit as done:
            code = done.code
    plt.close("all")
    return subprocess.CompletedProcess(argv, code, out.getvalue(), err.getvalue())


class PlotTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.run_dir = self.folder / "run"

    def assert_draws(self, script: str, *options: object) -> str:
        """Draws twice; both pictures are there and the SVG has the same bytes. Returns the SVG."""
        results = []
        for run in (plot_here, plot):
            done = run(script, self.run_dir, *options)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            results.append((self.run_dir / f"{script}.svg").read_bytes())
        self.assertEqual(results[0], results[1], "two runs drew different SVGs")
        self.assertTrue((self.run_dir / f"{script}.png").read_bytes().startswith(b"\x89PNG"))
        self.assertIn(str(self.run_dir / f"{script}.png"), done.stdout)
        self.assertNotIn(b"<dc:date>", results[0])
        return results[0].decode()

    def assert_fails(self, message: str, script: str, *arguments: object) -> None:
        done = plot_here(script, *arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn(message, done.stderr)

    def python_without(self, module: str, message: str) -> dict[str, str]:
        """An environment in which Python's import of a module fails."""
        folder = self.folder / f"without_{module}"
        folder.mkdir()
        (folder / f"{module}.py").write_text(f"raise ImportError({message!r})\n")
        return {"PYTHONPATH": str(folder)}

    def test_a_python_that_cannot_draw_gives_way(self):
        if subprocess.run(["/usr/bin/python3", "-E", "-s", "-c", "import matplotlib, numpy"], capture_output=True, check=False).returncode:
            self.skipTest("the distribution's Python has no matplotlib")
        synthetic.bouncing_ball(self.run_dir)
        for module in ("matplotlib", "numpy"):
            done = plot("energy", self.run_dir, "--out", self.folder / f"{module}.svg", **self.python_without(module, "none"))
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertTrue((self.folder / f"{module}.svg").exists())

    def test_no_python_that_can_draw_is_one_line(self):
        done = plot("energy", self.run_dir, FIRST_CONTACT_PYTHON_ASKED="/opt/own/python3 (none)",
                    **self.python_without("numpy", "made for another one\nand more of this"))
        self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (2, "", 1), done.stderr)
        for text in ("energy.py: no Python here can draw", "/opt/own/python3 (none)", "(made for another one)", "python3-matplotlib"):
            self.assertIn(text, done.stderr)

    def test_every_script_looks_for_a_python_first(self):
        for script in sorted(PLOTS.glob("*.py")):
            text = script.read_text(encoding="utf-8")
            imports = re.findall(r"^(?:import|from) (\w+)", text, re.M)
            if {"matplotlib", "numpy", "style"} & set(imports):
                self.assertEqual(imports[0], "drawing_python", script.name)

    def test_bouncing_ball(self):
        synthetic.bouncing_ball(self.run_dir)
        svg = self.assert_draws("energy")
        for text in ("energy [J]", "time [s]", "potential", "total", "impact"):
            self.assertIn(text, svg)
        svg = self.assert_draws("contacts")
        for text in ("impulse [N s]", "gap [m]", "tolerance, 1e-06 m", "1/30 s", "before", "after"):
            self.assertIn(text, svg)

    def test_run_without_contacts_says_so(self):
        synthetic.passing_by(self.run_dir)
        self.assertNotIn("potential", self.assert_draws("energy"))
        self.assertIn("no contact in this run", self.assert_draws("contacts"))

    def test_run_of_a_single_row(self):
        synthetic.bouncing_ball(self.run_dir, frames=0)
        self.assert_draws("energy")
        self.assert_draws("contacts")

    def test_one_solve(self):
        synthetic.one_solve(self.run_dir)
        self.assertIn("impulse [N s]", self.assert_draws("contacts"))

    def test_queries(self):
        synthetic.queries(self.run_dir)
        self.assertIn("vertex – edge", self.assert_draws("contacts"))

    def test_bunnies(self):
        synthetic.two_cubes(self.run_dir)
        mesh = self.folder / "cube.obj"
        synthetic.cube(mesh, (0, 0, 0))
        svg = self.assert_draws("bunnies", "--mesh", mesh)
        for text in ("t = 0.750 s", "first impact, 4 contacts", "the end"):
            self.assertIn(text, svg)
        self.assert_fails("no such mesh", "bunnies", self.run_dir, "--mesh", self.folder / "no.obj")
        (self.run_dir / "poses.csv").unlink()
        self.assert_fails("poses.csv: no such file", "bunnies", self.run_dir, "--mesh", mesh)

    def test_mesh_of_bunnies(self):
        mesh = self.folder / "cube.obj"
        synthetic.cube(mesh, (3, -4, 5))
        vertices, triangles = bunnies.load_obj(mesh)
        np.testing.assert_allclose(bunnies.center_of_mass(vertices, triangles), (3, -4, 5), atol=1e-12)
        normals = bunnies.vertex_normals(vertices, triangles)
        self.assertTrue((((vertices - (3, -4, 5)) * normals).sum(axis=1) > 0).all(), "a normal points inward")

    def test_poses_between_frames(self):
        """A quarter turn in half a second about a centre of mass that moves along x."""
        self.run_dir.mkdir()
        spin, center = np.pi, np.array([1.0, 0, 0])
        synthetic.write(self.run_dir / "poses.csv", synthetic.POSES,
                        [(t, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0, spin) for t in (0, 1)])
        position, turn, _ = bunnies.Poses(Table(self.run_dir / "poses.csv"), center).at(0.5)[0]
        np.testing.assert_allclose(turn, [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=1e-12)
        np.testing.assert_allclose(position + turn @ center, (2, 0, 0), atol=1e-12)

    def test_the_nearer_triangle_hides_the_other(self):
        far = np.array([[0, 0, 0], [20, 0, 0], [0, 20, 0]], float)
        near = far * (0.5, 0.5, 1) + (0, 0, 1)
        red, blue = np.array([[1, 0, 0]] * 3, float), np.array([[0, 0, 1]] * 3, float)
        for order in ([0, 1], [1, 0]):
            image, depth = bunnies.rasterize(np.stack([far, near])[order], np.stack([red, blue])[order], 20, 20)
            self.assertEqual((image[2, 2].tolist(), depth[2, 2]), ([0, 0, 1], 1))
            self.assertEqual((image[2, 15].tolist(), depth[2, 15]), ([1, 0, 0], 0))
            self.assertEqual((image[19, 19].tolist(), depth[19, 19]), ([1, 1, 1], -np.inf))

    def test_out(self):
        synthetic.bouncing_ball(self.run_dir)
        picture = self.folder / "somewhere.svg"
        self.assertEqual(plot_here("energy", self.run_dir, "--out", picture).returncode, 0)
        self.assertTrue(picture.exists())
        self.assertFalse((self.run_dir / "energy.svg").exists())
        self.assert_fails("unknown kind of picture", "energy", self.run_dir, "--out", self.folder / "picture.txt")
        self.assert_fails("cannot be written", "energy", self.run_dir, "--out", self.folder / "none" / "a.svg")

    def test_errors(self):
        for script in ("energy", "contacts"):
            self.assert_fails("no such folder", script, self.folder / "nothing")
        self.run_dir.mkdir()
        self.assert_fails("steps.csv: no such file", "energy", self.run_dir)
        self.assert_fails("none of steps.csv", "contacts", self.run_dir)
        steps = self.run_dir / "steps.csv"
        for content, message in {"": "empty", "t [s]\n": "no rows", "t [s],energy [J]\n0,1\n": "no column 'kinetic'",
                                 "t [s],kinetic [J]\n0\n": "steps.csv:2: 1 cells",
                                 "t [s]\nsoon\n": "column 't'"}.items():
            steps.write_text(content)
            self.assert_fails(message, "energy", self.run_dir)
        steps.write_bytes(b"\xff\xfe\x00")
        self.assert_fails("cannot be read", "energy", self.run_dir)
        synthetic.bouncing_ball(self.run_dir)
        (self.run_dir / "summary.json").write_text("{")
        self.assert_fails("summary.json", "contacts", self.run_dir)
        (self.run_dir / "summary.json").unlink()
        (self.run_dir / "contacts.csv").unlink()
        self.assert_fails("contacts.csv: no such file", "contacts", self.run_dir)


if __name__ == "__main__":
    unittest.main()
