// Panels of a running scene: what a frame costs, and its numbers ---------------------------------------------------------------

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

// The last 12 s of the scene and of its copy; the names of stages in the order they came.
const samplesOf = { scene: { list: [], mark: "" }, twin: { list: [], mark: "" } };
const stages = [], mostSamples = 120;

function takeState(state) {
  const before = live.state, first = !before;
  if (!first && (state.frame < before.frame || state.geometry !== before.geometry)) books.scene.start = books.twin.start = null;
  live.state = state;
  if (state.title && (!motion || !motion.extras.title)) document.title = state.title;
  if (typeof state.speed === "number") now.speed = speeds.reduce((best, s) => Math.abs(s - state.speed) < Math.abs(best - state.speed) ? s : best);
  if (state.failed) banner(`The scene has failed: ${state.failed}`, "reset the scene", () => order({ do: "reset" }));
  else if (before && before.failed) banner("");
  twinChanged(before);
  addSample(samplesOf.scene, state, state.frame);
  if (state.twin) addSample(samplesOf.twin, state.twin, state.twin.frame);
  showWarnings([...(state.warnings || []), ...((state.twin && state.twin.warnings) || []).map(line => `its copy: ${line}`)]);
  if (first && state.frame === 0 && motion) redraw();
  offerSettings();
  drawPanels();
  redraw();
}

function addSample(samples, state, frame) {
  const last = samples.list[samples.list.length - 1];
  if (last && last.frame === frame) return;
  const parts = [];
  let rest = state.step_ms || 0;
  for (const [name, ms] of Object.entries(state.stages || {})) {
    let index = stages.indexOf(name);
    if (index < 0) index = stages.push(name) - 1;
    parts[index] = ms || 0;
    rest -= ms || 0;
  }
  samples.list.push({ frame, ms: state.step_ms || 0, parts, rest: Math.max(0, rest), gap: state.min_gap, energy: state.energy, residual: state.residual, mark: samples.mark });
  samples.mark = "";  // a setting that was changed, written into the strip
  if (samples.list.length > mostSamples) samples.list.shift();
}

// The scene's last warnings; a click puts them away until there is another.
function showWarnings(lines) {
  const box = $("warnings"), signature = JSON.stringify(lines);
  if (box.dataset.signature === signature) return;
  box.dataset.signature = signature;
  box.hidden = lines.length === 0;
  box.onclick = () => { box.hidden = true; };
  box.replaceChildren(...lines.map(line => make("div", {}, line)));
}

function drawPanels() {
  if ($("panels").hidden || algorithm.open || !live.state) return;
  drawCost();
  drawNumbers();
  if (twinState()) drawApart();
}

// Cost -----

const stageColours = ["#2f7fd0", "#e08a00", "#1f9a6a", "#8c57b8", "#c9485b", "#5aa9c9", "#a08a3c", "#7d8597"];
const otherColour = "#aab1c0";
const colourOf = index => stages[index] === "other_ms" ? otherColour : stageColours[index % stageColours.length];
const stageName = name => name.replace(/_ms$/, "").replace(/_/g, " ").replace(/\b(ccd|lcp)\b/g, s => s.toUpperCase());
const scales = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 40, 100, 200, 500, 1000, 2000, 5000, 10000, 100000];
const lines = [[1000 / 60, "1/60 s"], [1000 / 30, "1/30 s"]];

// A bar for each frame, as high as it took, in the stages' colours. Two copies have one scale.
function drawBars(canvas, { list }, scale) {
  const ratio = fit(canvas), pen = canvas.getContext("2d"), w = canvas.clientWidth, h = canvas.clientHeight;
  const left = 44, bottom = h - 2, top = 14, bar = (w - left) / mostSamples, y = ms => bottom - (bottom - top) * ms / scale;
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, w, h);
  pen.font = "11px system-ui, sans-serif";
  let written = Infinity;  // the newest mark's left end: older ones stop before it
  const marks = [];
  list.forEach((sample, k) => {
    const x = w - bar * (list.length - k);
    let under = 0;
    const part = (ms, colour) => {
      pen.fillStyle = colour;
      pen.fillRect(x, y(under + ms), Math.max(1, bar - 0.5), y(under) - y(under + ms));
      under += ms;
    };
    sample.parts.forEach((ms, i) => part(ms, colourOf(i)));
    part(sample.rest, otherColour);
    if (sample.mark) marks.push([x, sample.mark]);
  });
  pen.strokeStyle = pen.fillStyle = colours.ink; pen.lineWidth = 1; pen.textBaseline = "bottom";
  for (const [x, mark] of marks.reverse()) {
    pen.beginPath(); pen.moveTo(x, top - 2); pen.lineTo(x, bottom); pen.stroke();
    const wide = pen.measureText(mark).width, from = x + wide < w ? x : x - wide;
    if (from + wide > written - 6 || from < left) continue;
    pen.textAlign = "left";
    pen.fillText(mark, from, top - 1);
    written = from;
  }
  pen.strokeStyle = colours.line;
  pen.beginPath(); pen.moveTo(left, bottom + 0.5); pen.lineTo(w, bottom + 0.5); pen.stroke();
  pen.fillStyle = colours.soft; pen.textAlign = "right"; pen.textBaseline = "middle";
  pen.fillText(`${short(scale)} ms`, left - 4, top + 1);
  pen.fillText("0", left - 4, bottom - 5);
  let free = bottom - 12;
  for (const [ms, name] of lines) {
    if (ms > scale) continue;
    pen.strokeStyle = colours.mark; pen.setLineDash([4, 3]);
    pen.beginPath(); pen.moveTo(left, y(ms)); pen.lineTo(w, y(ms)); pen.stroke();
    pen.setLineDash([]);
    if (y(ms) < free && y(ms) > top + 12) { pen.fillStyle = colours.mark; pen.fillText(name, left - 4, y(ms)); free = y(ms) - 12; }
  }
}

