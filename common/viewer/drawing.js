// Drawing --------------------------------------------------------------------------------------------------------

const gl = $("scene").getContext("webgl2", { alpha: false, antialias: true, preserveDrawingBuffer: true });

const vertexShader = `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 row0;
layout(location = 3) in vec4 row1;
layout(location = 4) in vec4 row2;
layout(location = 5) in vec4 paint;
uniform mat4 view;
out vec3 at, facing, colour;
void main() {
  vec4 p = vec4(position, 1.0);
  at = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
  facing = vec3(dot(row0.xyz, normal), dot(row1.xyz, normal), dot(row2.xyz, normal));
  colour = paint.rgb;
  gl_Position = view * vec4(at, 1.0);
}`;
const fragmentShader = `#version 300 es
precision highp float;
in vec3 at, facing, colour;
uniform vec3 eye, light;
uniform float flatness, alpha, glow;
out vec4 result;
void main() {
  vec3 toEye = normalize(eye - at);
  vec3 own = dot(facing, facing) > 0.0 ? facing : toEye;  // lines have no normals
  vec3 n = normalize(flatness > 0.5 ? cross(dFdx(at), dFdy(at)) : own);
  if (dot(n, toEye) < 0.0) n = -n;
  float key = max(dot(n, light), 0.0), sky = 0.5 + 0.5 * n.z;
  float rim = pow(1.0 - max(dot(n, toEye), 0.0), 3.0);
  vec3 lit = colour * (0.22 + 0.24 * sky + 0.72 * key) + vec3(0.10) * rim;
  result = vec4(pow(clamp(mix(lit, colour, glow), 0.0, 1.0), vec3(1.0 / 2.2)), alpha);
}`;

function program() {
  const p = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(p, shader);
  }
  gl.linkProgram(p);
  if (!gl.getProgramParameter(p, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(p));
  const uniforms = {};
  for (const name of ["view", "eye", "light", "flatness", "alpha", "glow"]) uniforms[name] = gl.getUniformLocation(p, name);
  gl.useProgram(p);
  return uniforms;
}

const perInstance = 16;  // floats: three rows of the placement, the colour

// The geometry's own buffers, and one for its instances' placements.
function upload(geometry) {
  if (geometry.array) return;
  geometry.buffers = [];
  const buffer = () => { geometry.buffers.push(gl.createBuffer()); return geometry.buffers[geometry.buffers.length - 1]; };
  const attribute = (place, values) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer());
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
  };
  geometry.array = gl.createVertexArray();
  gl.bindVertexArray(geometry.array);
  attribute(0, geometry.positions);
  if (geometry.normals) attribute(1, geometry.normals);
  geometry.instances = buffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, geometry.instances);
  for (let k = 0; k < 4; ++k) {
    gl.enableVertexAttribArray(2 + k);
    gl.vertexAttribPointer(2 + k, 4, gl.FLOAT, false, 4 * perInstance, 16 * k);
    gl.vertexAttribDivisor(2 + k, 1);
  }
  geometry.faces = buffer();
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, geometry.faces);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, geometry.indices, gl.STATIC_DRAW);
  geometry.type = geometry.indices instanceof Uint16Array ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT;
}

function forget(geometry) {
  geometry.buffers.forEach(b => gl.deleteBuffer(b));
  gl.deleteVertexArray(geometry.array);
}

// Every edge once, when a wireframe is first asked for.
function uploadEdges(geometry) {
  if (geometry.edges) return;
  const ends = [], seen = new Set(), n = geometry.positions.length / 3;
  for (let i = 0; i < geometry.indices.length; i += 3)
    for (let k = 0; k < 3; ++k) {
      const a = geometry.indices[i + k], b = geometry.indices[i + (k + 1) % 3], key = Math.min(a, b) * n + Math.max(a, b);
      if (!seen.has(key)) { seen.add(key); ends.push(a, b); }
    }
  geometry.edges = gl.createBuffer();
  geometry.buffers.push(geometry.edges);
  geometry.edgeEnds = ends.length;
  gl.bindVertexArray(geometry.array);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, geometry.edges);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint32Array(ends), gl.STATIC_DRAW);
}

