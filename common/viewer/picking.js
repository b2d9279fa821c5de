// What a ray meets --------------------------------------------------------------------------------------------------

// A ray in a body's axes: where it starts, and its way. Written anew for each body, so that nothing is allocated.
const ray = { from: new Float64Array(3), way: new Float64Array(3) };

// Turns a vector of the world back into the item's axes.
function turnBack(item, vx, vy, vz, out) {
  const x = -item.turn[0], y = -item.turn[1], z = -item.turn[2], w = item.turn[3], s = 1 / item.scale;
  const cx = y * vz - z * vy, cy = z * vx - x * vz, cz = x * vy - y * vx;
  out[0] = s * (vx + 2 * (w * cx + y * cz - z * cy));
  out[1] = s * (vy + 2 * (w * cy + z * cx - x * cz));
  out[2] = s * (vz + 2 * (w * cz + x * cy - y * cx));
}

// Where a ray first meets the triangles of an item: the share of its way, beyond 1 as well, or Infinity.
function meets(item, from, way) {
  const { positions, indices, radius } = item.geometry, o = ray.from, d = ray.way, p = item.position;
  turnBack(item, from[0] - p[0], from[1] - p[1], from[2] - p[2], o);
  turnBack(item, way[0], way[1], way[2], d);
  // First the ball about the origin that holds them all.
  const long = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], along = -(o[0] * d[0] + o[1] * d[1] + o[2] * d[2]);
  const outside = o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - radius * radius;
  if (outside > 0 && (along < 0 || along * along < long * outside)) return Infinity;
  let first = Infinity;
  for (let k = 0; k < indices.length; k += 3) {  // Möller and Trumbore's test of a ray and a triangle
    const a = 3 * indices[k], b = 3 * indices[k + 1], c = 3 * indices[k + 2];
    const ax = positions[a], ay = positions[a + 1], az = positions[a + 2];
    const bx = positions[b] - ax, by = positions[b + 1] - ay, bz = positions[b + 2] - az;
    const cx = positions[c] - ax, cy = positions[c + 1] - ay, cz = positions[c + 2] - az;
    const px = d[1] * cz - d[2] * cy, py = d[2] * cx - d[0] * cz, pz = d[0] * cy - d[1] * cx;
    const size = bx * px + by * py + bz * pz;
    if (size === 0) continue;
    const sx = o[0] - ax, sy = o[1] - ay, sz = o[2] - az, u = (sx * px + sy * py + sz * pz) / size;
    if (!(u >= 0 && u <= 1)) continue;
    const qx = sy * bz - sz * by, qy = sz * bx - sx * bz, qz = sx * by - sy * bx;
    const v = (d[0] * qx + d[1] * qy + d[2] * qz) / size, share = (cx * qx + cy * qy + cz * qz) / size;
    if (v >= 0 && u + v <= 1 && share > 0 && share < first) first = share;
  }
  return first;
}

// Where on the page a picture is: that of the scene, or of its copy. One alone has all of the canvas, two have a half each.
function pictureBox(copy) {
  const box = $("scene").getBoundingClientRect();
  return isSplit() ? { left: box.left + (copy ? 0.5 : 0) * box.width, top: box.top, width: 0.5 * box.width, height: box.height } : box;
}
function copyAt(clientX) {
  if (!isSplit()) return false;
  const box = $("scene").getBoundingClientRect();
  return clientX >= box.left + 0.5 * box.width;
}

// The way from the eye through a point of the screen, as long as it needs to go one metre away from the camera's plane.
function wayThrough(clientX, clientY, copy = copyAt(clientX)) {
  const box = pictureBox(copy), aspect = box.width / box.height, half = Math.tan(0.35) / Math.min(1, aspect);
  const [right, up, back] = cameraAxes();
  const sideways = half * aspect * (2 * (clientX - box.left) / box.width - 1), upwards = half * (1 - 2 * (clientY - box.top) / box.height);
  return right.map((v, i) => sideways * v + upwards * up[i] - back[i]);
}

// The body that is seen at a point of the screen: its number, how far away it is, and the point in its own axes; or null. What
// hides the rest is looked through.
function pick(clientX, clientY) {
  const copy = copyAt(clientX);
  if (copy) poseLive(twin);
  const seen = pickPosed(clientX, clientY);
  if (copy) poseLive(live);
  return seen;
}
function pickPosed(clientX, clientY) {
  const eye = eyeOf(), way = wayThrough(clientX, clientY);
  let best = Infinity, body = -1;
  for (let i = 0; i < motion.bodies.length; ++i) {
    const item = motion.bodies[i], share = item.veiled ? Infinity : meets(item, eye, way);
    if (share < best) { best = share; body = i; }
  }
  if (body < 0) return null;
  const item = motion.bodies[body], local = new Float64Array(3);
  turnBack(item, ...eye.map((v, i) => v + best * way[i] - item.position[i]), local);
  return { body, depth: best, local };
}

// A point in a body's axes, in the world's, for the pose at index `o` of an array of x y z and quaternion x y z w.
function placed(local, poses, o) {
  const [vx, vy, vz] = local, x = poses[o + 3], y = poses[o + 4], z = poses[o + 5], w = poses[o + 6];
  const cx = y * vz - z * vy, cy = z * vx - x * vz, cz = x * vy - y * vx;
  return [poses[o] + vx + 2 * (w * cx + y * cz - z * cy), poses[o + 1] + vy + 2 * (w * cy + z * cx - x * cz),
          poses[o + 2] + vz + 2 * (w * cz + x * cy - y * cx)];
}

// Where a point in the world is drawn on the page, in its pixels; in the picture of the scene, or of its copy.
function onScreen(point, copy = false) {
  const box = pictureBox(copy), m = viewMatrix(box.width / box.height);
  const clip = [0, 1, 3].map(r => m[r] * point[0] + m[4 + r] * point[1] + m[8 + r] * point[2] + m[12 + r]);
  return { x: box.left + box.width * (0.5 + 0.5 * clip[0] / clip[2]), y: box.top + box.height * (0.5 - 0.5 * clip[1] / clip[2]), before: clip[2] > 0 };
}
