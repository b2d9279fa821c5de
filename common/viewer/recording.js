"use strict";
const recording = "MOTION_GLB_BASE64";  // the bytes of motion.glb; empty in the page of a scene that runs
const isLive = recording === "";

// Small things ----------------------------------------------------------------------------------------------

const $ = id => document.getElementById(id);
const parameters = new URLSearchParams(location.search);

function make(tag, properties, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}
const text = (element, value) => { if (element.textContent !== value) element.textContent = value; };  // no layout for nothing

function fail(text) {
  $("message").style.display = "block";
  $("message").textContent = text;
  document.body.dataset.error = text;
}

function bytesOf(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// The page's colours by name, read when the scheme changes: asking the browser in every picture costs more than drawing.
let colours = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["ink", "soft", "line", "mark", "go", "ground"]) colours[name] = style.getPropertyValue("--" + name).trim();
  colours.dark = matchMedia("(prefers-color-scheme: dark)").matches;
  colours.clear = colours.ground.match(/[0-9a-f]{2}/gi).map(v => parseInt(v, 16) / 255);
}

// The last index k with times[k] <= t, at least 0. `from` is where it was last: mostly the answer, or next to it.
function keyBefore(times, t, from) {
  let low = from;
  if (!(times[low] <= t)) low = 0;
  else if (low + 1 >= times.length || times[low + 1] > t) return low;
  let high = times.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle; else high = middle;
  }
  return low;
}

// The recording: a binary glTF file ----------------------------------------------------------------------------

function parse(bytes) {
  const data = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.byteLength < 20 || data.getUint32(0, true) !== 0x46546c67 || data.getUint32(4, true) !== 2)
    throw new Error("this is not a binary glTF 2.0 file");
  if (data.getUint32(8, true) !== bytes.byteLength) throw new Error("the file has been cut off");
  const length = data.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
  const start = bytes.byteOffset + 20 + length + 8;  // behind the second chunk's header
  const width = { SCALAR: 1, VEC3: 3, VEC4: 4 };
  const kinds = { 5126: Float32Array, 5125: Uint32Array, 5123: Uint16Array };
  const accessor = index => {
    const a = json.accessors[index], view = json.bufferViews[a.bufferView];
    return new kinds[a.componentType](bytes.buffer, start + (view.byteOffset || 0), a.count * width[a.type]);
  };
  return { json, accessor };
}

const same = (a, b) => a === b || (a && b && a.length === b.length && a.constructor === b.constructor && a.every((v, i) => v === b[i]));

function geometryFrom(positions, indices, normals) {
  let radius = 0;
  for (let i = 0; i < positions.length; i += 3) radius = Math.max(radius, Math.hypot(positions[i], positions[i + 1], positions[i + 2]));
  return { positions, indices, normals, radius, bodies: [], arrows: [] };
}

