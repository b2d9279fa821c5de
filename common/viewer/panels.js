// Panels of a running scene: what a frame costs, its numbers, knobs, effects -------------------------------------------------

function showPanels(on) {
  $("panels").hidden = !on;
  $("more").setAttribute("aria-pressed", on);
  drawPanels();
  redraw();
}

// One line at the foot of the scene, for a few seconds.
let toastTimer = 0;
function toast(line, bad = false) {
  $("toast").hidden = false;
  $("toast").className = bad ? "panel bad" : "panel";
  text($("toast"), line);
  clearTimeout(toastTimer);
  toastTimer = setTimeout(() => { $("toast").hidden = true; }, bad ? 7000 : 4000);
}

// A line that stays until it is taken away: a scene that failed, a server that is gone.
function banner(line, button = "", action = null) {
  $("banner").hidden = !line;
  text($("bannerText"), line);
  $("bannerButton").hidden = !button;
  text($("bannerButton"), button);
  $("bannerButton").onclick = action;
}

// The state, ten times a second -----

const samples = { list: [], most: 120, stages: [] };  // the last 12 s; the names of stages in the order they came

function takeState(state) {
  const first = !live.state, failedBefore = live.state && live.state.failed;
  if (!first && (state.frame < live.state.frame || state.geometry !== live.state.geometry)) balance.start = null;
  live.state = state;
  if (state.title && (!motion || !motion.extras.title)) document.title = state.title;
  if (typeof state.speed === "number") now.speed = speeds.reduce((best, s) => Math.abs(s - state.speed) < Math.abs(best - state.speed) ? s : best);
  if (state.failed) banner(`The scene has failed: ${state.failed}`, "reset the scene", () => order({ do: "reset" }));
  else if (failedBefore) banner("");
  addSample(state);
  if (first && state.frame === 0 && motion) redraw();
  offerKnobs(state.knobs || []);
  offerEffects(Object.entries(state.effects || {}));
  drawPanels();
  redraw();
}

function addSample(state) {
  const last = samples.list[samples.list.length - 1];
  if (last && last.frame === state.frame) return;
  const parts = [];
  let rest = state.step_ms || 0;
  for (const [name, ms] of Object.entries(state.stages || {})) {
    let index = samples.stages.indexOf(name);
    if (index < 0) index = samples.stages.push(name) - 1;
    parts[index] = ms || 0;
    rest -= ms || 0;
  }
  samples.list.push({ frame: state.frame, ms: state.step_ms || 0, parts, rest: Math.max(0, rest), gap: state.min_gap, energy: state.energy, residual: state.residual, mark: pendingMark });
  pendingMark = "";
  if (samples.list.length > samples.most) samples.list.shift();
}
let pendingMark = "";  // a setting that was changed, to be written into the strip

function drawPanels() {
  if ($("panels").hidden || !live.state) return;
  drawCost();
  drawNumbers();
}

// Cost -----

const stageColours = ["#2f7fd0", "#e08a00", "#1f9a6a", "#8c57b8", "#c9485b", "#5aa9c9", "#a08a3c", "#7d8597"];
const restColour = "#aab1c0";
const stageName = name => name.replace(/_ms$/, "").replace(/_/g, " ").replace(/\b(ccd|lcp)\b/g, s => s.toUpperCase());
const scales = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 40, 100, 200, 500, 1000, 2000, 5000, 10000, 100000];
const lines = [[1000 / 60, "1/60 s"], [1000 / 30, "1/30 s"]];

