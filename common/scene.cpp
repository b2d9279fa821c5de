#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/scene_check.hpp"
#include "common/scene_parts.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

// The tree with "key.path=value" applied.
YamlPtr with_override(const YamlPtr& tree, const std::string& option, const std::string& text) {
  const auto origin = std::make_shared<const std::string>(option + " " + text);
  const std::size_t equals = text.find('=');
  const std::string path = text.substr(0, equals);
  const bool well_formed = !path.empty() && path.front() != '.' && path.back() != '.' &&
                           path.find("..") == std::string::npos &&
                           std::count(path.begin(), path.end(), '.') < 10;
  if (equals == std::string::npos || !well_formed) {
    refuse({origin}, "not a key and a value; write e.g. ccd.tolerance=1.0e-6");
  }
  return with_value(tree, path, parse_yaml(text.substr(equals + 1), origin, true), origin);
}

StepSpec read_step(const Section& step) {
  StepSpec spec;
  spec.dt = step.get(number_value, "dt");
  spec.duration = step.get(number_value, "duration");
  const double frames = std::round(spec.duration / spec.dt);
  constexpr double most_frames = 1e9;
  if (frames < 1) {
    refuse(step.node("duration").place,
           fmt::format("a duration of {} s has no frame of {} s; lengthen it, or shorten dt", spec.duration,
                       spec.dt));
  }
  if (frames > most_frames) {
    refuse(step.node("duration").place,
           fmt::format("{} frames are too many; shorten it, or lengthen dt", frames));
  }
  spec.frames = static_cast<int>(frames);
  return spec;
}

// What a scene must have besides its required keys: bodies and their shapes; or, instead of these, an LCP
// (chapter 3) or a linear file (chapter 1).
void check_subject(const Section& scene, int chapter) {
  for (const char* instead : {"lcp", "linear"}) {
    if (!scene.has(instead)) continue;
    for (const char* key : {"shapes", "pairs", "bodies", "contacts", "motions"}) {
      if (!scene.has(key)) continue;
      refuse(scene.entry(key).key_place, fmt::format("'{}' beside '{}'; keep one of them", key, instead));
    }
    return;
  }
  for (const char* key : {"shapes", "bodies", "contacts"}) {
    const SceneKey& row = scene.row(key);
    if (scene.has(key) || !row.known_in(chapter)) continue;
    refuse(scene.place(), fmt::format("missing key '{}'; add e.g. {}: {}", key, key, row.example));
  }
}

void check_query_bodies(const Section& scene, const std::vector<BodySpec>& bodies) {
  if (bodies.size() == 2) return;
  refuse(scene.entry("bodies").key_place,
         fmt::format("a query needs exactly two bodies, this scene has {}; keep two", bodies.size()));
}

// Effects without a value: an absent key means off, and there is no second way to say so.
bool read_switch(const Section& root, const char* key) {
  if (!root.has(key)) return false;
  if (!root.get(boolean_value, key))
    refuse(root.entry(key).key_place,
           fmt::format("an effect is off when its key is absent; remove '{}'", key));
  return true;
}

void read_effects(const Section& root, Scene& scene) {
  if (root.has("gravity")) scene.gravity = root.get(vector_value, "gravity");
  if (root.has("restitution")) scene.restitution = root.get(number_value, "restitution");
  if (root.has("friction")) scene.friction = root.get(number_value, "friction");
  if (root.has("envelope")) scene.envelope = root.get(number_value, "envelope");
  scene.gyroscopic = read_switch(root, "gyroscopic");
  if (root.has("drag")) {
    const Section drag = root.section("drag");
    scene.drag = {drag.get_or(number_value, "linear", 0.0), drag.get_or(number_value, "angular", 0.0)};
  }
  if (root.has("sleep")) {
    const Section sleep = root.section("sleep");
    scene.sleep = {sleep.get_or(number_value, "after", SleepSpec().after),
                   sleep.get_or(number_value, "speed", SleepSpec().speed)};
  }
}

Scene read_checked(const Section& root, const SceneSource& source) {
  Scene scene;
  scene.file = source.file;
  scene.name = root.get_or(text_value, "name", source.file.stem().string());
  if (root.has("step")) scene.step = read_step(root.section("step"));
  read_effects(root, scene);
  if (root.has("ccd")) {
    const Section ccd = root.section("ccd");
    scene.ccd.tolerance = ccd.get_or(number_value, "tolerance", scene.ccd.tolerance);
    scene.ccd.bound = ccd.get_or(text_value, "bound", scene.ccd.bound);
    scene.ccd.warm_start = ccd.get_or(boolean_value, "warm_start", scene.ccd.warm_start);
    scene.ccd.max_iterations = ccd.get_or(integer_value, "max_iterations", scene.ccd.max_iterations);
  }
  if (root.has("solver")) {
    const Section solver = root.section("solver");
    scene.solver.method = solver.get_or(text_value, "method", scene.solver.method);
    scene.solver.limit = solver.get_or(integer_value, "limit", scene.solver.limit);
    scene.solver.tolerance = solver.get_or(number_value, "tolerance", scene.solver.tolerance);
    scene.solver.compare = solver.get_or(boolean_value, "compare", scene.solver.compare);
  }
  check_subject(root, source.chapter);
  if (root.has("shapes")) scene.shapes = read_shapes(root, source);
  if (root.has("pairs")) scene.pairs = read_pairs(root, scene.shapes);
  if (root.has("bodies")) scene.bodies = read_bodies(root, scene.shapes, source);
  scene.interval = root.get_or(number_value, "interval", scene.interval);
  if (root.has("motions")) scene.motions = resolved_file(root, "motions", source);
  if (root.has("linear")) scene.linear = resolved_file(root, "linear", source);
  if (source.chapter <= 2 && !scene.linear) check_query_bodies(root, scene.bodies);
  if (root.has("contacts")) scene.contacts = read_contacts(root, scene.bodies);
  if (root.has("lcp")) scene.lcp = read_lcp(root.section("lcp"), source);
  return scene;
}

}  // namespace

std::string Scene::body_text(int body) const {
  const std::string& given = bodies.at(static_cast<std::size_t>(body)).name;
  return given.empty() ? std::to_string(body) : fmt::format("{} ({})", body, in_quotes(given));
}

Scene read_scene(const SceneSource& source) {
  return read_scene_text(read_text_file(source.file), source);
}

Scene read_scene_text(const std::string& text, const SceneSource& source) {
  const auto origin = std::make_shared<const std::string>(source.file.string());
  YamlPtr tree = parse_yaml(text, origin);
  if (tree->kind == YamlNode::Kind::nothing) refuse(tree->place, "the file is empty; write a scene into it");
  if (tree->kind != YamlNode::Kind::map) {
    refuse(tree->place, "a scene must be a map of keys; begin it with e.g. shapes:");
  }
  for (const std::string& set : source.overrides) tree = with_override(tree, "--set", set);
  if (!source.swept.empty()) tree = with_override(tree, "--sweep", source.swept);
  for (const SceneEdit& edit : source.edits)
    tree =
        edit.value ? with_override(tree, "set", edit.key + "=" + *edit.value) : without_key(tree, edit.key);
  std::map<std::string, SourceMark> marks = check_scene_keys(*tree, source.chapter);
  Scene scene = read_checked(Section(*tree, ""), source);
  scene.key_marks = std::move(marks);
  return scene;
}

}  // namespace fc
