// Chapter 4 beside Bullet and ODE: the same bodies with the same velocities, frame by frame. The engines do
// not compute the same motion: peers take a step and repair what overlaps, ours goes from contact to contact.
// So the rows also say what came out: `failed` counts the frames after which bodies overlap by more than
// about a millimetre, or the energy of an elastic gas is off by more than 1 %; `misses` the bullets behind
// the wall.
#include <algorithm>
#include <chrono>
#include <functional>

#include "ch04_multibody_stepping/study/parts.hpp"
#include "tests/bench/bench.hpp"
#include "tests/bench/ch04_engines.hpp"

namespace {

using namespace fc;
using namespace fc::bench;

constexpr double kFrame = 1.0 / 60;  // s
constexpr int kGasFrames = 60, kWarmUp = 5, kGasBodies = 1000, kRepeats = 3;
constexpr double kEnergyOff = 0.01;   // of the start's
constexpr double kShrunk = 1 - 2e-3;  // of a shape of half a metre: a millimetre
constexpr double kTolerance = 1e-6;   // m

using MakeEngine = std::function<std::unique_ptr<Engine>()>;

// What a run left behind after each frame: the states of all bodies.
using Frames = std::vector<std::vector<RigidBody>>;

struct Outcome {
  std::vector<double> ns;  // of each frame that counts, the median of the repetitions, ascending
  Verdict verdict;
};

// Runs everything several times; `counts` says which frames are timed, `judge` examines the states.
Outcome simulate(const MakeEngine& make, int bodies, int warm_up, int frames,
                 const std::function<bool(const Engine&)>& counts,
                 const std::function<Verdict(const Frames&)>& judge) {
  using Clock = std::chrono::steady_clock;
  std::vector<std::vector<double>> times(static_cast<std::size_t>(frames));
  Frames states;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    const std::unique_ptr<Engine> engine = make();
    for (int frame = 0; frame < warm_up; ++frame) engine->step(kFrame);
    states.clear();
    for (int frame = 0; frame < frames; ++frame) {
      const auto start = Clock::now();
      engine->step(kFrame);
      const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
      if (counts(*engine)) times[static_cast<std::size_t>(frame)].push_back(ns);
      states.emplace_back();
      for (int body = 0; body < bodies; ++body) states.back().push_back(engine->state(body));
    }
  }
  Outcome outcome;
  for (const auto& t : times)
    if (!t.empty()) outcome.ns.push_back(median_of(t));
  std::sort(outcome.ns.begin(), outcome.ns.end());
  if (outcome.ns.empty()) outcome.ns.push_back(0);
  outcome.verdict = judge(states);
  return outcome;
}

void add_simulation(const std::string& name, const MakeEngine& make, const std::function<Outcome()>& run) {
  const auto result = std::make_shared<Outcome>();  // kept: Google Benchmark runs a function several times
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    if (result->ns.empty()) *result = run();
    const std::unique_ptr<Engine> engine = make();
    for (auto _ : state) engine->step(kFrame);  // Google Benchmark's own column: frames from the start on
    state.counters["median_ns"] = result->ns[result->ns.size() / 2];
    state.counters["p95_ns"] = result->ns[result->ns.size() * 95 / 100];
    state.counters["misses"] = result->verdict.misses;
    state.counters["late"] = result->verdict.late;
    state.counters["failed"] = result->verdict.failed;
    for (const auto& [counter, value] : result->verdict.more) state.counters[counter] = value;
  });
}

class Ours : public Engine {
 public:
  explicit Ours(const Scene& scene) : world_(world::build_world(scene)) {}
  void step(double dt) override { contacts_ = world::step(world_, dt).contacts; }
  RigidBody state(int body) const override { return world_.bodies[static_cast<std::size_t>(body)].state; }
  int contacts() const override { return contacts_; }

 private:
  world::World world_;
  int contacts_ = 0;
};

// Bodies of a gas after each frame: overlaps of the shapes made a millimetre smaller, and the energy.
Verdict judge_gas(const Scene& scene, const std::vector<Shape>& shapes, const Frames& frames) {
  Scene smaller = scene;
  for (ShapeSpec& shape : smaller.shapes) {
    if (auto* ball = std::get_if<SphereSpec>(&shape.geometry)) ball->radius *= kShrunk;
    if (auto* block = std::get_if<BoxSpec>(&shape.geometry)) block->size *= kShrunk;
    if (auto* hull = std::get_if<HullSpec>(&shape.geometry))
      for (Vec3& p : hull->points) p *= kShrunk;
  }
  world::World world = world::build_world(smaller);
  const auto energy_of = [&](const std::vector<RigidBody>& states) {
    double sum = 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (scene.bodies[i].is_static) continue;
      RigidBody body = states[i];
      body.set_mass(shapes[static_cast<std::size_t>(scene.bodies[i].shape)].mass);
      sum += body.kinetic_energy();
    }
    return sum;
  };
  std::vector<RigidBody> start;
  for (const BodySpec& spec : scene.bodies)
    start.push_back(make_body(shapes[static_cast<std::size_t>(spec.shape)], spec));
  const double before = energy_of(start);

  Verdict verdict;
  int overlaps = 0;
  double energy_off = 0;
  for (const std::vector<RigidBody>& states : frames) {
    std::vector<world::Bounds> boxes;
    for (std::size_t i = 0; i < states.size(); ++i) {
      RigidBody& state = world.bodies[i].state;
      state.position = states[i].position;
      state.orientation = states[i].orientation;
      boxes.push_back(world.swept_bounds(static_cast<int>(i), 0, 0));
    }
    world::BoundsTree tree;
    tree.build(boxes);
    int here = 0;
    tree.overlapping_pairs([&](int a, int b) {
      if (!world.is_dynamic(a) && !world.is_dynamic(b)) return;
      const ca::PairPose pose(world.motion(a, 0), world.motion(b, 0), 0);
      here +=
          hulls::model_distance(world.model_of(a), world.model_of(b), pose, kTolerance, kTolerance).lower < 0;
    });
    const double off = std::abs(energy_of(states) / before - 1);
    overlaps += here;
    energy_off = std::max(energy_off, off);
    verdict.failed += here > 0 || !(off <= kEnergyOff);
  }
  verdict.more["overlaps"] = overlaps;
  verdict.more["energy_off"] = energy_off;
  return verdict;
}

