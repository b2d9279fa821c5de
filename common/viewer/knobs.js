// Knobs and effects of a running scene ---------------------------------------------------------------------------------------------

// Whom a setting is for while there are two copies: "scene" or "twin".
let settingsFor = "scene";

function setFor(which) {
  if (settingsFor === which) return;
  settingsFor = which;
  for (const knob of knobs.values()) { knob.shown = null; text(knob.answer, ""); }
  for (const effect of effects.values()) text(effect.answer, "");
  for (const [id, name] of [["forScene", "scene"], ["forTwin", "twin"]]) $(id).setAttribute("aria-pressed", which === name);
  offerSettings();
}

// The command that sets a key of the scene, or of the copy alone.
const setting = (key, value) => settingsFor === "twin" ? { do: "set", key, value, of: "twin" } : { do: "set", key, value };

function offerSettings() {
  const copy = twinState(), own = settingsFor === "twin" && copy ? copy : live.state, other = copy ? (own === copy ? live.state : copy) : null;
  offerKnobs(own.knobs || [], other ? other.knobs || [] : null);
  offerEffects(Object.entries(own.effects || {}), other ? other.effects || {} : null);
}
const otherName = () => settingsFor === "twin" ? "scene" : "copy";

// Knobs -----

const knobs = new Map();  // key -> its elements, and what it shows

function offerKnobs(list, others) {
  const signature = JSON.stringify(list.map(k => [k.key, k.low, k.high, k.choices, k.restarts, k.can_switch, k.why]));
  if (signature !== $("knobs").dataset.signature) {
    $("knobs").dataset.signature = signature;
    knobs.clear();
    $("knobs").replaceChildren(...list.map(knobRow));
    $("knobsPart").hidden = !list.length;
  }
  for (const k of list) {
    showKnob(knobs.get(k.key), k.value);
    const other = others && others.find(o => o.key === k.key);
    markOther(knobs.get(k.key), other && other.value !== k.value ? `${otherName()}: ${other.value || "none"}` : "");
  }
}

const isLogarithmic = k => k.low > 0 && k.high > k.low;
// A slider's place, 0 to 1000, for a value, and back.
const placeOf = (k, v) => Math.round(1000 * (isLogarithmic(k) ? Math.log(v / k.low) / Math.log(k.high / k.low) : (v - k.low) / (k.high - k.low)));
const valueAt = (k, place) => isLogarithmic(k) ? k.low * (k.high / k.low) ** (place / 1000) : k.low + (k.high - k.low) * place / 1000;
// Two digits are enough for a slider; more can be typed.
const knobText = v => String(+v.toPrecision(2)).replace(/e\+/, "e");

// What the other of two copies has instead.
function markOther(setting, words) {
  setting.row.classList.toggle("differs", words !== "");
  text(setting.other, words);
  setting.other.hidden = words === "";
}

function knobRow(k) {
  const id = "knob_" + k.key, words = (k.choices || []).length > 0, disabled = k.can_switch === false;
  const field = words ? make("select", { id, disabled }, ...k.choices.map(c => new Option(c, c))) : make("input", { id, disabled, type: "text", spellcheck: false, autocomplete: "off" });
  const slider = !words && k.high > k.low ? make("input", { type: "range", disabled, min: 0, max: 1000, step: 1 }) : null;
  if (slider) slider.setAttribute("aria-label", k.key);
  const note = make("div", { className: "note" }), answer = make("div", { className: "answer" }), other = make("span", { className: "tag other", hidden: true });
  answer.setAttribute("aria-live", "polite");
  note.textContent = k.meaning + (k.restarts ? " Restarts the scene." : "");
  const why = make("div", { className: "note why", hidden: !disabled }, k.why || "This cannot be set here.");
  const head = make("label", { htmlFor: id }, make("code", {}, k.key));
  const row = make("div", { className: disabled ? "knob off" : "knob" }, make("div", { className: "head" }, head, ...(k.restarts ? [make("span", { className: "tag" }, "restarts")] : []), field, make("span", { className: "unit" }, k.unit === "1" ? "" : k.unit || "")),
                   ...(slider ? [slider] : []), other, note, why, answer);
  const knob = { ...k, row, other, field, slider, answer, busy: 0 };
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
  const whose = settingsFor, sent = latest(`set ${knob.key} ${whose}`, setting(knob.key, String(value).trim()));
  if (!sent) return;
  ++knob.busy;
  tell(knob.answer, await sent, knob.key, whose);
  --knob.busy;
  knob.shown = null;  // what holds now is the server's to say
  if (knob.field.tagName === "INPUT" && document.activeElement === knob.field) knob.field.select();
}

// What became of a setting, below its knob or switch.
function tell(element, answer, key, whose) {
  element.className = answer.ok ? "answer" : "answer bad";
  const how = answer.restarted ? "scene restarted" : answer.rebuilt ? "rebuilt" : "set";
  text(element, answer.ok ? `${how}${answer.ms > 0 ? ` in ${short(+answer.ms.toPrecision(2))} ms` : ""}${answer.text ? ": " + answer.text : ""}` : answer.text);
  if (!answer.ok) return;
  samplesOf[whose].mark = key;
  books[whose].start = null;
}

// Effects -----

const effects = new Map();  // name -> its elements

function offerEffects(list, others) {
  const signature = JSON.stringify(list.map(([name, e]) => [name, e.can_switch, e.set]));
  if (signature !== $("effects").dataset.signature) {
    $("effects").dataset.signature = signature;
    effects.clear();
    $("effects").replaceChildren(...list.map(([name, e]) => effectRow(name, e)));
    $("effectsPart").hidden = !list.length;
  }
  for (const [name, e] of list) {
    const other = others && others[name], differs = other && (other.on !== e.on || (other.set || {}).on !== (e.set || {}).on);
    showEffect(effects.get(name), e);
    markOther(effects.get(name), differs ? `${otherName()}: ${other.on ? other.on === e.on ? other.set.on : "on" : "off"}` : "");
  }
}

function effectRow(name, e) {
  const button = make("button", { className: "switch", disabled: !canSwitch(e) }), ms = make("b"), why = make("div", { className: "note" }), adds = make("div", { className: "note" });
  const answer = make("div", { className: "answer" }), other = make("span", { className: "tag other", hidden: true });
  button.setAttribute("role", "switch");
  button.setAttribute("aria-label", name);
  answer.setAttribute("aria-live", "polite");
  const row = make("div", { className: "effect" }, make("div", { className: "head" }, button, make("span", { className: "name" }, name.replace(/_/g, " ")), other, ms), why, adds, answer);
  const effect = { row, other, button, ms, why, adds, answer, set: e.set, busy: false };
  effects.set(name, effect);
  button.onclick = async () => {
    if (effect.busy) return;
    effect.busy = true;
    row.classList.add("busy");
    const on = button.getAttribute("aria-checked") !== "true", whose = settingsFor;
    tell(answer, await command(setting(e.set.key, on ? e.set.on : "none")), `${name} ${on ? "on" : "off"}`, whose);
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
