// Two copies side by side ------------------------------------------------------------------------------------------------------
// The copy began as the scene stood. It gets the same commands, but for the settings that are made for one of the two.

const twin = newSide();
// Over simulated time: how far the same body's centres are apart at most (m; NaN while the two are not at one time).
const apart = { t: new Float64Array(4096), distance: new Float64Array(4096), count: 0, farthest: -1 };

const twinState = () => (live.state && live.state.twin) || null;
const isSplit = () => isLive && !algorithm.open && twin.newest !== null && twinState() !== null;

function takeTwinFrame(bytes, length) {
  const head = new DataView(bytes.buffer, 8, 12);
  keepFrame(twin, bytes, 20, length);
  if (twin.received === 1) showSplit();
  noteDistance(live.newest ? live.newest.t : twin.newest.t, head.getFloat64(0, true), head.getInt32(8, true));
  redraw();
}

function noteDistance(t, distance, farthest) {
  apart.farthest = farthest;
  const { count } = apart;
  if (count && t < apart.t[count - 1]) return;
  if (count && t === apart.t[count - 1]) { apart.distance[count - 1] = distance; return; }
  if (count === apart.t.length) halveDistances();
  apart.t[apart.count] = t;
  apart.distance[apart.count++] = distance;
}

// Makes room: of each two the larger stays, a gap only where both are one.
function halveDistances() {
  const { t, distance } = apart, half = apart.count >> 1;
  for (let k = 0; k < half; ++k) {
    const second = isNaN(distance[2 * k]) || distance[2 * k + 1] > distance[2 * k];
    t[k] = t[2 * k + 1];
    distance[k] = distance[second ? 2 * k + 1 : 2 * k];
  }
  apart.count = half;
}

function forgetTwin() {
  forgetFrames(twin);
  apart.count = 0; apart.farthest = -1;
}

const showSplit = () => document.body.classList.toggle("split", isSplit());

// The state has come, after another.
function twinChanged(before) {
  const state = twinState(), was = before && before.twin;
  if (state && !was) { samplesOf.twin.list.length = 0; books.twin.start = null; }
  if (was && !state) { forgetTwin(); setFor("scene"); }
  showSplit();
  $("twin").setAttribute("aria-pressed", state !== null);
  $("twinPart").hidden = $("forWhich").hidden = !state;
  if (!state) return;
  text($("sceneTitle"), live.state.failed ? "this scene: it has failed" : "this scene");
  const other = differences();
  text($("twinTitle"), state.failed ? `its copy has failed: ${state.failed}` : `its copy${other.length ? `: ${other.join(", ")}` : ""}`);
  $("twinTitle").classList.toggle("bad", !!state.failed);
}

async function switchTwin() {
  const on = twinState() === null, answer = await order({ do: "twin", on });
  if (answer.ok && on) toast(`A copy of the scene as it stands${answer.ms > 0 ? `, made in ${short(+answer.ms.toPrecision(2))} ms` : ""}. Knobs and effects now have a switch: this scene, or its copy.`);
}

// The copy's settings that are not the scene's, as "key value".
function differences() {
  const values = new Map((live.state.knobs || []).map(k => [k.key, k.value])), state = twinState(), scene = live.state.effects || {};
  const knobs = (state.knobs || []).filter(k => values.has(k.key) && values.get(k.key) !== k.value).map(k => `${k.key} ${k.value}`);
  const effects = Object.entries(state.effects || {}).filter(([name, e]) => scene[name] && scene[name].on !== e.on).map(([name, e]) => `${name} ${e.on ? "on" : "off"}`);
  return [...knobs, ...effects];
}

// The curve of distances, with decades -----

function drawApart() {
  const canvas = $("apart"), ratio = fit(canvas), pen = canvas.getContext("2d"), w = canvas.clientWidth, h = canvas.clientHeight, { t, distance, count } = apart;
  const left = 44, right = w - 8, top = 8, bottom = h - 30;
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, w, h);
  pen.font = "11px system-ui, sans-serif";
  let least = Infinity, most = 0;
  for (let k = 0; k < count; ++k) if (distance[k] > 0) { least = Math.min(least, distance[k]); most = Math.max(most, distance[k]); }
  const low = Math.floor(Math.log10(least < Infinity ? least : 1e-9)), high = Math.max(low + 1, Math.ceil(Math.log10(most || 1)));
  const from = count ? t[0] : 0, until = count ? Math.max(t[count - 1], from + 1e-9) : 1;
  const x = v => left + (right - left) * (v - from) / (until - from), y = v => v > 0 ? bottom - (bottom - top) * (Math.log10(v) - low) / (high - low) : bottom;
  pen.textBaseline = "middle"; pen.textAlign = "right"; pen.lineWidth = 1;
  const stride = Math.max(1, Math.ceil((high - low) / 5));
  for (let decade = low; decade <= high; decade += stride) {
    const at = Math.round(y(10 ** decade)) + 0.5;
    pen.strokeStyle = colours.line; pen.fillStyle = colours.soft;
    pen.beginPath(); pen.moveTo(left, at); pen.lineTo(right, at); pen.stroke();
    pen.fillText(`1e${decade}`, left - 5, at);
  }
  pen.textBaseline = "top"; pen.textAlign = "left";
  pen.fillText(`${short(+from.toFixed(3))} s`, left, bottom + 4);
  pen.textAlign = "right";
  pen.fillText(`${short(+until.toFixed(3))} s`, right, bottom + 4);
  pen.textAlign = "center";
  pen.fillText("simulated time", (left + right) / 2, bottom + 16);
  pen.strokeStyle = colours.mark; pen.lineWidth = 1.5; pen.lineJoin = "round";
  pen.beginPath();
  let drawing = false;
  for (let k = 0; k < count; ++k) {
    if (isNaN(distance[k])) { drawing = false; continue; }
    if (drawing) pen.lineTo(x(t[k]), y(distance[k])); else pen.moveTo(x(t[k]) - 0.5, y(distance[k]));
    drawing = true;
  }
  pen.stroke();
  const last = count ? distance[count - 1] : NaN, body = motion && motion.bodies[apart.farthest];
  text($("apartNow"), isNaN(last) ? "at other times" : `${numberText(last)} m`);
  text($("apartWho"), isNaN(last) ? "The two stand at different times: their frames are not equally long."
    : last === 0 ? "The two are the same, to the last digit." : body ? `Farthest apart: ${body.name.replace("_", " ")}.` : "");
}