const meanOf = (samples, of) => {
  const recent = samples.list.slice(-10);
  return recent.reduce((sum, s) => sum + (of(s) || 0), 0) / Math.max(1, recent.length);
};

function drawCost() {
  const { scene, twin: copy } = samplesOf, state = live.state, both = twinState() !== null, shown = both ? [scene, copy] : [scene];
  const high = Math.max(...shown.map(({ list }) => list.reduce((m, s) => Math.max(m, s.ms), 0))), scale = scales.find(s => s >= 1.1 * high) || high;
  $("costsTwin").hidden = $("costsTwinName").hidden = !both;
  drawBars($("costs"), scene, scale);
  if (both) drawBars($("costsTwin"), copy, scale);
  const ms = shown.map(samples => meanOf(samples, s => s.ms)), words = v => short(+v.toPrecision(3));
  text($("costNow"), both ? `${words(ms[0])} and ${words(ms[1])} ms a frame` : `${words(ms[0])} ms a frame`);
  const pace = state.step_ms > 0 ? 1000 * state.dt / ms[0] : 0;
  text($("costPace"), pace > 0 && isFinite(pace) && !both ? `${pace >= 1 ? short(+pace.toPrecision(2)) + " × faster than" : short(+pace.toPrecision(2)) + " ×"} real time` : "");
  drawLegend(shown, ms);
  text($("pageCost"), `The page: ${live.pictureMs.toFixed(1)} ms of its own work a picture.`);
}

function drawLegend(shown, totals) {
  const legend = $("legend"), rows = stages.map((name, i) => ({ name: stageName(name), colour: colourOf(i), ms: shown.map(samples => meanOf(samples, s => s.parts[i])) }));
  const rest = shown.map(samples => meanOf(samples, s => s.rest)), other = rows.find(row => row.name === "other");
  if (other) rest.forEach((ms, i) => { other.ms[i] += ms; });
  else rows.push({ name: "other", colour: otherColour, ms: rest });
  legend.classList.toggle("both", shown.length > 1);
  while (legend.children.length < rows.length) legend.append(make("span", {}, make("i"), make("span"), make("b"), make("b")));
  rows.forEach(({ name, colour, ms }, i) => {
    const row = legend.children[i], number = v => v === undefined ? "" : v >= 0.0005 ? v.toPrecision(2) : "0";
    row.hidden = name === "other" && !other && ms.every((v, k) => v < 0.01 * totals[k]);
    row.children[0].style.background = colour;
    text(row.children[1], name);
    text(row.children[2], number(ms[0]));
    text(row.children[3], number(ms[1]));
    row.children[1].title = name;
  });
}

// Numbers -----

const books = { scene: { start: null }, twin: { start: null } };  // J: energy less its account, at the first state since the bodies or the settings changed

function numbersOf(s, book) {
  const account = Object.entries(s.account || {}).filter(([, v]) => typeof v === "number");
  const rows = [["smallest gap", s.min_gap, "m", "gap"], ["residual", s.residual, "", "residual"], ["contacts", s.contacts, ""], ["lost time", s.lost_time, "s"],
                ["energy", s.energy, "J", "energy"], ["kinetic", s.kinetic, "J"], ["potential", s.potential, "J"]];
  if (account.length) rows.push(["energy from, since the start"], ...account.map(([name, v]) => [name.replace(/_/g, " "), v, "J"]));
  if (typeof s.energy === "number" && account.length) {
    const left = s.energy - account.reduce((sum, [, v]) => sum + v, 0);
    if (book.start === null) book.start = left;
    rows.push(["not accounted for", left - book.start, "J", null, "Change of the energy that its account does not explain, since bodies or settings were last changed"]);
  }
  return rows;
}

// The numbers of both, those of the copy by their names: an account may have other entries.
function drawNumbers() {
  const table = $("numbers"), state = twinState(), rows = numbersOf(live.state, books.scene), copy = new Map(state ? numbersOf(state, books.twin).map(row => [row[0], row]) : []);
  for (const [name, row] of copy) if (!rows.some(r => r[0] === name)) rows.push([name, undefined, row[2]]);
  if (state) rows.unshift(["head"]);
  table.classList.toggle("both", state !== null);
  while (table.rows.length > rows.length) table.deleteRow(-1);
  while (table.rows.length < rows.length) table.append(make("tr", {}, make("td"), make("td"), make("td"), make("td", {}, make("span"), make("canvas", { hidden: true }))));
  const words = v => typeof v === "number" ? numberText(v) : v === null ? "none" : "";
  rows.forEach(([name, value, unit, curve, title], i) => {
    const cells = table.rows[i].cells, head = name === "head", other = copy.get(name), [span, canvas] = cells[3].children;
    text(cells[0], head ? "" : name);
    table.rows[i].className = head ? "both" : value === undefined && !(other && other[1] !== undefined) ? "title" : "";
    text(cells[1], head ? "scene" : words(value));
    text(cells[2], typeof value === "number" || (other && typeof other[1] === "number") ? unit : "");
    table.rows[i].title = title || "";
    text(span, head ? "copy" : other ? words(other[1]) : "");
    canvas.hidden = !curve || state !== null;
    if (!canvas.hidden) spark(canvas, samplesOf.scene.list.map(s => s[curve]), curve !== "energy");
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
    const x = w - (w - 2) * (numbers.length - i) / mostSamples, y = h - 2 - (h - 4) * (v - low) / span;
    if (drawing) pen.lineTo(x, y); else pen.moveTo(x - 0.5, y);
    pen.lineTo(x, y);
    drawing = true;
  });
  pen.stroke();
}
