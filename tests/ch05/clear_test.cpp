// The clear version of chapter 5's step, beside the fast one: the laws that both must keep, and where bodies are.
#include "ch05_resting_contact/clear.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <random>

#include "ch02_hull_hierarchy/model_distance.hpp"
#include "ch05_resting_contact/resting.hpp"
#include "support/worlds.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;
using fc::resting::ClearResting;
using fc::resting::Resting;

// What the laws say of a frame, at its worst.
struct Laws {
  double newton = 0;   // of each body, as a share of the momenta that took part
  double rise = 0;     // of energy, beyond what corrections lift and kinematic bodies do, as a share of what there was
  double rise_joule = 0;
  double told = 0;     // J, of corrections
  double overlap = 0;  // m, at a frame's end
  double across = 0;   // of the margin: the widest gap over which an impulse acts
  double lost = 0;     // s
  double ms = 0;       // of the whole run
  int plans = 0, halved = 0;
};

// One of the two versions at work.
template <class Planner>
struct Run {
  fc::world::World world;
  double dt;
  Planner planner;
  Laws worst;

  explicit Run(const fc::Scene& scene)
      : world(fc::world::build_world(scene)), dt(scene.step->dt), planner(scene, world, dt) {}

  double energy(double* size = nullptr) const {
    double sum = 0;
    for (const auto& b : world.bodies) {
      if (b.state.is_static()) continue;
      const double kinetic = b.state.kinetic_energy();
      const double potential =
          world.effects.gravity ? -b.state.mass * world.effects.gravity->dot(b.state.position) : 0;
      sum += kinetic + potential;
      if (size) *size += kinetic + std::abs(potential);
    }
    return sum;
  }

  double overlap() const {  // m, the deepest; 0 if there is none
    double depth = 0;
    for (int a = 0; a < static_cast<int>(world.bodies.size()); ++a)
      for (int b = a + 1; b < static_cast<int>(world.bodies.size()); ++b) {
        if (!world.yields(a) && !world.yields(b)) continue;
        const fc::ca::PairPose pose(world.bodies[a].state.pose(), world.bodies[b].state.pose());
        const auto gap = fc::hulls::model_distance(world.model_of(a), world.model_of(b), pose, 1e-9, 1e-6);
        depth = std::max(depth, -gap.lower);
      }
    return depth;
  }

  void frame() {
    double size = 0;
    const double before = energy(&size);
    std::vector<Vec3> momentum, impulse(world.bodies.size(), Vec3::Zero());
    std::vector<double> pushed(world.bodies.size(), 0.0);
    for (const auto& b : world.bodies) momentum.push_back(b.state.momentum());
    double work = 0;  // J, of kinematic bodies, which go straight on
    const auto report = planner.step(world, {[&](const fc::world::ImpactRecord& r) {
      const Vec3 j = r.impulse.impulse * r.contact.normal;
      for (const bool of_b : {false, true}) {
        const auto body = static_cast<std::size_t>(of_b ? r.contact.body_b : r.contact.body_a);
        const Vec3 own = of_b ? j : Vec3(-j);
        impulse[body] += own;
        pushed[body] += j.norm();
        if (world.bodies[body].state.is_static()) work += own.dot(world.bodies[body].state.velocity);
      }
      worst.across = std::max(worst.across, r.contact.gap / planner.envelope());
    }});
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      const fc::RigidBody& s = world.bodies[i].state;
      if (s.is_static()) continue;
      const Vec3 weight =
          world.effects.gravity ? Vec3(s.mass * dt * *world.effects.gravity) : Vec3(Vec3::Zero());
      const double all = momentum[i].norm() + weight.norm() + pushed[i];
      if (all > 0)
        worst.newton = std::max(worst.newton, (s.momentum() - momentum[i] - weight - impulse[i]).norm() / all);
    }
    const double rise = energy() - before - work - report.correction_energy;
    if (size > 0) worst.rise = std::max(worst.rise, rise / size);
    worst.rise_joule = std::max(worst.rise_joule, rise);
    worst.told += report.correction_energy;
    worst.overlap = std::max(worst.overlap, overlap());
    worst.lost += report.step.lost_time;
    worst.ms += 1e-6 * static_cast<double>(report.step.step_ns);
    worst.plans += report.plans;
    if constexpr (std::is_same_v<Planner, ClearResting>) worst.halved += report.halved;
  }
};

struct Both {
  Run<ClearResting> clear;
  Run<Resting> fast;
  double apart = 0, turned = 0;  // m, rad: the worst of any body at any frame's end

  explicit Both(const fc::Scene& scene) : clear(scene), fast(scene) {}
  void run(int frames) {
    for (int f = 0; f < frames; ++f) {
      clear.frame();
      fast.frame();
      for (std::size_t i = 0; i < clear.world.bodies.size(); ++i) {
        const fc::RigidBody &c = clear.world.bodies[i].state, &q = fast.world.bodies[i].state;
        apart = std::max(apart, (c.position - q.position).norm());
        turned = std::max(turned, c.orientation.angularDistance(q.orientation));
      }
    }
  }
};

