#include "ch04_multibody_stepping/live_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "ch04_multibody_stepping/live_offer.hpp"
#include "ch04_multibody_stepping/record.hpp"
#include "common/motion_recording.hpp"
#include "common/stopwatch.hpp"
#include "common/yaml_tree.hpp"

namespace fc::world {

Pipeline::Pipeline(const LiveChapter& chapter, Scene of, World made, const LiveBefore& before)
    : scene(std::move(of)), world(std::move(made)), step(chapter.prepare(scene, world, before)) {
  effects = effects_offered(chapter, scene, world);
  knobs = knobs_offered(chapter, scene, world, step);
}

double energy_of(const World& world) {  // J
  const Totals totals = totals_of(world);
  return totals.kinetic + totals.potential;
}

LiveWorld::LiveWorld(const SceneSource& source, const LiveChapter& chapter) {
  state_.source = source;
  state_.text = read_text_file(source.file);
  state_.chapter = chapter;
  state_.first = read(source.edits);
  start(state_.first);
}

LiveWorld::LiveWorld(LiveState state, const Pipeline& pipeline)
    : state_(std::move(state)), now_(rebuilt(pipeline)) {}

Scene LiveWorld::read(const std::vector<SceneEdit>& edits) const {
  SceneSource source = state_.source;
  source.edits = edits;
  return completed(read_scene_text(state_.text, source));
}

Scene LiveWorld::completed(const Scene& scene) const {
  return state_.chapter.complete ? state_.chapter.complete(scene) : scene;
}

// The balls become bodies. An envelope that follows from the smallest shape stays as it is, whatever their size.
Scene LiveWorld::with_balls(Scene scene, const std::vector<Throw>& balls) const {
  if (!balls.empty() && scene.envelope == 0.0 && state_.envelope) scene.envelope = state_.envelope;
  add_throws(scene, balls);
  return scene;
}

// The scene begins. If it is refused, nothing has changed.
void LiveWorld::start(const Scene& scene) {
  now_ = std::make_unique<Pipeline>(state_.chapter, scene, build_world(scene));
  state_.size = size_of(now_->world);
  state_.envelope = now_->step.envelope;
  state_.balls.clear();
  state_.hand.drop();
  ++state_.geometry;
  state_.frame = 0;
  state_.dt_since = 0;
  state_.t_since = 0;
  state_.account = {};
  state_.contacts.clear();
  state_.last = {};
  state_.warnings.clear();
  state_.last.report.min_gap = std::numeric_limits<double>::infinity();
}

// Another pipeline goes on; what that changed of the energy (gravity, another ball) is booked under `entry`.
void LiveWorld::put(std::unique_ptr<Pipeline> next, const char* entry) {
  const double change = energy_of(next->world) - energy_of(now_->world);
  state_.t_since = t();
  state_.dt_since = state_.frame;
  now_ = std::move(next);
  if (change != 0) state_.account.add(entry, change);
}

// The same bodies in the same state, with a step that remembers nothing.
std::unique_ptr<Pipeline> LiveWorld::rebuilt(const Pipeline& from) const {
  return std::make_unique<Pipeline>(state_.chapter, from.scene, rebuild_world(from.scene, from.world));
}

std::string LiveWorld::glb() const {
  MotionRecording motion(title(), state_.chapter.name, now_->scene.step->dt);
  for (const Shape& shape : now_->world.shapes) motion.add_shape(shape);
  for (const Body& body : now_->world.bodies) motion.add_body(body.shape, body.state);
  return motion.glb();
}

// A frame that fails is taken back: the scene stands as before it, with a new pipeline.
void LiveWorld::step() {
  World& world = now_->world;
  const std::vector<Body> before = world.bodies;
  const std::vector<std::pair<int, int>> sighted = world.sighted;
  const double energy = energy_of(world);
  state_.contacts.clear();
  const Stopwatch watch;
  try {
    const double hand = state_.hand.pull(world, now_->scene.step->dt, state_.size);
    Listeners listeners;
    listeners.impact = [&](const ImpactRecord& record) { state_.contacts.push_back(record); };
    state_.last = now_->step.frame(world, listeners);
    state_.last.report.step_ns = watch.ns();
    count(state_.last, energy, hand);
  } catch (...) {
    world.bodies = before;
    world.sighted = sighted;
    world.part_start = 0;
    state_.contacts.clear();
    now_ = rebuilt(*now_);
    throw;
  }
  book(state_.last.warnings);
  ++state_.frame;
}

// Drag alone has no report: it is what is left of the frame's change. Without drag everything else has to add up by itself.
void LiveWorld::count(const LiveFrame& frame, double before, double hand) {
  const Effects& effects = now_->world.effects;
  double sum = 0;
  const auto add = [&](const std::string& name, double energy) {
    sum += energy;
    state_.account.add(name, energy);
  };
  add("hand", hand);
  for (const auto& [name, energy] : frame.account) add(name, energy);
  if (effects.kinematic) add("kinematic bodies", frame.report.kinematic_work);
  if (effects.sleep) add("sleep", -frame.report.slept_energy);
  if (effects.drag) add("drag", energy_of(now_->world) - before - sum);
}

void LiveWorld::book(const std::vector<LiveWarning>& warnings) {
  constexpr std::size_t kMost = 5;
  for (const LiveWarning& warning : warnings)
    state_.warnings.push_back(fmt::format("at {:.6g} s: {}", t() + warning.time, warning.text));
  if (state_.warnings.size() > kMost)
    state_.warnings.erase(state_.warnings.begin(), state_.warnings.end() - kMost);
}

live::Snapshot LiveWorld::snapshot() const {
  live::Snapshot now;
  const StepReport& report = state_.last.report;
  now.frame = state_.frame;
  now.t = t();
  now.dt = now_->scene.step->dt;
  for (const Body& body : now_->world.bodies)
    now.poses.push_back({body.state.position, body.state.orientation});
  for (const ImpactRecord& record : state_.contacts) {
    const lcp::Contact& c = record.contact;
    now.contacts.push_back({c.point, c.normal, record.impulse.impulse * c.normal + record.tangential,
                            c.body_a, c.body_b, record.kind == ContactKind::rest});
  }
  now.step_ms = ms(report.step_ns);
  double other = now.step_ms;
  for (const auto& stage : state_.last.stages) {
    now.stages.push_back(stage);
    other -= stage.second;
  }
  now.stages.emplace_back("other_ms", std::max(0.0, other));
  const Totals totals = totals_of(now_->world);
  now.kinetic = totals.kinetic;
  now.potential = totals.potential;
  now.energy = totals.kinetic + totals.potential;
  now.account = state_.account.sums();
  now.min_gap = report.min_gap;
  now.lost_time = report.lost_time;
  now.residual = report.lcp_residual;
  now.warnings = state_.warnings;
  now.grabbed = state_.hand.body();
  if (now.grabbed < 0) return now;
  now.grab_point = state_.hand.point(now_->world);
  now.grab_target = state_.hand.target();
  return now;
}

std::vector<live::EffectState> LiveWorld::effects() const {
  std::vector<live::EffectState> list = now_->effects;
  offer_values_of(state_.first, list);
  for (live::EffectState& state : list)
    for (const auto& [effect, time] : state_.last.effects)
      if (state.on && state.name == effect) state.ms = time;
  return list;
}

}  // namespace fc::world
