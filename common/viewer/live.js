// A scene that runs ------------------------------------------------------------------------------------------------
// What the server says is in common/live/STREAM.md.

const patience = 10000;  // ms without a server until it counts as gone

const live = Object.assign(newSide(), {
  key: parameters.get("key") || "", connected: false, ended: false, lostAt: 0, retries: 0,
  shown: 0, rate: 1,                       // s, simulated; simulated seconds per second
  geometry: -1, loading: false, reach: 1,  // of the loaded scene; m
  state: null, pictures: 0, pictureMs: 0,
});

const path = name => `/${name}?key=${encodeURIComponent(live.key)}`;
const pause = ms => new Promise(done => setTimeout(done, ms));

// The stream ---

// Puts pieces of the stream together to messages. Each message begins at the buffer's start, so that its floats are aligned.
const assembly = { bytes: new Uint8Array(1 << 16), filled: 0 };

function take(piece) {
  for (let at = 0; at < piece.length;) {
    const a = assembly;
    const length = a.filled < 4 ? 4 : 4 + new DataView(a.bytes.buffer).getUint32(0, true);
    if (length > 1 << 28) throw new Error(`a message of ${length} bytes`);
    if (length > a.bytes.length) {
      const larger = new Uint8Array(2 * length);
      larger.set(a.bytes.subarray(0, a.filled));
      a.bytes = larger;
    }
    const count = Math.min(length - a.filled, piece.length - at);
    a.bytes.set(piece.subarray(at, at + count), a.filled);
    a.filled += count;
    at += count;
    if (a.filled !== length || length <= 4) continue;
    const kind = new DataView(a.bytes.buffer).getUint32(4, true);
    a.filled = 0;
    if (kind === 1) takeFrame(a.bytes, length);
    else if (kind === 3) takeTwinFrame(a.bytes, length);
    else if (kind === 2) takeState(JSON.parse(new TextDecoder().decode(a.bytes.subarray(8, length))));
  }
}

function takeFrame(bytes, length) {
  if (keepFrame(live, bytes, 8, length)) beginAgain();
  now.playing = (live.newest.flags & 1) !== 0;
  if (live.newest.geometry !== live.geometry) loadScene();
  redraw();
}

// The scene stands at its beginning.
function beginAgain() {
  live.shown = 0;
  forgetTwin();
  leaveAlgorithm();
}

// Reads the stream until it ends; a server that is gone for a moment is asked again.
async function follow() {
  while (!live.ended) {
    let reason = "The simulation does not answer.";
    try {
      const answer = await fetch(path("stream"));
      if (answer.status === 503) reason = (await answer.text()).trim() || reason;  // too many pages, or it is about to end
      if (!answer.ok) throw new Error(String(answer.status));
      const reader = answer.body.getReader();
      assembly.filled = 0;
      for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
        connected();
        try {
          take(piece.value);
        } catch (error) {  // not the network's: a message that cannot be read
          console.error(error);
          reader.cancel();
          throw error;
        }
      }
    } catch (error) {
      if (error.message === "403") return end("The key in this page's address is not the simulation's. Open the address that it printed.");
    }
    if (live.ended) return;
    live.connected = false;
    live.lostAt = live.lostAt || performance.now();
    if (performance.now() - live.lostAt > patience) return end(reason + " It has ended, or its computer cannot be reached.", "try again");
    banner(reason + " Trying again …");
    now.playing = false;
    redraw();
    await pause(Math.min(1000, 200 + 100 * live.retries++));
  }
}

function connected() {
  if (live.connected) return;
  live.connected = true;
  live.lostAt = live.retries = 0;
  forgetFrames(live);
  beginAgain();
  banner("");
  const known = live.state;  // a scene that stands still may send none for long; one that the stream sends first is newer
  fetch(path("state")).then(answer => answer.ok ? answer.json() : null).then(state => { if (state && live.state === known) takeState(state); }, () => {});
}

function end(text, again) {
  live.ended = true; live.connected = false; now.playing = false;
  document.body.classList.add("over");
  banner(text, again, () => { live.ended = false; live.lostAt = 0; document.body.classList.remove("over"); banner("Trying again …"); follow(); });
  redraw();
}

// The scene's shapes, anew when bodies or shapes have changed.
async function loadScene() {
  if (live.loading) return;
  live.loading = true;
  const wanted = live.newest ? live.newest.geometry : -1;
  try {
    const answer = await fetch(path("scene.glb"));
    if (!answer.ok) throw new Error(`the server answers ${answer.status} ${answer.statusText}`);
    const old = motion, next = load(new Uint8Array(await answer.arrayBuffer()), old ? old.geometries : []);
    next.geometries.forEach(upload);
    if (old) {
      old.geometries.filter(g => !next.geometries.includes(g)).forEach(forget);
      if (camera.follow) camera.follow = next.bodies[old.bodies.indexOf(camera.follow)] || null;
    }
    motion = next;
    live.geometry = wanted;
    live.reach = next.bodies.reduce((most, b) => b.moves ? Math.max(most, b.geometry.radius) : most, 0) || 1;
    hoverOver(-1);
    offerLevels();
  } finally {
    live.loading = false;
  }
  if (live.newest && live.newest.geometry !== live.geometry) return loadScene();
  redraw();
}

// Commands: one after another; of those of a kind that wait (a drag, a slider), only the last ---

let lastCommand = Promise.resolve();
const waitingCommands = new Map();  // kind -> the command to send when its turn comes

async function post(command) {
  try {
    const answer = await fetch(path("command"), { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(command) });
    const told = await answer.json();
    return { ok: answer.ok && told.ok === true, text: String(told.text || ""), restarted: !!told.restarted, rebuilt: !!told.rebuilt, ms: +told.ms || 0, scene: told.scene };
  } catch (error) {
    return { ok: false, text: "The simulation does not answer." };
  }
}

// The answer to a command; what it refuses is shown.
function command(what) {
  const answer = lastCommand.then(() => post(what));
  lastCommand = answer;
  return answer;
}

// The same for the latest of a kind; null where one waits already, which then says this instead.
function latest(kind, what) {
  const waits = waitingCommands.has(kind);
  waitingCommands.set(kind, what);
  if (waits) return null;
  const answer = lastCommand.then(() => { const last = waitingCommands.get(kind); waitingCommands.delete(kind); return post(last); });
  lastCommand = answer;
  return answer;
}

// Sends a command and shows its line if it is refused; of what is done one sees the effect, but for the ball's size and number.
async function order(what) {
  const answer = await command(what);
  if (!answer.ok || (what.do === "throw" && answer.text)) toast(answer.text || "This was refused.", !answer.ok);
  return answer;
}