// Room for the placements of this many instances.
function room(geometry, count) {
  if (!geometry.placed || geometry.placed.length < perInstance * count) geometry.placed = new Float32Array(perInstance * Math.ceil(1.5 * count));
  return geometry.placed;
}

// Hands the first `count` placements to the graphics card.
function transfer(geometry, count) {
  gl.bindVertexArray(geometry.array);
  gl.bindBuffer(gl.ARRAY_BUFFER, geometry.instances);
  gl.bufferData(gl.ARRAY_BUFFER, geometry.placed, gl.STREAM_DRAW, 0, perInstance * count);
  return count;
}

// Writes the placements of items into the geometry's instance buffer: of those that are veiled, or are not, or (null) of all;
// returns how many there are.
function place(geometry, items, veiled) {
  if (!items.length) return 0;
  const out = room(geometry, items.length);
  let count = 0;
  for (let i = 0; i < items.length; ++i) {
    const item = items[i];
    if (!(item.scale > 0) || (veiled !== null && item.veiled !== veiled)) continue;
    const x = item.turn[0], y = item.turn[1], z = item.turn[2], w = item.turn[3], s = item.scale, o = perInstance * count++;
    out[o] = s * (1 - 2 * (y * y + z * z)); out[o + 1] = s * 2 * (x * y - z * w); out[o + 2] = s * 2 * (x * z + y * w);
    out[o + 4] = s * 2 * (x * y + z * w); out[o + 5] = s * (1 - 2 * (x * x + z * z)); out[o + 6] = s * 2 * (y * z - x * w);
    out[o + 8] = s * 2 * (x * z - y * w); out[o + 9] = s * 2 * (y * z + x * w); out[o + 10] = s * (1 - 2 * (x * x + y * y));
    for (let k = 0; k < 3; ++k) { out[o + 4 * k + 3] = item.position[k]; out[o + 12 + k] = item.colour[k] * (1 - item.lit) + item.lit; }
  }
  return count ? transfer(geometry, count) : 0;
}

function drawFaces(geometry, count) {
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, geometry.faces);
  gl.uniform1f(uniforms.flatness, geometry.normals ? 0 : 1);
  gl.drawElementsInstanced(gl.TRIANGLES, geometry.indices.length, geometry.type, 0, count);
}
function drawEdges(geometry, count) {
  uploadEdges(geometry);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, geometry.edges);
  gl.uniform1f(uniforms.flatness, 0);
  gl.drawElementsInstanced(gl.LINES, geometry.edgeEnds, gl.UNSIGNED_INT, 0, count);
}
// How opaque, and how far the plain colour replaces the lit one.
const look = (alpha, glow) => { gl.uniform1f(uniforms.alpha, alpha); gl.uniform1f(uniforms.glow, glow); };

// The camera looks at `target` from `distance`; z is up.
const camera = { target: [0, 0, 0], distance: 5, yaw: -0.9, pitch: 0.35, follow: null };

// The box of what moves, and of the contacts. A few bodies that run away from all others do not count: of what lies
// three times as far out as six in ten of all places do, nothing is looked at.
function box(until) {
  const moving = motion.bodies.filter(b => b.moves), places = [];
  for (const body of moving.length ? moving : motion.bodies)
    for (let k = 0; k <= 12; ++k) {
      pose(body, until * k / 12);
      places.push({ at: [...body.position], radius: body.geometry.radius });
    }
  const points = motion.contacts.flatMap(({ track: { translation: { times, values } } }) =>
    [...times.keys()].filter(k => times[k] <= until).map(k => ({ at: values.slice(3 * k, 3 * k + 3), radius: 0 })));
  const stride = Math.ceil(points.length / places.length) || 1;
  places.push(...points.filter((_, k) => k % stride === 0));
  const quantile = (values, share) => values.sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(share * values.length))];
  const middle = [0, 1, 2].map(i => quantile(places.map(p => p.at[i]), 0.5));
  const reach = p => Math.hypot(...p.at.map((v, i) => v - middle[i])) + p.radius;
  const limit = moving.length < 3 ? Infinity : 3 * quantile(places.map(reach), 0.6);
  const seen = places.filter(p => reach(p) <= limit);
  return [-1, 1].map(side => [0, 1, 2].map(i => seen.reduce((most, p) => side * Math.max(side * most, side * p.at[i] + p.radius), -side * Infinity)));
}

