"""A server of a live scene as common/live/STREAM.md describes it, with bodies that move by formulas: for tests of the page."""

import copy
import json
import math
import struct
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import parse_qs, urlparse

import numpy as np

KEY = "0123456789abcdef0123456789abcdef"
# What the server allows its page.
POLICY = ("default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src 'self' data: blob:; "
          "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'")


def box(size):
    """Positions and indices of a box, each face with corners of its own."""
    positions, indices = [], []
    for axis in range(3):
        for side in (-1, 1):
            first = len(positions)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                corner = [0.0, 0.0, 0.0]
                corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3] = side, a, b
                positions.append([0.5 * c * s for c, s in zip(corner, size)])
            quad = [0, 1, 2, 0, 2, 3] if side > 0 else [0, 2, 1, 0, 3, 2]
            indices += [first + k for k in quad]
    return np.array(positions, "<f4"), np.array(indices, "<u4"), None


def ball(radius, rows=12):
    """A ball of 4 rows^2 triangles; with normals, so that it looks smooth."""
    columns = 2 * rows
    up, around = np.meshgrid(np.linspace(0, math.pi, rows + 1), np.linspace(0, 2 * math.pi, columns + 1), indexing="ij")
    normals = np.stack([np.sin(up) * np.cos(around), np.sin(up) * np.sin(around), np.cos(up)], -1).reshape(-1, 3).astype("<f4")
    row, column = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    a = row * (columns + 1) + column
    b = a + columns + 1
    return radius * normals, np.stack([a, b, a + 1, a + 1, b, b + 1], -1).reshape(-1).astype("<u4"), normals


COLOURS = ((0.0, 0.168, 0.445), (0.791, 0.347, 0.0), (0.0, 0.342, 0.171), (0.093, 0.456, 0.815), (0.604, 0.191, 0.386), (0.871, 0.776, 0.054))


def glb(title, shapes, bodies):
    """A binary glTF file as motion.glb is: `bodies` are (shape, static, pose)."""
    chunk, views, accessors, meshes, known = b"", [], [], [], {}

    def accessor(values, kind):
        nonlocal chunk
        views.append({"buffer": 0, "byteOffset": len(chunk), "byteLength": values.nbytes})
        chunk += values.tobytes()
        accessors.append({"bufferView": len(views) - 1, "componentType": 5125 if values.dtype == np.dtype("<u4") else 5126,
                          "count": len(values), "type": kind})
        return len(accessors) - 1

    parts = {}
    for name, (positions, indices, normals) in shapes.items():
        attributes = {"POSITION": accessor(positions, "VEC3")}
        if normals is not None:
            attributes["NORMAL"] = accessor(normals, "VEC3")
        parts[name] = {"attributes": attributes, "indices": accessor(indices, "SCALAR")}
    materials = [{"pbrMetallicRoughness": {"baseColorFactor": [*colour, 1]}} for colour in (*COLOURS, (0.46, 0.46, 0.46))]
    nodes = [{"name": "world", "rotation": [-math.sqrt(0.5), 0, 0, math.sqrt(0.5)]}]
    for i, (shape, static, pose) in enumerate(bodies):
        paint = 6 if static else i % 6
        if (shape, paint) not in known:
            known[shape, paint] = len(meshes)
            meshes.append({"primitives": [{**parts[shape], "material": paint}]})
        nodes.append({"name": f"body_{i}", "mesh": known[shape, paint], "translation": [float(v) for v in pose[:3]],
                      "rotation": [float(v) for v in pose[3:]], "extras": {"static": static}})
    nodes[0]["children"] = list(range(1, len(nodes)))
    data = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0], "extras": {"title": title, "chapter": "a fake"}}],
            "nodes": nodes, "meshes": meshes, "materials": materials, "accessors": accessors, "bufferViews": views,
            "buffers": [{"byteLength": len(chunk)}]}
    text = json.dumps(data).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(chunk)
    return (struct.pack("<4sII", b"glTF", 2, total) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(chunk), b"BIN\0") + chunk)


