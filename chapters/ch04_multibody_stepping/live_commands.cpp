// What a page does to a live scene. What is refused has changed nothing.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ch04_multibody_stepping/live_offer.hpp"
#include "ch04_multibody_stepping/live_world.hpp"
#include "common/scene_writer.hpp"
#include "common/stopwatch.hpp"
#include "common/text.hpp"
#include "common/yaml_tree.hpp"

namespace fc::world {
namespace {

// The radius of a thrown ball, as a share of the size of the scene.
constexpr double kBall = 1.0 / 20;

// Whether the scenes have other shapes, or other bodies.
bool is_reshaped(const std::string& key, const Scene& before, const Scene& after) {
  const auto same_shape = [](const BodySpec& a, const BodySpec& b) { return a.shape == b.shape; };
  return key == "shapes" || key.starts_with("shapes.") ||
         !std::equal(before.bodies.begin(), before.bodies.end(), after.bodies.begin(), after.bodies.end(),
                     same_shape);
}

}  // namespace

live::Answer LiveWorld::reset() {
  const Stopwatch watch;
  start(read(state_.source.edits));
  return {.text = "the scene begins again", .restarted = true, .ms = ms(watch.ns())};
}

live::Answer LiveWorld::set(const std::string& key, const std::string& value) {
  const Stopwatch watch;
  if (key.find('=') != std::string::npos)
    throw InputError(fmt::format("{} is not a key; write e.g. ccd.tolerance", in_quotes(key)));
  const bool removes = value == "none";
  if (removes && !now_->scene.mark(key))
    throw InputError(fmt::format("the scene has no key {} that could be removed", in_quotes(key)));
  std::vector<SceneEdit> edits = state_.source.edits;
  std::erase_if(edits, [&](const SceneEdit& e) { return e.key == key || e.key.starts_with(key + "."); });
  edits.push_back({key, removes ? std::nullopt : std::optional(value)});
  const Scene scene = read(edits);
  live::Answer answer{.text = removes ? key + " is removed" : key + " is " + value};
  if (changes_live(key)) {
    const Scene present = with_balls(scene, state_.balls);
    World world = rebuild_world(present, now_->world);
    const bool same_search = world.tolerance == now_->world.tolerance;
    const LiveBefore before{same_search ? &now_->step : nullptr, false};
    put(std::make_unique<Pipeline>(state_.chapter, present, std::move(world), before), "settings");
    if (state_.balls.empty()) state_.envelope = now_->step.envelope;
    answer.rebuilt = true;
  } else {
    answer.reshaped = is_reshaped(key, read(state_.source.edits), scene);
    start(scene);
    answer.restarted = true;
    answer.text += "; the scene begins again";
  }
  state_.source.edits = edits;
  answer.ms = ms(watch.ns());
  return answer;
}

// The scene and its world with one more ball, which may be refused.
std::pair<Scene, World> LiveWorld::with_ball(const Throw& ball) const {
  check_vector(ball.position, "the point to throw from");
  check_vector(ball.velocity, "the velocity");
  std::vector<Throw> balls = state_.balls;
  balls.push_back(ball);
  Scene scene = with_balls(read(state_.source.edits), balls);
  World world = rebuild_world(scene, now_->world);
  refuse_overlap_of_last(world, scene);
  return {std::move(scene), std::move(world)};
}

void LiveWorld::check_throw(const Vec3& from, const Vec3& velocity) const {
  with_ball({kBall * state_.size, from, velocity});
}

live::Answer LiveWorld::throw_ball(const Vec3& from, const Vec3& velocity) {
  const Stopwatch watch;
  const Throw ball{kBall * state_.size, from, velocity};
  auto [scene, world] = with_ball(ball);
  const LiveBefore before{&now_->step, true};
  put(std::make_unique<Pipeline>(state_.chapter, std::move(scene), std::move(world), before), "throws");
  state_.balls.push_back(ball);
  ++state_.geometry;
  return {
      .text = fmt::format("a ball of {:.3g} m flies: body {}", ball.radius, now_->world.bodies.size() - 1),
      .rebuilt = true,
      .ms = ms(watch.ns())};
}

live::Answer LiveWorld::grab(int body, const Vec3& point) {
  state_.hand.grab(now_->world, now_->scene, body, point);
  return {.text = fmt::format("body {} is held", now_->scene.body_text(body))};
}

live::Answer LiveWorld::drag(const Vec3& to) {
  state_.hand.drag(to);
  return {.text = "it is pulled"};
}

live::Answer LiveWorld::drop() {
  state_.hand.drop();
  return {.text = "nothing is held"};
}

// The text knows nothing of what a step remembers, so the live scene forgets it, too. The hand lets go.
live::Answer LiveWorld::save() {
  const Stopwatch watch;
  const Scene stands = scene_as_it_stands(now_->scene, now_->world);
  const std::string text = scene_text(stands);
  SceneSource plain = state_.source;
  plain.overrides.clear();
  plain.swept.clear();
  plain.edits.clear();
  Scene scene = completed(read_scene_text(text, plain));
  World world = build_world(scene);
  keep_marks(stands, scene);
  put(std::make_unique<Pipeline>(state_.chapter, std::move(scene), std::move(world)), "settings");
  state_.hand.drop();
  return {.text = text, .rebuilt = true, .ms = ms(watch.ns())};
}

std::unique_ptr<live::Simulation> LiveWorld::copy() {
  state_.hand.drop();
  put(rebuilt(*now_), "settings");
  return std::unique_ptr<live::Simulation>(new LiveWorld(state_, *now_));
}

std::string LiveWorld::algorithm() const {
  if (!state_.chapter.algorithm) return live::Simulation::algorithm();
  World copy = now_->world;
  state_.hand.pull(copy, now_->scene.step->dt, state_.size);
  return state_.chapter.algorithm(now_->scene, copy, state_.frame, t());
}

}  // namespace fc::world
