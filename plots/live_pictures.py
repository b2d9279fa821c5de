#!/usr/bin/env python3
"""The pictures of chapters/LIVE.md: the page of live scenes as headless Chromium shows it, of scenes that really run.

Each scene goes on by a fixed number of frames, so the bodies stand where they stood the last time; the times that frames took are
this machine's. Where no Chromium runs, or the program has no server, this says so, and the pictures stay as they are. So they do
while plots/texts.py --check compares: it could not compare them."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import argparse
import contextlib
import io
import json
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Iterator

from PIL import Image  # matplotlib needs it, too

from style import PlotError

ROOT = Path(__file__).resolve().parents[1]
CHAPTERS = ROOT / "chapters"
sys.path.insert(0, str(ROOT / "tests/browser"))
from devtools import BrowserError, NoBrowser, Page  # noqa: E402

WIDTH, HEIGHT = 1100, 714  # pixels of the page

# In the page: makes this many frames. Each has come, with its numbers and its copy, and is drawn, before the next is asked for.
STEP = """(async count => {
  const copyCame = () => !live.state.twin || (twin.newest && twin.newest.frame === live.state.twin.frame);
  const come = frame => live.newest.frame === frame && live.state.frame === frame && copyCame();
  for (let k = 0; k < count; ++k) {
    const frame = live.newest.frame + 1, answer = await viewer.command({ do: "step" });
    if (!answer.ok) throw new Error(answer.text);
    while (!come(frame)) await pause(2);
    await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));
  }
})"""


class Scene:
    """The page of a scene that runs in a program. It stands at its beginning."""

    def __init__(self, page: Page, address: str):
        self.page, self.js = page, page.js
        page.call("Emulation.setDeviceMetricsOverride", width=WIDTH, height=HEIGHT, deviceScaleFactor=1, mobile=False)
        if "error" in (ready := page.go(address)):
            raise PlotError(f"the page says: {ready['error']}")
        self.wait("viewer.live().connected && live.newest && live.state")
        self.command(do="pause")
        self.reset()

    def wait(self, condition: str) -> None:
        end = time.monotonic() + 60
        while not self.js(condition):
            if time.monotonic() > end:
                raise PlotError(f"in the page this did not come true: {condition} {self.page.complaints}")
            time.sleep(0.02)

    def command(self, **what) -> None:
        answer = self.js(f"viewer.command({json.dumps(what)})")
        if not answer["ok"]:
            raise PlotError(f"{what}: {answer['text']}")

    def reset(self) -> None:
        """To the beginning, without the curves of what was before."""
        self.command(do="reset")
        self.wait("live.newest.frame === 0 && live.state.frame === 0 && !viewer.live().running")
        self.js("for (const samples of Object.values(samplesOf)) samples.list.length = 0")

    def frames(self, count: int) -> None:
        self.js(f"{STEP}({count})")

    def look(self, **camera) -> None:
        self.js(f"Object.assign(camera, {json.dumps(camera)}); redraw()")
        self.page.settle()

    def click(self, selector: str) -> None:
        self.js(f"document.querySelector({json.dumps(selector)}).click()")

    def picture(self) -> bytes:
        """What the page shows."""
        self.wait("document.getElementById('toast').hidden")
        self.js("document.activeElement.blur(); drawPanels(); redraw()")
        smaller = io.BytesIO()
        Image.open(io.BytesIO(self.page.picture())).convert("RGB").save(smaller, format="PNG", optimize=True)
        return smaller.getvalue()


@contextlib.contextmanager
def live(page: Page, program: Path, scene: str) -> Iterator[Scene]:
    process = subprocess.Popen([program, CHAPTERS / scene, "--live", "--quiet"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        address = process.stdout.readline().strip()
        if not address.startswith("http://"):
            why = process.communicate()[1].strip()
            raise (NoBrowser if "server" in why else PlotError)(why)
        yield Scene(page, address)
        page.call("Page.navigate", url="about:blank")  # it does not watch the program's end
    finally:
        process.kill()
        process.communicate()


def dominoes(page: Page, program: Path) -> dict[str, bytes]:
    """Half of the row has fallen; a hand lifts one domino of the other half, and is ahead of it."""
    taken = 16
    with live(page, program, "ch06_friction/scenes/dominoes.yaml") as scene:
        scene.look(target=[1.95, 0, 0.15], distance=5.05, yaw=-1.2, pitch=0.25)
        scene.frames(60)
        place = scene.js(f"viewer.onScreen({taken})")
        page.mouse("Moved", place["x"], place["y"], "none")
        page.mouse("Pressed", place["x"], place["y"])
        scene.wait(f"viewer.live().grabbed === {taken}")
        for height, frames in ((0.6, 20), (0.8, 17), (1.1, 3)):  # of the hand, m
            place = scene.js(f"onScreen([{0.2 * (taken - 2)}, 0, {height}])")
            page.mouse("Moved", place["x"], place["y"])
            scene.wait(f"grip.told && Math.abs(grip.target[2] - {height}) < 0.1")
            scene.frames(frames)
        pictures = {"live.png": scene.picture()}
        page.mouse("Released", place["x"], place["y"])
        page.mouse("Moved", 5, HEIGHT - 5, "none")
        scene.wait("viewer.live().grabbed === -1")
        scene.js("for (const part of document.querySelectorAll('#panels details')) part.open = part.id === 'knobsPart'")
        return pictures | {"live_knobs.png": scene.picture()}


def gas(page: Page, program: Path) -> dict[str, bytes]:
    """The copy's frames are a quarter as long."""
    with live(page, program, "ch04_multibody_stepping/scenes/gas.yaml") as scene:
        scene.click("#twin")
        scene.wait("viewer.twin().split")
        scene.command(do="set", key="step.dt", value="0.004166666666666667", of="twin")
        scene.reset()
        scene.look(target=[0, 0, 0.5], distance=20, yaw=-1.5708, pitch=0.12)  # from the front: one sees through the wall there
        scene.frames(180)
        return {"live_two.png": scene.picture()}


def cards(page: Page, program: Path) -> dict[str, bytes]:
    """The cones of friction, with their impulses."""
    with live(page, program, "ch06_friction/scenes/card_house.yaml") as scene:
        scene.frames(5)
        scene.click("#algorithm")
        scene.wait("viewer.algorithm().open")
        scene.click("#parts li:last-child button")
        scene.look(target=[0, 0, 0.92], distance=3.8)
        return {"live_algorithm.png": scene.picture()}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=Path, metavar="BIN_DIR", help="the folder of the programs")
    parser.add_argument("--out", type=Path, default=CHAPTERS, metavar="DIR", help="where the pictures go; default: chapters")
    options = parser.parse_args()
    try:
        if "TEXTS_CHECK" in os.environ:
            raise NoBrowser("they are not compared")
        program = options.bin.resolve() / "ch06_friction"
        if not program.exists():
            raise PlotError(f"{program}: no such program; build first")
        with Page(seconds=600) as page:
            pictures = dominoes(page, program) | gas(page, program) | cards(page, program)
        options.out.mkdir(parents=True, exist_ok=True)
        for name, picture in pictures.items():
            (options.out / name).write_bytes(picture)
            print(options.out / name)
    except NoBrowser as reason:
        print(f"live_pictures.py: the pictures stay as they are: {reason}")
    except (PlotError, BrowserError, OSError) as error:
        print(f"live_pictures.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