class Scene:
    """Bodies that sway about their places; the one in the hand is where it is pulled to."""

    def __init__(self, shapes, bodies, title="a fake scene", dt=1 / 60):
        self.shapes, self.first, self.title, self.dt = shapes, list(bodies), title, dt
        self.geometry = 0
        self.values = {"ccd.tolerance": "1e-6", "solver.method": "dantzig", "step.dt": str(dt), "restitution": "0.3"}
        self.gravity = True
        self.twin = None  # a copy of this, and its first frame
        self.warnings = []
        self.reset()

    def reset(self):
        self.bodies = list(self.first)
        self.places = np.array([pose for _, _, pose in self.bodies], float)
        self.moves = np.array([not static for _, static, _ in self.bodies])
        self.frame, self.failed, self.grabbed, self.local, self.target = 0, None, -1, np.zeros(3), np.zeros(3)
        self.geometry += 1
        self.separate = None  # s: since then this is a copy, and runs away from the scene

    def add_ball(self, at):
        self.bodies.append(("ball", False, (*at, 0, 0, 0, 1)))
        self.places = np.vstack([self.places, (*at, 0, 0, 0, 1)])
        self.moves = np.append(self.moves, True)
        self.geometry += 1

    def poses(self):
        poses = self.places.copy()
        t = self.frame * self.dt
        poses[self.moves, 0] += 0.3 * math.sin(t)
        if self.separate is not None:  # the last body that moves flies off, tenfold farther each half second
            last = np.flatnonzero(self.moves)[-1]
            poses[last, 1] += min(0.8, 1e-6 * (10 ** (2 * (t - self.separate)) - 1))
        half = 0.5 * t
        poses[self.moves, 5], poses[self.moves, 6] = math.sin(half), math.cos(half)
        if self.grabbed >= 0:
            poses[self.grabbed] = (*(self.target - self.local), 0, 0, 0, 1)
        return poses

    def state(self, running):
        t = self.frame * self.dt
        busy = 1 + 0.25 * math.sin(3 * t) + (1.6 if self.values["ccd.tolerance"] == "1e-9" else 0)
        stages = {"broad_ms": 0.4, "ccd_ms": 3.1 * busy, "contacts_ms": 0.7, "lcp_ms": 1.9 * busy, "corrections_ms": 0.3, "other_ms": 0.2}
        effect = {"on": True, "ms": 0.12, "can_switch": True, "set": {"key": "gravity", "on": "[0, 0, -9.81]"}, "why": "declared at line 4", "adds": "an acceleration of every body"}
        off = {"on": False, "ms": 0, "can_switch": False, "set": {"key": "", "on": ""}, "why": "not asked for by this scene", "adds": "cones of friction in the solver"}
        knob = {"unit": "1", "low": 0, "high": 0, "choices": [], "restarts": False}
        state = {"t": t, "frame": self.frame, "running": running, "failed": self.failed, "title": self.title, "dt": self.dt, "bodies": len(self.bodies),
                "geometry": self.geometry, "step_ms": sum(stages.values()), "stages": stages, "contacts": 2, "energy": 12.5 - 0.1 * t, "kinetic": 2.5, "potential": 10 - 0.1 * t,
                "account": {"impacts": -0.1 * t, "friction": 0.0, "hand": 0.0}, "min_gap": None if self.frame == 0 else 5e-7 * (1.5 + math.sin(7 * t)), "lost_time": 0,
                "residual": 10 ** (-13 + math.sin(5 * t)), "speed": self.speed,
                "effects": {"gravity": {**effect, "on": self.gravity, "ms": 0.12 if self.gravity else 0}, "friction": off},
                "knobs": [{**knob, "key": "ccd.tolerance", "unit": "m", "value": self.values["ccd.tolerance"], "low": 1e-9, "high": 1e-2, "meaning": "Gap at which two bodies are in contact."},
                          {**knob, "key": "restitution", "value": self.values["restitution"], "low": 0, "high": 1, "meaning": "Part of the approach speed that an impact returns."},
                          {**knob, "key": "solver.method", "value": self.values["solver.method"], "choices": ["dantzig", "lemke", "pgs"], "meaning": "Algorithm that solves the LCP."},
                          {**knob, "key": "step.dt", "unit": "s", "value": self.values["step.dt"], "low": 1e-3, "high": 0.1, "meaning": "Length of a frame.", "restarts": True},
                          {**knob, "key": "envelope", "unit": "m", "value": "none", "low": 1e-6, "high": 1e-2, "meaning": "Gap that contacts which last keep.", "can_switch": False, "why": "no body of this scene rests"}]}
        if self.warnings:
            state["warnings"] = self.warnings
        state["twin"] = None
        if self.twin:
            left_out = ("running", "title", "bodies", "geometry", "speed", "warnings", "twin")
            state["twin"] = {k: v for k, v in self.twin.state(running).items() if k not in left_out} | {"distance": None if math.isnan(self.distance()[0]) else self.distance()[0]}
        return state

    def distance(self):
        """How far the same body's centres are apart at most, and which body's; NaN at two times."""
        if abs(self.twin.frame * self.twin.dt - self.frame * self.dt) > 1e-9 * self.dt:
            return math.nan, -1
        away = np.linalg.norm(self.twin.poses()[:, :3] - self.poses()[:, :3], axis=1)
        return float(away.max()), int(away.argmax())

    def make_twin(self, on):
        self.twin = copy.deepcopy(self) if on else None
        if on:
            self.twin.twin, self.twin.separate = None, self.frame * self.dt

    def algorithm(self):
        """What GET /algorithm tells, or None where it fails."""
        return account(self.frame * self.dt, (self.frame + 1) * self.dt, self.frame + 1)

    def advance(self):
        self.frame += 1
        while self.twin and not self.twin.failed and self.twin.frame * self.twin.dt < self.frame * self.dt - 1e-12:
            self.twin.frame += 1

    speed = 1

    def frame_message(self, running):
        return self.message(1, b"", running)

    def messages(self, running):
        twin = self.twin.message(3, struct.pack("<di", *self.distance()), running) if self.twin else b""
        return self.frame_message(running) + twin

    def message(self, kind, more, running):
        poses = self.poses().astype("<f4")
        contacts = np.zeros((2, 10), "<f4")
        contacts[0] = (*poses[0, :2], poses[0, 2] - 0.5, 0, 0, 1, 0, 0, 0.5, 1)
        contacts[1] = (*poses[0, :2], poses[0, 2] + 0.5, 1, 0, 0, 2, 0, 0, 0)
        body = more + struct.pack("<IIdIIIi", self.geometry, self.frame, self.frame * self.dt, (1 if running else 0) | (2 if self.failed else 0), len(poses), 2, self.grabbed)
        body += poses.tobytes() + contacts.tobytes()
        if self.grabbed >= 0:
            body += np.array([*(poses[self.grabbed, :3] + self.local), *self.target], "<f4").tobytes()
        return struct.pack("<II", len(body) + 4, kind) + body