function frameView() {
  const until = motion.impacts.length ? Math.min(motion.duration, 1.25 * motion.impacts[motion.impacts.length - 1]) : motion.duration;
  const [low, high] = box(until);
  camera.target = low.map((v, i) => 0.5 * (v + high[i]));
  camera.distance = (isLive ? 1.6 : 1.3) * Math.max(1e-3, Math.hypot(...low.map((v, i) => high[i] - v)));
  camera.yaw = -0.9; camera.pitch = 0.35; camera.follow = null;
  // Look at the longest way from the side.
  const size = low.map((v, i) => high[i] - v);
  if (size[0] > 1.5 * size[1]) camera.yaw = -1.25;
  if (size[1] > 1.5 * size[0]) camera.yaw = -0.3;
}

function eyeOf() {
  const { yaw, pitch, distance, target } = camera;
  return [target[0] + distance * Math.cos(pitch) * Math.cos(yaw), target[1] + distance * Math.cos(pitch) * Math.sin(yaw),
          target[2] + distance * Math.sin(pitch)];
}
// Right, up and backward of the camera.
function cameraAxes() {
  const { yaw, pitch } = camera;
  return [[-Math.sin(yaw), Math.cos(yaw), 0],
          [-Math.sin(pitch) * Math.cos(yaw), -Math.sin(pitch) * Math.sin(yaw), Math.cos(pitch)],
          [Math.cos(pitch) * Math.cos(yaw), Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch)]];
}
const dot3 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

function viewMatrix(aspect) {
  const [r, u, b] = cameraAxes(), e = eyeOf(), f = Math.min(1, aspect) / Math.tan(0.35), near = 0.02 * camera.distance, far = 40 * camera.distance;
  const p = (far + near) / (near - far), q = 2 * far * near / (near - far);
  const rows = [r, u, b].map(axis => [...axis, -dot3(axis, e)]);
  const matrix = new Float32Array(16);  // projection times view, by columns
  for (let c = 0; c < 4; ++c) {
    matrix[4 * c] = f / aspect * rows[0][c];
    matrix[4 * c + 1] = f * rows[1][c];
    matrix[4 * c + 2] = p * rows[2][c] + (c === 3 ? q : 0);
    matrix[4 * c + 3] = -rows[2][c];
  }
  return matrix;
}

function fit(canvas) {
  const ratio = Math.min(2, devicePixelRatio || 1), w = Math.round(canvas.clientWidth * ratio), h = Math.round(canvas.clientHeight * ratio);
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  return ratio;
}

// Whether a body that never moves stands between the eye and what it looks at, as the wall of a pit does. Fine meshes are
// not asked.
function hides(item, eye) {
  if (item.moves || !motion.anyMoves || item.geometry.indices.length > 15000) return false;
  return meets(item, eye, [camera.target[0] - eye[0], camera.target[1] - eye[1], camera.target[2] - eye[2]]) < 1;
}

// See-through things: seen from both sides, and hiding nothing.
function glass(on) {
  if (on) gl.enable(gl.BLEND); else gl.disable(gl.BLEND);
  gl.depthMask(!on);
}

// What marks contacts: faintly through everything, then where it is in sight.
function drawMarks(geometry, count) {
  if (!count) return;
  gl.enable(gl.BLEND); gl.disable(gl.DEPTH_TEST);
  look(0.45, 0.85);
  drawFaces(geometry, count);
  gl.disable(gl.BLEND); gl.enable(gl.DEPTH_TEST);
  look(1, 0.6);
  drawFaces(geometry, count);
}