// What is drawn: bodies and contact arrows, each with its pose over time; geometries, each with its instances. Geometries
// that are in `known` already are taken from there: a ball that is thrown sends no mesh to the graphics card again.
function load(bytes, known = []) {
  const { json, accessor } = parse(bytes), extras = json.scenes[0].extras || {};
  const tracks = new Map();  // node -> its animated properties
  for (const { sampler, target } of json.animations && !isLive ? json.animations[0].channels : []) {
    const s = json.animations[0].samplers[sampler];
    if (!tracks.has(target.node)) tracks.set(target.node, {});
    tracks.get(target.node)[target.path] = { times: accessor(s.input), values: accessor(s.output) };
  }
  const geometries = new Map();
  const geometryOf = (mesh, colourToo) => {
    const p = json.meshes[mesh].primitives[0], key = p.attributes.POSITION + "/" + p.indices;
    if (!geometries.has(key)) {
      const positions = accessor(p.attributes.POSITION);
      const indices = accessor(p.indices), normals = p.attributes.NORMAL === undefined ? null : accessor(p.attributes.NORMAL);
      const old = known.find(g => same(g.positions, positions) && same(g.indices, indices) && same(g.normals, normals));
      geometries.set(key, old || geometryFrom(positions, indices, normals));
      geometries.get(key).bodies = [];
      geometries.get(key).arrows = [];
    }
    const geometry = geometries.get(key);
    if (!colourToo) return geometry;
    const paint = json.materials[p.material].pbrMetallicRoughness.baseColorFactor;
    return { geometry, colour: paint.slice(0, 3) };
  };
  const bodies = [], contacts = [];
  json.nodes.forEach((node, index) => {
    if (node.mesh === undefined) return;
    const item = {
      name: node.name, track: tracks.get(index) || null, cursor: 0, static: !!(node.extras && node.extras.static), veiled: false, lit: 0,
      position: Float32Array.from(node.translation || [0, 0, 0]), turn: Float32Array.from(node.rotation || [0, 0, 0, 1]),
      scale: node.scale ? node.scale[0] : 1, ...geometryOf(node.mesh, true),
    };
    item.contact = node.name.startsWith("contact_");
    item.moves = isLive ? !item.static : item.track !== null;
    (item.contact ? contacts : bodies).push(item);
    (item.contact ? item.geometry.arrows : item.geometry.bodies).push(item);
  });
  const levels = (extras.levels || []).map(l => ({ ...l, geometry: geometryOf(l.mesh, false), items: l.bodies.map(i => bodies[i]) }));
  const frameTimes = extras.frame_times === undefined ? new Float32Array([0]) : accessor(extras.frame_times);
  return {
    extras, bodies, contacts, levels, algorithm: (json.extras || {}).algorithm || [], anyMoves: bodies.some(b => b.moves), frameTimes, duration: frameTimes[frameTimes.length - 1],
    geometries: [...new Set(geometries.values())],
    impacts: extras.impact_times === undefined ? new Float32Array(0) : accessor(extras.impact_times),
    series: fromLowestPotential((extras.series || []).map(s => ({ ...s, values: accessor(s.values) }))),
  };
}

// Potential energy counts from the lowest of the run: where the scene's z is 0 says nothing. A kinetic energy that is
// small even so has axes of its own.
function fromLowestPotential(series) {
  const potential = series.find(s => s.name === "potential"), kinetic = series.find(s => s.name === "kinetic");
  if (!potential) return series;
  const lowest = potential.values.reduce((a, b) => Math.min(a, b), Infinity);
  for (const s of series)
    if (s.name === "potential" || s.name === "total") {
      s.values = s.values.map(v => v - lowest);
      s.rounding = 1e-6 * Math.abs(lowest);
      s.remark = `zero is the lowest potential, ${short(lowest)} J`;
    }
  const most = values => values.reduce((a, b) => Math.max(a, b), 0), ofTotal = most(potential.values);
  if (kinetic && most(kinetic.values) < 0.1 * ofTotal) kinetic.group = "kinetic";
  return series;
}

// Sets an item's pose to that of time t: bodies move evenly from key to key, contacts jump.
function pose(item, t) {
  if (!item.track) return;
  const { translation, rotation, scale } = item.track, times = translation.times;
  const k = item.cursor = keyBefore(times, t, item.cursor);
  const last = item.contact || k + 1 >= times.length || t <= times[k];
  const s = last ? 0 : (t - times[k]) / (times[k + 1] - times[k]), next = last ? k : k + 1;
  const p = translation.values, q = rotation.values;
  between(item, p, 3 * k, p, 3 * next, q, 4 * k, q, 4 * next, s);
  if (scale) item.scale = scale.values[3 * k];
}

// The pose between two: positions of `p` from index `pi` and of `n` from `ni`, quaternions of `q` and `r` in the same way, the
// shorter way round.
function between(item, p, pi, n, ni, q, qi, r, ri, s) {
  for (let i = 0; i < 3; ++i) item.position[i] = p[pi + i] * (1 - s) + n[ni + i] * s;
  let dot = 0;
  for (let i = 0; i < 4; ++i) dot += q[qi + i] * r[ri + i];
  const angle = Math.acos(Math.min(1, Math.abs(dot))), sine = Math.sin(angle);
  const a = sine > 1e-6 ? Math.sin((1 - s) * angle) / sine : 1 - s;
  const b = (sine > 1e-6 ? Math.sin(s * angle) / sine : s) * (dot < 0 ? -1 : 1);
  for (let i = 0; i < 4; ++i) item.turn[i] = a * q[qi + i] + b * r[ri + i];
}