def account(t0, t1, frame):
    """A document of the algorithm with each kind of mark, a chart of each kind, and bars. Its first step moves body 0."""
    corners = [[x, y, z] for z in (0.1, 0.9) for x, y in ((-0.6, 1.2), (0.9, 1.2), (0.9, 2.2), (-0.6, 2.2))]
    faces = [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7]]
    ring = [[1.5 + 0.8 * math.cos(a), -0.5 + 0.8 * math.sin(a), 0.02] for a in np.linspace(0, 2 * math.pi, 33)[:-1]]
    times = [t0 + (t1 - t0) * (1 - 0.5 ** k) for k in range(8)]
    gap = {"name": "certified gap", "role": "now", "points": [[t, 0.4 * 0.5 ** k] for k, t in enumerate(times)], "steps": False}
    bound = {"name": "motion bound", "role": "past", "points": [[t0, 0.4], [t1, 0.0]], "steps": False}
    error = {"name": "error", "role": "a", "points": [[k, 10.0 ** (-2 * k)] for k in range(8)], "steps": True}
    return {"frame": frame, "t0": t0, "t1": t1, "parts": [
        {"chapter": 1, "title": "body 0 and body 1: the first time of contact", "steps": [
            {"text": "Advance 1: the gap is at least 0.4 m, and closes with at most 24 m/s. Until 0.45 s nothing can touch.",
             "poses": [[0, -0.5, -1.0, 1.5, 0, 0, 0, 1]],
             "draw": [{"kind": "plane", "at": [0, -0.8, 0.8], "normal": [1, 0, 0], "radius": 1.2, "role": "now"},
                      {"kind": "line", "points": [[-1.0, -0.9, 0.5], [1.0, -0.6, 0.5]], "role": "now", "closed": False},
                      {"kind": "point", "at": [-1.0, -0.9, 0.5], "role": "a"}, {"kind": "point", "at": [1.0, -0.6, 0.5], "role": "b"},
                      {"kind": "label", "at": [-1.0, -0.9, 0.5], "text": "gap 0.4 m"}, {"kind": "label", "at": [1.0, -0.6, 0.5], "text": "witness of body 1"},
                      {"kind": "label", "at": [1.0, -0.6, 0.5], "text": "on the same point"}],
             "chart": {"x": "time of the frame [s]", "y": "gap [m]", "log": False, "curves": [gap, bound], "marks": [[times[1], 0.2, "advance 1"], [times[2], 0.1, "advance 2"], [times[3], 0.05, "advance 3"]]}},
            {"text": "Advance 2: proved.", "draw": [{"kind": "line", "points": ring, "role": "good", "closed": True}, {"kind": "arrow", "from": [1.5, -0.5, 0.5], "to": [1.5, -0.5, 2.0], "role": "force"}]}]},
        {"chapter": 2, "title": "the node pairs that the search opened, the best first, which is a long title", "steps": [
            {"text": "The hulls of both nodes; the pair is refused.", "draw": [{"kind": "mesh", "points": corners, "triangles": faces, "role": "a"}, {"kind": "line", "points": [[-3, 3, 0.2], [3, 3, 0.2]], "role": "bad", "closed": False},
                                                                             {"kind": "point", "at": [0, 3, 0.2], "role": "bad"}, {"kind": "point", "at": [0, -3, 0.2], "role": "past"}]}]},
        {"chapter": 3, "title": "impulses, pivot by pivot", "steps": [
            {"text": "Pivot 3: row 2 leaves the basis with 1.25 N s, row 0 comes in.",
             "bars": {"title": "impulses after this pivot", "unit": "N s", "rows": [{"label": f"contact {k}", "value": v, "role": r, "note": n} for k, (v, r, n) in
                                                                                  enumerate(((1.25, "good", "in"), (-0.4, "bad", "must not pull"), (0.0, "past", ""), (3.5e-3, "now", "comes in"), (None, "past", "not known")))]},
             "chart": {"x": "pivot", "y": "error [m/s]", "log": True, "curves": [error], "marks": [[3, 1e-6, "tolerance"]]}}]}]}


