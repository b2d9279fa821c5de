// A scene that runs ------------------------------------------------------------------------------------------------
// What the server says is in common/live/STREAM.md. A frame's numbers stay in arrays that are used again: nothing is allocated
// for a body or a contact.

const keptFrames = 8;       // of the stream, the newest; between two of them bodies are drawn
const lagFrames = 1.25;     // how far behind the newest frame is drawn: one frame to move in, and a quarter for uneven arrival
const holdFrames = 6;       // for how long an impact's arrow is seen, as in a recording
const mostArrows = 2000;    // of contacts that last, and as many of impacts
const patience = 10000;     // ms without a server until it counts as gone

const live = {
  key: parameters.get("key") || "", connected: false, ended: false, lostAt: 0, retries: 0,
  frames: [], received: 0, newest: null, before: null,  // the ring, and its last two
  shown: 0, rate: 1,                                    // s, simulated; simulated seconds per second
  geometry: -1, loading: false, reach: 1, largest: 0,   // of the loaded scene; m; N s
  state: null, pictures: 0, pictureMs: 0,
};
// Impacts of the last frames: point, normal, impulse, and from when until when they are seen.
const impacts = { values: new Float64Array(9 * mostArrows), next: 0, count: 0 };

const path = name => `/${name}?key=${encodeURIComponent(live.key)}`;
const pause = ms => new Promise(done => setTimeout(done, ms));

// The stream ---

// Puts pieces of the stream together to messages. Each message begins at the buffer's start, so that its floats are aligned.
const assembly = { bytes: new Uint8Array(1 << 16), filled: 0 };

function take(piece) {
  for (let at = 0; at < piece.length;) {
    const a = assembly;
    const length = a.filled < 4 ? 4 : 4 + new DataView(a.bytes.buffer).getUint32(0, true);
    if (length > 1 << 28) throw new Error(`a message of ${length} bytes`);
    if (length > a.bytes.length) {
      const larger = new Uint8Array(2 * length);
      larger.set(a.bytes.subarray(0, a.filled));
      a.bytes = larger;
    }
    const count = Math.min(length - a.filled, piece.length - at);
    a.bytes.set(piece.subarray(at, at + count), a.filled);
    a.filled += count;
    at += count;
    if (a.filled !== length || length <= 4) continue;
    const kind = new DataView(a.bytes.buffer).getUint32(4, true);
    a.filled = 0;
    if (kind === 1) takeFrame(a.bytes, length);
    else if (kind === 2) takeState(JSON.parse(new TextDecoder().decode(a.bytes.subarray(8, length))));
  }
}

function emptyFrame() {
  return { geometry: 0, frame: 0, t: 0, flags: 0, bodies: 0, contacts: 0, grabbed: -1, arrived: 0, poses: new Float32Array(0),
           marks: new Float32Array(0), hand: new Float32Array(6) };
}

function takeFrame(bytes, length) {
  const head = new DataView(bytes.buffer), last = live.newest;
  const number = head.getUint32(12, true), bodies = head.getUint32(28, true), contacts = head.getUint32(32, true), grabbed = head.getInt32(36, true);
  if (length !== 40 + 28 * bodies + 40 * contacts + (grabbed >= 0 ? 24 : 0)) throw new Error(`a frame of ${bodies} bodies has ${length} bytes`);
  const t = head.getFloat64(16, true);
  if (last && (number < last.frame || t < last.t)) forgetFrames();  // it began again
  else if (last && number === last.frame) --live.received;          // the same frame, told once more
  const frame = live.frames[live.received % keptFrames] || (live.frames[live.received % keptFrames] = emptyFrame());
  live.received++;
  if (frame.poses.length < 7 * bodies) frame.poses = new Float32Array(7 * bodies);
  if (frame.marks.length < 10 * contacts) frame.marks = new Float32Array(20 * contacts);
  frame.poses.set(new Float32Array(bytes.buffer, 40, 7 * bodies));
  frame.marks.set(new Float32Array(bytes.buffer, 40 + 28 * bodies, 10 * contacts));
  if (grabbed >= 0) frame.hand.set(new Float32Array(bytes.buffer, 40 + 28 * bodies + 40 * contacts, 6));
  frame.geometry = head.getUint32(8, true); frame.frame = number; frame.t = t; frame.flags = head.getUint32(24, true);
  frame.bodies = bodies; frame.contacts = contacts; frame.grabbed = grabbed; frame.arrived = performance.now();
  live.newest = frame;
  live.before = live.received > 1 ? live.frames[(live.received - 2) % keptFrames] : frame;
  now.playing = (frame.flags & 1) !== 0;
  rememberImpacts(frame);
  if (frame.geometry !== live.geometry) loadScene();
  redraw();
}

