#include "ch04_multibody_stepping/live_offer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/scene_keys.hpp"

namespace fc::world {
namespace {

// An effect that a key switches by being there.
struct Switch {
  const char* effect;  // as --explain calls it
  const char* key;
  const char* on;    // a value, if the scene has none
  const char* adds;  // if it is on
};
constexpr Switch kSwitches[] = {
    {"gravity", "gravity", "[0, 0, -9.81]", "free fall in closed form inside every motion"},
    {"gyroscopic", "gyroscopic", "true", "torque-free rotation in closed form (Jacobi) inside every motion"},
    {"drag", "drag", "{linear: 0.1, angular: 0.1}", "exponential decay in closed form inside every motion"},
    {"restitution", "restitution", "0.5", "the right-hand side of the LCP"},
    {"friction", "friction", "0.5", "three rows a contact"},
    {"envelope", "envelope", "0", "contacts that last, in plans"},
    {"sleep", "sleep", "{after: 0.25, speed: 0.01}", "bodies at rest for long enough cost nothing"},
};

std::string vector_text(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}

// The value that switches the effect on: the scene's own, if it has one.
std::string value_for_on(const Switch& effect, const Scene& scene) {
  const std::string key = effect.key;
  if (key == "gravity" && scene.gravity) return vector_text(*scene.gravity);
  if (key == "drag" && scene.drag)
    return fmt::format("{{linear: {}, angular: {}}}", scene.drag->linear, scene.drag->angular);
  if (key == "restitution" && scene.restitution) return fmt::format("{}", *scene.restitution);
  if (key == "friction" && scene.friction) return fmt::format("{}", *scene.friction);
  if (key == "envelope" && scene.envelope) return fmt::format("{}", *scene.envelope);
  if (key == "sleep" && scene.sleep)
    return fmt::format("{{after: {}, speed: {}}}", scene.sleep->after, scene.sleep->speed);
  return effect.on;
}

// Whether shapes or pairs ask for the effect, too: then the scene's own key alone does not switch it off.
bool is_asked_for_elsewhere(const std::string& key, const Scene& scene) {
  const auto shape_has = [&](const ShapeSpec& shape) {
    return key == "restitution" ? shape.restitution.has_value() : key == "friction" && shape.friction;
  };
  const auto pair_has = [&](const PairSpec& pair) {
    return key == "restitution" ? pair.restitution.has_value() : key == "friction" && pair.friction;
  };
  return std::any_of(scene.shapes.begin(), scene.shapes.end(), shape_has) ||
         std::any_of(scene.pairs.begin(), scene.pairs.end(), pair_has);
}

const Switch* switch_of(const std::string& effect) {
  const auto* found = std::find_if(std::begin(kSwitches), std::end(kSwitches),
                                   [&](const Switch& s) { return s.effect == effect; });
  return found == std::end(kSwitches) ? nullptr : found;
}

// Why the scene's own key does not switch off an effect that is on; empty: it does.
std::string kept_on(const LiveChapter& chapter, const Switch& effect, const Scene& scene) {
  if (is_asked_for_elsewhere(effect.key, scene)) return "shapes or pairs ask for it, too";
  return chapter.keeps ? chapter.keeps(scene, effect.effect) : "";
}

// A scale for lengths: the smallest reach of a body that can be moved, m.
double smallest_reach(const World& world) {
  double least = std::numeric_limits<double>::infinity();
  for (const Body& body : world.bodies)
    if (!body.state.is_static())
      least = std::min(least, world.shapes[static_cast<std::size_t>(body.shape)].reach);
  return std::isfinite(least) ? least : 1;
}

live::Knob knob_of(const char* key, const std::string& value, double low, double high) {
  const SceneKey& row = *find_scene_key(key);
  live::Knob knob;
  knob.key = key;
  knob.unit = row.unit;
  knob.value = value;
  knob.meaning = row.meaning;
  knob.low = low;
  knob.high = high;
  return knob;
}

}  // namespace

bool changes_live(const std::string& key) {
  static const std::vector<std::string> keys = {"ccd",      "step.dt", "gravity",  "gyroscopic",
                                                "drag",     "sleep",   "envelope", "restitution",
                                                "friction", "pairs",   "solver"};
  const auto is = [&](const std::string& known) { return key == known || key.starts_with(known + "."); };
  if (std::any_of(keys.begin(), keys.end(), is)) return true;
  return key.starts_with("shapes.") && (key.ends_with(".restitution") || key.ends_with(".friction"));
}

std::vector<live::EffectState> effects_offered(const LiveChapter& chapter, const Scene& scene,
                                               const World& world) {
  std::vector<live::EffectState> list;
  for (const Effect& effect : chapter.explain(scene, world)) {
    const auto known = std::find_if(list.begin(), list.end(),
                                    [&](const live::EffectState& e) { return e.name == effect.name; });
    if (known != list.end()) {  // friction has a line for each pair of shapes
      known->why += "; " + effect.reason;
      continue;
    }
    live::EffectState state;
    state.name = effect.name;
    state.on = true;
    state.why = effect.reason;
    state.adds = effect.stages;
    if (const Switch* s = switch_of(effect.name)) {
      state.key = std::string(s->key) + "=" + value_for_on(*s, scene);
      state.can_switch = scene.mark(s->key).has_value() && kept_on(chapter, *s, scene).empty();
    }
    list.push_back(state);
  }
  for (live::EffectState& state : list)
    if (const Switch* s = switch_of(state.name))
      if (const std::string kept = kept_on(chapter, *s, scene); !kept.empty())
        state.why += "; it stays on: " + kept;
  for (const Switch& s : kSwitches) {
    const auto is_on = [&](const live::EffectState& e) { return e.name == s.effect; };
    if (!find_scene_key(s.key)->known_in(chapter.number) || std::any_of(list.begin(), list.end(), is_on))
      continue;
    live::EffectState state;
    state.name = s.effect;
    state.can_switch = true;
    state.key = std::string(s.key) + "=" + s.on;
    state.why = "not asked for by this scene";
    state.adds = s.adds;
    list.push_back(state);
  }
  return list;
}

void offer_values_of(const Scene& scene, std::vector<live::EffectState>& effects) {
  for (live::EffectState& effect : effects)
    if (const Switch* s = switch_of(effect.name); s != nullptr && !effect.on)
      effect.key = std::string(s->key) + "=" + value_for_on(*s, scene);
}

std::vector<live::Knob> knobs_offered(const LiveChapter& chapter, const Scene& scene, const World& world,
                                      const LiveStep& step) {
  const auto text = [](double x) { return fmt::format("{}", x); };
  const double reach = smallest_reach(world);
  // An envelope has at least 100 tolerances (envelope_of, chapter 5).
  std::vector<live::Knob> knobs = {knob_of("ccd.tolerance", text(scene.ccd.tolerance), 1e-9,
                                           step.envelope ? 0.01 * *step.envelope : 0.01 * reach),
                                   knob_of("step.dt", text(scene.step->dt), 1e-4, 0.1)};
  if (step.envelope)
    knobs.push_back(
        knob_of("envelope", text(*step.envelope), std::max(1e-6, 100 * world.tolerance), 0.2 * reach));
  if (scene.restitution) knobs.push_back(knob_of("restitution", text(*scene.restitution), 0, 1));
  if (scene.friction) knobs.push_back(knob_of("friction", text(*scene.friction), 0, 2));
  // Contacts with friction have solvers of their own (chapter 6).
  const bool rubs = chapter.number >= 6 && (scene.friction || is_asked_for_elsewhere("friction", scene));
  if (!rubs) {
    knobs.push_back(knob_of("solver.method", scene.solver.method, 0, 0));
    knobs.back().choices = find_scene_key("solver.method")->choices;
  }
  if (scene.sleep) knobs.push_back(knob_of("sleep.after", text(scene.sleep->after), 0.01, 10));
  return knobs;
}

double size_of(const World& world) {
  Eigen::AlignedBox3d box;
  for (const bool all : {false, true}) {
    for (const Body& body : world.bodies) {
      if (body.state.is_static() && !all) continue;
      const Vec3 reach = Vec3::Constant(world.shapes[static_cast<std::size_t>(body.shape)].reach);
      box.extend(body.state.position - reach);
      box.extend(body.state.position + reach);
    }
    if (!box.isEmpty()) break;
  }
  return box.diagonal().norm();
}

}  // namespace fc::world