class Refused(Exception):
    """A command with a mistake; the text is one line."""


class FakeServer:
    """Serves a page and a Scene; `commands` are all that it was sent, in their order."""

    def __init__(self, page: str, scene: Scene, running=True):
        self.page, self.scene, self.running, self.key = page, scene, running, KEY
        self.commands, self.port, self.ended = [], 0, False
        self.change = threading.Condition()
        self.version = self.told = 0
        self.delay = 0.0
        self.streams = 0
        self.start()
        self.clock = threading.Thread(target=self.run, daemon=True)
        self.clock.start()

    @property
    def url(self):
        return f"http://127.0.0.1:{self.port}/?key={self.key}"

    def start(self):
        """Listens, at the same port if it did so before."""
        fake = self

        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def log_message(self, *_):
                pass

            def do_GET(self):
                fake.get(self)

            def do_POST(self):
                fake.post(self)

        class Server(ThreadingHTTPServer):
            daemon_threads, allow_reuse_address, block_on_close = True, True, False

            def handle_error(self, *_):  # a page that closes its stream is no error
                pass

        self.gone = False
        self.server = Server(("127.0.0.1", self.port), Handler)
        self.port = self.server.server_address[1]
        threading.Thread(target=self.server.serve_forever, args=(0.05,), daemon=True).start()

    def go(self):
        """Is gone, as a server that has crashed."""
        with self.change:
            self.gone = True
            self.change.notify_all()
        self.server.shutdown()
        self.server.server_close()

    def close(self):
        self.ended = True
        self.go()
        self.clock.join()

    def run(self):
        due = time.monotonic()
        while not self.ended:
            due = max(due + self.scene.dt / self.scene.speed, time.monotonic() - 0.1)
            time.sleep(max(0.0, min(0.1, due - time.monotonic())))
            if time.monotonic() < due:
                continue
            with self.change:
                if self.running:
                    self.scene.advance()
                    self.publish()

    def publish(self, at_once=False):
        self.message = self.scene.messages(self.running)
        self.version += 1
        self.told += at_once
        self.change.notify_all()

    def answer(self, handler, status, body, kind="application/json"):
        body = body if isinstance(body, bytes) else body.encode()
        handler.send_response(status)
        handler.send_header("Content-Type", kind)
        handler.send_header("Content-Length", str(len(body)))
        handler.send_header("Content-Security-Policy", POLICY)
        handler.end_headers()
        handler.wfile.write(body)

    def allowed(self, handler):
        if parse_qs(urlparse(handler.path).query).get("key") == [self.key]:
            return True
        self.answer(handler, 403, "no", "text/plain")
        return False

    def get(self, handler):
        if not self.allowed(handler):
            return
        name = urlparse(handler.path).path
        if name == "/":
            self.answer(handler, 200, self.page, "text/html; charset=utf-8")
        elif name == "/state":
            with self.change:
                state = self.scene.state(self.running)
            self.answer(handler, 200, json.dumps(state))
        elif name == "/scene.glb":
            with self.change:
                bodies = [(shape, static, pose) for (shape, static, _), pose in zip(self.scene.bodies, self.scene.poses())]
            self.answer(handler, 200, glb(self.scene.title, self.scene.shapes, bodies), "model/gltf-binary")
        elif name == "/algorithm":
            with self.change:
                self.running = False
                told = self.scene.algorithm()
                self.publish(True)
            self.answer(handler, *((503, "the next frame cannot be worked out", "text/plain") if told is None else (200, json.dumps(told))))
        elif name == "/stream":
            self.stream(handler)
        else:
            self.answer(handler, 404, "no", "text/plain")

    def stream(self, handler):
        handler.send_response(200)
        handler.send_header("Content-Type", "application/octet-stream")
        handler.send_header("Transfer-Encoding", "chunked")
        handler.end_headers()
        handler.close_connection = True
        seen, told, state_due = -1, -1, 0.0
        self.streams += 1
        try:
            while True:
                with self.change:
                    self.change.wait_for(lambda: self.version != seen or self.gone, 1)
                    if self.gone:
                        return
                    if seen < 0:
                        self.publish(True)
                    frame, seen = self.message, self.version
                    with_state = self.told != told or time.monotonic() >= state_due
                    told = self.told
                    state = json.dumps(self.scene.state(self.running)).encode() if with_state else b""
                if with_state:
                    state_due = time.monotonic() + 0.1
                    frame += struct.pack("<II", len(state) + 4, 2) + state
                for at in range(0, len(frame), 5000):  # in pieces that end anywhere
                    piece = frame[at:at + 5000]
                    handler.wfile.write(f"{len(piece):x}\r\n".encode() + piece + b"\r\n")
        finally:
            self.streams -= 1

    def post(self, handler):
        text = handler.rfile.read(int(handler.headers.get("Content-Length", 0)))
        if not self.allowed(handler):
            return
        time.sleep(self.delay)
        command = json.loads(text)
        with self.change:
            self.commands.append(command)
            try:
                answer = {"ok": True, "text": "", "restarted": False, "rebuilt": False, "ms": 0, **self.obey(command)}
            except Refused as reason:
                answer = {"ok": False, "text": str(reason)}
            self.publish(True)
        self.answer(handler, 200 if answer["ok"] else 400, json.dumps(answer))
        if command["do"] == "stop":
            self.go()

    def obey(self, command):
        scene, do = self.scene, command["do"]
        if do in ("run", "pause"):
            self.running = do == "run"
        elif do == "step":
            self.running = False
            scene.advance()
        elif do == "reset":
            twin, scene.twin = scene.twin, None
            scene.reset()
            scene.make_twin(twin is not None)
            self.running = True
            return {"restarted": True}
        elif do == "twin":
            scene.make_twin(command["on"])
            return {"rebuilt": True, "ms": 1.25}
        elif do == "grab":
            if not scene.moves[command["body"]]:
                raise Refused(f"body {command['body']} is static: it cannot be grabbed")
            local = np.array(command["point"]) - scene.poses()[command["body"]][:3]
            for each in filter(None, (scene, scene.twin)):
                each.local, each.target, each.grabbed = local, np.array(command["point"]), command["body"]
        elif do == "drag":
            if scene.grabbed < 0:
                raise Refused("nothing is grabbed")
            for each in filter(None, (scene, scene.twin)):
                each.target = np.array(command["to"])
        elif do == "drop":
            for each in filter(None, (scene, scene.twin)):
                if each.grabbed >= 0:
                    each.places[each.grabbed, :3] = each.target - each.local
                each.grabbed = -1
        elif do == "throw":
            for each in filter(None, (scene, scene.twin)):
                each.add_ball(np.array(command["from"]) + 0.3 * np.array(command["velocity"]))
            return {"rebuilt": True, "ms": 1.5}
        elif do == "speed":
            scene.speed = command["value"]
        elif do == "save":
            return {"scene": "name: saved\n"}
        elif do == "set":
            return self.set(scene.twin if command.get("of") == "twin" else scene, command["key"], command["value"])
        return {}

    def set(self, scene, key, value):
        if scene is None:
            raise Refused("there is no copy")
        if key == "gravity":
            scene.gravity = value != "none"
            return {"rebuilt": True, "ms": 2.25}
        if key != "solver.method" and not 0 < float(value) <= 1000:
            raise Refused(f"{key} must be in (0, 1000], but is {value}")
        scene.values[key] = value
        if key == "step.dt":
            if scene.separate is not None:  # the copy goes on, with frames of another length
                t, scene.dt = scene.frame * scene.dt, float(value)
                scene.frame = math.ceil(t / scene.dt)
                return {"rebuilt": True, "ms": 4}
            scene.reset()
            return {"restarted": True, "ms": 4}
        return {"rebuilt": True, "ms": 3.14}

    def fail(self, line):
        with self.change:
            self.scene.failed, self.running = line, False
            self.publish(True)


