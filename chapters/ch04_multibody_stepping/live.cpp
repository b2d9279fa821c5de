#include "ch04_multibody_stepping/live.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "ch04_multibody_stepping/live_hand.hpp"
#include "ch04_multibody_stepping/live_offer.hpp"
#include "ch04_multibody_stepping/live_scene.hpp"
#include "ch04_multibody_stepping/record.hpp"
#include "ch04_multibody_stepping/show_frame.hpp"
#include "common/motion_recording.hpp"
#include "common/scene_writer.hpp"
#include "common/stopwatch.hpp"
#include "common/text.hpp"
#include "common/yaml_tree.hpp"

namespace fc::world {
namespace {

// The radius of a thrown ball, as a share of the size of the scene.
constexpr double kBall = 1.0 / 20;

double energy_of(const World& world) {  // J
  const Totals totals = totals_of(world);
  return totals.kinetic + totals.potential;
}

// A scene, its world, and the step for it: exchanged as a whole, so that a change that is refused changes nothing.
struct Pipeline {
  Scene scene;
  World world;
  LiveStep step;
  std::vector<live::EffectState> effects;
  std::vector<live::Knob> knobs;

  Pipeline(const LiveChapter& chapter, Scene of, World made, const LiveBefore& before = {})
      : scene(std::move(of)), world(std::move(made)), step(chapter.prepare(scene, world, before)) {
    effects = effects_offered(chapter, scene, world);
    knobs = knobs_offered(chapter, scene, world, step);
  }
};

// J, since the start or the last reset. Kinetic and potential energy are those of the start and these sums.
class Account {
 public:
  void add(const std::string& name, double energy) {
    const auto known =
        std::find_if(sums_.begin(), sums_.end(), [&](const auto& e) { return e.first == name; });
    if (known != sums_.end())
      known->second += energy;
    else
      sums_.emplace_back(name, energy);
  }
  const NamedNumbers& sums() const { return sums_; }

 private:
  NamedNumbers sums_ = {{"impacts", 0}, {"hand", 0}};
};

class LiveWorld final : public live::Simulation {
 public:
  LiveWorld(const SceneSource& source, const LiveChapter& chapter)
      : source_(source), text_(read_text_file(source.file)), chapter_(chapter), first_(read(source_.edits)) {
    start(first_);
  }

  std::string title() const override { return now_->scene.name; }
  std::string glb() const override;
  int geometry() const override { return geometry_; }
  void step() override;
  live::Snapshot snapshot() const override;
  std::vector<live::EffectState> effects() const override;
  std::vector<live::Knob> knobs() const override { return now_->knobs; }
  live::Answer reset() override;
  live::Answer set(const std::string& key, const std::string& value) override;
  live::Answer throw_ball(const Vec3& from, const Vec3& velocity) override;
  live::Answer grab(int body, const Vec3& point) override;
  live::Answer drag(const Vec3& to) override;
  live::Answer drop() override;
  live::Answer save() override;
  std::string algorithm() const override;

 private:
  Scene read(const std::vector<SceneEdit>& edits) const;
  Scene completed(const Scene& scene) const;
  Scene with_balls(Scene scene, const std::vector<Throw>& balls) const;
  void start(const Scene& scene);
  void put(std::unique_ptr<Pipeline> next, const char* entry);
  void count(const LiveFrame& frame, double before, double hand);

