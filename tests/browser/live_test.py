"""Opens the page of a live scene in headless Chromium, against a server of a scene that is made up (fake_server.py).

Usage: live_test.py PAGE; PAGE is the viewer as it is built into the programs, its parts joined. Where no Chromium runs it says
"skipped" and ends with 77, unless FC_BROWSER_REQUIRED=1 is set.
"""

import io
import os
import sys
import tempfile
import time
import unittest
from pathlib import Path

import matplotlib.image
import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))
from algorithm_checks import check_steps  # noqa: E402
from devtools import NoBrowser, Page  # noqa: E402
from fake_server import FakeServer, bunnies_scene, crowd_scene, table_scene  # noqa: E402

PAGE = Path("viewer.html")


def live_page() -> str:
    """As live_page() of common/motion_page.hpp makes it."""
    text = PAGE.read_text(encoding="utf-8")
    assert text.count("MOTION_TITLE") == text.count("MOTION_GLB_BASE64") == 1
    return text.replace("MOTION_TITLE", "a fake scene").replace("MOTION_GLB_BASE64", "")


class LiveTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text = live_page()
        cls.page = Page(seconds=900)

    @classmethod
    def tearDownClass(cls):
        cls.page.close()

    def open(self, scene=None, running=True, text=None):
        self.server = FakeServer(text or self.text, scene or table_scene(), running)
        self.addCleanup(self.server.close)
        self.addCleanup(self.page.call, "Page.navigate", url="about:blank")  # it does not watch the server's end
        ready = self.page.go(self.server.url)
        self.assertNotIn("error", ready)
        self.wait("viewer.live().connected && viewer.live().frame >= 0 && viewer.live().state !== null")
        return ready

    def wait(self, condition, seconds=20):
        """Until an expression of the page, or a function, is true."""
        end = time.monotonic() + seconds
        while not (condition() if callable(condition) else self.page.js(condition)):
            self.assertLess(time.monotonic(), end, f"{condition} did not come true; {self.page.complaints}")
            time.sleep(0.03)

    def live(self):
        return self.page.js("viewer.live()")

    def click(self, element):
        self.page.js(f"document.getElementById('{element}').click()")

    def done(self, kind):
        """The commands of a kind that have come."""
        return [c for c in list(self.server.commands) if c["do"] == kind]

    def pulled_to(self, x, y, copy=False):
        """Waits until the server pulls to what is drawn at this point of the page."""
        def away():
            seen = self.page.js(f"onScreen({[float(v) for v in self.server.scene.target]}, {str(copy).lower()})")
            return max(abs(seen["x"] - x), abs(seen["y"] - y))
        self.wait(lambda: away() < 1.5)

    def where(self, body):
        self.page.settle()
        at = self.page.js(f"viewer.onScreen({body})")
        return at["x"], at["y"]

    def picture(self):
        image = matplotlib.image.imread(io.BytesIO(self.page.picture()), format="png")[:, :, :3] * 255
        size = self.page.js("[document.getElementById('stage').clientWidth, document.getElementById('stage').clientHeight]")
        return image[:size[1], :size[0]]

    def shown(self, element):
        return self.page.js(f"(e => e.offsetParent !== null && !e.hidden ? e.textContent : '')(document.getElementById('{element}'))")

    def assert_quiet(self):
        """Nothing was asked of another address, and nothing complained of."""
        outside = [url for url in self.page.requests if not url.startswith(("data:", f"http://127.0.0.1:{self.server.port}/", "blob:"))]
        self.assertEqual(outside, [])
        self.assertEqual(self.page.complaints, [])

    def test_loads_and_moves(self):
        ready = self.open()
        self.assertEqual(ready["bodies"], 5)
        self.assertEqual(self.shown("info").split("a fake")[0], "boxes & <balls>")
        first = self.live()
        self.wait(f"viewer.live().frame > {first['frame'] + 20} && viewer.live().pictures > {first['pictures'] + 5}")
        # What is drawn lies between the last two frames, or is the last; it is never ahead, and never goes back.
        times = self.page.js("""(async () => { const seen = []; for (let k = 0; k < 30; ++k) {
            await new Promise(requestAnimationFrame); const l = viewer.live(); seen.push([l.shown, l.t, viewer.state().positions[0][0]]); } return seen; })()""")
        for (shown, newest, x), (later, _, _) in zip(times, times[1:]):
            self.assertLessEqual(shown, newest)
            self.assertLessEqual(shown, later)
            self.assertGreater(shown, newest - 0.5)
            self.assertAlmostEqual(x, -1.5 + 0.3 * np.sin(shown), delta=2e-4)
        self.assertGreater(times[-1][0], times[0][0])
        self.assertEqual(self.page.js("document.body.className"), "live")
        self.assertEqual([self.page.js(f"getComputedStyle(document.getElementById('{e}')).display") for e in ("strips", "previous", "next")], ["none"] * 3)
        self.assert_quiet()

    def test_runs_pauses_and_steps(self):
        self.open()
        self.page.press(" ")
        self.wait("!viewer.live().running")
        frame = self.live()["frame"]
        self.assertEqual(self.page.js("document.getElementById('play').textContent"), "run")
        self.page.press("ArrowRight")
        self.wait(f"viewer.live().frame === {frame + 1}")
        self.click("ahead")
        self.wait(f"viewer.live().frame === {frame + 2} && viewer.live().shown === viewer.live().t")
        time.sleep(0.2)
        self.assertEqual(self.live()["frame"], frame + 2)
        self.click("play")
        self.wait(f"viewer.live().running && viewer.live().frame > {frame + 5}")
        self.page.press(",")
        self.wait(lambda: self.done("speed") == [{"do": "speed", "value": 0.5}])
        self.wait("viewer.state().speed === 0.5")
        self.assertEqual([c["do"] for c in self.server.commands], ["pause", "step", "step", "run", "speed"])
        self.assert_quiet()

    def test_grabs_and_drags_with_the_pointer(self):
        self.open(running=False)
        x, y = self.where(0)
        camera = self.page.js("JSON.stringify(viewer.state().view)")
        self.page.mouse("Moved", x, y, "none")
        self.wait("viewer.live().hovered === 0")
        self.page.mouse("Pressed", x, y)
        self.wait("viewer.live().grabbed === 0")
        grab = self.done("grab")[0]
        pose = self.server.scene.places[0]
        self.assertEqual(grab["body"], 0)
        self.assertTrue(np.all(np.abs(np.array(grab["point"]) - pose[:3]) <= 0.5 + 1e-5), "a point of the box")
        self.assertAlmostEqual(np.abs(np.array(grab["point"]) - pose[:3]).max(), 0.5, places=5, msg="of its surface")
        for k in range(1, 11):
            self.page.mouse("Moved", x + 10 * k, y - 6 * k)
        self.wait(lambda: self.server.scene.grabbed == 0 and np.linalg.norm(self.server.scene.target - grab["point"]) > 0.3)
        self.wait("viewer.live().grabbed === 0")
        # The grabbed point is drawn below the pointer.
        self.pulled_to(x + 100, y - 60)
        target = [float(v) for v in self.server.scene.target]
        far = self.page.js(f"dot3(cameraAxes()[2], eyeOf().map((v, i) => v - {target}[i]))")
        self.page.mouse("Wheel", x + 100, y - 60, deltaX=0, deltaY=-300)
        self.wait(lambda: self.page.js(f"dot3(cameraAxes()[2], eyeOf().map((v, i) => v - {[float(v) for v in self.server.scene.target]}[i]))") > 1.2 * far)
        self.page.mouse("Released", x + 100, y - 60)
        self.wait(lambda: len(self.done("drop")) == 1)
        self.assertEqual(self.live()["grabbed"], -1)
        self.assertEqual(self.page.js("JSON.stringify(viewer.state().view)"), camera, "the view stays while a body is dragged")
        self.assertEqual(self.server.commands[-1]["do"], "drop")
        self.assert_quiet()

    def test_one_drag_is_on_its_way_at_a_time(self):
        self.open(running=False)
        x, y = self.where(0)
        self.page.mouse("Moved", x, y, "none")
        self.page.mouse("Pressed", x, y)
        self.wait("viewer.live().grabbed === 0")
        self.server.delay = 0.2
        for k in range(1, 41):
            self.page.mouse("Moved", x + 2 * k, y)
        self.page.mouse("Released", x + 80, y)
        self.wait(lambda: len(self.done("drop")) == 1)
        self.assertLess(len(self.done("drag")), 20)
        seen = self.page.js(f"onScreen({self.done('drag')[-1]['to']})")
        self.assertAlmostEqual(seen["x"], x + 80, delta=1.5, msg="the server gets the last place, even where places before it were left out")

    def test_the_background_and_what_is_static_turn_the_view(self):
        self.open(running=False)
        for button, body in (("left", 3), ("left", None), ("right", 0)):
            x, y = self.where(body) if body is not None else (600, 30)
            before = self.page.js("camera.yaw")
            self.page.mouse("Pressed", x, y, button)
            self.page.mouse("Moved", x + 40, y, button)
            self.page.mouse("Released", x + 40, y, button)
            self.assertNotAlmostEqual(self.page.js("camera.yaw"), before)
        self.assertEqual(self.done("grab"), [])
        self.page.js("viewer.grab(3)")
        self.wait(lambda: "static" in self.shown("toast"))
        self.assertEqual(self.live()["grabbed"], -1)

    def test_grabs_by_number_for_tests(self):
        self.open(running=False)
        self.assertTrue(self.page.js("viewer.grab(1).then(a => a.ok)"))
        self.page.js("viewer.drag([0, 0, 4])")
        self.wait("Math.abs(viewer.state().positions[1][2] - 4) < 1e-5")
        self.assertTrue(self.page.js("viewer.drop().then(a => a.ok)"))

    def test_throws_a_ball(self):
        self.open()
        geometry = self.live()["geometry"]
        x, y = self.where(4)
        self.page.mouse("Moved", x, y, "none")
        self.page.press("b")
        self.wait("viewer.live().bodies === 6")
        self.assertNotEqual(self.live()["geometry"], geometry)
        throw = self.done("throw")[0]
        start, way = np.array(throw["from"]), np.array(throw["velocity"])
        speed = float(np.linalg.norm(way))
        np.testing.assert_allclose(start, self.page.js("eyeOf()"), atol=1e-9)
        to_wall = np.array([4, 0, 1]) - start
        self.assertGreater(way @ to_wall / np.linalg.norm(way) / np.linalg.norm(to_wall), 0.999)
        self.page.js("(e => { e.value = +e.value + 0.3; e.oninput(); })(document.getElementById('force'))")
        self.click("throw")
        self.wait("viewer.live().bodies === 7")
        self.assertAlmostEqual(float(np.linalg.norm(self.done("throw")[1]["velocity"])) / speed, 10 ** 0.3, delta=0.1)
        for _ in range(30):
            self.click("throw")
        self.wait("viewer.live().bodies === 37")
        self.assert_quiet()

    def test_known_shapes_are_not_sent_to_the_graphics_card_again(self):
        self.open()
        self.page.js("window.uploads = 0; gl.bufferData = (plain => function (kind, data, use, ...more) {"
                     " if (use === gl.STATIC_DRAW) ++window.uploads; return plain.call(gl, kind, data, use, ...more); })(gl.bufferData)")
        self.click("throw")
        self.wait("viewer.live().bodies === 6")
        self.assertEqual(self.page.js("window.uploads"), 0)

    def knob(self, key):
        return f"document.getElementById('knob_{key}')"

    def test_turns_a_knob(self):
        self.open()
        row = self.page.js(f"{self.knob('ccd.tolerance')}.closest('.knob').textContent")
        for part in ("ccd.tolerance", "m", "Gap at which"):
            self.assertIn(part, row)
        self.page.js(f"(e => {{ e.focus(); e.value = '1e-4'; e.onchange(); e.blur(); }})({self.knob('ccd.tolerance')})")
        answer = f"{self.knob('ccd.tolerance')}.closest('.knob').querySelector('.answer')"
        self.wait(f"{answer}.textContent === 'rebuilt in 3.1 ms'")
        self.assertEqual(self.done("set"), [{"do": "set", "key": "ccd.tolerance", "value": "1e-4"}])
        slider = f"{self.knob('ccd.tolerance')}.closest('.knob').querySelector('input[type=range]')"
        self.wait(f"{slider}.value === '714'")  # log(1e-4 / 1e-9) / log(1e-2 / 1e-9) = 5/7
        self.page.js(f"(e => {{ e.value = 429; e.oninput(); }})({slider})")
        self.wait(lambda: self.done("set")[-1]["value"] == "0.000001" or float(self.done("set")[-1]["value"]) == 1e-6)
        # A refusal is one line, and the knob shows again what holds.
        self.page.js(f"(e => {{ e.value = '-3'; e.onchange(); }})({self.knob('ccd.tolerance')})")
        self.wait(f"{answer}.className === 'answer bad' && {answer}.textContent.includes('must be in')")
        self.wait(f"+{self.knob('ccd.tolerance')}.value === 1e-6")
        self.page.js(f"(e => {{ e.value = 'lemke'; e.onchange(); }})({self.knob('solver.method')})")
        self.wait(lambda: self.server.scene.values["solver.method"] == "lemke")
        self.page.js(f"(e => {{ e.value = '0.02'; e.onchange(); }})({self.knob('step.dt')})")
        self.wait(f"{self.knob('step.dt')}.closest('.knob').querySelector('.answer').textContent === 'scene restarted in 4 ms'")
        self.assertIn("restarts", self.page.js(f"{self.knob('step.dt')}.closest('.knob').textContent").lower())
        self.assertEqual([c for c in self.page.complaints if "400" not in c], [])

    def test_switches_an_effect(self):
        self.open()
        switch = "document.querySelector('.switch[aria-label=gravity]')"
        row = f"{switch}.closest('.effect')"
        for part in ("declared at line 4", "Adds: an acceleration", "0.12 ms"):
            self.assertIn(part, self.page.js(f"{row}.textContent"))
        self.page.js(f"{switch}.click()")
        self.wait(f"{switch}.getAttribute('aria-checked') === 'false'")
        self.wait(f"{row}.textContent.includes('rebuilt in 2.3 ms') || {row}.textContent.includes('rebuilt in 2.2 ms')")
        self.page.js(f"{switch}.click()")
        self.wait(f"{switch}.getAttribute('aria-checked') === 'true'")
        self.assertEqual([c["value"] for c in self.done("set")], ["none", "[0, 0, -9.81]"])
        friction = "document.querySelector('.switch[aria-label=friction]')"
        self.assertTrue(self.page.js(f"{friction}.disabled"))
        self.assertIn("not asked for by this scene", self.page.js(f"{friction}.closest('.effect').textContent"))

    def test_numbers_and_cost(self):
        self.open()
        rows = "Object.fromEntries([...document.getElementById('numbers').rows].map(r => [r.cells[0].textContent, r.cells[1].textContent + ' ' + r.cells[2].textContent]))"
        self.wait(f"{rows}['smallest gap'].endsWith('m')")
        numbers = self.page.js(rows)
        self.assertEqual(numbers["kinetic"], "2.5000 J")
        self.assertTrue(numbers["energy"].endswith(" J") and numbers["impacts"].startswith("-"))
        self.assertLess(abs(float(numbers["not accounted for"].split()[0])), 1e-9)
        self.assertEqual(self.page.js("[...document.querySelectorAll('#legend span span')].map(e => e.textContent)"), ["broad", "CCD", "contacts", "LCP", "corrections", "other"])
        self.assertEqual(self.page.js("getComputedStyle(document.querySelector('#legend > span:last-child i')).backgroundColor"), "rgb(170, 177, 192)", "neutral")
        cost = float(self.shown("costNow").split()[0])
        self.assertTrue(4 < cost < 9, cost)
        # The strip is as high as its samples say, in the stages' colours.
        drawn = self.page.js("""(() => { const c = document.getElementById('costs'), d = c.getContext('2d').getImageData(c.width - 4, 0, 1, c.height).data;
            let blue = 0, orange = 0; for (let k = 0; k < d.length; k += 4) { if (d[k + 2] > 180 && d[k] < 90) ++blue; if (d[k] > 200 && d[k + 2] < 60) ++orange; } return [blue, orange]; })()""")
        self.assertGreater(drawn[1], 2 * drawn[0])
        self.assertGreater(drawn[0], 0)

    def test_saves(self):
        self.open()
        with tempfile.TemporaryDirectory() as folder:
            self.page.call("Page.setDownloadBehavior", behavior="allow", downloadPath=folder)
            self.page.press("s")
            self.wait(lambda: list(Path(folder).glob("*.yaml")))
            file = next(Path(folder).glob("*.yaml"))
            self.wait(lambda: file.read_text() == "name: saved\n")
            self.assertTrue(file.name.startswith("boxes_balls_"), file.name)
        self.assert_quiet()

    def test_a_scene_that_fails_is_told_and_reset(self):
        self.open()
        self.server.fail("body 2 left the world <at once>")
        self.wait(lambda: "body 2 left the world <at once>" in self.shown("banner"))
        self.assertFalse(self.live()["running"])
        self.click("bannerButton")
        self.wait(lambda: self.shown("banner") == "" and self.done("reset"))
        self.wait("viewer.live().running && viewer.live().frame < 100")
        self.assert_quiet()

    def test_a_reset_begins_again_at_frame_0(self):
        self.open()
        self.wait("viewer.live().frame > 30")
        before = self.live()["frame"]
        self.page.press("0")
        self.wait(f"viewer.live().frame < {before} && viewer.live().shown <= viewer.live().t")
        self.wait("viewer.live().frame > 5 && viewer.live().shown > 0")

    def test_a_server_that_is_gone_for_a_moment(self):
        self.open()
        self.server.go()
        self.wait(lambda: "does not answer" in self.shown("banner"))
        self.assertFalse(self.live()["connected"])
        self.server.start()
        self.wait("viewer.live().connected")
        self.assertEqual(self.shown("banner"), "")
        frame = self.live()["frame"]
        self.wait(f"viewer.live().frame > {frame}")

    def test_a_server_that_is_gone_for_good(self):
        self.open(text=self.text.replace("const patience = 10000", "const patience = 600"))
        self.server.go()
        self.wait(lambda: "has ended" in self.shown("banner"))
        self.assertTrue(self.live()["ended"])
        self.server.start()
        self.click("bannerButton")
        self.wait("viewer.live().connected && !viewer.live().ended")
        self.assertEqual(self.shown("banner"), "")

    def test_stop_is_asked_twice(self):
        self.open()
        self.click("stop")
        self.page.settle()
        self.assertEqual(self.done("stop"), [])
        self.click("stop")
        self.wait(lambda: len(self.done("stop")) == 1)
        self.wait(lambda: "as you asked" in self.shown("banner"))
        self.assertTrue(self.live()["ended"])

    def test_a_wrong_key_is_told(self):
        self.open()
        self.server.go()
        self.server.key = "another"  # a program that was started anew
        self.server.start()
        self.wait(lambda: "key in this page's address" in self.shown("banner"))
        self.assertTrue(self.live()["ended"])

    def split(self, scene=None, running=True):
        self.open(scene, running)
        self.page.press("t")
        self.wait("viewer.twin().split && viewer.twin().frame >= 0")

    def test_two_copies_have_one_camera(self):
        self.split(running=False)
        self.assertEqual(self.done("twin"), [{"do": "twin", "on": True}])
        size = self.page.js("[document.getElementById('stage').clientWidth, document.getElementById('stage').clientHeight]")
        for body in (0, 1, 4):
            left, right = self.page.js(f"viewer.onScreen({body})"), self.page.js(f"viewer.onScreen({body}, true)")
            self.assertAlmostEqual(right["x"] - left["x"], size[0] / 2, delta=0.01)
            self.assertAlmostEqual(right["y"], left["y"], delta=0.01)
        # Both halves show the same, but for what is written over them, until the two part.
        def halves():
            self.page.js("document.getElementById('toast').hidden = true")
            image, half = self.picture(), size[0] // 2
            return image[130:size[1] - 60, 160:half - 4], image[130:size[1] - 60, 160 + half:2 * half - 4]
        one, other = halves()
        self.assertGreater(np.abs(one - one[0, 0]).max(axis=2).astype(bool).mean(), 0.05, "there is nothing")
        self.assertLess((np.abs(one - other).max(axis=2) > 30).mean(), 2e-3)
        self.page.mouse("Pressed", 60, 300)
        self.page.mouse("Moved", 160, 280)
        self.page.mouse("Released", 160, 280)
        turned, twin = halves()
        self.assertGreater((np.abs(one - turned).max(axis=2) > 30).mean(), 0.02)
        self.assertLess((np.abs(turned - twin).max(axis=2) > 30).mean(), 2e-3)
        self.server.scene.twin.places[2, 2] += 2
        self.page.press("ArrowRight")
        self.wait("viewer.twin().distance > 1.9")
        one, other = halves()
        self.assertGreater((np.abs(one - other).max(axis=2) > 30).mean(), 5e-3)
        self.assertEqual((self.shown("sceneTitle"), self.shown("twinTitle")), ("this scene", "its copy"))
        self.page.press("t")
        self.wait("!viewer.twin().split && !viewer.twin().on")
        self.assertEqual((self.shown("sceneTitle"), self.shown("apartWho")), ("", ""))
        self.assert_quiet()

    def test_the_distance_of_two_copies_over_time(self):
        self.split()
        self.wait("viewer.twin().count > 20 && viewer.twin().distance > 1e-5")
        self.assertEqual(self.page.js("viewer.twin().farthest"), 2)
        self.wait(lambda: self.shown("apartWho") == "Farthest apart: body 2.")
        self.assertTrue(self.shown("apartNow").endswith(" m"))
        # Each value is that of the formula at its time.
        curve = self.page.js("[...apart.t.subarray(0, apart.count)].map((t, k) => [t, apart.distance[k]])")
        since = self.server.scene.twin.separate
        for t, distance in curve:
            self.assertAlmostEqual(distance, min(0.8, 1e-6 * (10 ** (2 * (t - since)) - 1)), delta=1e-9 + 1e-6 * distance)
        drawn = """(() => { drawApart(); const c = document.getElementById('apart'), d = c.getContext('2d').getImageData(44, 0, c.width - 54, c.height - 32), rows = [];
            for (let x = 0; x < d.width; x += 4) for (let y = 0; y < d.height; ++y) { const o = 4 * (y * d.width + x); if (d.data[o + 3] > 150 && d.data[o] > 150 && d.data[o + 2] < 90) { rows.push(y); break; } }
            return rows; })()"""
        rows = self.page.js(drawn)
        self.assertGreater(len(rows), 20, "the curve")
        self.assertLess(rows[-1], rows[3], "it rises")
        # Frames of another length: while the two are at other times, there is a gap.
        self.page.press(" ")
        self.wait("!viewer.live().running")
        self.click("forTwin")
        self.page.js(f"(e => {{ e.value = '0.1'; e.onchange(); }})({self.knob('step.dt')})")
        self.wait(lambda: self.done("set") == [{"do": "set", "key": "step.dt", "value": "0.1", "of": "twin"}])
        for _ in range(3):
            self.page.press("ArrowRight")
        self.wait(lambda: self.shown("apartNow") == "at other times")
        self.assertIsNone(self.page.js("viewer.twin().distance"))
        self.page.press("0")
        self.wait("viewer.twin().count > 0 && viewer.twin().count < 20", 5)
        self.assertEqual(self.page.complaints, [])

    def test_the_curve_of_distances_keeps_its_largest(self):
        self.split(running=False)
        kept = self.page.js("""(() => { apart.count = 0; for (let k = 0; k < 10000; ++k) noteDistance(k, k === 5001 ? 7 : k < 100 ? NaN : 1, 0);
            const d = [...apart.distance.subarray(0, apart.count)]; return [apart.count, Math.max(...d.filter(v => v > 0)), isNaN(d[0]), d.some((v, k) => k && apart.t[k] <= apart.t[k - 1])]; })()""")
        self.assertLessEqual(kept[0], 4096)
        self.assertEqual(kept[1:], [7, True, False])

    def test_settings_of_the_scene_or_of_its_copy(self):
        self.split()
        field = self.knob("ccd.tolerance")
        self.click("forTwin")
        self.page.js(f"(e => {{ e.value = '1e-4'; e.onchange(); }})({field})")
        self.wait("viewer.live().state.twin.knobs[0].value === '1e-4'")
        self.assertEqual(self.done("set"), [{"do": "set", "key": "ccd.tolerance", "value": "1e-4", "of": "twin"}])
        self.wait(f"{field}.closest('.knob').classList.contains('differs') && {field}.value === '1e-4'")
        self.assertIn("scene: 1e-6", self.page.js(f"{field}.closest('.knob').textContent"))
        self.wait(lambda: self.shown("twinTitle") == "its copy: ccd.tolerance 1e-4")
        self.click("forScene")
        self.assertEqual(self.page.js(f"{field}.value"), "1e-6")
        self.assertIn("copy: 1e-4", self.page.js(f"{field}.closest('.knob').textContent"))
        switch = "document.querySelector('.switch[aria-label=gravity]')"
        self.page.js(f"{switch}.click()")
        self.wait(f"{switch}.closest('.effect').textContent.includes('copy: on')")
        self.assertEqual(self.done("set")[1], {"do": "set", "key": "gravity", "value": "none"})
        self.assertEqual(self.page.js("document.querySelectorAll('.differs').length"), 2)
        # Costs and numbers of both.
        self.page.js("document.getElementById('forTwin').scrollIntoView()")
        self.assertEqual(self.page.js("[...document.getElementById('numbers').rows[0].cells].map(c => c.textContent)"), ["", "scene", "", "copy"])
        row = self.page.js("[...[...document.getElementById('numbers').rows].find(r => r.cells[0].textContent === 'kinetic').cells].map(c => c.textContent)")
        self.assertEqual(row, ["kinetic", "2.5000", "J", "2.5000"])
        self.assertEqual(self.page.js("document.querySelectorAll('#legend.both b + b').length"), 6)
        self.assert_quiet()

    def test_grabs_in_both_halves(self):
        self.split(running=False)
        self.page.settle()
        for copy in (False, True):
            at = self.page.js(f"viewer.onScreen(0, {str(copy).lower()})")
            self.page.mouse("Moved", at["x"], at["y"], "none")
            self.page.mouse("Pressed", at["x"], at["y"])
            self.wait("viewer.live().grabbed === 0")
            for k in range(1, 9):
                self.page.mouse("Moved", at["x"] + 5 * k, at["y"] - 4 * k)
            self.wait(lambda: self.server.scene.grabbed == 0 and self.server.scene.twin.grabbed == 0)
            self.pulled_to(at["x"] + 40, at["y"] - 32, copy)
            self.page.mouse("Released", at["x"] + 40, at["y"] - 32)
            self.wait("viewer.live().grabbed === -1")
            self.page.settle()

    def test_a_copy_that_fails_says_so(self):
        self.split()
        with self.server.change:
            self.server.scene.twin.failed = "no impulse was found"
            self.server.publish(True)
        self.wait(lambda: "no impulse was found" in self.shown("twinTitle"))
        frame = self.live()["frame"]
        self.wait(f"viewer.live().frame > {frame + 5}")
        self.assertEqual(self.shown("banner"), "")

    def test_two_copies_of_a_thousand_bodies(self):
        self.split(crowd_scene(), running=False)
        own = self.page.js("viewer.cost(40)")
        print(f"two copies of a crowd: {own:.2f} ms of our own work a picture")
        self.assertLess(own, 1000 / 60)
        self.assert_quiet()

    def test_the_algorithm_step_by_step(self):
        self.open()
        self.wait("viewer.live().frame > 5")
        self.page.press("a")
        self.wait("viewer.algorithm().open && !viewer.live().running && viewer.live().shown === viewer.live().t")
        check_steps(self, self.page, self.picture, self.server.scene.poses()[0, :3])
        self.assert_quiet()

    def test_the_algorithm_keeps_up_with_the_scene(self):
        self.split(running=False)
        self.page.press("a")
        self.wait("viewer.algorithm().open && !viewer.twin().split")
        frame = self.live()["frame"]
        self.assertIn(f"frame {frame + 1}:", self.shown("accountFrame"))
        self.page.press("ArrowRight")
        self.wait(lambda: f"frame {frame + 2}:" in self.shown("accountFrame"))
        self.click("accountNext")
        self.wait(lambda: f"frame {frame + 3}:" in self.shown("accountFrame"))
        self.page.press(" ")
        self.wait("viewer.live().running && !viewer.algorithm().open && viewer.twin().split")
        # One that cannot be worked out is one line.
        self.server.scene.algorithm = lambda: None
        self.page.press("a")
        self.wait(lambda: "cannot be worked out" in self.shown("toast"))
        self.assertFalse(self.page.js("viewer.algorithm().open"))

    def test_warnings_and_knobs_that_cannot_be_set(self):
        self.open()
        self.assertEqual(self.shown("warnings"), "")
        self.server.scene.warnings = ["body 3 is thin: 1e-7 m", "<b>another</b>"]
        self.wait(lambda: self.shown("warnings") == "body 3 is thin: 1e-7 m<b>another</b>")
        self.server.scene.warnings = []
        self.wait(lambda: self.shown("warnings") == "")
        self.assertTrue(self.page.js(f"{self.knob('envelope')}.disabled"))
        self.assertIn("no body of this scene rests", self.page.js(f"{self.knob('envelope')}.closest('.knob').textContent"))
        self.assertEqual(self.page.js("getComputedStyle(document.getElementById('levelKeys')).display === 'none' || document.getElementById('levelKeys').hidden"), True)

    def measure(self, scene):
        self.open(scene)
        time.sleep(1)
        first = self.page.js("[viewer.live().pictures, performance.now()]")
        time.sleep(3)
        last = self.page.js("[viewer.live().pictures, performance.now()]")
        own = self.page.js("viewer.cost(40)")
        rate = 1000 * (last[0] - first[0]) / (last[1] - first[1])
        print(f"{scene.title}: {own:.2f} ms of our own work a picture; {rate:.0f} pictures/s where software draws them")
        return own

    def test_a_thousand_bodies_at_60_pictures(self):
        self.assertLess(self.measure(crowd_scene()), 1000 / 60)
        x, y = self.where(0)
        self.assertLess(self.page.js(f"(() => {{ const start = performance.now(); for (let k = 0; k < 20; ++k) pick({x}, {y}); return (performance.now() - start) / 20; }})()"), 1000 / 60)

    def test_two_fine_meshes_at_60_pictures(self):
        self.assertLess(self.measure(bunnies_scene()), 1000 / 60)
        x, y = self.where(0)
        self.assertEqual(self.page.js(f"pick({x}, {y}).body"), 0)
        self.assertLess(self.page.js(f"(() => {{ const start = performance.now(); for (let k = 0; k < 20; ++k) pick({x}, {y}); return (performance.now() - start) / 20; }})()"), 1000 / 60)

    def test_small_screens_and_dark_ones(self):
        self.page.call("Emulation.setDeviceMetricsOverride", width=400, height=760, deviceScaleFactor=1, mobile=False)
        self.page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        try:
            self.open()
            self.assertTrue(self.page.js("document.getElementById('panels').hidden"))
            self.click("more")
            self.page.settle()
            self.assertGreater(self.page.js("document.getElementById('stage').clientHeight"), 150)
            self.assertLessEqual(self.page.js("document.documentElement.scrollWidth"), 400)
            self.assertLess(self.picture()[5, 200].mean(), 60)
        finally:
            self.page.call("Emulation.clearDeviceMetricsOverride")
            self.page.call("Emulation.setEmulatedMedia", features=[])


if __name__ == "__main__":
    if len(sys.argv) > 1:
        PAGE = Path(sys.argv.pop(1))
    try:
        Page(seconds=120).close()
    except NoBrowser as reason:
        print(f"skipped: {reason}")
        sys.exit(1 if os.environ.get("FC_BROWSER_REQUIRED") == "1" else 77)
    unittest.main()