def table_scene():
    """A box, a ball and a wall on a floor."""
    shapes = {"box": box((1, 1, 1)), "ball": ball(0.5), "floor": box((12, 12, 0.4)), "wall": box((0.3, 4, 2))}
    upright = (0, 0, 0, 1)
    return Scene(shapes, [("box", False, (-1.5, -1, 0.5, *upright)), ("ball", False, (1.5, -0.5, 0.5, *upright)), ("box", False, (0.2, 1.6, 0.5, *upright)),
                          ("floor", True, (0, 0, -0.2, *upright)), ("wall", True, (4, 0, 1, *upright))], "boxes & <balls>")


def crowd_scene():
    places = [(x, y, z) for x in range(10) for y in range(10) for z in range(10)]
    return Scene({"ball": ball(0.3, 8), "box": box((0.5, 0.5, 0.5))}, [("box" if i % 2 else "ball", False, (*p, 0, 0, 0, 1)) for i, p in enumerate(places)], "a crowd")


def bunnies_scene():
    """Two meshes of 70,000 triangles."""
    rows = int(math.sqrt(70000 / 4))
    return Scene({"ball": ball(0.8, rows)}, [("ball", False, (-1, 0, 0, 0, 0, 0, 1)), ("ball", False, (1, 0, 0, 0, 0, 0, 1))], "two fine meshes")
