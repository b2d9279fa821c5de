// Chapter 5 beside Bullet and ODE: boxes heaped into a pit, a wall, a stack; frictionless, without bounce,
// nobody sleeps. Ten seconds of each, from the start. Peers take a step and repair what overlaps; the rows
// say how deep that is (one judge for all): `failed` counts the frames after which boxes overlap by more than
// a millimetre.
#include <algorithm>
#include <chrono>
#include <functional>

#include "ch05_resting_contact/resting.hpp"
#include "tests/bench/bench.hpp"
#include "tests/bench/ch04_engines.hpp"
#include "tests/bench/ch05_boxes.hpp"

namespace {

using namespace fc;
using namespace fc::bench;

constexpr double kFrame = 1.0 / 60;  // s
constexpr int kFrames = 600, kLast = 60;
constexpr double kDeep = 1e-3;   // m: an overlap that counts as a failure
constexpr double kLongest = 90;  // s: who takes longer is stopped, and `frames` tells how far it got

class Ours : public Engine {
 public:
  explicit Ours(const Scene& scene) : world_(world::build_world(scene)), resting_(scene, world_, kFrame) {}
  void step(double) override {
    const resting::RestReport report = resting_.step(world_);
    contacts_ = report.step.contacts;
    residual_ = std::max(residual_, report.step.lcp_residual);
    lost_ += report.step.lost_time;
  }
  RigidBody state(int body) const override { return world_.bodies[static_cast<std::size_t>(body)].state; }
  int contacts() const override { return contacts_; }
  double residual() const { return residual_; }
  double lost() const { return lost_; }

 private:
  world::World world_;
  resting::Resting resting_;
  int contacts_ = 0;
  double residual_ = 0, lost_ = 0;
};

struct Outcome {
  std::vector<double> ns;  // of each frame, ascending
  Verdict verdict;
};

Outcome simulate(const Scene& scene, const std::vector<Shape>& shapes,
                 const std::function<std::unique_ptr<Engine>()>& make) {
  using Clock = std::chrono::steady_clock;
  const std::unique_ptr<Engine> engine = make();
  Outcome outcome;
  std::vector<RigidBody> states(scene.bodies.size()), before;
  double sum = 0, deepest = 0, deepest_late = 0;
  for (int frame = 0; frame < kFrames && sum < 1e9 * kLongest; ++frame) {
    const auto start = Clock::now();
    engine->step(kFrame);
    const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    outcome.ns.push_back(ns);
    sum += ns;
    for (std::size_t i = 0; i < states.size(); ++i) states[i] = engine->state(static_cast<int>(i));
    const double deep = deepest_overlap(scene, states);
    outcome.verdict.failed += deep > kDeep;
    deepest = std::max(deepest, deep);
    if (frame >= kFrames - kLast) deepest_late = std::max(deepest_late, deep);
    if (frame == kFrames - kLast) before = states;
  }
  auto& more = outcome.verdict.more;
  more["frames"] = static_cast<double>(outcome.ns.size());
  more["mean_ns"] = sum / static_cast<double>(outcome.ns.size());
  more["overlap_mm"] = 1e3 * deepest;
  more["late_overlap_mm"] = 1e3 * deepest_late;
  double drift = 0, energy = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (scene.bodies[i].is_static) continue;
    if (!before.empty()) drift = std::max(drift, (states[i].position - before[i].position).norm());
    RigidBody body = states[i];
    body.set_mass(shapes[static_cast<std::size_t>(scene.bodies[i].shape)].mass);
    energy += body.kinetic_energy();
  }
  more["drift_mm"] = 1e3 * drift;
  more["energy_J"] = energy;
  if (const auto* ours = dynamic_cast<const Ours*>(engine.get())) {
    more["residual"] = ours->residual();
    more["lost_ms"] = 1e3 * ours->lost();
  }
  std::sort(outcome.ns.begin(), outcome.ns.end());
  return outcome;
}

void add_case(const std::string& name, const Scene& made) {
  const auto scene = std::make_shared<Scene>(made);
  const auto shapes = std::make_shared<std::vector<Shape>>(build_shapes(*scene, true));
  const auto row = [=](const std::string& who, const std::function<std::unique_ptr<Engine>()>& make) {
    const auto result = std::make_shared<Outcome>();  // kept: Google Benchmark runs a function several times
    benchmark::RegisterBenchmark((name + "/" + who).c_str(), [=](benchmark::State& state) {
      if (result->ns.empty()) *result = simulate(*scene, *shapes, make);
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
  row("ours", [=]() -> std::unique_ptr<Engine> { return std::make_unique<Ours>(*scene); });
  row("bullet", [=] { return make_bullet(*scene, *shapes, false); });
  row("bullet_50", [=] { return make_bullet(*scene, *shapes, false, 50); });
  row("ode", [=] { return make_ode(*scene, *shapes); });
  row("ode_50", [=] { return make_ode(*scene, *shapes, 50); });
}

}  // namespace

int main(int argc, char** argv) {
  add_case("heap_1000", heap(8, 8, 16));
  add_case("heap_200", heap(4, 4, 12));
  add_case("wall_10x10", wall(10, 10));
  add_case("stack_50", stack(50));
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