  SceneSource source_;
  std::string text_;  // the file's, as it was at the start
  LiveChapter chapter_;
  Scene first_;  // as it was read at the start: what an effect is switched on with again
  std::unique_ptr<Pipeline> now_;
  std::vector<Throw> balls_;
  Hand hand_;
  double size_ = 0;                 // m, of the scene at its start
  std::optional<double> envelope_;  // m, in force before the first ball was thrown
  int geometry_ = 0;
  std::int64_t frame_ = 0;
  double t_ = 0;
  Account account_;
  std::vector<ImpactRecord> contacts_;  // of the last frame
  LiveFrame last_;
};

Scene LiveWorld::read(const std::vector<SceneEdit>& edits) const {
  SceneSource source = source_;
  source.edits = edits;
  return completed(read_scene_text(text_, source));
}

Scene LiveWorld::completed(const Scene& scene) const {
  return chapter_.complete ? chapter_.complete(scene) : scene;
}

// The balls become bodies. An envelope that follows from the smallest shape stays as it is, whatever their size.
Scene LiveWorld::with_balls(Scene scene, const std::vector<Throw>& balls) const {
  if (!balls.empty() && scene.envelope == 0.0 && envelope_) scene.envelope = envelope_;
  add_throws(scene, balls);
  return scene;
}

// The scene begins. If it is refused, nothing has changed.
void LiveWorld::start(const Scene& scene) {
  now_ = std::make_unique<Pipeline>(chapter_, scene, build_world(scene));
  size_ = size_of(now_->world);
  envelope_ = now_->step.envelope;
  balls_.clear();
  hand_.drop();
  ++geometry_;
  frame_ = 0;
  t_ = 0;
  account_ = {};
  contacts_.clear();
  last_ = {};
  last_.report.min_gap = std::numeric_limits<double>::infinity();
}

// Another pipeline goes on; what that changed of the energy (gravity, another ball) is booked under `entry`.
void LiveWorld::put(std::unique_ptr<Pipeline> next, const char* entry) {
  const double change = energy_of(next->world) - energy_of(now_->world);
  now_ = std::move(next);
  if (change != 0) account_.add(entry, change);
}

std::string LiveWorld::glb() const {
  MotionRecording motion(title(), chapter_.name, now_->scene.step->dt);
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
  contacts_.clear();
  const Stopwatch watch;
  try {
    const double hand = hand_.pull(world, now_->scene.step->dt, size_);
    Listeners listeners;
    listeners.impact = [&](const ImpactRecord& record) { contacts_.push_back(record); };
    last_ = now_->step.frame(world, listeners);
    last_.report.step_ns = watch.ns();
    count(last_, energy, hand);
  } catch (...) {
    world.bodies = before;
    world.sighted = sighted;
    world.part_start = 0;
    contacts_.clear();
    now_ = std::make_unique<Pipeline>(chapter_, now_->scene, rebuild_world(now_->scene, world));
    throw;
  }
  ++frame_;
  t_ += now_->scene.step->dt;
}

// Drag alone has no report: it is what is left of the frame's change. Without drag everything else has to add up by itself.
void LiveWorld::count(const LiveFrame& frame, double before, double hand) {
  const Effects& effects = now_->world.effects;
  double sum = 0;
  const auto add = [&](const std::string& name, double energy) {
    sum += energy;
    account_.add(name, energy);
  };
  add("hand", hand);
  for (const auto& [name, energy] : frame.account) add(name, energy);
  if (effects.kinematic) add("kinematic bodies", frame.report.kinematic_work);
  if (effects.sleep) add("sleep", -frame.report.slept_energy);
  if (effects.drag) add("drag", energy_of(now_->world) - before - sum);
}

live::Snapshot LiveWorld::snapshot() const {
  live::Snapshot now;
  const StepReport& report = last_.report;
  now.frame = frame_;
  now.t = t_;
  now.dt = now_->scene.step->dt;
  for (const Body& body : now_->world.bodies)
    now.poses.push_back({body.state.position, body.state.orientation});
  for (const ImpactRecord& record : contacts_) {
    const lcp::Contact& c = record.contact;
    now.contacts.push_back({c.point, c.normal, record.impulse.impulse * c.normal + record.tangential,
                            c.body_a, c.body_b, record.kind == ContactKind::rest});
  }
  now.step_ms = ms(report.step_ns);
  double rest = now.step_ms;
  for (const auto& stage : last_.stages) {
    now.stages.push_back(stage);
    rest -= stage.second;
  }
  now.stages.emplace_back("rest_ms", std::max(0.0, rest));
  const Totals totals = totals_of(now_->world);
  now.kinetic = totals.kinetic;
  now.potential = totals.potential;
  now.energy = totals.kinetic + totals.potential;
  now.account = account_.sums();
  now.min_gap = report.min_gap;
  now.lost_time = report.lost_time;
  now.residual = report.lcp_residual;
  now.grabbed = hand_.body();
  if (now.grabbed < 0) return now;
  now.grab_point = hand_.point(now_->world);
  now.grab_target = hand_.target();
  return now;
}

// What is measured of an effect is the time of its stage; of a solver, that of the last law that was put on top.
std::vector<live::EffectState> LiveWorld::effects() const {
  static const std::pair<const char*, const char*> kStages[] = {{"swept detection", "broad_phase_ms"},
                                                                {"collision", "ccd_ms"},
                                                                {"envelope", "contacts_ms"},
                                                                {"plans", "proofs_ms"},
                                                                {"friction", "lcp_ms"},
                                                                {"impact law", "lcp_ms"}};
  std::vector<live::EffectState> list = now_->effects;
  offer_values_of(first_, list);
  NamedNumbers left = last_.stages;
  for (const auto& [effect, stage] : kStages)
    for (live::EffectState& state : list) {
      if (state.name != effect || !state.on) continue;
      for (auto& [name, time] : left)
        if (name == stage) state.ms = std::exchange(time, 0);
    }
  return list;
}

live::Answer LiveWorld::reset() {
  const Stopwatch watch;
  start(read(source_.edits));
  return {.text = "the scene begins again", .restarted = true, .ms = ms(watch.ns())};
}

live::Answer LiveWorld::set(const std::string& key, const std::string& value) {
  const Stopwatch watch;
  if (key.find('=') != std::string::npos)
    throw InputError(fmt::format("{} is not a key; write e.g. ccd.tolerance", in_quotes(key)));
  const bool removes = value == "none";
  if (removes && !now_->scene.mark(key))
    throw InputError(fmt::format("the scene has no key {} that could be removed", in_quotes(key)));
  std::vector<SceneEdit> edits = source_.edits;
  std::erase_if(edits, [&](const SceneEdit& e) { return e.key == key || e.key.starts_with(key + "."); });
  edits.push_back({key, removes ? std::nullopt : std::optional(value)});
  const Scene scene = read(edits);
  live::Answer answer{.text = removes ? key + " is removed" : key + " is " + value};
  if (changes_live(key)) {
    const Scene present = with_balls(scene, balls_);
    World world = rebuild_world(present, now_->world);
    const bool same_search = world.tolerance == now_->world.tolerance;
    const LiveBefore before{same_search ? &now_->step : nullptr, false};
    put(std::make_unique<Pipeline>(chapter_, present, std::move(world), before), "settings");
    if (balls_.empty()) envelope_ = now_->step.envelope;
    answer.rebuilt = true;
  } else {
    start(scene);
    answer.restarted = true;
    answer.text += "; the scene begins again";
  }
  source_.edits = edits;
  answer.ms = ms(watch.ns());
  return answer;
}

live::Answer LiveWorld::throw_ball(const Vec3& from, const Vec3& velocity) {
  const Stopwatch watch;
  check_vector(from, "the point to throw from");
  check_vector(velocity, "the velocity");
  std::vector<Throw> balls = balls_;
  balls.push_back({kBall * size_, from, velocity});
  Scene scene = with_balls(read(source_.edits), balls);
  World world = rebuild_world(scene, now_->world);
  refuse_overlap_of_last(world, scene);
  const LiveBefore before{&now_->step, true};
  put(std::make_unique<Pipeline>(chapter_, std::move(scene), std::move(world), before), "throws");
  balls_ = balls;
  ++geometry_;
  return {.text = fmt::format("a ball of {:.3g} m flies: body {}", balls.back().radius,
                              now_->world.bodies.size() - 1),
          .rebuilt = true,
          .ms = ms(watch.ns())};
}

live::Answer LiveWorld::grab(int body, const Vec3& point) {
  hand_.grab(now_->world, now_->scene, body, point);
  return {.text = fmt::format("body {} is held", now_->scene.body_text(body))};
}

live::Answer LiveWorld::drag(const Vec3& to) {
  hand_.drag(to);
  return {.text = "it is pulled"};
}

live::Answer LiveWorld::drop() {
  hand_.drop();
  return {.text = "nothing is held"};
}

// The text knows nothing of what a step remembers, so the live scene forgets it, too. The hand lets go.
live::Answer LiveWorld::save() {
  const Stopwatch watch;
  const Scene stands = scene_as_it_stands(now_->scene, now_->world);
  const std::string text = scene_text(stands);
  SceneSource plain = source_;
  plain.overrides.clear();
  plain.swept.clear();
  plain.edits.clear();
  Scene scene = completed(read_scene_text(text, plain));
  World world = build_world(scene);
  keep_marks(stands, scene);
  put(std::make_unique<Pipeline>(chapter_, std::move(scene), std::move(world)), "settings");
  hand_.drop();
  return {.text = text, .rebuilt = true, .ms = ms(watch.ns())};
}

std::string LiveWorld::algorithm() const {
  if (!chapter_.algorithm) return live::Simulation::algorithm();
  World copy = now_->world;
  hand_.pull(copy, now_->scene.step->dt, size_);
  return chapter_.algorithm(now_->scene, copy, frame_, t_);
}

}  // namespace

double ms(std::int64_t ns) {
  return 1e-6 * static_cast<double>(ns);
}

double impact_energy(const ImpactRecord& record) {
  return 0.5 * record.impulse.impulse * (record.impulse.v_before + record.impulse.v_after);
}

LiveStep live_step(const Scene& scene) {
  const double dt = scene.step->dt;
  return {[dt](World& world, const Listeners& listeners) {
    LiveFrame frame;
    double impacts = 0;
    Listeners own = listeners;
    own.impact = [&](const ImpactRecord& record) {
      impacts += impact_energy(record);
      if (listeners.impact) listeners.impact(record);
    };
    frame.report = step(world, dt, own);
    frame.account = {{"impacts", impacts}};
    frame.stages = {{"broad_phase_ms", ms(frame.report.broad_ns)},
                    {"ccd_ms", ms(frame.report.ccd_ns - frame.report.broad_ns)},
                    {"lcp_ms", ms(frame.report.lcp_ns)}};
    return frame;
  }};
}

LiveChapter live_chapter() {
  LiveChapter chapter;
  chapter.name = "ch04_multibody_stepping";
  chapter.prepare = [](const Scene& scene, World&, const LiveBefore&) { return live_step(scene); };
  chapter.explain = [](const Scene& scene, const World&) { return explain(scene); };
  chapter.algorithm = [](const Scene& scene, World& copy, std::int64_t frame, double t0) {
    return algorithm::json(show_frame(scene, copy, frame, t0));
  };
  return chapter;
}

std::unique_ptr<live::Simulation> make_live(const SceneSource& source, const LiveChapter& chapter) {
  return std::make_unique<LiveWorld>(source, chapter);
}

}  // namespace fc::world