void add_gas(const std::string& name, world::Kind kind) {
  const auto scene = std::make_shared<Scene>(world::gas(kind, kGasBodies, 1));
  const auto shapes = std::make_shared<std::vector<Shape>>(build_shapes(*scene, true));
  const auto row = [=](const std::string& who, const MakeEngine& make) {
    add_simulation(name + "/" + who, make, [=] {
      return simulate(
          make, static_cast<int>(scene->bodies.size()), kWarmUp, kGasFrames,
          [](const Engine&) { return true; },
          [&](const Frames& frames) { return judge_gas(*scene, *shapes, frames); });
    });
  };
  row("ours", [=] { return make_ours(*scene); });
  row("bullet", [=] { return make_bullet(*scene, *shapes, false); });
  row("ode", [=] { return make_ode(*scene, *shapes); });
}

// A hundred cubes of 5 cm at 100 m/s, spinning, against a wall of 1 cm.
Scene bullets() {
  Scene scene;
  scene.name = "bullets";
  scene.restitution = 0.5;
  ShapeSpec wall, bullet;
  wall.geometry = BoxSpec{Vec3(0.01, 4, 4)};
  bullet.geometry = BoxSpec{Vec3(0.05, 0.05, 0.05)};
  bullet.mass = 0.1;
  scene.shapes = {wall, bullet};
  BodySpec still;
  still.is_static = true;
  scene.bodies.push_back(still);
  for (int i = 0; i < 100; ++i) {
    BodySpec body;
    body.shape = 1;
    body.position = Vec3(-2, -1.35 + 0.3 * (i % 10), -1.35 + 0.3 * (i / 10));
    body.velocity = Vec3(100 + 0.01 * i, 0, 0);
    body.spin = Vec3(30, 50, 70);
    scene.bodies.push_back(body);
  }
  return scene;
}

void add_bullets() {
  const auto scene = std::make_shared<Scene>(bullets());
  const auto shapes = std::make_shared<std::vector<Shape>>(build_shapes(*scene, true));
  const auto row = [=](const std::string& who, const MakeEngine& make) {
    add_simulation("bullets_100/" + who, make, [=] {
      return simulate(
          make, static_cast<int>(scene->bodies.size()), 0, 6, [](const Engine&) { return true; },
          [](const Frames& frames) {
            Verdict verdict;
            for (std::size_t i = 1; i < frames.back().size(); ++i)
              verdict.misses += frames.back()[i].position.x() > 0;
            return verdict;
          });
    });
  };
  row("ours", [=] { return make_ours(*scene); });
  row("bullet", [=] { return make_bullet(*scene, *shapes, false); });
  row("bullet_ccd", [=] { return make_bullet(*scene, *shapes, true); });
  row("ode", [=] { return make_ode(*scene, *shapes); });
}

// The demo: only frames with contact are timed. Bullet's GImpact meshes are its method for two moving meshes; it needs
// several frames of overlap for what is one instant here.
void add_bunnies() {
  const std::filesystem::path file =
      FC_SOURCE_DIR "/chapters/ch04_multibody_stepping/scenes/two_bunnies.yaml";
  if (!std::filesystem::exists("/usr/share/glmark2/models/bunny.obj")) return;
  const auto scene = std::make_shared<Scene>(read_scene({file, {}, {}, 4}));
  const auto shapes = std::make_shared<std::vector<Shape>>(build_shapes(*scene, true));
  const auto row = [=](const std::string& who, const MakeEngine& make) {
    add_simulation("bunnies_two/" + who, make, [=] {
      return simulate(
          make, 2, 0, 60, [](const Engine& engine) { return engine.contacts() > 0; },
          [](const Frames&) { return Verdict{}; });
    });
  };
  row("ours", [=] { return make_ours(*scene); });
  row("bullet_gimpact", [=] { return make_bullet(*scene, *shapes, false); });
}

}  // namespace

std::unique_ptr<Engine> fc::bench::make_ours(const Scene& scene) {
  return std::make_unique<Ours>(scene);
}

int main(int argc, char** argv) {
  add_gas("gas_1000_spheres", world::Kind::ball);
  add_gas("gas_1000_boxes", world::Kind::block);
  add_gas("gas_1000_hulls", world::Kind::hull);
  add_bullets();
  add_bunnies();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
