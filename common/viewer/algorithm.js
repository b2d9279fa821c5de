// The algorithm of one frame, step by step -----------------------------------------------------------------------------------
// A document tells what happened in a frame, in parts, one or more for a chapter, and these in steps. A running scene is asked for
// that of its next frame; a recording has those that its run was asked for. common/live/STREAM.md says what is in it.

const algorithm = { open: false, asking: false, documents: [], chosen: 0, steps: [], at: 0, camera: null };
// steps: of all parts, one after another; camera: how one looked before it came near by itself

const documentNow = () => algorithm.documents[algorithm.chosen];
const stepNow = () => algorithm.steps[algorithm.at].step;

async function openAlgorithm() {
  if (algorithm.open) return leaveAlgorithm();
  if (!isLive) {
    if (!motion.algorithm.length) return;
    const nearest = motion.algorithm.reduce((best, d, k) => Math.abs(d.t0 - now.time) < Math.abs(motion.algorithm[best].t0 - now.time) ? k : best, 0);
    return showDocuments(motion.algorithm, nearest);
  }
  askForDocument();
}

// Asks for the next frame's document. The server pauses the scene.
async function askForDocument() {
  if (algorithm.asking) return;
  algorithm.asking = true;
  toast("Working out the next frame …");
  try {
    const answer = await fetch(path("algorithm"));
    if (!answer.ok) return toast((await answer.text()).trim() || "The next frame's account is not to be had.", true), leaveAlgorithm();
    const told = await answer.json();
    $("toast").hidden = true;
    showDocuments([told], 0);
  } catch (error) {
    toast("The simulation does not answer.", true);
  } finally {
    algorithm.asking = false;
  }
}

function showDocuments(documents, chosen) {
  const usable = documents.filter(d => d.parts.some(p => p.steps.length));
  if (!usable.length) return toast("This frame has no steps: no pair came near.", true);
  Object.assign(algorithm, { open: true, documents: usable });
  drop();
  now.playing = false;
  document.body.classList.add("algorithm");
  showSplit();
  $("account").hidden = false;
  $("algorithm").setAttribute("aria-pressed", true);
  $("documents").replaceChildren(...usable.map((d, k) => new Option(`frame ${d.frame}`, k)));
  $("documentChoice").hidden = usable.length < 2;
  chooseDocument(Math.max(0, usable.indexOf(documents[chosen])));
}

function chooseDocument(index) {
  algorithm.chosen = index;
  const { frame, t0, t1, parts } = documentNow();
  algorithm.steps = parts.flatMap((part, k) => part.steps.map((step, i) => ({ part: k, index: i, step })));
  if (!isLive) now.time = Math.min(motion.duration, t0);
  $("documents").value = index;
  text($("accountFrame"), `frame ${frame}: ${timeText(t0, t1 - t0)} to ${timeText(t1, t1 - t0)} s`);
  $("parts").replaceChildren(...parts.map((part, k) => {
    const button = make("button", { onclick: () => toStep(algorithm.steps.findIndex(s => s.part === k)), disabled: !part.steps.length });
    button.append(make("b", {}, `${part.chapter}`), make("span", {}, part.title), make("i", {}, String(part.steps.length)));
    button.title = `Chapter ${part.chapter}: ${part.title}`;
    return make("li", {}, button);
  }));
  toStep(0);
}
const timeText = (t, span) => t.toFixed(Math.max(3, Math.min(9, 3 - Math.floor(Math.log10(span || 1)))));

function toStep(index) {
  algorithm.at = Math.max(0, Math.min(algorithm.steps.length - 1, index));
  const { part, index: inPart, step } = algorithm.steps[algorithm.at], parts = documentNow().parts;
  [...$("parts").children].forEach((item, k) => item.firstChild.setAttribute("aria-current", k === part));
  $("parts").children[part].scrollIntoView({ block: "nearest" });
  text($("stepNow"), `step ${inPart + 1} of ${parts[part].steps.length}`);
  $("stepBack").disabled = algorithm.at === 0;
  $("stepOn").disabled = algorithm.at === algorithm.steps.length - 1;
  text($("stepText"), step.text);
  prepareMarks(step.draw || []);
  drawCharts();
  $("stepLook").disabled = !marks.list.length;
  lookAtStep(step);
  redraw();
}

