// Hands ------------------------------------------------------------------------------------------------------------------

// Buttons and keys. What a recording and a running scene share has one name.
function listen() {
  const toggle = name => { now[name] = !now[name]; redraw(); };
  const levels = () => Math.max(-1, ...motion.levels.map(l => l.level));
  const changeLevel = by => { now.level = Math.max(-1, Math.min(levels(), now.level + by)); redraw(); };
  const toSpeed = speed => { now.speed = speed; if (isLive) order({ do: "speed", value: speed }); redraw(); };
  const changeSpeed = by => toSpeed(speeds[Math.max(0, Math.min(speeds.length - 1, speeds.indexOf(now.speed) + by))]);
  const help = () => { $("help").style.display = $("help").style.display === "block" ? "none" : "block"; };
  const reset = () => { frameView(); redraw(); };
  const play_ = () => isLive ? order({ do: now.playing ? "pause" : "run" }) : play(!now.playing);
  const ahead = () => isLive ? order({ do: "step" }) : stepFrames(1);
  const escape = () => algorithm.open ? leaveAlgorithm() : isLive && drop();
  const stepTo = by => { if (algorithm.open) toStep(algorithm.at + by); };
  const again = () => order({ do: "reset" }), panels = () => showPanels($("panels").hidden);
  const buttons = { ahead, play: play_, wire: () => toggle("wire"), xray: () => toggle("xray"), arrows: () => toggle("arrows"), reset, what: help, algorithm: openAlgorithm };
  const keys = {
    " ": play_, ArrowRight: ahead, ",": () => changeSpeed(-1), ".": () => changeSpeed(1), w: buttons.wire, x: buttons.xray, c: buttons.arrows,
    h: () => changeLevel(1), H: () => changeLevel(-1), r: reset, "?": help, a: openAlgorithm, "]": () => stepTo(1), "[": () => stepTo(-1), PageDown: () => stepTo(1), PageUp: () => stepTo(-1), f: lookCloser, Escape: escape,
  };
  if (isLive) {
    Object.assign(buttons, { again, throw: () => throwBall(), save, stop: stopTwice, more: panels, twin: switchTwin, forScene: () => setFor("scene"), forTwin: () => setFor("twin") });
    Object.assign(keys, { b: () => throwBall(pointer.x, pointer.y), 0: again, s: save, p: panels, t: switchTwin });
  } else {
    Object.assign(buttons, { previous: () => toImpact(-1), next: () => toImpact(1), back: () => stepFrames(-1) });
    Object.assign(keys, { ArrowLeft: () => stepFrames(-1), ArrowDown: () => toImpact(1), n: () => toImpact(1), ArrowUp: () => toImpact(-1), p: () => toImpact(-1) });
  }
  for (const [id, action] of Object.entries(buttons)) $(id).onclick = () => action();
  $("speed").onchange = e => toSpeed(+e.target.value);
  $("level").onchange = e => { now.level = +e.target.value; redraw(); };
  addEventListener("keydown", e => {
    const tag = e.target.tagName;
    const typed = e.getModifierState("AltGraph");  // where ] and [ are typed with it
    if ((!typed && (e.ctrlKey || e.altKey)) || e.metaKey || tag === "SELECT" || tag === "INPUT") return;
    const action = keys[e.key] || keys[e.key.toLowerCase()];
    if (!action || (e.key === " " && (tag === "BUTTON" || tag === "SUMMARY"))) return;
    e.preventDefault();
    action();
  });
  listenToScene();
  listenToAlgorithm();
  if (!isLive) listenToStrips();
  addEventListener("resize", redraw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { readColours(); drawCharts(); redraw(); });
}

// The pointer on the scene: it takes a body in a running scene, or turns, moves and nears the view.
function listenToScene() {
  const scene = $("scene"), touches = new Map();
  scene.oncontextmenu = e => e.preventDefault();
  scene.onpointerdown = e => {
    scene.setPointerCapture(e.pointerId);
    touches.set(e.pointerId, [e.clientX, e.clientY]);
    Object.assign(pointer, { x: e.clientX, y: e.clientY });
    if (isLive && !algorithm.open && touches.size === 1 && e.button === 0 && !e.shiftKey) grabAt(e.clientX, e.clientY);
    else if (touches.size > 1) drop();
  };
  scene.onpointerup = scene.onpointercancel = e => { touches.delete(e.pointerId); drop(); };
  scene.onpointerleave = () => { pointer.x = null; hoverOver(-1); };
  scene.onpointermove = e => {
    Object.assign(pointer, { x: e.clientX, y: e.clientY, moved: isLive && e.pointerType !== "touch" });
    const last = touches.get(e.pointerId);
    if (!last) return isLive && redraw();
    const dx = e.clientX - last[0], dy = e.clientY - last[1];
    if (grip.body >= 0) {
      dragOn();
    } else if (touches.size === 2) {  // two fingers: nearer and farther, and sideways
      const other = [...touches].find(([id]) => id !== e.pointerId)[1];
      const before = Math.hypot(last[0] - other[0], last[1] - other[1]), after = Math.hypot(e.clientX - other[0], e.clientY - other[1]);
      camera.distance *= before / Math.max(1, after);
      pan(dx / 2, dy / 2);
    } else if (e.shiftKey || e.buttons & (isLive ? 4 : 2)) {
      pan(dx, dy);
    } else {
      camera.yaw -= 0.008 * dx;
      camera.pitch = Math.max(-1.55, Math.min(1.55, camera.pitch + 0.008 * dy));
    }
    touches.set(e.pointerId, [e.clientX, e.clientY]);
    redraw();
  };
  const pan = (dx, dy) => {
    const [right, up] = cameraAxes(), s = 0.73 * camera.distance / scene.clientHeight;
    camera.follow = null;
    camera.target = camera.target.map((v, i) => v - s * dx * right[i] + s * dy * up[i]);
  };
  scene.addEventListener("wheel", e => {
    e.preventDefault();
    if (grip.body >= 0) { grip.depth *= Math.exp(-0.001 * e.deltaY); dragOn(); }
    else camera.distance *= Math.exp(0.001 * e.deltaY);
    redraw();
  }, { passive: false });
  scene.ondblclick = e => {  // the body whose middle is drawn nearest
    const copy = copyAt(e.clientX);
    let best = 80;
    if (copy) poseLive(twin);
    for (const body of motion.bodies) {
      const seen = onScreen(body.position, copy), away = Math.hypot(seen.x - e.clientX, seen.y - e.clientY);
      if (seen.before && away < best) { best = away; camera.follow = body; }
    }
    if (copy) poseLive(live);
    redraw();
  };
}

function listenToStrips() {
  const strips = $("strips");
  const scrub = e => {
    now.playing = false;
    seek(motion.duration * (e.clientX - strips.getBoundingClientRect().left - margin.left) / (strips.clientWidth - margin.left - margin.right));
  };
  strips.onpointerdown = e => { strips.setPointerCapture(e.pointerId); scrub(e); };
  strips.onpointermove = e => { if (e.buttons) scrub(e); };
}