function forgetFrames() {
  live.received = 0; live.newest = live.before = null;
  live.shown = 0; live.largest = 0;
  impacts.next = impacts.count = 0;
}

function rememberImpacts(frame) {
  const dt = live.state ? live.state.dt : frame.t - live.before.t;
  live.largest *= 0.998;  // a hard blow makes the others' arrows short only for a while
  for (let k = 0; k < frame.contacts; ++k) {
    const o = 10 * k, m = frame.marks, size = Math.hypot(m[o + 6], m[o + 7], m[o + 8]);
    live.largest = Math.max(live.largest, size);
    if (m[o + 9]) continue;
    const to = 9 * (impacts.next++ % mostArrows);
    for (let i = 0; i < 6; ++i) impacts.values[to + i] = m[o + i];
    impacts.values[to + 6] = size; impacts.values[to + 7] = frame.t; impacts.values[to + 8] = frame.t + holdFrames * dt;
  }
  impacts.count = Math.min(mostArrows, impacts.next);
}

// Reads the stream until it ends; a server that is gone for a moment is asked again.
async function follow() {
  while (!live.ended) {
    let reason = "The simulation does not answer.";
    try {
      const answer = await fetch(path("stream"));
      if (answer.status === 503) reason = (await answer.text()).trim() || reason;  // too many pages, or it is about to end
      if (!answer.ok) throw new Error(String(answer.status));
      const reader = answer.body.getReader();
      assembly.filled = 0;
      for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
        connected();
        try {
          take(piece.value);
        } catch (error) {  // not the network's: a message that cannot be read
          console.error(error);
          reader.cancel();
          throw error;
        }
      }
    } catch (error) {
      if (error.message === "403") return end("The key in this page's address is not the simulation's. Open the address that it printed.");
    }
    if (live.ended) return;
    live.connected = false;
    live.lostAt = live.lostAt || performance.now();
    if (performance.now() - live.lostAt > patience) return end(reason + " It has ended, or its computer cannot be reached.", "try again");
    banner(reason + " Trying again …");
    now.playing = false;
    redraw();
    await pause(Math.min(1000, 200 + 100 * live.retries++));
  }
}

function connected() {
  if (live.connected) return;
  live.connected = true;
  live.lostAt = live.retries = 0;
  forgetFrames();
  banner("");
  const known = live.state;  // a scene that stands still may send none for long; one that the stream sends first is newer
  fetch(path("state")).then(answer => answer.ok ? answer.json() : null).then(state => { if (state && live.state === known) takeState(state); }, () => {});
}

function end(text, again) {
  live.ended = true; live.connected = false; now.playing = false;
  document.body.classList.add("over");
  banner(text, again, () => { live.ended = false; live.lostAt = 0; document.body.classList.remove("over"); banner("Trying again …"); follow(); });
  redraw();
}

// The scene's shapes, anew when bodies or shapes have changed.
async function loadScene() {
  if (live.loading) return;
  live.loading = true;
  const wanted = live.newest ? live.newest.geometry : -1;
  try {
    const answer = await fetch(path("scene.glb"));
    if (!answer.ok) throw new Error(`the server answers ${answer.status} ${answer.statusText}`);
    const old = motion, next = load(new Uint8Array(await answer.arrayBuffer()), old ? old.geometries : []);
    next.geometries.forEach(upload);
    if (old) {
      old.geometries.filter(g => !next.geometries.includes(g)).forEach(forget);
      if (camera.follow) camera.follow = next.bodies[old.bodies.indexOf(camera.follow)] || null;
    }
    motion = next;
    live.geometry = wanted;
    live.reach = next.bodies.reduce((most, b) => b.moves ? Math.max(most, b.geometry.radius) : most, 0) || 1;
    hoverOver(-1);
    offerLevels();
  } finally {
    live.loading = false;
  }
  if (live.newest && live.newest.geometry !== live.geometry) return loadScene();
  redraw();
}

