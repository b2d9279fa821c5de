// The beginning ---------------------------------------------------------------------------------------------------------

// What tests ask.
window.viewer = {
  seek, play,
  state: () => ({ ...now, frame: frameAt(now.time), contacts: motion.contacts.filter(c => c.scale > 0).length, view: { target: [...camera.target], distance: camera.distance },
                  values: Object.fromEntries(motion.series.map(s => [s.name, valueNow(s)])), positions: motion.bodies.slice(0, 4).map(b => [...b.position]) }),
  cost: count => {  // ms of our own work for one picture, the graphics card's aside
    const start = performance.now();
    for (let k = 0; k < count; ++k) {
      now.time = motion.duration * k / count;
      if (isLive && live.newest) live.shown = live.before.t + (live.newest.t - live.before.t) * k / count;
      drawScene();
    }
    return (performance.now() - start) / count;
  },
  // Of a running scene. A body is grabbed by its number, at its centre of mass unless a point in its axes is given.
  live: () => ({ connected: live.connected, ended: live.ended, running: now.playing, pictures: live.pictures, pictureMs: live.pictureMs, shown: live.shown,
                 geometry: live.geometry, bodies: motion.bodies.length, frame: live.newest ? live.newest.frame : -1, t: live.newest ? live.newest.t : null,
                 grabbed: grip.held ? grip.body : -1, hovered, state: live.state }),
  twin: () => ({ on: twinState() !== null, split: isSplit(), frame: twin.newest ? twin.newest.frame : -1, t: twin.newest ? twin.newest.t : null, count: apart.count,
                 distance: apart.count ? apart.distance[apart.count - 1] : null, farthest: apart.farthest }),
  algorithm: () => ({ open: algorithm.open, documents: algorithm.documents.length, chosen: algorithm.chosen, at: algorithm.at, steps: algorithm.steps.length,
                      text: algorithm.open ? stepNow().text : "", positions: motion.bodies.slice(0, 4).map(b => [...b.position]) }),
  openAlgorithm, switchTwin,
  grab: (body, local = [0, 0, 0]) => { pointer.x = null; return grab(body, local, dot3(cameraAxes()[2], eyeOf().map((v, i) => v - motion.bodies[body].position[i]))); },
  drag, drop, throw: throwBall, command,
  onScreen: (body, copy = false) => { if (copy) poseLive(twin); const seen = onScreen(motion.bodies[body].position, copy); if (copy) poseLive(live); return seen; },
};

function offerLevels() {
  const levels = [...new Set(motion.levels.map(l => l.level))].sort((a, b) => a - b);
  $("levels").hidden = $("levelKeys").hidden = levels.length === 0;
  $("level").replaceChildren(new Option("off", -1), ...levels.map(level => new Option("level " + level, level)));
}

function begin() {
  for (const s of speeds) $("speed").add(new Option(s >= 1 ? s + " ×" : `1/${Math.round(1 / s)} ×`, s));
  now.wire = parameters.has("wire");
  now.xray = parameters.has("xray");
  now.level = +(parameters.get("level") ?? -1);
  offerLevels();
  $("algorithm").hidden = $("algorithmKeys").hidden = !isLive && motion.algorithm.length === 0;
  frameView();
  listen();
}

function ready(more) {
  drawn = performance.now();
  draw(drawn);
  document.body.dataset.ready = JSON.stringify({ bodies: motion.bodies.length, triangles: motion.bodies.reduce((sum, b) => sum + b.geometry.indices.length / 3, 0), ...more });
}

function playRecording() {
  try {
    motion = load(bytesOf(recording));
    uniforms = program();
    motion.geometries.forEach(upload);
  } catch (error) {
    return fail("The recording in this page cannot be read: " + error.message + ". Run the program again to write it anew.");
  }
  begin();
  const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
  if (parameters.has("t")) now.time = Math.max(0, Math.min(motion.duration, +parameters.get("t") || 0));
  else now.playing = !calm;
  ready({ duration: motion.duration, frames: motion.frameTimes.length, impacts: motion.impacts.length });
}

async function watch() {
  try {
    uniforms = program();
    Object.values(shapes).forEach(upload);
    await loadScene();
  } catch (error) {
    return fail("The scene cannot be fetched: " + error.message + ".");
  }
  begin();
  offerThrow();
  showPanels(innerWidth > 760);
  ready({});
  follow();
}

function main() {
  readColours();
  document.body.classList.add(isLive ? "live" : "recording");
  if (!gl) return fail("This page draws with WebGL 2, which this browser does not offer." + (isLive ? "" : " motion.glb, beside this page, opens in any glTF viewer."));
  if (isLive) watch();
  else playRecording();
}
main();