std::string text(const Laws& w) {
  return fmt::format(
      "newton {:.1e} rise {:.1e} ({:.1e} J) told {:.1e} J overlap {:.1e} across {:.4f} lost {:.1e} plans {} halved {} {:.0f} ms",
      w.newton, w.rise, w.rise_joule, w.told, w.overlap, w.across, w.lost, w.plans, w.halved, w.ms);
}

struct Random {
  std::mt19937_64 engine;
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  double log(double low, double high) { return std::exp((*this)(std::log(low), std::log(high))); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine); }
  bool chance(double share) { return (*this)(0, 1) < share; }
  std::string vector(int n, double size) {
    std::string text = "[";
    for (int i = 0; i < n; ++i) text += (i ? ", " : "") + fmt::format("{}", (*this)(-size, size));
    return text + "]";
  }
};

// 2 to 9 convex bodies that fall on a floor or into a pit, as in random_scenes_test.cpp.
std::string random_scene(unsigned seed) {
  Random random{std::mt19937_64(seed)};
  const int count = 2 + random.below(8);
  const bool pit = random.chance(0.3), mixed = random.chance(0.3);
  const double dt = random.log(1.0 / 240, 0.03), restitution = random.chance(0.3) ? 0 : random(0, 1);
  const double heaviest = random.chance(0.5) ? 1 : random.log(1, 1e3);
  std::string shapes = "  floor: {box: {size: [40, 40, 1]}}\n  wall: {box: {size: [1, 8, 8]}}\n", bodies;
  for (int i = 0; i < count; ++i) {
    const std::array<std::string, 8> kinds{
        "box: {size: [0.5, 0.4, 0.3]}",
        "box: {size: [0.8, 0.5, 0.05]}",
        "sphere: {radius: 0.3}",
        "capsule: {radius: 0.12, length: 0.5}",
        "hull: {points: [[0.4, 0, 0], [-0.4, 0, 0], [0, 0.3, 0], [0, -0.3, 0], [0, 0, 0.3], [0.1, 0, -0.3]]}",
        "hull: {points: [[0.3, 0.3, 0.3], [-0.3, -0.3, 0.3], [-0.3, 0.3, -0.3], [0.3, -0.3, -0.3]]}",
        "cylinder: {radius: 0.25, length: 0.4}",
        "cone: {radius: 0.25, length: 0.5}"};
    shapes += fmt::format("  s{}: {{{}, mass: {}{}}}\n", i, kinds[static_cast<std::size_t>(random.below(8))],
                          random.log(1, heaviest), mixed ? fmt::format(", restitution: {}", random(0, 1)) : "");
    bodies += fmt::format(
        "  - {{shape: s{}, position: [{}, {}, {}], orientation: {}, velocity: [{}, {}, {}], spin: {}}}\n", i,
        1.1 * (i % 3 - 1), 1.1 * (i / 3 - 1), 0.6 + 0.2 * random(0, 1), random.vector(4, 1), random(-0.5, 0.5),
        random(-0.5, 0.5), random(-2, 0.5), random.vector(3, 3));
  }
  bodies += "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n";
  if (pit)
    for (const double x : {-2.3, 2.3})
      bodies += fmt::format("  - {{shape: wall, static: true, position: [{}, 0, 3.9]}}\n", x);
  return fmt::format(
      "step: {{dt: {}, duration: 1.5}}\nrestitution: {}\nenvelope: {}\nccd: {{tolerance: 1.0e-7}}\n"
      "gravity: [0, 0, -9.81]\nshapes:\n{}bodies:\n{}",
      dt, restitution, random.log(1e-4, 5e-3), shapes, bodies);
}

fc::Scene read_rest_scene(const std::string& text) {
  const auto file = scratch("scenes") / "scene.yaml";
  std::ofstream(file) << text;
  return fc::read_scene({file, {}, {}, 5});
}

TEST(Clear, RandomScratch) {
  const char* count = std::getenv("FC_SCENES");
  if (!count) GTEST_SKIP();
  for (int seed = std::getenv("FC_FIRST") ? std::atoi(std::getenv("FC_FIRST")) : 1; seed <= std::atoi(count); ++seed) {
    const fc::Scene scene = read_rest_scene(random_scene(static_cast<unsigned>(seed)));
    Both both(scene);
    std::string error;
    try {
      both.run(scene.step->frames);
    } catch (const std::exception& e) {
      error = e.what();
    }
    std::cout << fmt::format("seed {} bodies {} dt {:.4f} h {:.1e} apart {:.2e} m {:.2e} rad {}\n  clear {}\n  fast  {}\n", seed,
                             scene.bodies.size(), scene.step->dt, both.clear.planner.envelope(), both.apart, both.turned, error,
                             text(both.clear.worst), text(both.fast.worst)) << std::flush;
  }
}

TEST(Clear, Scratch) {
  const char* name = std::getenv("FC_SCENE");
  if (!name) GTEST_SKIP();
  const fc::Scene scene = fc::read_scene({name, {}, {}, 5});
  Both both(scene);
  const int every = 10;
  for (int f = 0; f < scene.step->frames; f += every) {
    both.run(every);
    std::cout << fmt::format("{:4d} apart {:.2e} m {:.2e} rad\n  clear {}\n  fast  {}\n", f + every, both.apart, both.turned,
                             text(both.clear.worst), text(both.fast.worst)) << std::flush;
  }
}

}  // namespace
