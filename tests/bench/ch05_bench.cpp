// Chapter 5 beside Bullet and ODE: boxes heaped into a pit, a wall, a stack; frictionless, without bounce,
// nobody sleeps. Ten seconds of each, from the start. Peers take a step and repair what overlaps; the rows
// say how deep that is (one judge for all): `failed` counts the frames after which boxes overlap by more than
// a millimetre. Meshes (a chain, rings, a bunny in a bowl) are ours alone, and so is their judge: the certified gap.
//
// Of ours the rows also say what its step does at a price: `shortened_percent` of the bodies a frame, `lost_ms`, and
// `energy_up_J`, the largest rise in a frame beyond what corrections report.
//
// --frames=N: no more than N frames of each, to see that all of it runs.
#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <functional>

#include "ch04_multibody_stepping/record.hpp"
#include "ch05_resting_contact/resting.hpp"
#include "tests/bench/bench.hpp"
#include "tests/bench/ch04_engines.hpp"
#include "tests/bench/ch05_boxes.hpp"

namespace {

using namespace fc;
using namespace fc::bench;

constexpr double kFrame = 1.0 / 60;  // s
constexpr int kFrames = 600, kMeshFrames = 120, kLast = 60;
constexpr double kDeep = 1e-3;   // m: an overlap that counts as a failure
constexpr double kLongest = 90;  // s: who takes longer is stopped, and `frames` says how far it got

class Ours : public Engine {
 public:
  explicit Ours(const Scene& scene)
      : world_(world::build_world(scene)), resting_(scene, world_, kFrame), energy_(energy()) {
    for (const BodySpec& body : scene.bodies) moving_ += body.is_static ? 0 : 1;
  }
  void step(double) override { report_ = resting_.step(world_); }
  RigidBody state(int body) const override { return world_.bodies[static_cast<std::size_t>(body)].state; }
  int contacts() const override { return report_.step.contacts; }
  double overlap() const { return report_.step.max_penetration; }  // m, in the last step

  // Adds up what the last step reported; not a part of its time.
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

Outcome simulate(const Scene& scene, const std::vector<Shape>& shapes, int frames, bool meshes,
                 const std::function<std::unique_ptr<Engine>()>& make) {
  using Clock = std::chrono::steady_clock;
  const std::unique_ptr<Engine> engine = make();
  auto* const ours = dynamic_cast<Ours*>(engine.get());
  Outcome outcome;
  std::vector<RigidBody> states(scene.bodies.size()), before;
  double sum = 0, deepest = 0, deepest_late = 0;
  for (int frame = 0; frame < frames && sum < 1e9 * kLongest; ++frame) {
    const auto start = Clock::now();
    engine->step(kFrame);
    const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    outcome.ns.push_back(ns);
    sum += ns;
    for (std::size_t i = 0; i < states.size(); ++i) states[i] = engine->state(static_cast<int>(i));
    if (ours) ours->look();
    const double deep = meshes ? ours->overlap() : deepest_overlap(scene, states);
    outcome.verdict.failed += deep > kDeep;
    deepest = std::max(deepest, deep);
    if (frame >= frames - kLast) deepest_late = std::max(deepest_late, deep);
    if (frame == std::max(0, frames - kLast)) before = states;
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
  if (ours) ours->report(more);
  std::sort(outcome.ns.begin(), outcome.ns.end());
  return outcome;
}

// `meshes`: ours alone.
void add_case(const std::string& name, const Scene& made, int frames, bool meshes = false) {
  const auto scene = std::make_shared<Scene>(made);
  const auto shapes = std::make_shared<std::vector<Shape>>(build_shapes(*scene, true));
  const auto row = [=](const std::string& who, const std::function<std::unique_ptr<Engine>()>& make) {
    const auto result = std::make_shared<Outcome>();  // kept: Google Benchmark runs a function several times
    benchmark::RegisterBenchmark((name + "/" + who).c_str(), [=](benchmark::State& state) {
      if (result->ns.empty()) *result = simulate(*scene, *shapes, frames, meshes, make);
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
  if (meshes) return;
  row("bullet", [=] { return make_bullet(*scene, *shapes, false); });
  row("bullet_50", [=] { return make_bullet(*scene, *shapes, false, 50); });
  row("ode", [=] { return make_ode(*scene, *shapes); });
  row("ode_50", [=] { return make_ode(*scene, *shapes, 50); });
}

}  // namespace

int main(int argc, char** argv) {
  int most = kFrames;
  for (int i = 1; i < argc; ++i)
    if (std::strncmp(argv[i], "--frames=", 9) == 0) {
      most = std::max(1, std::atoi(argv[i] + 9));
      std::rotate(argv + i, argv + i + 1, argv + argc--);
    }
  const int some = std::min(most, kMeshFrames);
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "fc_bench_ch05";
  std::filesystem::create_directories(folder);
  add_case("heap_1000", heap(8, 8, 16), most);
  add_case("heap_200", heap(4, 4, 12), most);
  add_case("wall_10x10", wall(10, 10), most);
  add_case("stack_50", stack(50), most);
  add_case("chain_66", chain(66, folder / "link.obj"), some, true);
  add_case("rings_40", rings(40), some, true);
  if (std::filesystem::exists("/usr/share/glmark2/models/bunny.obj"))
    add_case("bunny_in_a_bowl", bunny_in_a_bowl(), some, true);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