function drawCost() {
  const canvas = $("costs"), ratio = fit(canvas), pen = canvas.getContext("2d"), w = canvas.clientWidth, h = canvas.clientHeight;
  const { list, most } = samples, left = 44, bottom = h - 2, top = 14;
  const high = list.reduce((m, s) => Math.max(m, s.ms), 0), scale = scales.find(s => s >= 1.1 * high) || high, y = ms => bottom - (bottom - top) * ms / scale;
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, w, h);
  pen.font = "11px system-ui, sans-serif";
  const bar = (w - left) / most;
  list.forEach((sample, k) => {
    const x = w - bar * (list.length - k);
    let under = 0;
    const part = (ms, colour) => {
      pen.fillStyle = colour;
      pen.fillRect(x, y(under + ms), Math.max(1, bar - 0.5), y(under) - y(under + ms));
      under += ms;
    };
    sample.parts.forEach((ms, i) => part(ms, stageColours[i % stageColours.length]));
    part(sample.rest, restColour);
    if (!sample.mark) return;
    pen.strokeStyle = colours.ink; pen.lineWidth = 1;
    pen.beginPath(); pen.moveTo(x, top - 2); pen.lineTo(x, bottom); pen.stroke();
    pen.fillStyle = colours.ink; pen.textBaseline = "bottom"; pen.textAlign = x > w / 2 ? "right" : "left";
    pen.fillText(sample.mark, x, top - 1);
  });
  pen.strokeStyle = colours.line; pen.lineWidth = 1;
  pen.beginPath(); pen.moveTo(left, bottom + 0.5); pen.lineTo(w, bottom + 0.5); pen.stroke();
  pen.fillStyle = colours.soft; pen.textAlign = "right"; pen.textBaseline = "middle";
  pen.fillText(`${short(scale)} ms`, left - 4, top + 1);
  pen.fillText("0", left - 4, bottom - 5);
  for (const [ms, name] of lines) {
    if (ms > scale) continue;
    pen.strokeStyle = colours.mark; pen.setLineDash([4, 3]);
    pen.beginPath(); pen.moveTo(left, y(ms)); pen.lineTo(w, y(ms)); pen.stroke();
    pen.setLineDash([]);
    if (y(ms) < bottom - 12 && y(ms) > top + 10) { pen.fillStyle = colours.mark; pen.fillText(name, left - 4, y(ms)); }
  }
  const { step_ms, dt } = live.state, recent = list.slice(-10), mean = of => recent.reduce((sum, s) => sum + (of(s) || 0), 0) / Math.max(1, recent.length);
  text($("costNow"), `${short(+mean(s => s.ms).toPrecision(3))} ms a frame`);
  const pace = step_ms > 0 ? 1000 * dt / mean(s => s.ms) : 0;
  text($("costPace"), pace > 0 && isFinite(pace) ? `${pace >= 1 ? short(+pace.toPrecision(2)) + " × faster than" : short(+pace.toPrecision(2)) + " ×"} real time` : "");
  const legend = $("legend"), names = [...samples.stages.map((name, i) => [stageName(name), stageColours[i % stageColours.length], mean(s => s.parts[i])]), ["other", restColour, mean(s => s.rest)]];
  while (legend.children.length < names.length) legend.append(make("span", {}, make("i"), make("span"), make("b")));
  names.forEach(([name, colour, ms], i) => {
    const row = legend.children[i];
    row.hidden = name === "other" && ms < 0.01 * mean(s => s.ms);
    row.children[0].style.background = colour;
    text(row.children[1], name);
    text(row.children[2], ms >= 0.0005 ? ms.toPrecision(2) : "0");
  });
  text($("pageCost"), `The page: ${live.pictureMs.toFixed(1)} ms of its own work a picture.`);
}

// Numbers -----

const balance = { start: null };  // J: energy less its account, at the first state since the bodies or the settings changed

function numbersNow() {
  const s = live.state, account = Object.entries(s.account || {}).filter(([, v]) => typeof v === "number");
  const rows = [["smallest gap", s.min_gap, "m", "gap"], ["residual", s.residual, "", "residual"], ["contacts", s.contacts, ""], ["lost time", s.lost_time, "s"],
                ["energy", s.energy, "J", "energy"], ["kinetic", s.kinetic, "J"], ["potential", s.potential, "J"]];
  if (account.length) rows.push(["energy from, since the start"], ...account.map(([name, v]) => [name.replace(/_/g, " "), v, "J"]));
  if (typeof s.energy === "number" && account.length) {
    const left = s.energy - account.reduce((sum, [, v]) => sum + v, 0);
    if (balance.start === null) balance.start = left;
    rows.push(["not accounted for", left - balance.start, "J", null, "Change of the energy that its account does not explain, since bodies or settings were last changed"]);
  }
  return rows;
}