// Time: a clock that runs at the stream's pace, somewhat behind it ---

// Moves on the time that is shown; whether there is more to come.
function advance(passed) {
  const { newest, before, frames, received } = live;
  if (!newest) return false;
  const interval = newest.t - before.t, oldest = frames[Math.max(0, received - keptFrames) % keptFrames];
  const wall = (newest.arrived - oldest.arrived) / 1000;
  if (wall > 0.02 && newest.t > oldest.t) live.rate = (newest.t - oldest.t) / wall;
  const lag = lagFrames * interval, since = (performance.now() - newest.arrived) / 1000;
  const wanted = newest.t - lag + Math.min(lag, live.rate * since), ahead = wanted - live.shown;
  if (!now.playing || !(interval > 0)) live.shown = newest.t;
  else if (Math.abs(ahead) > 3 * lag) live.shown = wanted;
  else live.shown += passed * live.rate * Math.max(0.5, Math.min(2, 1 + 0.3 * ahead / lag));
  live.shown = Math.max(oldest.t, Math.min(newest.t, live.shown));
  return live.shown < newest.t;
}

// The pair of frames around the time that is shown.
const around = { from: null, to: null, share: 0 };
function findAround() {
  const first = Math.max(0, live.received - keptFrames);
  around.from = around.to = live.newest;
  around.share = 1;
  for (let k = live.received - 2; k >= first; --k) {
    const frame = live.frames[k % keptFrames];
    if (around.from.t <= live.shown) break;
    around.to = around.from;
    around.from = frame;
  }
  if (around.to.t > around.from.t) around.share = Math.max(0, Math.min(1, (live.shown - around.from.t) / (around.to.t - around.from.t)));
}

function poseLive() {
  if (!live.newest) return;
  findAround();
  const a = around.from.poses, b = around.to.poses, count = Math.min(motion.bodies.length, around.from.bodies, around.to.bodies);
  for (let i = 0; i < count; ++i) between(motion.bodies[i], a, 7 * i, b, 7 * i, a, 7 * i + 3, b, 7 * i + 3, around.share);
}

// Contacts and the hand's line ---

// A surface of revolution about z, from a profile of [radius, z].
function lathe(profile, sides = 16) {
  const positions = [], indices = [];
  for (const [radius, z] of profile)
    for (let k = 0; k < sides; ++k) positions.push(radius * Math.cos(2 * Math.PI * k / sides), radius * Math.sin(2 * Math.PI * k / sides), z);
  for (let row = 0; row + 1 < profile.length; ++row)
    for (let k = 0; k < sides; ++k) {
      const a = sides * row + k, b = sides * row + (k + 1) % sides;
      indices.push(a, b, a + sides, b, b + sides, a + sides);
    }
  return geometryFrom(new Float32Array(positions), new Uint16Array(indices), null);
}
const shapes = {
  arrow: lathe([[0.045, 0], [0.022, 0.03], [0.022, 0.72], [0.07, 0.72], [0, 1]], 12),
  rod: lathe([[1, 0], [1, 1]], 8),
  knob: lathe([...Array(9).keys()].map(k => [Math.sin(Math.PI * k / 8), -Math.cos(Math.PI * k / 8)])),
};
const paints = { impact: [0.90, 0.06, 0.03], lasts: [0.55, 0.03, 0.28], hand: [0.0, 0.27, 0.62] };  // linear light

