// What a step of the algorithm draws -----------------------------------------------------------------------------------------
// Meshes and planes are drawn by the graphics card, see-through; points, lines, arrows and labels on a canvas above it, whatever lies
// before them. All of it is made ready once for a step, and placed anew in each picture.

// The drawings' colours (plots/style.py), of bodies A and B, the accent, …; brighter ones on a dark ground.
const roleColours = {
  light: { a: "#0072b2", b: "#c47f00", now: "#d55e00", past: "#767676", good: "#00845f", bad: "#b0003a", force: "#a3478a" },
  dark: { a: "#56b4e9", b: "#f0b429", now: "#ff8a3d", past: "#9aa3b5", good: "#2fcf9f", bad: "#ff5c86", force: "#e79fcb" },
};
const roleColour = role => roleColours[colours.dark ? "dark" : "light"][role] || colours.ink;
const linear = hex => [1, 3, 5].map(k => (parseInt(hex.slice(k, k + 2), 16) / 255) ** 2.2);

const marks = { list: [], solids: [], low: [0, 0, 0], high: [0, 0, 0] };  // low, high: of all that is drawn, m

const pointsOf = mark => mark.kind === "line" || mark.kind === "mesh" ? mark.points : mark.kind === "arrow" ? [mark.from, mark.to] : [mark.at];

// Two axes across a normal.
function acrossOf(n) {
  const helper = Math.abs(n[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0], size = Math.hypot(...n) || 1, m = n.map(v => v / size);
  const u = [helper[1] * m[2] - helper[2] * m[1], helper[2] * m[0] - helper[0] * m[2], helper[0] * m[1] - helper[1] * m[0]], long = Math.hypot(...u);
  const first = u.map(v => v / long);
  return [first, [m[1] * first[2] - m[2] * first[1], m[2] * first[0] - m[0] * first[2], m[0] * first[1] - m[1] * first[0]]];
}
function circle({ at, normal, radius }, sides = 48) {
  const [u, v] = acrossOf(normal);
  return [...Array(sides).keys()].map(k => {
    const c = radius * Math.cos(2 * Math.PI * k / sides), s = radius * Math.sin(2 * Math.PI * k / sides);
    return at.map((p, i) => p + c * u[i] + s * v[i]);
  });
}

function solidOf(points, triangles, role, edges) {
  const geometry = geometryFrom(new Float32Array(points.flat()), new Uint32Array(triangles.flat()), null);
  upload(geometry);
  return { geometry, role, edges };
}

function prepareMarks(list) {
  marks.solids.forEach(s => forget(s.geometry));
  marks.list = list;
  marks.solids = [];
  for (const mark of list) {
    if (mark.kind === "mesh") marks.solids.push(solidOf(mark.points, mark.triangles, mark.role, true));
    if (mark.kind === "plane") {
      mark.ring = circle(mark);
      marks.solids.push(solidOf([mark.at, ...mark.ring], mark.ring.map((_, k) => [0, 1 + k, 1 + (k + 1) % mark.ring.length]), mark.role, false));
    }
  }
  Object.assign(marks, extentOf(list));
}

// The box of all that is drawn, m.
function extentOf(list) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const mark of list)
    for (const point of mark.kind === "plane" ? circle(mark, 8) : pointsOf(mark))
      for (let i = 0; i < 3; ++i) { low[i] = Math.min(low[i], point[i]); high[i] = Math.max(high[i], point[i]); }
  return { low, high };
}

// One instance, whose axes are the world's.
function placeInWorld(geometry, paint) {
  const out = room(geometry, 1).fill(0, 0, perInstance);
  out[0] = out[5] = out[10] = 1;
  out.set(paint, 12);
  return transfer(geometry, 1);
}

// See-through solids, after the bodies.
function drawStep() {
  for (const { geometry, role, edges } of marks.solids) {
    const count = placeInWorld(geometry, linear(roleColour(role)));
    glass(true);
    look(edges ? 0.16 : 0.26, 0.75);
    drawFaces(geometry, count);
    if (edges) { look(0.55, 1); drawEdges(geometry, count); }
    glass(false);
  }
}