function drawNumbers() {
  const table = $("numbers"), rows = numbersNow();
  while (table.rows.length > rows.length) table.deleteRow(-1);
  while (table.rows.length < rows.length) table.append(make("tr", {}, make("td"), make("td"), make("td"), make("td", {}, make("canvas", { hidden: true }))));
  rows.forEach(([name, value, unit, curve, title], i) => {
    const cells = table.rows[i].cells;
    text(cells[0], name);
    table.rows[i].className = value === undefined ? "title" : "";
    text(cells[1], typeof value === "number" ? numberText(value) : value === null ? "none" : "");
    text(cells[2], typeof value === "number" ? unit : "");
    table.rows[i].title = title || "";
    const canvas = cells[3].firstChild;
    canvas.hidden = !curve;
    if (curve) spark(canvas, samples.list.map(s => s[curve]), curve !== "energy");
  });
}

const numberText = v => Number.isInteger(v) && Math.abs(v) < 1e6 ? String(v) : Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3 ? v.toExponential(2) : v.toPrecision(5);

// A small curve of the last seconds; of what spans decades, of its logarithm.
function spark(canvas, values, decades) {
  const ratio = fit(canvas), pen = canvas.getContext("2d"), w = canvas.clientWidth, h = canvas.clientHeight;
  const numbers = values.map(v => typeof v !== "number" || (decades && !(v > 0)) ? NaN : decades ? Math.log10(v) : v), known = numbers.filter(v => !isNaN(v));
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, w, h);
  if (!known.length) return;
  const low = Math.min(...known), span = Math.max(Math.max(...known) - low, decades ? 0.5 : 1e-9 * Math.abs(low) || 1);
  pen.strokeStyle = colours.go; pen.lineWidth = 1.25;
  pen.beginPath();
  let drawing = false;
  numbers.forEach((v, i) => {
    if (isNaN(v)) { drawing = false; return; }
    const x = w - (w - 2) * (numbers.length - i) / samples.most, y = h - 2 - (h - 4) * (v - low) / span;
    if (drawing) pen.lineTo(x, y); else pen.moveTo(x - 0.5, y);
    pen.lineTo(x, y);
    drawing = true;
  });
  pen.stroke();
}

// Knobs -----

const knobs = new Map();  // key -> its elements, and what it shows

function offerKnobs(list) {
  const signature = JSON.stringify(list.map(k => [k.key, k.low, k.high, k.choices, k.restarts]));
  if (signature !== $("knobs").dataset.signature) {
    $("knobs").dataset.signature = signature;
    knobs.clear();
    $("knobs").replaceChildren(...list.map(knobRow));
    $("knobsPart").hidden = !list.length;
  }
  for (const k of list) showKnob(knobs.get(k.key), k.value);
}

const isLogarithmic = k => k.low > 0 && k.high > k.low;
// A slider's place, 0 to 1000, for a value, and back.
const placeOf = (k, v) => Math.round(1000 * (isLogarithmic(k) ? Math.log(v / k.low) / Math.log(k.high / k.low) : (v - k.low) / (k.high - k.low)));
const valueAt = (k, place) => isLogarithmic(k) ? k.low * (k.high / k.low) ** (place / 1000) : k.low + (k.high - k.low) * place / 1000;
// Two digits are enough for a slider; more can be typed.
const knobText = v => String(+v.toPrecision(2)).replace(/e\+/, "e");

function knobRow(k) {
  const id = "knob_" + k.key, words = (k.choices || []).length > 0;
  const field = words ? make("select", { id }, ...k.choices.map(c => new Option(c, c))) : make("input", { id, type: "text", spellcheck: false, autocomplete: "off" });
  const slider = !words && k.high > k.low ? make("input", { type: "range", min: 0, max: 1000, step: 1 }) : null;
  if (slider) slider.setAttribute("aria-label", k.key);
  const note = make("div", { className: "note" }), answer = make("div", { className: "answer" });
  answer.setAttribute("aria-live", "polite");
  note.textContent = k.meaning + (k.restarts ? " Restarts the scene." : "");
  const head = make("label", { htmlFor: id }, make("code", {}, k.key));
  const row = make("div", { className: "knob" }, make("div", { className: "head" }, head, ...(k.restarts ? [make("span", { className: "tag" }, "restarts")] : []), field, make("span", { className: "unit" }, k.unit === "1" ? "" : k.unit || "")),
                   ...(slider ? [slider] : []), note, answer);
  const knob = { ...k, field, slider, answer, busy: 0 };
  knobs.set(k.key, knob);
  field.onchange = () => turn(knob, field.value);
  if (slider) {  // what restarts the scene is sent when the slider is let go, all else while it moves
    slider.oninput = () => {
      field.value = knobText(valueAt(k, +slider.value));
      if (!k.restarts) turn(knob, field.value);
    };
    if (k.restarts) slider.onchange = () => turn(knob, field.value);
  }
  return row;
}

