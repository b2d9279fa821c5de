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
import crowds  # noqa: E402
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

    def drawn(self, script: str) -> str:
        """The SVG of one drawing."""
        picture = self.folder / "picture.svg"
        done = plot_here(script, self.run_dir, "--out", picture)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return picture.read_text(encoding="utf-8")

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

    def test_drawings_from_formulas_need_no_run(self):
        self.run_dir.mkdir()
        names = ("margin", "push", "bend", "turning_plane", "unproved", "cut", "impact", "shortened", "free_flight")
        pictures = []
        for folder in ("first", "second"):
            done = plot_here("ch05_drawings", self.run_dir, "--out", self.folder / folder, "--only", *names)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            pictures.append([(self.folder / folder / f"{name}.svg").read_bytes() for name in names])
        self.assertEqual(*pictures)
        self.assert_fails("bounces/contacts.csv: no such file", "ch05_drawings", self.run_dir, "--only", "zeno")
        self.assert_fails("nowhere: no such folder", "ch05_drawings", self.folder / "nowhere")

    def test_bouncing_ball(self):
        synthetic.bouncing_ball(self.run_dir)
        svg = self.assert_draws("energy")
        for text in ("energy [J]", "time [s]", "potential", "total", "impact"):
            self.assertIn(text, svg)
        svg = self.assert_draws("contacts")
        for text in ("impulse [N s]", "gap [m]", "tolerance, 1e-06 m", "1/30 s", "before", "after"):
            self.assertIn(text, svg)

    def panels(self, script: str) -> dict[str, plt.Axes]:
        """The panels of a drawing, by their titles."""
        with mock.patch.object(plt, "close"):
            figure = runpy.run_path(str(PLOTS / f"{script}.py"))["draw"](self.run_dir)
        self.addCleanup(plt.close, figure)
        figure.canvas.draw()
        return {axes.get_title("left"): axes for axes in figure.axes}

    def curve(self, axes: plt.Axes, label: str) -> np.ndarray:
        return next(line.get_ydata() for line in axes.lines if line.get_label() == label)

    def test_a_heap_is_drawn_in_bands(self):
        for kinds in (True, False):
            synthetic.heap(self.run_dir, kinds=kinds)
            svg = self.drawn("contacts")
            self.assertLess(len(svg), 300_000)
            for text in ("5–95 %", "median", "largest", "envelope h, 0.0005 m", "h/2, 0.00025 m", "tolerance, 1e-06 m"):
                self.assertIn(text, svg)
            self.assertEqual("at rest" in svg, kinds)
        impulses = next(axes for title, axes in self.panels("contacts").items() if title.startswith("Impulse"))
        self.assertIn("(300 less than a millionth of the largest are left out)", impulses.get_title("left"))
        self.assertGreater(impulses.get_ylim()[0], 1e-4, "round-off stretches the axis")

    def test_bands_are_quantiles(self):
        bins = crowds.Bins.between(np.array([0.0, 1, 2, 3]))
        x, values = np.repeat([0.5, 2.0], 101), np.concatenate([np.arange(101), 7 + np.arange(101)])
        for share, expected in ((0, (0, np.nan, 7)), (0.05, (5, np.nan, 12)), (0.5, (50, np.nan, 57)), (1, (100, np.nan, 107))):
            np.testing.assert_array_equal(crowds.quantiles(bins, x, values, (share,))[0], expected)
        many = crowds.Bins.between(np.arange(10_001.0))
        self.assertLessEqual(len(many.ends), crowds.MOST_BINS)
        self.assertEqual(many.reduced(np.arange(10_001.0), np.maximum)[-1], 10_000)
        x, y = crowds.thinned(np.arange(100_000.0), np.where(np.arange(100_000) == 54_321, 9.0, 0.0))
        self.assertLess(len(x), 3 * crowds.MOST_POINTS)
        self.assertEqual((y.max(), x[-1]), (9.0, 99_999.0), "a peak is lost")

    def test_energy_of_what_rests(self):
        synthetic.heap(self.run_dir)
        svg = self.drawn("energy")
        for text in ("impact (3 instants)", "added by corrections", "momentum is not drawn: gravity and fixed bodies change it"):
            self.assertIn(text, svg)
        panels = self.panels("energy")
        energy, small = panels["Energy; zero is the lowest potential, 1000 J"], panels["The small ones among them"]
        np.testing.assert_allclose(self.curve(energy, "potential")[[0, -1]], (0, 5), atol=1e-9)
        self.assertLess(energy.get_ylim()[1], 6)
        np.testing.assert_allclose(self.curve(energy, "added by corrections")[-1], 5)
        self.assertLess(small.get_ylim()[1], 0.02, "kinetic energy is flat")
        self.assertEqual(len(panels), 2)

    def test_many_impacts_are_counted_not_lined_up(self):
        synthetic.heap(self.run_dir, kinds=False)
        self.assertIn("impacts (303 instants): how many", self.drawn("energy"))
        energy = next(iter(self.panels("energy").values()))
        self.assertLess(len(energy.lines), 10)

    def test_momentum_with_fixed_bodies(self):
        synthetic.passing_by(self.run_dir)
        self.assertIn("relative change since the start", self.drawn("energy"))
        synthetic.motion(self.run_dir / "motion.glb", fixed=True)
        svg = self.drawn("energy")
        self.assertNotIn("relative change since the start", svg)
        self.assertIn("momentum is not drawn: fixed bodies change it", svg)
        (self.run_dir / "motion.glb").write_bytes(b"glTF")
        self.assert_fails("not a recorded motion", "energy", self.run_dir)

    def test_a_sweep_is_no_run(self):
        for name in ("dt=1", "dt=2"):
            synthetic.passing_by(self.run_dir / name)
            (self.run_dir / name / "summary.json").write_text("{}")
        (self.run_dir / "sweep.csv").write_text("dt\n1\n2\n")
        for script in ("energy", "contacts", "bunnies"):
            self.assert_fails("a sweep; give one of its runs: dt=1, dt=2", script, self.run_dir)

    def sweep_of(self, folder: str, rows: str, header: str = "ccd.tolerance [m],error [m],step_ns,kind,exit_code") -> Path:
        (self.folder / folder).mkdir()
        (self.folder / folder / "sweep.csv").write_text(f"{header}\n{rows}", encoding="utf-8")
        return self.folder / folder

    def test_parts_of_a_sweep_are_one(self):
        one = self.sweep_of("one", "1e-2,0.1,5e6,a,0\n1e-6,1e-5,7e6,b,0\n")
        two = self.sweep_of("two", "1e-4,0.001,6e6,c,3\n1e-2,0.1,9e6,a,0\n")
        done = plot_here("sweep", two, one, "--y", "error", "--y", "step_ns")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        svg = (two / "sweep.svg").read_text(encoding="utf-8")
        for text in ("ccd.tolerance [m]", "error [m]", "step [ms]", "failed (exit code)"):
            self.assertIn(text, svg)
        self.assertTrue((two / "sweep.png").exists())
        error, time = runpy.run_path(str(PLOTS / "sweep.py"))["draw"]([two, one], None, ["error", "step_ns"]).axes
        np.testing.assert_array_equal(error.lines[0].get_xydata(), [(1e-6, 1e-5), (1e-4, 0.001), (1e-2, 0.1)])
        np.testing.assert_array_equal(time.lines[0].get_ydata(), (7, 6, 9))
        self.assertEqual((error.get_xscale(), error.get_yscale(), time.get_yscale()), ("log", "log", "linear"))
        plt.close("all")
        self.assertEqual(plot_here("sweep", one, two, "--x", "error", "--y", "step_ns").returncode, 0)
        self.assertEqual(plot_here("sweep", self.sweep_of("words", "[1,2],1,1,a,0\n[3,4],2,1,a,0\n".replace("[1,2]", '"[1,2]"').replace("[3,4]", '"[3,4]"')),
                                   "--y", "error").returncode, 0)

    def test_what_is_no_sweep(self):
        one = self.sweep_of("one", "1e-2,0.1,5e6,a,0\n")
        other = self.sweep_of("other", "1e-2,0.2,5e6,a,0\n")
        third = self.sweep_of("third", "1,0.2\n", "step.dt [s],error [m]")
        twice = self.sweep_of("twice", "1,2\n", "envelope [m],envelope [m]")
        self.assert_fails("ccd.tolerance = 1e-2 is there twice, with two values of 'error': 0.1 and 0.2", "sweep", one, other)
        self.assert_fails("sweeps 'step.dt', not 'ccd.tolerance'", "sweep", one, third)
        self.assert_fails("two columns are called 'envelope'", "sweep", twice)
        self.assert_fails("no column 'eror'; the sweep has: ccd.tolerance, error", "sweep", one, "--y", "eror")
        self.assert_fails("has no numbers: a", "sweep", one, "--y", "kind")
        self.assert_fails("no usual column changes", "sweep", one)
        synthetic.bouncing_ball(self.run_dir)
        self.assert_fails("a run, not a sweep", "sweep", self.run_dir)
        self.assert_fails("no such file", "sweep", self.folder)

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
        red, blue = np.array([1.0, 0, 0]), np.array([0, 0, 1.0])
        for order in ([0, 1], [1, 0]):
            image, depth = bunnies.rasterize(np.stack([far, near])[order], np.stack([red, blue])[order], 20, 20)
            self.assertEqual((image[2, 2].tolist(), round(depth[2, 2], 6)), ([0, 0, 1], 1))
            self.assertEqual((image[2, 15].tolist(), round(depth[2, 15], 6)), ([1, 0, 0], 0))
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
        for content, message in {"": "empty", "t [s]\n": "no rows", "t [s],energy [J]\n0,1\n": "no column 'potential'",
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
