#include "tests/bench/boxes_bench.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "ch04_multibody_stepping/record.hpp"
#include "ch05_resting_contact/resting.hpp"
#include "tests/bench/bench.hpp"
#include "tests/bench/ch04_engines.hpp"
#include "tests/bench/ch05_boxes.hpp"

namespace fc::bench {
namespace {

constexpr double kFrame = 1.0 / 60;  // s
constexpr int kLast = 60;            // frames
constexpr double kDeep = 1e-3;       // m: an overlap that counts as a failure
constexpr double kLongest = 90;      // s: a slower engine is stopped, and `frames` says how far it got
constexpr double kStill = 1e-6;      // J, of all bodies together

class Ours : public Engine {
 public:
  explicit Ours(const Case& what)
      : world_(world::build_world(what.scene)),
        resting_(what.scene, world_, kFrame, {}, what.law ? what.law(world_) : nullptr),
        energy_(energy()) {
    for (const BodySpec& body : what.scene.bodies) moving_ += body.is_static ? 0 : 1;
  }
  void step(double) override { report_ = resting_.step(world_); }
  RigidBody state(int body) const override { return world_.bodies[static_cast<std::size_t>(body)].state; }
  int contacts() const override { return report_.step.contacts; }
  double overlap() const { return report_.step.max_penetration; }  // m, in the last step

  // Adds up what the last step reported; not part of its time.
  void look() {
    ++frames_;
    const double now = energy();
    energy_up_ =
        std::max(energy_up_, now - energy_ - report_.correction_energy - report_.step.kinematic_work);
    energy_ = now;
    residual_ = std::max(residual_, report_.step.lcp_residual);
    lost_ += report_.step.lost_time;
    shortened_ += report_.shortened;
  }
  void report(std::map<std::string, double>& more) const {
    more["residual"] = residual_;
    more["lost_ms"] = 1e3 * lost_;
    more["shortened_percent"] = 100 * shortened_ / std::max(1, frames_ * moving_);
    more["energy_up_J"] = energy_up_;
  }

 private:
  double energy() const {  // J
    const world::Totals totals = world::totals_of(world_);
    return totals.kinetic + totals.potential;
  }

  world::World world_;
  resting::Resting resting_;
  resting::RestReport report_;
  int frames_ = 0, moving_ = 0;
  double energy_, energy_up_ = 0, residual_ = 0, lost_ = 0, shortened_ = 0;
};

struct Outcome {
  std::vector<double> ns;  // of each frame, ascending
  Verdict verdict;
};

// The bodies of a scene that can move, as engines leave them.
struct Watched {
  const Scene& scene;
  const std::vector<Shape>& shapes;

  double kinetic(const std::vector<RigidBody>& states) const {  // J
    double sum = 0;
    each(states, [&](std::size_t i) {
      RigidBody body = states[i];
      body.set_mass(shapes[static_cast<std::size_t>(scene.bodies[i].shape)].mass);
      sum += body.kinetic_energy();
    });
    return sum;
  }
  double farthest(const std::vector<RigidBody>& from, const std::vector<RigidBody>& to) const {  // m
    double most = 0;
    each(from, [&](std::size_t i) { most = std::max(most, (to[i].position - from[i].position).norm()); });
    return most;
  }
  // How far, at most, bodies moved that should stand; `fallen` are those that moved farther than half their narrowest
  // side.
  void stand(const std::vector<RigidBody>& from, const std::vector<RigidBody>& to,
             std::map<std::string, double>& more) const {
    double sank = 0, aside = 0;
    int fallen = 0;
    each(from, [&](std::size_t i) {
      const Vec3 way = to[i].position - from[i].position;
      const Shape& shape = shapes[static_cast<std::size_t>(scene.bodies[i].shape)];
      sank = std::max(sank, -way.z());
      aside = std::max(aside, way.head<2>().norm());
      fallen += way.norm() > 0.5 * bounds_of(shape).sizes().minCoeff();
    });
    more["sank_mm"] = 1e3 * sank;
    more["aside_mm"] = 1e3 * aside;
    more["fallen"] = fallen;
  }

