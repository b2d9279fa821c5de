// Frames of a running scene --------------------------------------------------------------------------------------------------
// The stream brings those of the scene and, while there are two copies, those of the copy: each is a side. A frame's numbers stay
// in arrays that are used again: nothing is allocated for a body or a contact.

const keptFrames = 8;       // of the stream, the newest; between two of them bodies are drawn
const lagFrames = 1.25;     // how far behind the newest frame is drawn: one frame to move in, and a quarter for uneven arrival
const holdFrames = 6;       // for how long an impact's arrow is seen, as in a recording
const mostArrows = 2000;    // of contacts that last, and as many of impacts

function newSide() {
  return {
    frames: [], received: 0, newest: null, before: null,  // the ring, and its last two
    around: { from: null, to: null, share: 0 },           // the two frames of the time that is shown, and where between them
    // Impacts of the last frames: point, normal, size of the impulse, and from when until when they are seen.
    impacts: { values: new Float64Array(9 * mostArrows), next: 0, count: 0 },
    largest: 0,  // N s
  };
}

function emptyFrame() {
  return { geometry: 0, frame: 0, t: 0, flags: 0, bodies: 0, contacts: 0, grabbed: -1, arrived: 0, poses: new Float32Array(0),
           marks: new Float32Array(0), hand: new Float32Array(6) };
}

// Takes a frame whose head begins at `at`, of a message that ends at `length`, into a side's ring. Whether the side began again.
function keepFrame(side, bytes, at, length) {
  const head = new DataView(bytes.buffer, at, 32), last = side.newest;
  const number = head.getUint32(4, true), bodies = head.getUint32(20, true), contacts = head.getUint32(24, true), grabbed = head.getInt32(28, true);
  if (length !== at + 32 + 28 * bodies + 40 * contacts + (grabbed >= 0 ? 24 : 0)) throw new Error(`a frame of ${bodies} bodies has ${length} bytes`);
  const t = head.getFloat64(8, true), again = last !== null && (number < last.frame || t < last.t);
  if (again) forgetFrames(side);
  else if (last && number === last.frame) --side.received;  // the same frame, told once more
  const frame = side.frames[side.received % keptFrames] || (side.frames[side.received % keptFrames] = emptyFrame());
  const old = last && !again && number === last.frame;
  side.received++;
  if (frame.poses.length < 7 * bodies) frame.poses = new Float32Array(7 * bodies);
  if (frame.marks.length < 10 * contacts) frame.marks = new Float32Array(20 * contacts);
  frame.poses.set(new Float32Array(bytes.buffer, at + 32, 7 * bodies));
  frame.marks.set(new Float32Array(bytes.buffer, at + 32 + 28 * bodies, 10 * contacts));
  if (grabbed >= 0) frame.hand.set(new Float32Array(bytes.buffer, at + 32 + 28 * bodies + 40 * contacts, 6));
  frame.geometry = head.getUint32(0, true); frame.frame = number; frame.t = t; frame.flags = head.getUint32(16, true);
  frame.bodies = bodies; frame.contacts = contacts; frame.grabbed = grabbed; frame.arrived = performance.now();
  side.newest = frame;
  side.before = side.received > 1 ? side.frames[(side.received - 2) % keptFrames] : frame;
  if (!old) rememberImpacts(side, frame);
  return again;
}

function forgetFrames(side) {
  side.received = 0; side.newest = side.before = null;
  side.largest = 0;
  side.impacts.next = side.impacts.count = 0;
}

function rememberImpacts(side, frame) {
  const dt = live.state ? live.state.dt : frame.t - side.before.t || 1 / 60, { impacts } = side;
  side.largest *= 0.998;  // a hard blow makes the others' arrows short only for a while
  for (let k = 0; k < frame.contacts; ++k) {
    const o = 10 * k, m = frame.marks, size = Math.hypot(m[o + 6], m[o + 7], m[o + 8]);
    side.largest = Math.max(side.largest, size);
    if (m[o + 9]) continue;
    const to = 9 * (impacts.next++ % mostArrows);
    for (let i = 0; i < 6; ++i) impacts.values[to + i] = m[o + i];
    impacts.values[to + 6] = size; impacts.values[to + 7] = frame.t; impacts.values[to + 8] = frame.t + holdFrames * dt;
  }
  impacts.count = Math.min(mostArrows, impacts.next);
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

// The pair of a side's frames around the time that is shown. The copy's frame may be another, and its newest ahead of it.
function findAround(side) {
  const first = Math.max(0, side.received - keptFrames), { around } = side;
  around.from = around.to = side.newest;
  around.share = 1;
  for (let k = side.received - 2; k >= first; --k) {
    const frame = side.frames[k % keptFrames];
    if (around.from.t <= live.shown) break;
    around.to = around.from;
    around.from = frame;
  }
  if (around.to.t > around.from.t) around.share = Math.max(0, Math.min(1, (live.shown - around.from.t) / (around.to.t - around.from.t)));
}

// Puts the bodies where a side has them.
function poseLive(side) {
  if (!side.newest) return;
  findAround(side);
  const { from, to, share } = side.around, a = from.poses, b = to.poses, count = Math.min(motion.bodies.length, from.bodies, to.bodies);
  for (let i = 0; i < count; ++i) between(motion.bodies[i], a, 7 * i, b, 7 * i, a, 7 * i + 3, b, 7 * i + 3, share);
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

const lengthOf = (side, size) => 0.8 * live.reach * (side.largest > 0 ? Math.max(0.125, size / side.largest) : 1);

function drawLiveContacts(side) {
  if (!side.newest) return;
  const { impacts } = side, frame = side.around.to, m = frame.marks, v = impacts.values, out = room(shapes.arrow, 2 * mostArrows);
  let count = 0;
  for (let k = 0; k < frame.contacts && count < mostArrows; ++k) {
    const o = 10 * k;
    if (!m[o + 9]) continue;
    const long = lengthOf(side, Math.hypot(m[o + 6], m[o + 7], m[o + 8]));
    lay(out, count++, m[o], m[o + 1], m[o + 2], m[o + 3], m[o + 4], m[o + 5], long, long, paints.lasts);
  }
  for (let k = 0; k < impacts.count; ++k) {
    const o = 9 * k, long = lengthOf(side, v[o + 6]);
    if (live.shown >= v[o + 7] - 1e-9 && live.shown < v[o + 8])
      lay(out, count++, v[o], v[o + 1], v[o + 2], v[o + 3], v[o + 4], v[o + 5], long, long, paints.impact);
  }
  if (count) drawMarks(shapes.arrow, transfer(shapes.arrow, count));
}

function drawHand(side) {
  const line = handLine(side);
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