// The eye comes near by itself where what a step draws would be small, and goes where it is out of sight.
function lookAtStep({ poses }) {
  const { low, high } = marks;
  if (!(high[0] >= low[0])) return;
  const middle = low.map((v, i) => 0.5 * (v + high[i])), size = Math.hypot(...low.map((v, i) => high[i] - v)), eye = eyeOf(), back = cameraAxes()[2];
  const away = dot3(back, eye.map((v, i) => v - middle[i])), aside = Math.hypot(...middle.map((v, i) => eye[i] - away * back[i] - v));
  const wanted = Math.max(4 * size, 5 * reachOf((poses || []).map(p => motion.bodies[p[0]]).filter(b => b)));
  if (camera.distance > 3 * wanted || size > 0.8 * camera.distance || away <= 0 || aside > 0.32 * away) comeNear(middle, wanted);
}
// The largest of bodies that move; of all there are if none of these do. m
function reachOf(bodies) {
  const some = bodies.some(b => b.moves) ? bodies : motion.bodies;
  return some.reduce((most, b) => b.moves ? Math.max(most, b.geometry.radius) : most, 1e-3);
}
function comeNear(target, distance) {
  algorithm.camera = algorithm.camera || { ...camera };
  Object.assign(camera, { follow: null, target, distance });
}

// Charts are drawn for the panel's width; anew when it changes.
function drawCharts() {
  if (!algorithm.open) return;
  const { chart, bars } = stepNow(), width = $("account").clientWidth - 32;
  const height = Math.max(170, Math.min(240, 0.27 * $("account").clientHeight));
  $("stepChart").replaceChildren(...(chart ? chartOf(chart, width, height) : []));
  $("stepBars").replaceChildren(...(bars ? barsOf(bars, width) : []));
}

function leaveAlgorithm() {
  if (!algorithm.open) return;
  algorithm.open = false;
  document.body.classList.remove("algorithm");
  $("account").hidden = true;
  $("algorithm").setAttribute("aria-pressed", false);
  prepareMarks([]);
  if (algorithm.camera) Object.assign(camera, algorithm.camera);
  algorithm.camera = null;
  showSplit();
  drawPanels();
  redraw();
}

// The bodies of this step that stand elsewhere than at the frame's start.
function poseStep() {
  for (const [body, x, y, z, qx, qy, qz, qw] of stepNow().poses || []) {
    const item = motion.bodies[body];
    if (!item) continue;
    item.position[0] = x; item.position[1] = y; item.position[2] = z;
    item.turn[0] = qx; item.turn[1] = qy; item.turn[2] = qz; item.turn[3] = qw;
  }
}

// A picture is about to be drawn: what is told is of a time that is over if the scene has gone on.
function keepUpAlgorithm() {
  if (!algorithm.open) return;
  const { t0, t1 } = documentNow();
  if (!isLive) {
    if (now.playing || Math.abs(now.time - Math.min(motion.duration, t0)) > 1e-9) leaveAlgorithm();
  } else if (live.newest && live.newest.t > 0.5 * (t0 + t1)) {
    if (now.playing) leaveAlgorithm();
    else askForDocument();
  }
}

// Brings what a step draws near, and the eye to it.
function lookCloser() {
  if (!algorithm.open || !marks.list.length) return;
  const { low, high } = marks;
  comeNear(low.map((v, i) => 0.5 * (v + high[i])), Math.max(0.05 * reachOf([]), 2 * Math.hypot(...low.map((v, i) => high[i] - v))));
  redraw();
}

function listenToAlgorithm() {
  $("stepBack").onclick = () => toStep(algorithm.at - 1);
  $("stepOn").onclick = () => toStep(algorithm.at + 1);
  $("stepLook").onclick = lookCloser;
  $("accountClose").onclick = leaveAlgorithm;
  $("accountNext").onclick = () => order({ do: "step" });
  $("documents").onchange = e => chooseDocument(+e.target.value);
  addEventListener("resize", drawCharts);
}
