// Taking hold of a body in a running scene ------------------------------------------------------------------------------

const pointer = { x: null, y: null, moved: false };
// The grabbed body, whether it was taken in the copy's picture, the point of it (in its axes), how far in front of the eye's plane
// it is pulled to, and where on the page.
const grip = { body: -1, held: false, copy: false, local: new Float64Array(3), depth: 1, target: null, told: false };
let hovered = -1;

// Shows which body a press would take.
function hoverOver(body) {
  for (const item of motion.bodies) item.lit = 0;
  hovered = body >= 0 && motion.bodies[body].moves ? body : -1;
  if (hovered >= 0) motion.bodies[hovered].lit = 0.12;
  $("scene").style.cursor = grip.body >= 0 ? "grabbing" : hovered >= 0 ? "pointer" : "";
}

// Once for a picture, and only if the pointer has moved.
function hover() {
  if (!pointer.moved || pointer.x === null) return;
  pointer.moved = false;
  const seen = grip.body >= 0 ? { body: grip.body } : pick(pointer.x, pointer.y);
  hoverOver(seen ? seen.body : -1);
}

function grabAt(x, y) {
  const seen = pick(x, y);
  if (seen && motion.bodies[seen.body].moves) grab(seen.body, seen.local, seen.depth, copyAt(x));
}

// Takes hold of a body at a point of its own axes. The body is drawn a little late: the server is told where the point is in the
// newest frame.
async function grab(body, local, depth, copy = false) {
  Object.assign(grip, { body, held: false, copy, depth, target: null, told: false });
  grip.local.set(local);
  hoverOver(body);
  const frame = live.newest;
  const point = frame && body < frame.bodies ? placed(local, frame.poses, 7 * body) : placed(local, poseOf(motion.bodies[body]), 0);
  redraw();
  const answer = await order({ do: "grab", body, point });
  if (grip.body !== body) return answer;  // it was let go meanwhile
  grip.held = answer.ok;
  if (answer.ok) dragOn(); else letGo();
  return answer;
}

const poseOf = item => [...item.position, ...item.turn];

// Pulls to below the pointer, in the plane that faces the camera; one such command is on its way at a time.
function dragOn() {
  if (grip.body < 0) return;
  if (pointer.x !== null) {
    const eye = eyeOf(), way = wayThrough(pointer.x, pointer.y, grip.copy), to = eye.map((v, i) => v + grip.depth * way[i]);
    if (!grip.target || to.some((v, i) => v !== grip.target[i])) Object.assign(grip, { target: to, told: false });
  }
  if (grip.held && grip.target && !grip.told) drag(grip.target);
}

function drag(to) {
  Object.assign(grip, { target: [...to], told: true });
  const answer = latest("drag", { do: "drag", to: grip.target });
  if (answer) answer.then(a => { if (!a.ok && grip.body >= 0) { toast(a.text, true); letGo(); } });
  return lastCommand;
}

function letGo() {
  Object.assign(grip, { body: -1, held: false, target: null });
  hoverOver(hovered);
  redraw();
}

function drop() {
  if (grip.body < 0) return null;
  letGo();
  return order({ do: "drop" });
}

// The line to draw in a side's picture: of the own hand at once, of another page's from the stream.
function handLine(side) {
  if (grip.body >= 0 && grip.body < motion.bodies.length) {
    const from = placed(grip.local, poseOf(motion.bodies[grip.body]), 0);
    return { from, to: grip.target || from };
  }
  const frame = side.newest && side.around.to;
  if (!frame || frame.grabbed < 0 || frame !== side.newest) return null;
  return { from: [...frame.hand.subarray(0, 3)], to: [...frame.hand.subarray(3, 6)] };
}

// A ball from the eye, through a point of the page or straight ahead.
function throwBall(x, y) {
  const box = pictureBox(false), inside = x !== null && x !== undefined;
  const way = wayThrough(inside ? x : box.left + box.width / 2, inside ? y : box.top + box.height / 2), size = Math.hypot(...way);
  return order({ do: "throw", from: eyeOf(), velocity: way.map(v => v / size * throwSpeed()) });
}
const throwSpeed = () => 10 ** +$("force").value;

// The slider's range is of the scene's size: from a twentieth of the way to it in a second to ten times that way.
function offerThrow() {
  const middle = Math.log10(2 * camera.distance), slider = $("force");
  const show = () => { $("forceText").textContent = `${short(+throwSpeed().toPrecision(2))} m/s`; };
  slider.min = middle - 1.6; slider.max = middle + 1; slider.step = 0.02; slider.value = middle;
  slider.oninput = show;
  show();
}

async function save() {
  const answer = await command({ do: "save" });
  if (!answer.ok || typeof answer.scene !== "string") return toast(answer.text || "The scene was not saved.", true);
  const link = document.createElement("a"), address = URL.createObjectURL(new Blob([answer.scene], { type: "text/yaml" }));
  const name = (motion.extras.title || "scene").replace(/[^\w.-]+/g, "_"), frame = live.newest ? `_frame_${live.newest.frame}` : "";
  link.href = address;
  link.download = `${name}${frame}.yaml`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
  toast(`Saved as ${link.download}.`);
}

// Stops the program, which other pages may watch: asked twice.
let stopAsked = -Infinity;
async function stopTwice() {
  if (performance.now() - stopAsked > 3000) {
    stopAsked = performance.now();
    $("stop").textContent = "really stop?";
    setTimeout(() => { $("stop").textContent = "stop"; }, 3000);
    return;
  }
  live.ended = true;
  const answer = await command({ do: "stop" });
  if (answer.ok) return end("The simulation has ended, as you asked. ./run live SCENE starts another.");
  live.ended = false;
  toast(answer.text, true);
}
