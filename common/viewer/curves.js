// Curves, and the time line under them ------------------------------------------------------------------------------

const margin = { left: 66, right: 16, bottom: 20, top: 6 };
const curveColours = ["#2f7fd0", "#e08a00", "#8c57b8", "#1f9a6a"];
const short = v => v === 0 ? "0" : Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3 ? v.toExponential(1) : String(+v.toPrecision(4));

// What happened in a frame, and not what is at its end.
const isOfFrame = curve => curve.group === "contacts" || curve.group === "impulse";

// A curve's value to show: of the frame that holds this time, or at the end of the last one that is over.
function valueNow(curve) {
  const over = frameAt(now.time), inside = now.time > motion.frameTimes[over] + 1e-6;
  return curve.values[Math.min(curve.values.length - 1, isOfFrame(curve) && inside ? over + 1 : over)];
}

// How many contacts there are, in the box and in the strip: of the frame; in a recording without frames, those in sight.
function contactsNow() {
  const curve = motion.series.find(s => s.name === "contacts in the frame");
  return curve ? valueNow(curve) : motion.contacts.filter(c => c.scale > 0).length;
}

function drawStrips() {
  const canvas = $("strips"), ratio = fit(canvas), pen = canvas.getContext("2d");
  const w = canvas.clientWidth, h = canvas.clientHeight, { soft, line, ink, mark } = colours;
  const x = t => margin.left + (w - margin.left - margin.right) * (motion.duration > 0 ? t / motion.duration : 0);
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, w, h);
  pen.font = "11px system-ui, sans-serif";
  const groups = [...new Set(motion.series.map(s => s.group))];
  const height = (h - margin.bottom - margin.top) / Math.max(1, groups.length);
  groups.forEach((group, g) => {
    const curves = motion.series.filter(s => s.group === group);
    const top = margin.top + g * height + 16, bottom = margin.top + (g + 1) * height - 5;
    let low = 0, high = 0;
    for (const c of curves) for (const v of c.values) { low = Math.min(low, v); high = Math.max(high, v); }
    const rounding = Math.max(...curves.map(c => c.rounding || 0));  // a range below it is none
    if (high - low <= rounding) high = low + (rounding || 1);
    const y = v => bottom - (bottom - top) * (v - low) / (high - low);
    pen.strokeStyle = line; pen.lineWidth = 1;
    pen.beginPath(); pen.moveTo(margin.left, y(0)); pen.lineTo(w - margin.right, y(0)); pen.stroke();
    pen.fillStyle = soft; pen.textAlign = "right"; pen.textBaseline = "middle";
    pen.fillText(short(high), margin.left - 6, top + 2);
    if (y(low) - top > 14) pen.fillText(short(low), margin.left - 6, bottom - 2);
    let written = margin.left;  // names and values beside each other, as far as they go
    curves.forEach((curve, k) => {
      const bars = isOfFrame(curve), colour = curveColours[(g + k) % curveColours.length];
      pen.strokeStyle = pen.fillStyle = colour; pen.lineWidth = 1.5;
      pen.beginPath();
      curve.values.forEach((v, i) => {
        if (bars) { if (v !== 0) { pen.moveTo(x(motion.frameTimes[i]), y(0)); pen.lineTo(x(motion.frameTimes[i]), y(v)); } }
        else if (i === 0) pen.moveTo(x(motion.frameTimes[0]), y(v));
        else pen.lineTo(x(motion.frameTimes[i]), y(v));
      });
      pen.stroke();
      const words = `${curve.name}: ${short(valueNow(curve))} ${curve.unit}`;
      pen.textAlign = "left"; pen.textBaseline = "bottom";
      pen.fillText(words, written, top - 3, Math.max(40, w - margin.right - written));
      written += Math.max(pen.measureText(words).width + 14, w > 700 ? 190 : 0);
    });
    const remark = curves.map(c => c.remark).find(text => text);
    pen.fillStyle = soft; pen.textAlign = "right";
    if (remark && written + pen.measureText(remark).width < w - margin.right) pen.fillText(remark, w - margin.right, top - 3);
  });
  pen.strokeStyle = mark; pen.lineWidth = 1.5;
  for (const t of motion.impacts) { pen.beginPath(); pen.moveTo(x(t), h - margin.bottom); pen.lineTo(x(t), h - margin.bottom + 6); pen.stroke(); }
  pen.strokeStyle = soft; pen.lineWidth = 1;
  pen.beginPath(); pen.moveTo(margin.left, h - margin.bottom); pen.lineTo(w - margin.right, h - margin.bottom); pen.stroke();
  pen.fillStyle = soft; pen.textBaseline = "bottom"; pen.textAlign = "left";
  pen.fillText("0 s", margin.left, h - 1);
  pen.textAlign = "right";
  pen.fillText(short(motion.duration) + " s", w - margin.right, h - 1);
  pen.strokeStyle = ink; pen.lineWidth = 1.5;
  pen.beginPath(); pen.moveTo(x(now.time), margin.top); pen.lineTo(x(now.time), h - margin.bottom + 6); pen.stroke();
}

function drawInfo() {
  const { title, chapter, note } = motion.extras;
  const hulls = motion.levels.filter(l => l.level === now.level).reduce((sum, l) => sum + l.hulls * l.bodies.length, 0);
  const rows = [["time", now.time.toFixed(6) + " s"], ["frame", `${frameAt(now.time)} of ${motion.frameTimes.length - 1}`],
                ["contacts", short(contactsNow())]];
  if (hulls) rows.push(["hulls", `level ${now.level}: ${hulls}`]);
  if (camera.follow) rows.push(["following", camera.follow.name.replace("_", " ")]);
  writeInfo(title || "motion", [chapter, note].filter(Boolean).join(" · "), rows);
}

function drawLiveInfo() {
  const { newest, state } = live, since = newest ? (performance.now() - newest.arrived) / 1000 : 0, dt = state ? state.dt / Math.max(1e-6, state.speed || 1) : 1;
  const condition = live.ended ? "ended" : !live.connected ? "not connected" : state && state.failed ? "failed" : now.playing ? "live" : "live, paused";
  const rows = [["time", live.shown.toFixed(3) + " s"], ["frame", newest ? String(newest.frame) : "–"], ["bodies", String(motion.bodies.length)], ["contacts", newest ? String(newest.contacts) : "–"]];
  if (now.playing && since > 1 + 2 * dt) rows.push(["this frame", `${since.toFixed(0)} s so far`]);
  if (camera.follow) rows.push(["following", camera.follow.name.replace("_", " ")]);
  const body = grip.body >= 0 ? grip.body : hovered;
  if (body >= 0) rows.push([grip.body >= 0 ? "in hand" : "pointed at", motion.bodies[body].name.replace("_", " ")]);
  writeInfo((state && state.title) || motion.extras.title || "scene", [motion.extras.chapter, condition].filter(Boolean).join(" · "), rows);
}

// The box at the top left. Only what has changed is written: a page that is laid out anew in every picture is slow.
function writeInfo(title, remark, rows) {
  const box = $("info");
  if (!box.firstChild) box.append(make("h1"), make("div", { className: "soft" }), make("table"));
  const [head, soft, table] = box.children;
  text(head, title);
  text(soft, remark);
  while (table.rows.length > rows.length) table.deleteRow(-1);
  while (table.rows.length < rows.length) table.insertRow().append(make("td", { className: "soft" }), make("td"));
  rows.forEach(([name, value], i) => { text(table.rows[i].cells[0], name); text(table.rows[i].cells[1], value); });
}