// Writes one placement: at a point, the shape's z along a unit vector, its thickness and its length.
function lay(out, index, px, py, pz, nx, ny, nz, thick, long, paint) {
  const o = perInstance * index, flat = Math.abs(nz) < 0.9;
  let ux = flat ? -ny : 0, uy = flat ? nx : -nz, uz = flat ? 0 : ny;  // across n
  const size = Math.hypot(ux, uy, uz) || 1;
  ux /= size; uy /= size; uz /= size;
  const vx = ny * uz - nz * uy, vy = nz * ux - nx * uz, vz = nx * uy - ny * ux;
  out[o] = thick * ux; out[o + 1] = thick * vx; out[o + 2] = long * nx; out[o + 3] = px;
  out[o + 4] = thick * uy; out[o + 5] = thick * vy; out[o + 6] = long * ny; out[o + 7] = py;
  out[o + 8] = thick * uz; out[o + 9] = thick * vz; out[o + 10] = long * nz; out[o + 11] = pz;
  out[o + 12] = paint[0]; out[o + 13] = paint[1]; out[o + 14] = paint[2];
}

const lengthOf = size => 0.8 * live.reach * (live.largest > 0 ? Math.max(0.125, size / live.largest) : 1);

function drawLiveContacts() {
  if (!live.newest) return;
  const frame = around.to, m = frame.marks, v = impacts.values, out = room(shapes.arrow, 2 * mostArrows);
  let count = 0;
  for (let k = 0; k < frame.contacts && count < mostArrows; ++k) {
    const o = 10 * k;
    if (!m[o + 9]) continue;
    const long = lengthOf(Math.hypot(m[o + 6], m[o + 7], m[o + 8]));
    lay(out, count++, m[o], m[o + 1], m[o + 2], m[o + 3], m[o + 4], m[o + 5], long, long, paints.lasts);
  }
  for (let k = 0; k < impacts.count; ++k) {
    const o = 9 * k, long = lengthOf(v[o + 6]);
    if (live.shown >= v[o + 7] - 1e-9 && live.shown < v[o + 8])
      lay(out, count++, v[o], v[o + 1], v[o + 2], v[o + 3], v[o + 4], v[o + 5], long, long, paints.impact);
  }
  if (count) drawMarks(shapes.arrow, transfer(shapes.arrow, count));
}

function drawHand() {
  const line = handLine();
  if (!line) return;
  const { from, to } = line, way = to.map((v, i) => v - from[i]), long = Math.hypot(...way), thick = 0.0022 * camera.distance;
  const n = long > 0 ? way.map(v => v / long) : [0, 0, 1];
  lay(room(shapes.rod, 1), 0, ...from, ...n, thick, long, paints.hand);
  drawMarks(shapes.rod, transfer(shapes.rod, 1));
  room(shapes.knob, 2);
  lay(shapes.knob.placed, 0, ...from, 0, 0, 1, 2.5 * thick, 2.5 * thick, paints.hand);
  lay(shapes.knob.placed, 1, ...to, 0, 0, 1, 4 * thick, 4 * thick, paints.hand);
  drawMarks(shapes.knob, transfer(shapes.knob, 2));
}

// Commands: one after another; of those of a kind that wait (a drag, a slider), only the last ---

let lastCommand = Promise.resolve();
const waitingCommands = new Map();  // kind -> the command to send when its turn comes

async function post(command) {
  try {
    const answer = await fetch(path("command"), { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(command) });
    const told = await answer.json();
    return { ok: answer.ok && told.ok === true, text: String(told.text || ""), restarted: !!told.restarted, rebuilt: !!told.rebuilt, ms: +told.ms || 0, scene: told.scene };
  } catch (error) {
    return { ok: false, text: "The simulation does not answer." };
  }
}

// The answer to a command; what it refuses is shown.
function command(what) {
  const answer = lastCommand.then(() => post(what));
  lastCommand = answer;
  return answer;
}

// The same for the latest of a kind; null where one waits already, which then says this instead.
function latest(kind, what) {
  const waits = waitingCommands.has(kind);
  waitingCommands.set(kind, what);
  if (waits) return null;
  const answer = lastCommand.then(() => { const last = waitingCommands.get(kind); waitingCommands.delete(kind); return post(last); });
  lastCommand = answer;
  return answer;
}

// Sends a command and shows its line if it is refused; of what is done one sees the effect, but for the ball's size and number.
async function order(what) {
  const answer = await command(what);
  if (!answer.ok || (what.do === "throw" && answer.text)) toast(answer.text || "This was refused.", !answer.ok);
  return answer;
}
