// Time ------------------------------------------------------------------------------------------------------------------

const now = { time: 0, playing: false, speed: 1, wire: false, xray: false, arrows: true, level: -1 };
const speeds = [0.001, 0.01, 0.05, 0.2, 0.5, 1, 2, 4].filter(s => !isLive || s <= 1);
let motion = null, uniforms = null, drawn = 0, waiting = false;

const frameAt = t => keyBefore(motion.frameTimes, t + 1e-6, 0);

function seek(t) {
  now.time = Math.max(0, Math.min(motion.duration, t));
  redraw();
}
function stepFrames(count) {
  now.playing = false;
  const k = frameAt(now.time), between = now.time > motion.frameTimes[k] + 1e-6;
  seek(motion.frameTimes[Math.max(0, Math.min(motion.frameTimes.length - 1, k + count + (count < 0 && between ? 1 : 0)))]);
}
function toImpact(direction) {
  now.playing = false;
  const later = [...motion.impacts].filter(t => direction > 0 ? t > now.time + 1e-6 : t < now.time - 1e-6);
  if (later.length) seek(direction > 0 ? later[0] : later[later.length - 1]);
  else redraw();
}
function play(on) {
  now.playing = on;
  if (on && now.time >= motion.duration) now.time = 0;
  redraw();
}
function redraw() {
  if (!waiting && motion) { waiting = true; requestAnimationFrame(draw); }
}
function draw(clock) {
  waiting = false;
  const passed = Math.max(0, Math.min(0.1, (clock - drawn) / 1000));  // a frame's clock may be older than main()'s
  drawn = Math.max(drawn, clock);
  if (isLive) drawLive(passed);
  else drawRecording(passed);
}
function drawRecording(passed) {
  if (now.playing) {
    now.time = Math.min(motion.duration, now.time + passed * now.speed);
    if (now.time >= motion.duration) now.playing = false;
  }
  keepUpAlgorithm();
  drawScene();
  drawOverlay();
  drawAxes();
  if (!algorithm.open) drawStrips();
  drawInfo();
  showButtons();
  if (now.playing) redraw();
}
// A picture of the stream. It asks for the next one while there is motion left to show.
function drawLive(passed) {
  const start = performance.now(), more = advance(passed);
  hover();
  if (grip.body >= 0) dragOn();
  keepUpAlgorithm();
  drawScene();
  drawOverlay();
  drawAxes();
  drawLiveInfo();
  showButtons();
  ++live.pictures;
  live.pictureMs += 0.05 * (performance.now() - start - live.pictureMs);
  if (more) redraw();
}
function showButtons() {
  const text = now.playing ? "pause" : isLive ? "run" : "play";
  if ($("play").textContent !== text) $("play").textContent = text;
  for (const name of ["wire", "xray", "arrows"]) $(name).setAttribute("aria-pressed", now[name]);
  $("speed").value = now.speed;
  $("level").value = now.level;
}