// The canvas above -----

const pen = { context: null, matrix: null, w: 0, h: 0, a: new Float64Array(4), b: new Float64Array(4) };

function toClip(p, out) {
  const m = pen.matrix;
  for (let r = 0; r < 4; ++r) out[r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
  return out[3] > 0 && out[2] > -out[3];
}
const xOf = c => pen.w * (0.5 + 0.5 * c[0] / c[3]), yOf = c => pen.h * (0.5 - 0.5 * c[1] / c[3]);

// Appends a piece of a line to the path, cut off where it comes behind the eye.
function trace(p, q) {
  const { a, b, context } = pen, before = toClip(p, a), after = toClip(q, b);
  if (!before && !after) return;
  if (before !== after) {
    const out = before ? b : a, inside = before ? a : b, far = out[2] + out[3], s = far / (far - (inside[2] + inside[3])) + 1e-6;
    for (let i = 0; i < 4; ++i) out[i] += s * (inside[i] - out[i]);
  }
  context.moveTo(xOf(a), yOf(a));
  context.lineTo(xOf(b), yOf(b));
}

// A path with a rim in the ground's colour, so that it is seen on all colours.
function inked(role, width, dashed) {
  const { context } = pen;
  context.lineCap = context.lineJoin = "round";
  context.setLineDash([]);
  context.strokeStyle = colours.ground; context.lineWidth = width + 2.5; context.globalAlpha = 0.75;
  context.stroke();
  context.setLineDash(dashed ? [6, 6] : []);
  context.strokeStyle = roleColour(role); context.lineWidth = width; context.globalAlpha = 1;
  context.stroke();
  context.setLineDash([]);
}
const widthOf = role => role === "now" ? 3 : role === "past" ? 1.5 : 2.2;

function drawPolyline(points, closed, role, width) {
  pen.context.beginPath();
  for (let k = 0; k + 1 < points.length; ++k) trace(points[k], points[k + 1]);
  if (closed && points.length > 2) trace(points[points.length - 1], points[0]);
  inked(role, width, role === "bad");
}

function drawPoint(at, role) {
  if (!toClip(at, pen.a)) return;
  const { context } = pen, x = xOf(pen.a), y = yOf(pen.a), r = role === "now" ? 6 : role === "past" ? 3.5 : 5;
  context.beginPath();
  if (role === "bad") {  // a cross: refused
    context.moveTo(x - r, y - r); context.lineTo(x + r, y + r); context.moveTo(x - r, y + r); context.lineTo(x + r, y - r);
    return inked(role, 2.5, false);
  }
  context.arc(x, y, r, 0, 2 * Math.PI);
  context.fillStyle = roleColour(role); context.strokeStyle = colours.ground; context.lineWidth = 2;
  context.fill(); context.stroke();
}

function drawArrow(from, to, role) {
  drawPolyline([from, to], false, role, widthOf(role));
  if (!toClip(from, pen.a) || !toClip(to, pen.b)) return;
  const { context } = pen, x = xOf(pen.b), y = yOf(pen.b), dx = x - xOf(pen.a), dy = y - yOf(pen.a), long = Math.hypot(dx, dy);
  if (long < 4) return;
  const head = Math.min(13, 0.6 * long), ux = dx / long * head, uy = dy / long * head;
  context.beginPath();
  context.moveTo(x, y); context.lineTo(x - ux - 0.42 * uy, y - uy + 0.42 * ux); context.lineTo(x - ux + 0.42 * uy, y - uy - 0.42 * ux); context.closePath();
  context.fillStyle = roleColour(role);
  context.fill();
}

// Where a label is tried, from its point: sideways, upwards, then farther away.
const labelPlaces = [10, 26, 46, 70].flatMap(r => [[1, -0.7], [1, 0.7], [-1, -0.7], [-1, 0.7], [0, -1], [0, 1], [1, 0], [-1, 0]].map(([x, y]) => [r * x, r * y]));
const overlap = (a, b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];

function drawLabel({ at, text: words }, boxes) {
  if (!toClip(at, pen.a)) return;
  const { context, w, h } = pen, x = xOf(pen.a), y = yOf(pen.a);
  if (x < 0 || x > w || y < 0 || y > h) return;
  const wide = context.measureText(words).width + 10, tall = 20;
  let best = null, least = Infinity;
  for (const [dx, dy] of labelPlaces) {
    const left = Math.max(2, Math.min(w - wide - 2, x + dx - (dx > 0 ? 0 : dx < 0 ? wide : wide / 2))), top = Math.max(2, Math.min(h - tall - 2, y + dy - tall / 2));
    const box = [left, top, left + wide, top + tall], hits = boxes.reduce((sum, other) => sum + overlap(box, other), 0);
    if (hits < least) { best = box; least = hits; }
    if (!hits) break;
  }
  boxes.push(best);
  const [left, top, right, bottom] = best, nx = Math.max(left, Math.min(right, x)), ny = Math.max(top, Math.min(bottom, y));
  if (Math.hypot(nx - x, ny - y) > 14) {  // far from its point: a line leads there
    context.strokeStyle = colours.soft; context.lineWidth = 1;
    context.beginPath(); context.moveTo(x, y); context.lineTo(nx, ny); context.stroke();
  }
  context.globalAlpha = 0.88; context.fillStyle = colours.ground;
  context.beginPath(); context.roundRect(left, top, wide, tall, 4); context.fill();
  context.globalAlpha = 1; context.fillStyle = colours.ink;
  context.fillText(words, left + 5, top + tall / 2 + 0.5);
}

// Adds small boxes along a line of few pieces.
function keepClear(points, boxes) {
  if (points.length > 5) return;
  for (let k = 0; k + 1 < points.length; ++k) {
    if (!toClip(points[k], pen.a) || !toClip(points[k + 1], pen.b)) continue;
    const x = xOf(pen.a), y = yOf(pen.a), dx = xOf(pen.b) - x, dy = yOf(pen.b) - y, count = Math.min(60, Math.ceil(Math.hypot(dx, dy) / 16));
    for (let i = 1; i < count; ++i) boxes.push([x + dx * i / count - 1, y + dy * i / count - 1, x + dx * i / count + 1, y + dy * i / count + 1]);
  }
}

// All that is not solid: what was before lies below, what this step adds above, labels last.
const layers = [["past"], ["a", "b", "good", "bad", "force"], ["now"]];
function drawOverlay() {
  const canvas = $("marks");
  canvas.hidden = !algorithm.open;
  if (!algorithm.open) return;
  const ratio = fit(canvas), context = canvas.getContext("2d");
  Object.assign(pen, { context, w: canvas.width / ratio, h: canvas.height / ratio, matrix: viewMatrix(canvas.width / canvas.height) });
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, pen.w, pen.h);
  context.font = "13px system-ui, sans-serif"; context.textBaseline = "middle"; context.textAlign = "left";
  const boxes = [[pen.w - 90, 0, pen.w, 90]];  // what labels keep clear of: the axes, points, and lines
  for (const roles of layers)
    for (const mark of marks.list) {
      const { kind, role } = mark;
      if (kind === "label" || !roles.includes(role)) continue;
      if (kind === "plane") drawPolyline(mark.ring, true, role, 1.5);
      if (kind === "line") drawPolyline(mark.points, mark.closed, role, widthOf(role));
      if (kind === "arrow") drawArrow(mark.from, mark.to, role);
      if (kind === "line" || kind === "arrow") keepClear(pointsOf(mark), boxes);
      if (kind !== "point") continue;
      drawPoint(mark.at, role);
      if (toClip(mark.at, pen.a)) boxes.push([xOf(pen.a) - 6, yOf(pen.a) - 6, xOf(pen.a) + 6, yOf(pen.a) + 6]);
    }
  for (const mark of marks.list) if (mark.kind === "label") drawLabel(mark, boxes);
}
