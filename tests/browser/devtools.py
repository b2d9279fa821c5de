"""Speaks with a headless Chromium over its DevTools pipe: standard library only, no port, no network."""

import base64
import json
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

FLAGS = ("--headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
         "--disable-component-update --disable-sync --disable-default-apps --disable-extensions --mute-audio "
         "--use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader --remote-debugging-pipe").split()


class NoBrowser(Exception):
    """There is no Chromium that runs here; the text says why."""


class BrowserError(Exception):
    """Chromium answered a command with an error."""


class Page:
    """One page, with all that it logged, threw and asked the network for since it was opened."""

    def __init__(self, seconds: float = 60):
        program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
        if not program:
            raise NoBrowser("no chromium on the PATH")
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.deadline = time.monotonic() + seconds
        to_child, self.writer = os.pipe()
        self.reader, from_child = os.pipe()

        def give_pipes():  # Chromium listens on 3 and answers on 4
            low, high = os.dup(to_child), os.dup(from_child)
            os.dup2(low, 3)
            os.dup2(high, 4)

        self.process = subprocess.Popen(
            [program, *FLAGS, f"--user-data-dir={self.profile.name}", "--window-size=1200,800", "about:blank"],
            preexec_fn=give_pipes, close_fds=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(to_child)
        os.close(from_child)
        os.set_blocking(self.reader, False)
        self.buffer, self.last_id, self.session = b"", 0, None
        self.requests, self.complaints = [], []
        try:
            targets = self.call("Target.getTargets")["targetInfos"]
            target = next(t["targetId"] for t in targets if t["type"] == "page")
        except (NoBrowser, StopIteration) as error:
            self.close()
            raise NoBrowser(f"{program} does not start: {error}") from None
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        os.close(self.writer)
        os.close(self.reader)
        self.profile.cleanup()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _message(self) -> dict:
        while b"\0" not in self.buffer:
            if self.process.poll() is not None:
                raise NoBrowser(f"it ended with exit code {self.process.returncode}")
            if time.monotonic() > self.deadline:
                raise NoBrowser("it did not answer in time")
            try:
                piece = os.read(self.reader, 1 << 20)
            except BlockingIOError:
                time.sleep(0.005)
                continue
            if not piece:
                raise NoBrowser("it closed its pipe")
            self.buffer += piece
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def _note(self, message: dict) -> None:
        method, what = message.get("method"), message.get("params", {})
        if method == "Network.requestWillBeSent":
            self.requests.append(what["request"]["url"])
        elif method == "Runtime.exceptionThrown":
            details = what["exceptionDetails"]
            self.complaints.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and what["type"] in ("error", "warning", "assert"):
            self.complaints.append(" ".join(str(a.get("value", a.get("description"))) for a in what["args"]))
        elif method == "Log.entryAdded" and what["entry"]["level"] in ("error", "warning"):
            if "GPU stall due to ReadPixels" not in what["entry"]["text"]:  # the price of our own screenshot
                self.complaints.append(what["entry"]["text"])

    def call(self, method: str, **params) -> dict:
        self.last_id += 1
        message = {"id": self.last_id, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.writer, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._message()
            if answer.get("id") == self.last_id:
                if "error" in answer:
                    raise BrowserError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            self._note(answer)

    def js(self, expression: str):
        """The value of an expression in the page."""
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise BrowserError(f"{expression}: {result['exceptionDetails']['text']}")
        return result["result"].get("value")

    def open(self, file: Path, query: str = "") -> dict:
        """Opens a page from its file, as a double click does; what it says of itself when it is ready."""
        return self.go(file.resolve().as_uri() + query)

    def go(self, address: str) -> dict:
        self.requests, self.complaints = [], []
        self.call("Page.navigate", url=address)
        while not (state := self.js("document.body && (document.body.dataset.ready || document.body.dataset.error)")):
            time.sleep(0.02)
            if time.monotonic() > self.deadline:
                raise NoBrowser(f"{address} did not get ready in time: {self.complaints}")
        return json.loads(state) if state.startswith("{") else {"error": state}

    def press(self, key: str) -> None:
        text = {"text": key} if len(key) == 1 else {}
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, **text)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key)

    def mouse(self, kind: str, x: float, y: float, button: str = "left", **more) -> None:
        """`kind`: Pressed, Moved, Released or Wheel. While a button is down, moves name it, too."""
        held = {"left": 1, "right": 2, "middle": 4, "none": 0}[button] if kind != "Released" else 0
        self.call("Input.dispatchMouseEvent", type=f"mouse{kind}", x=x, y=y, button=button, buttons=held, **{"clickCount": 1} | more)

    def settle(self) -> None:
        """Waits until what was asked for is drawn."""
        self.js("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def picture(self) -> bytes:
        """What the page shows, as a PNG."""
        self.settle()
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
