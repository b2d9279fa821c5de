// Charts of a step of the algorithm, as SVG -------------------------------------------------------------------------------------

function svg(tag, attributes, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}
// How wide a text is in the charts' letters.
const ruler = document.createElement("canvas").getContext("2d");
function roomFor(words) {
  ruler.font = "12px system-ui, sans-serif";
  return Math.ceil(ruler.measureText(words).width) + 1;
}
// A text without its end, if it does not fit.
function cut(words, space) {
  if (roomFor(words) <= space) return words;
  let count = words.length;
  while (count > 1 && roomFor(words.slice(0, count) + "…") > space) --count;
  return words.slice(0, count) + "…";
}

// Round numbers that part a range into some four pieces.
function ticksOf(low, high, pieces = 4) {
  const raw = (high - low) / pieces, power = 10 ** Math.floor(Math.log10(raw)), step = power * [1, 2, 2.5, 5, 10].find(f => f * power >= 0.999 * raw);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) ticks.push(k * step);
  return ticks;
}
function decadesOf(low, high, most = 6) {
  const stride = Math.max(1, Math.ceil((high - low) / most)), ticks = [];
  for (let k = Math.ceil(low); k <= high + 1e-9; k += stride) ticks.push(k);
  return ticks;
}
// Ticks with as many digits as tell them apart.
function tickTexts(ticks) {
  const most = Math.max(...ticks.map(Math.abs)), step = ticks.length > 1 ? ticks[1] - ticks[0] : most;
  if (most >= 1e5 || most < 1e-3) {
    const digits = Math.max(0, Math.min(12, Math.floor(Math.log10(most || 1)) - Math.floor(Math.log10(step || 1) + 1e-9)));
    return ticks.map(v => v === 0 ? "0" : v.toExponential(digits));
  }
  const two = Math.abs(step / 10 ** Math.floor(Math.log10(step) + 1e-9) - 2.5) < 1e-6 ? 1 : 0;
  return ticks.map(v => v.toFixed(Math.max(0, Math.min(9, two - Math.floor(Math.log10(step || 1) + 1e-9)))));
}

// The range of values, with some air; of a logarithm in decades, of the positive ones.
function rangeOf(values, log) {
  const usable = values.filter(v => Number.isFinite(v) && (!log || v > 0)).map(v => log ? Math.log10(v) : v);
  if (!usable.length) return [0, 1];
  let low = Math.min(...usable), high = Math.max(...usable);
  if (log) return [Math.floor(low), Math.max(Math.ceil(high), Math.floor(low) + 1)];
  if (low >= 0 && low < 0.4 * high) low = 0;
  if (low === 0 && high === 0) return [0, 1];
  if (!(high > low)) { const half = Math.abs(low) || 1; return [low - 0.5 * half, low + 0.5 * half]; }
  const air = 0.06 * (high - low);
  return [low === 0 ? 0 : low - air, high + air];
}

