"""Opens recorded runs in headless Chromium, as a double click does, and looks at what the page shows.

Usage: browser_test.py BIN_DIR; BIN_DIR has the chapters' executables. Where no Chromium runs it says "skipped" and ends
with 77, unless FC_BROWSER_REQUIRED=1 is set.
"""

import base64
import io
import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import matplotlib.image
import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))
from algorithm_checks import check_steps  # noqa: E402
from devtools import NoBrowser, Page  # noqa: E402
from fake_server import account  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
BIN = ROOT / "build/bin"

# A ball of 2 kg flies at 2 m/s along a line of three; the gap is 1 m, so the first impact is at 0.5 s.
BALLS = """
name: three <balls> & one
step: {dt: 0.05, duration: 1.5}
restitution: 1
shapes: {ball: {sphere: {radius: 0.5}, mass: 2}, block: {box: {size: [1, 1, 1]}, mass: 2}}
bodies:
  - {shape: ball, position: [-2, 0, 0], velocity: [2, 0, 0]}
  - {shape: block}
"""
CROWD = """
name: crowd
step: {dt: 0.016666666666666666, duration: 0.5}
shapes: {ball: {sphere: {radius: 0.3}, mass: 1}}
bodies: [{shape: ball, grid: {count: [10, 10, 10], spacing: [1, 1, 1]}, velocity: [1, 0, 0], spin: [0, 0, 3]}]
"""
# A ball falls on a floor of 80 m that lies 100 m up, bounces, and lies; three others lie beside it from the start, and one, far
# from them, is shot away.
REST = """
name: rest
step: {dt: 0.016666666666666666, duration: 2}
gravity: [0, 0, -9.81]
restitution: 0.4
envelope: 5.0e-4
shapes: {ball: {sphere: {radius: 0.5}, mass: 1}, floor: {box: {size: [80, 80, 1]}}}
bodies:
  - {shape: ball, position: [0, 0, 101.5]}
  - {shape: ball, grid: {count: [3, 1, 1], spacing: [1.5, 1.5, 1.5]}, position: [2, 0, 100.5]}
  - {shape: ball, position: [10, 0, 101.5], velocity: [0, 200, 30]}
  - {shape: floor, static: true, position: [0, 0, 99.5]}
"""
# A wall stands between the ball and where the page looks from first.
HIDDEN = """
name: hidden
step: {dt: 0.05, duration: 0.5}
shapes: {ball: {sphere: {radius: 0.5}, mass: 1}, wall: {box: {size: [4, 0.1, 4]}}}
bodies:
  - {shape: ball, velocity: [0.1, 0, 0]}
  - {shape: wall, static: true, position: [0.78, -1, 0.46]}
"""


def run(chapter: str, scene: Path, out: Path, *options: str) -> Path:
    subprocess.run([BIN / chapter, scene, "--out", out, "--quiet", *options], check=True)
    return out / "motion.html"


def pixels(page: Page) -> np.ndarray:
    """The scene's part of the screen, n by m by 3, 0 to 255."""
    image = matplotlib.image.imread(io.BytesIO(page.picture()), format="png")[:, :, :3] * 255
    height = page.js("document.getElementById('stage').clientHeight")
    return image[140:height, :1000]  # without the panel and the axes


def count(image: np.ndarray, colour: str) -> int:
    """How many pixels are of a colour's kind."""
    red, green, blue = image[..., 0], image[..., 1], image[..., 2]
    kinds = {"arrow": (red > 170) & (green < 110) & (blue < 110) & (red > 1.8 * green),
             "blue": (blue > 90) & (blue > 1.35 * red) & (blue > 1.1 * green),
             "orange": (red > 120) & (green > 0.5 * red) & (blue < 0.45 * red)}
    return int(kinds[colour].sum())


class BrowserTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        (cls.folder / "balls.yaml").write_text(BALLS)
        (cls.folder / "crowd.yaml").write_text(CROWD)
        (cls.folder / "rest.yaml").write_text(REST)
        cls.rest = run("ch05_resting_contact", cls.folder / "rest.yaml", cls.folder / "rest")
        cls.balls = run("ch04_multibody_stepping", cls.folder / "balls.yaml", cls.folder / "balls")
        cls.page = Page(seconds=900)

    @classmethod
    def tearDownClass(cls):
        cls.page.close()
        cls.temporary.cleanup()

    def broken(self, old: str, new: str, page: Path | None = None) -> Path:
        """A copy of the page with a mistake planted."""
        text = (page or self.balls).read_text(encoding="utf-8")
        self.assertIn(old, text)
        file = self.folder / "broken.html"
        file.write_text(text.replace(old, new), encoding="utf-8")
        return file

    def assert_quiet(self, page_file: Path) -> None:
        """The page asked for itself alone, and complained of nothing."""
        outside = [url for url in self.page.requests if not url.startswith("data:")]
        self.assertEqual(outside, [page_file.resolve().as_uri() + url_tail for url_tail in self.queries])
        self.assertEqual(self.page.complaints, [])

    def open(self, file: Path, query: str = "?t=0") -> dict:
        self.queries = [query]
        return self.page.open(file, query)

    def state(self) -> dict:
        self.page.settle()
        return self.page.js("viewer.state()")

    def test_shows_the_bodies_and_arrows_only_from_the_impact_on(self):
        ready = self.open(self.balls)
        self.assertEqual((ready["bodies"], ready["frames"], ready["impacts"]), (2, 31, 1))
        self.assertAlmostEqual(ready["duration"], 1.5, places=6)
        self.assertEqual(self.page.js("document.title"), "three <balls> & one")
        self.assertEqual(self.page.js("document.querySelector('h1').textContent"), "three <balls> & one")
        for t, arrows in ((0, 0), (0.49, 0), (0.51, 1), (0.75, 1), (0.9, 0)):
            self.page.js(f"viewer.seek({t})")
            image = pixels(self.page)
            self.assertGreater(count(image, "blue"), 1000, f"no ball at {t} s")
            self.assertGreater(count(image, "orange"), 1000, f"no block at {t} s")
            self.assertEqual(self.state()["contacts"], arrows)
            if arrows:
                self.assertGreater(count(image, "arrow"), 150, f"no arrow at {t} s")
            else:
                self.assertEqual(count(image, "arrow"), 0, f"an arrow at {t} s")
        self.assert_quiet(self.balls)

    def test_moves_the_bodies_as_they_flew(self):
        self.open(self.balls)
        for t, ball, block in ((0, -2, 0), (0.25, -1.5, 0), (0.5, -1, 0), (0.512, -1, 0.024), (1, -1, 1)):
            self.page.js(f"viewer.seek({t})")
            x = self.state()["positions"]
            self.assertAlmostEqual(x[0][0], ball, delta=2e-6)
            self.assertAlmostEqual(x[1][0], block, delta=2e-6)

    def test_steps_plays_and_jumps(self):
        self.open(self.balls)
        for key, time in (("ArrowRight", 0.05), ("ArrowRight", 0.1), ("ArrowLeft", 0.05), ("n", 0.5), ("ArrowRight", 0.55),
                          ("ArrowUp", 0.5), ("ArrowLeft", 0.45), ("p", 0.45)):
            self.page.press(key)
            self.assertAlmostEqual(self.state()["time"], time, delta=1e-5, msg=key)
        for button, time in (("next", 0.5), ("ahead", 0.55), ("back", 0.5), ("previous", 0.5)):
            self.page.js(f"document.getElementById('{button}').click()")
            self.assertAlmostEqual(self.state()["time"], time, delta=1e-5, msg=button)
        self.page.press(",")
        self.assertEqual(self.state()["speed"], 0.5)
        self.page.press(" ")
        self.assertTrue(self.state()["playing"])
        self.page.js("new Promise(done => setTimeout(done, 600))")
        self.page.press(" ")
        state = self.state()
        self.assertFalse(state["playing"])
        self.assertGreater(state["time"], 0.5)
        self.assertLess(state["time"], 0.5 + 0.5 * 2)
        self.page.js("viewer.seek(1.5); viewer.play(true)")
        self.assertLess(self.state()["time"], 1.4, "at the end, play begins anew")
        box = self.page.js("(({left, top, width}) => ({left, top, width}))(document.getElementById('strips').getBoundingClientRect())")
        for kind in ("mousePressed", "mouseReleased"):  # a third of the way along the time line
            self.page.call("Input.dispatchMouseEvent", type=kind, x=box["left"] + 66 + (box["width"] - 82) / 3,
                           y=box["top"] + 60, button="left", buttons=1, clickCount=1)
        self.assertAlmostEqual(self.state()["time"], 0.5, delta=0.002)
        self.assertFalse(self.state()["playing"])
        self.assert_quiet(self.balls)

    def test_wireframe_see_through_and_no_contacts(self):
        self.open(self.balls, "?t=0.52")
        solid = pixels(self.page)
        self.page.press("w")
        self.assertTrue(self.state()["wire"])
        self.assertLess(count(pixels(self.page), "orange"), 0.3 * count(solid, "orange"))
        self.page.press("w")
        self.page.press("x")
        self.assertGreater(np.abs(pixels(self.page) - solid).mean(), 1)
        self.page.press("x")
        self.assertGreater(count(solid, "arrow"), 0)
        self.page.press("c")
        self.assertEqual(count(pixels(self.page), "arrow"), 0)

    def test_turning_the_view_and_going_back(self):
        self.open(self.balls)
        first = pixels(self.page)
        for kind, x in (("mousePressed", 500), ("mouseMoved", 620), ("mouseReleased", 620)):
            self.page.call("Input.dispatchMouseEvent", type=kind, x=x, y=300, button="left", buttons=1, clickCount=1)
        self.assertGreater(np.abs(pixels(self.page) - first).mean(), 0.5)
        self.page.press("r")
        self.assertEqual(np.abs(pixels(self.page) - first).max(), 0)

    def told(self) -> tuple[str, str]:
        """The count of contacts in the box, and in the strip."""
        self.page.settle()
        return tuple(self.page.js("""(() => {
          const box = [...document.querySelectorAll('#info tr')].find(row => row.cells[0].textContent === 'contacts').cells[1].textContent;
          const written = [], plain = CanvasRenderingContext2D.prototype.fillText;
          CanvasRenderingContext2D.prototype.fillText = function (text) { written.push(text); };
          drawStrips();
          CanvasRenderingContext2D.prototype.fillText = plain;
          return [box, written.find(text => text.startsWith('contacts in the frame')).split(': ')[1].trim()];
        })()"""))

    def counts(self, file: Path) -> list[tuple[str, str]]:
        self.open(file)
        found = []
        for time in (0, 0.4, 0.47, 0.4833, 1.5):
            self.page.js(f"viewer.seek({time})")
            found.append(self.told())
        return found

    def test_tells_one_count_of_contacts(self):
        for box, strip in self.counts(self.rest):
            self.assertEqual(box, strip)
        self.assertEqual(self.told(), ("4", "4"), "four balls lie")
        broken = self.broken("short(contactsNow())", "String(motion.contacts.filter(c => c.scale > 0).length)", self.rest)
        self.assertTrue(any(box != strip for box, strip in self.counts(broken)))

    def times_of_impacts(self, file: Path) -> list[float]:
        self.open(file)
        times = []
        for _ in range(40):
            self.page.press("n")
            times.append(self.state()["time"])
        return sorted(set(times))

    def test_jumps_to_impacts_and_not_to_what_lies(self):
        with (self.rest.parent / "contacts.csv").open() as stream:
            rows = [line.strip().split(",") for line in stream][1:]
        impacts = sorted({float(row[0]) for row in rows if row[-1] == "impact"})
        self.assertGreater(len([row for row in rows if row[-1] == "rest"]), 300)
        self.assertTrue(2 < len(impacts) < 40)
        np.testing.assert_allclose(self.times_of_impacts(self.rest), impacts, atol=2e-6)
        frames = self.broken("toImpact(1), n: () => toImpact(1)", "stepFrames(1), n: () => stepFrames(1)", self.rest)
        self.assertGreater(len(self.times_of_impacts(frames)), len(impacts))

    def test_potential_counts_from_the_lowest(self):
        self.open(self.rest, "?t=2")
        curves = self.page.js("Object.fromEntries(motion.series.map(s => [s.name, [...s.values]]))")
        self.assertAlmostEqual(min(curves["potential"]), 0, places=6)
        self.assertLess(curves["total"][0], 25_000)  # of the one that is shot away; 4,900 J of all others' places are gone
        lying = self.broken("v => v - lowest", "v => v", self.rest)
        self.open(lying, "?t=2")
        self.assertGreater(self.page.js("Math.min(...motion.series.find(s => s.name === 'potential').values)"), 3000)

    def view_of(self, file: Path) -> dict:
        self.open(file)
        return self.state()["view"]

    def test_looks_at_the_many_and_not_at_one_that_runs_away(self):
        view = self.view_of(self.rest)
        self.assertLess(view["distance"], 30)
        np.testing.assert_allclose(view["target"], (2.5, 0, 100.75), atol=2.5)
        spoiled = self.view_of(self.broken("moving.length < 3 ? Infinity", "moving.length < 3000 ? Infinity", self.rest))
        self.assertGreater(spoiled["distance"], 100)

    def test_what_hides_the_bodies_is_seen_through(self):
        (self.folder / "hidden.yaml").write_text(HIDDEN)
        page = run("ch04_multibody_stepping", self.folder / "hidden.yaml", self.folder / "hidden")
        self.open(page)
        self.assertGreater(count(pixels(self.page), "blue"), 1000)
        self.open(self.broken("item.veiled = hides(item, eye)", "item.veiled = false", page))
        self.assertEqual(count(pixels(self.page), "blue"), 0)

    def time_after_an_old_clock(self, file: Path) -> float:
        """A picture's clock may be of before the page was ready."""
        self.open(file)
        self.page.js("viewer.play(true); draw(performance.now() - 5000)")
        return self.page.js("now.time")

    def test_time_never_runs_backwards(self):
        self.assertGreaterEqual(self.time_after_an_old_clock(self.balls), 0)
        self.assertLess(self.time_after_an_old_clock(self.broken("Math.max(0, Math.min(0.1, ", "(Math.min(0.1, ")), 0)

    def test_levels_of_the_hierarchy(self):
        bunny = Path("/usr/share/glmark2/models/bunny.obj")
        if not bunny.exists():
            self.skipTest("no bunny.obj: install glmark2-data")
        page = run("ch02_hull_hierarchy", ROOT / "chapters/ch02_hull_hierarchy/scenes/two_bunnies.yaml", self.folder / "ch02")
        ready = self.open(page, "?t=0")
        self.assertEqual(ready["triangles"], 2 * 69666)
        self.assertFalse(self.page.js("document.getElementById('levels').hidden"))
        plain = pixels(self.page)
        self.page.press("h")
        self.assertEqual(self.state()["level"], 0)
        self.assertGreater(np.abs(pixels(self.page) - plain).mean(), 1)
        self.assertEqual(self.page.complaints, [])
        print(f"two bunnies: {self.page.js('viewer.cost(20)'):.1f} ms a picture, software drawing included")

    def with_algorithm(self, documents: list) -> Path:
        """The recording of the two balls, with documents of the algorithm in its glTF's extras."""
        text = self.balls.read_text(encoding="utf-8")
        start = text.index('recording = "') + len('recording = "')
        end = text.index('"', start)
        data = base64.b64decode(text[start:end])
        length = struct.unpack_from("<I", data, 12)[0]
        content = json.loads(data[20:20 + length])
        content["extras"] = {"algorithm": documents}
        part = json.dumps(content).encode()
        part += b" " * (-len(part) % 4)
        rest = data[20 + length:]
        data = struct.pack("<4sII", b"glTF", 2, 20 + len(part) + len(rest)) + struct.pack("<I4s", len(part), b"JSON") + part + rest
        file = self.folder / "algorithm.html"
        file.write_text(text[:start] + base64.b64encode(data).decode() + text[end:], encoding="utf-8")
        return file

    def test_the_algorithm_step_by_step(self):
        late = {**account(1.0, 1.05, 21), "parts": [{"chapter": 4, "title": "the clocks", "steps": [{"text": "Nothing moves."}]}]}
        file = self.with_algorithm([account(0.45, 0.5, 10), late])
        self.open(file, "?t=0.1")
        self.assertEqual(self.page.js("document.getElementById('algorithm').offsetParent !== null"), True)
        self.page.press("a")
        self.assertAlmostEqual(self.state()["time"], 0.45, places=6)

        def picture():
            image = matplotlib.image.imread(io.BytesIO(self.page.picture()), format="png")[:, :, :3] * 255
            size = self.page.js("[document.getElementById('stage').clientWidth, document.getElementById('stage').clientHeight]")
            return image[:size[1], :size[0]]

        check_steps(self, self.page, picture, (-1.1, 0, 0))
        self.assert_quiet(file)
        # Of several documents one is chosen; to go elsewhere in time leaves it.
        self.page.press("a")
        self.page.js("(e => { e.value = 1; e.onchange({ target: e }); })(document.getElementById('documents'))")
        self.assertAlmostEqual(self.state()["time"], 1.0, places=6)
        self.assertEqual(self.page.js("viewer.algorithm().text"), "Nothing moves.")
        self.page.press("ArrowRight")
        self.assertAlmostEqual(self.state()["time"], 1.05, places=6)
        self.assertFalse(self.page.js("viewer.algorithm().open"))
        self.page.press("a")  # the nearest
        self.assertEqual(self.page.js("viewer.algorithm().chosen"), 1)
        self.assert_quiet(file)

    def test_a_recording_without_the_algorithm(self):
        plain = run("ch04_multibody_stepping", self.folder / "balls.yaml", self.folder / "plain", "--algorithm", "none")
        self.open(plain)
        self.page.press("a")
        self.page.settle()
        self.assertFalse(self.page.js("viewer.algorithm().open"))
        self.assertEqual(self.page.js("[document.getElementById('algorithm').hidden, document.getElementById('algorithmKeys').hidden, document.getElementById('levelKeys').hidden]"), [True] * 3)
        self.assert_quiet(plain)

    def test_a_thousand_bodies(self):
        page = run("ch04_multibody_stepping", self.folder / "crowd.yaml", self.folder / "crowd")
        self.assertEqual(self.open(page)["bodies"], 1000)
        self.assertEqual(self.page.complaints, [])
        print(f"1,000 bodies: {self.page.js('viewer.cost(20)'):.1f} ms a picture, software drawing included")

    def test_a_damaged_recording_is_told(self):
        text = self.balls.read_text(encoding="utf-8")
        start = text.index('recording = "') + len('recording = "')
        for damaged, message in ((text[:start + 400] + text[start + 440:], "cut off"), (text[:start] + "AAAA" + text[start + 4:], "not a binary")):
            file = self.folder / "damaged.html"
            file.write_text(damaged, encoding="utf-8")
            self.assertIn(message, self.open(file)["error"])
            self.assertEqual(self.page.js("document.getElementById('message').style.display"), "block")

    # Each check sees the mistake that it is there for.

    def test_sees_a_request(self):
        file = self.broken("<style>", '<link rel="stylesheet" href="https://example.org/a.css"><style>')
        self.open(file)
        with self.assertRaises(AssertionError):
            self.assert_quiet(file)

    def test_sees_an_error(self):
        file = self.broken("\nmain();", "\nmain();\nconsole.error('planted');\nnowhere();")
        self.open(file)
        self.page.settle()
        self.assertEqual(len(self.page.complaints), 2)

    def test_sees_arrows_that_are_always_or_never_there(self):
        never = self.broken("if (!now.arrows) return;", "return;")
        self.open(never, "?t=0.52")
        self.assertEqual(count(pixels(self.page), "arrow"), 0)
        always = self.broken("if (scale) item.scale = scale.values[3 * k];", "if (scale) item.scale = 0.4;")
        self.open(always, "?t=0")
        self.assertGreater(count(pixels(self.page), "arrow"), 0)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        BIN = Path(sys.argv.pop(1))
    try:
        Page(seconds=120).close()
    except NoBrowser as reason:
        print(f"skipped: {reason}")
        sys.exit(1 if os.environ.get("FC_BROWSER_REQUIRED") == "1" else 77)
    unittest.main()