 private:
  template <class Do>
  void each(const std::vector<RigidBody>& states, const Do& what) const {
    for (std::size_t i = 0; i < states.size(); ++i)
      if (!scene.bodies[i].is_static) what(i);
  }
};

Outcome simulate(const Case& what, const std::vector<Shape>& shapes,
                 const std::function<std::unique_ptr<Engine>()>& make) {
  using Clock = std::chrono::steady_clock;
  const std::unique_ptr<Engine> engine = make();
  auto* const ours = dynamic_cast<Ours*>(engine.get());
  const Watched watched{what.scene, shapes};
  const OverlapJudge judge(what.scene, shapes);
  Outcome outcome;
  std::vector<RigidBody> states(what.scene.bodies.size());
  const auto look = [&] {
    for (std::size_t i = 0; i < states.size(); ++i) states[i] = engine->state(static_cast<int>(i));
  };
  look();
  const std::vector<RigidBody> start = states;
  std::vector<RigidBody> before = start;
  double sum = 0, deepest = 0, deepest_late = 0, kinetic = 0;
  int rest_frame = 0;
  for (int frame = 0; frame < what.frames && sum < 1e9 * kLongest; ++frame) {
    const auto begin = Clock::now();
    engine->step(kFrame);
    const double ns = std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
    outcome.ns.push_back(ns);
    sum += ns;
    look();
    if (ours) ours->look();
    const double deep = what.meshes ? ours->overlap() : judge.deepest(states);
    outcome.verdict.failed += deep > kDeep;
    deepest = std::max(deepest, deep);
    if (frame >= what.frames - kLast) deepest_late = std::max(deepest_late, deep);
    if (frame == std::max(0, what.frames - kLast)) before = states;
    kinetic = watched.kinetic(states);
    if (!(kinetic < kStill)) rest_frame = frame + 1;
  }
  auto& more = outcome.verdict.more;
  more["frames"] = static_cast<double>(outcome.ns.size());
  more["mean_ns"] = sum / static_cast<double>(outcome.ns.size());
  more["overlap_mm"] = 1e3 * deepest;
  more["late_overlap_mm"] = 1e3 * deepest_late;
  more["drift_mm"] = 1e3 * watched.farthest(before, states);
  more["energy_J"] = kinetic;
  more["rest_frame"] = rest_frame;
  if (what.stands) watched.stand(start, states, more);
  if (ours) ours->report(more);
  std::sort(outcome.ns.begin(), outcome.ns.end());
  return outcome;
}

}  // namespace

void add_case(const Case& given) {
  const auto what = std::make_shared<Case>(given);
  const auto shapes = std::make_shared<std::vector<Shape>>(build_shapes(what->scene, true));
  const auto row = [=](const std::string& who, const std::function<std::unique_ptr<Engine>()>& make) {
    const auto result = std::make_shared<Outcome>();  // kept: Google Benchmark runs a function several times
    benchmark::RegisterBenchmark((what->name + "/" + who).c_str(), [=](benchmark::State& state) {
      if (result->ns.empty()) *result = simulate(*what, *shapes, make);
      const std::unique_ptr<Engine> engine = make();
      for (auto _ : state) engine->step(kFrame);  // Google Benchmark's own column: frames from the start on
      state.counters["median_ns"] = result->ns[result->ns.size() / 2];
      state.counters["p95_ns"] = result->ns[result->ns.size() * 95 / 100];
      state.counters["misses"] = result->verdict.misses;
      state.counters["late"] = result->verdict.late;
      state.counters["failed"] = result->verdict.failed;
      for (const auto& [counter, value] : result->verdict.more) state.counters[counter] = value;
    });
  };
  const double friction = what->scene.friction.value_or(0);
  row("ours", [=]() -> std::unique_ptr<Engine> { return std::make_unique<Ours>(*what); });
  if (what->meshes) return;
  row("bullet", [=] { return make_bullet(what->scene, *shapes, false, 10, friction); });
  row("bullet_50", [=] { return make_bullet(what->scene, *shapes, false, 50, friction); });
  row("ode", [=] { return make_ode(what->scene, *shapes, 20, friction); });
  row("ode_50", [=] { return make_ode(what->scene, *shapes, 50, friction); });
}

int most_frames(int& argc, char** argv) {
  int most = kFrames;
  for (int i = 1; i < argc; ++i)
    if (std::strncmp(argv[i], "--frames=", 9) == 0) {
      most = std::max(1, std::atoi(argv[i] + 9));
      std::rotate(argv + i, argv + i + 1, argv + argc--);
    }
  return most;
}

int run_cases(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace fc::bench