function chartOf({ x, y, log, curves, marks: notes }, width, height) {
  const points = curves.flatMap(c => c.points), noted = notes || [];
  const xs = [...points, ...noted].map(p => p[0]).filter(Number.isFinite), [bottom, top] = rangeOf([...points, ...noted].map(p => p[1]), log);
  const [left, right] = xs.length && Math.max(...xs) > Math.min(...xs) ? [Math.min(...xs), Math.max(...xs)] : rangeOf(xs, false);
  const ySteps = log ? decadesOf(bottom, top) : ticksOf(bottom, top), yTexts = log ? ySteps.map(k => bottom >= -3 && top <= 3 ? String(+(10 ** k).toPrecision(1)) : `1e${k}`) : tickTexts(ySteps);
  const area = { left: 14 + Math.max(...yTexts.map(roomFor)), right: width - 14, top: 26, bottom: height - 40 };
  const px = v => area.left + (area.right - area.left) * (v - left) / (right - left);
  const py = v => { const level = log ? (v > 0 ? Math.log10(v) : bottom) : v; return area.bottom - (area.bottom - area.top) * (level - bottom) / (top - bottom); };
  const drawing = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${y} against ${x}` });
  ySteps.forEach((v, k) => {
    const at = py(log ? 10 ** v : v);
    drawing.append(svg("line", { x1: area.left, x2: area.right, y1: at, y2: at, class: "grid" }), svg("text", { x: area.left - 6, y: at + 4, class: "tick", "text-anchor": "end" }, yTexts[k]));
  });
  let xSteps = ticksOf(left, right), xTexts = tickTexts(xSteps);
  while (xSteps.length > 2 && Math.max(...xTexts.map(roomFor)) * xSteps.length > 0.9 * (area.right - area.left)) {  // fewer, so that none touch
    xSteps = xSteps.filter((_, k) => k % 2 === 0);
    xTexts = xTexts.filter((_, k) => k % 2 === 0);
  }
  xSteps.forEach((v, k) => drawing.append(svg("line", { x1: px(v), x2: px(v), y1: area.bottom, y2: area.bottom + 4, class: "axis" }), svg("text", { x: px(v), y: area.bottom + 17, class: "tick", "text-anchor": "middle" }, xTexts[k])));
  drawing.append(svg("line", { x1: area.left, x2: area.right, y1: area.bottom, y2: area.bottom, class: "axis" }), svg("text", { x: area.left - 4, y: 14, class: "name", "text-anchor": "start" }, y),
                 svg("text", { x: area.right, y: height - 6, class: "name", "text-anchor": "end" }, x));
  for (const curve of curves) drawing.append(...curveParts(curve, px, py));
  drawing.append(...noteParts(noted, px, py, area));
  const legend = make("div", { className: "curves" }, ...curves.map(c => { const line = make("i"); line.style.background = roleColour(c.role); return make("span", {}, line, c.name); }));
  return [drawing, legend];
}

// A curve through its points, or in steps; its points, too, where they are few.
function curveParts({ role, points, steps }, px, py) {
  const seen = points.filter(p => Number.isFinite(p[0]) && Number.isFinite(p[1]));
  const way = seen.map(([x, y], k) => k === 0 ? `M${px(x)} ${py(y)}` : steps ? `H${px(x)}V${py(y)}` : `L${px(x)} ${py(y)}`).join("");
  const colour = roleColour(role), parts = [svg("path", { d: way, fill: "none", stroke: colour, "stroke-width": role === "now" ? 2.5 : 1.75, "stroke-linejoin": "round" })];
  if (seen.length <= 24 && !steps) parts.push(...seen.map(([x, y]) => svg("circle", { cx: px(x), cy: py(y), r: 2.5, fill: colour })));
  return parts;
}

// Texts at points, each where it covers none before it.
function noteParts(notes, px, py, area) {
  const boxes = [], parts = [];
  for (const [x, y, words] of notes) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
    const cx = px(x), cy = py(y), wide = roomFor(words);
    let best = null;
    for (const rise of [-9, 16, -24, 31, -39, 46]) {
      for (const from of [cx + 6, cx - 6 - wide, cx - wide / 2]) {
        const left = Math.max(area.left, Math.min(area.right - wide, from)), box = [left, cy + rise - 11, left + wide, cy + rise + 3];
        if (box[1] < area.top - 8 || box[3] > area.bottom - 1 || boxes.some(other => overlap(box, other))) continue;
        best = box;
        break;
      }
      if (best) break;
    }
    parts.push(svg("circle", { cx, cy, r: 4, class: "noted" }));
    if (!best) continue;
    boxes.push(best, [cx - 4, cy - 4, cx + 4, cy + 4]);
    parts.push(svg("text", { x: best[0], y: best[3] - 3, class: "note" }, words));
  }
  return parts;
}

// Numbers that differ little are told apart by their places, not by bars from zero, which would all look alike.
const isCrowded = values => values.length > 1 && Math.min(...values) > 0 && Math.max(...values) - Math.min(...values) < 0.25 * Math.max(...values) && Math.max(...values) > Math.min(...values);
// As short as it can be, but with the digits that tell the values apart.
function barTexts(rows, span) {
  return rows.map(({ value, note }) => {
    if (!Number.isFinite(value)) return ["–", note || ""];
    const digits = value && span ? Math.max(4, Math.min(12, 3 + Math.ceil(Math.log10(Math.abs(value) / span)))) : 4;
    return [digits > 4 ? String(+value.toPrecision(digits)) : short(value), note || ""];
  });
}

// Bars, one below the other: name, bar, value and a word on it. Names and words that do not fit beside their bar stand above it.
function barsOf({ title, unit, rows }, width) {
  const values = rows.map(r => r.value).filter(Number.isFinite), crowded = isCrowded(values), spread = Math.max(...values) - Math.min(...values);
  const high = crowded ? Math.max(...values) + 0.05 * spread : Math.max(0, ...values), low = crowded ? Math.min(...values) - 0.05 * spread : Math.min(0, ...values), span = high - low || 1;
  const told = barTexts(rows, crowded ? spread : 0).map(([value, note]) => note ? `${value}, ${note}` : value);
  const names = 8 + Math.max(0, ...rows.map(r => roomFor(r.label))), numbers = 8 + Math.max(0, ...told.map(roomFor)), above = names + numbers > 0.6 * width;
  const from = above ? 16 : names, until = above ? width - 16 : width - numbers, tall = above ? 36 : 22, top = 6, bottom = top + tall * rows.length, px = v => from + (until - from) * (v - low) / span;
  const drawing = svg("svg", { width, height: bottom + 36, viewBox: `0 0 ${width} ${bottom + 36}`, role: "img", "aria-label": title });
  const ticks = ticksOf(low, low + span), texts = tickTexts(ticks), stride = Math.ceil(1.3 * Math.max(...texts.map(roomFor)) * ticks.length / (until - from));
  ticks.forEach((v, k) => {
    drawing.append(svg("line", { x1: px(v), x2: px(v), y1: top, y2: bottom + 4, class: "grid" }));
    if (k % stride === 0) drawing.append(svg("text", { x: px(v), y: bottom + 18, class: "tick", "text-anchor": "middle" }, texts[k]));
  });
  rows.forEach(({ label, value, role }, k) => {
    const y = top + tall * k, full = svg("title", {}, `${label}: ${told[k]}`), own = cut(told[k], above ? 0.6 * width : numbers);
    const row = svg("g", {}, full, svg("text", { x: 0, y: y + 15, class: "label" }, cut(label, above ? width - roomFor(own) - 14 : names)));
    row.append(above ? svg("text", { x: width - 2, y: y + 15, class: "label", "text-anchor": "end" }, own) : svg("text", { x: until + 8, y: y + 15, class: "label" }, own));
    if (Number.isFinite(value)) row.append(...barParts(px(crowded ? low : 0), px(value), above ? y + 20 : y + 4, above ? 11 : tall - 8, roleColour(role), crowded));
    drawing.append(row);
  });
  if (!crowded) drawing.append(svg("line", { x1: px(0), x2: px(0), y1: top, y2: bottom + 4, class: "axis" }));
  return [make("div", { className: "chartName" }, unit && unit !== "1" && !title.includes(`[${unit}]`) ? `${title} [${unit}]` : title), drawing];
}
function barParts(zero, end, y, height, colour, crowded) {
  if (!crowded) return [svg("rect", { x: Math.min(zero, end), y, width: Math.max(1, Math.abs(end - zero)), height, fill: colour, rx: 1.5 })];
  const middle = y + height / 2;
  return [svg("line", { x1: zero, x2: end, y1: middle, y2: middle, stroke: colour, "stroke-dasharray": "1 4" }), svg("circle", { cx: end, cy: middle, r: 5, fill: colour })];
}