function showKnob(knob, value) {
  if (knob.busy || document.activeElement === knob.field) return;
  if (knob.shown === value) return;
  knob.shown = value;
  if (knob.field.tagName === "SELECT" && ![...knob.field.options].some(o => o.value === value)) knob.field.add(new Option(value || "none", value));
  knob.field.value = value;
  if (knob.slider && isFinite(parseFloat(value))) knob.slider.value = placeOf(knob, parseFloat(value));
}

async function turn(knob, value) {
  const sent = latest("set " + knob.key, { do: "set", key: knob.key, value: String(value).trim() });
  if (!sent) return;
  ++knob.busy;
  tell(knob.answer, await sent, knob.key);
  --knob.busy;
  knob.shown = null;  // what holds now is the server's to say
  if (knob.field.tagName === "INPUT" && document.activeElement === knob.field) knob.field.select();
}

// What became of a setting, below its knob or switch.
function tell(element, answer, key) {
  element.className = answer.ok ? "answer" : "answer bad";
  const how = answer.restarted ? "scene restarted" : answer.rebuilt ? "rebuilt" : "set";
  text(element, answer.ok ? `${how}${answer.ms > 0 ? ` in ${short(+answer.ms.toPrecision(2))} ms` : ""}${answer.text ? ": " + answer.text : ""}` : answer.text);
  if (!answer.ok) return;
  pendingMark = key;
  balance.start = null;
}

// Effects -----

const effects = new Map();  // name -> its elements

function offerEffects(list) {
  const signature = JSON.stringify(list.map(([name, e]) => [name, e.can_switch, e.set]));
  if (signature !== $("effects").dataset.signature) {
    $("effects").dataset.signature = signature;
    effects.clear();
    $("effects").replaceChildren(...list.map(([name, e]) => effectRow(name, e)));
    $("effectsPart").hidden = !list.length;
  }
  for (const [name, e] of list) showEffect(effects.get(name), e);
}

function effectRow(name, e) {
  const button = make("button", { className: "switch", disabled: !canSwitch(e) }), ms = make("b"), why = make("div", { className: "note" }), adds = make("div", { className: "note" });
  const answer = make("div", { className: "answer" });
  button.setAttribute("role", "switch");
  button.setAttribute("aria-label", name);
  answer.setAttribute("aria-live", "polite");
  const row = make("div", { className: "effect" }, make("div", { className: "head" }, button, make("span", { className: "name" }, name.replace(/_/g, " ")), ms), why, adds, answer);
  const effect = { row, button, ms, why, adds, answer, set: e.set, busy: false };
  effects.set(name, effect);
  button.onclick = async () => {
    if (effect.busy) return;
    effect.busy = true;
    row.classList.add("busy");
    const on = button.getAttribute("aria-checked") !== "true";
    tell(answer, await command({ do: "set", key: e.set.key, value: on ? e.set.on : "none" }), `${name} ${on ? "on" : "off"}`);
    effect.busy = false;
    row.classList.remove("busy");
  };
  return row;
}

const canSwitch = e => !!(e.can_switch && e.set && e.set.key);

function showEffect(effect, e) {
  effect.button.setAttribute("aria-checked", e.on === true);
  effect.button.title = canSwitch(e) ? `${e.set.key}: ${e.on ? "none" : e.set.on}` : "No key of the scene switches this by itself.";
  effect.row.classList.toggle("off", !e.on);
  text(effect.ms, e.on && e.ms > 0 ? `${(+e.ms).toPrecision(2)} ms` : "");
  text(effect.why, e.why || (e.on ? "" : "not asked for by this scene"));
  text(effect.adds, e.adds ? (e.on ? "Adds: " : "Would add: ") + e.adds : "");
}