function clearPicture() {
  const [ground0, ground1, ground2] = colours.clear;
  fit($("scene"));
  gl.clearColor(ground0, ground1, ground2, 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
}

// The camera and the light, for a picture that begins `from` pixels from the left.
function beginPicture(eye, from, width) {
  const { height } = $("scene");
  gl.viewport(from, 0, width, height);
  const [right, up, back] = cameraAxes();
  const light = back.map((v, i) => 0.55 * v + 0.35 * up[i] - 0.45 * right[i] + (i === 2 ? 0.45 : 0));
  const size = Math.hypot(...light);
  gl.uniformMatrix4fv(uniforms.view, false, viewMatrix(width / height));
  gl.uniform3fv(uniforms.eye, eye);
  gl.uniform3fv(uniforms.light, light.map(v => v / size));
  gl.enable(gl.DEPTH_TEST);
  gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
}

function drawBodies(hulls) {
  // First what is opaque; what hides the rest is drawn last, so that all else shines through.
  for (const veiled of [false, true])
    for (const geometry of motion.geometries) {
      const count = place(geometry, geometry.bodies, veiled), clear = now.xray || hulls.length > 0 || algorithm.open || veiled;
      if (!count) continue;
      if (now.wire) {
        look(1, geometry.normals ? 0.7 : 1);
        drawEdges(geometry, count);
        continue;
      }
      glass(clear);
      look(clear ? 0.28 : 1, 0);
      drawFaces(geometry, count);
      glass(false);
    }
  for (const { items, geometry } of hulls) {
    const count = place(geometry, items, null);
    if (!count) continue;
    glass(true);
    look(0.10, 0.5);
    drawFaces(geometry, count);
    look(0.3, 0.7);
    drawEdges(geometry, count);
    glass(false);
  }
}

// One picture; of two copies one in each half, from the same eye.
function drawScene() {
  if (isLive) poseLive(live);
  else {
    for (const item of motion.bodies) pose(item, now.time);
    for (const item of motion.contacts) pose(item, now.time);
  }
  if (algorithm.open) poseStep();
  if (camera.follow) camera.target = [...camera.follow.position];
  clearPicture();
  const eye = eyeOf(), { width } = $("scene");
  if (isSplit()) {
    const half = width >> 1;
    poseLive(twin);
    drawSide(twin, eye, half, width - half);
    poseLive(live);  // last: what is asked later is of the scene
    drawSide(live, eye, 0, half);
  } else {
    drawSide(live, eye, 0, width);
  }
}

// A picture of the poses that the bodies have.
function drawSide(side, eye, from, width) {
  beginPicture(eye, from, width);
  for (const item of motion.bodies) item.veiled = hides(item, eye);
  drawBodies(now.level < 0 ? [] : motion.levels.filter(l => l.level === now.level));
  if (algorithm.open) return drawStep();
  if (isLive) drawHand(side);
  if (!now.arrows) return;
  if (isLive) drawLiveContacts(side);
  for (const geometry of motion.geometries) drawMarks(geometry, place(geometry, geometry.arrows, false));
}

function drawAxes() {
  const canvas = $("axes"), ratio = fit(canvas), pen = canvas.getContext("2d"), [right, up] = cameraAxes();
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, 72, 72);
  pen.font = "11px system-ui, sans-serif";
  pen.textAlign = "center"; pen.textBaseline = "middle"; pen.lineWidth = 2;
  [["x", "#d23b1a"], ["y", "#1f8a4c"], ["z", "#2f6fd0"]].forEach(([name, colour], i) => {
    pen.strokeStyle = pen.fillStyle = colour;
    pen.beginPath(); pen.moveTo(36, 36); pen.lineTo(36 + 22 * right[i], 36 - 22 * up[i]); pen.stroke();
    pen.fillText(name, 36 + 30 * right[i], 36 - 30 * up[i]);
  });
}

