// Free bodies of all shapes, thrown together in random scenes. Nothing acts on them from outside: their total momenta stay, and
// their common centre of mass moves at a constant velocity, whatever the bodies do to each other. FC_SCENES=1000 runs a
// thousand scenes, FC_FIRST=n begins with seed n; CI runs the first of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>
#include <random>

#include "ch02_hull_hierarchy/inside.hpp"
#include "ch02_hull_hierarchy/model_distance.hpp"
#include "events.hpp"

namespace {

using namespace fc_test;
using fc::Mat3;
using fc::Vec3;

#ifdef FC_SANITIZED
constexpr int kScenes = 12;
#else
constexpr int kScenes = 60;
#endif

int from_environment(const char* name, int otherwise) {
  const char* asked = std::getenv(name);
  return asked ? std::atoi(asked) : otherwise;
}

struct Random {
  std::mt19937_64 engine;
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  double log(double low, double high) { return std::exp((*this)(std::log(low), std::log(high))); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine); }
  std::string vector(int n, double size) {
    std::string text = "[";
    for (int i = 0; i < n; ++i) text += (i ? ", " : "") + fmt::format("{}", (*this)(-size, size));
    return text + "]";
  }
};

struct Trial {
  std::string text;
  double dt, restitution;
  int frames;
};

// 2 to 30 bodies on a lattice, each within a ball of 0.5 m, flying towards the middle.
Trial random_trial(unsigned seed) {
  Random random{std::mt19937_64(seed)};
  const int count = 2 + random.below(seed % 4 == 0 ? 29 : 8);
  Trial trial;
  trial.restitution = seed % 3 == 0 ? 0 : seed % 3 == 1 ? random(0, 0.5) : random(0.5, 1);
  trial.dt = random.log(1.0 / 240, 0.1);
  trial.frames = static_cast<int>(std::ceil(1.0 / trial.dt));
  const std::string ring =
      std::string(FC_SOURCE_DIR) + "/chapters/ch04_multibody_stepping/scenes/parts/ring.obj";
  std::string shapes, bodies;
  const double heaviest = random.log(1, 1e6);
  for (int i = 0; i < count; ++i) {
    const std::array<std::string, 7> kinds{
        "box: {size: [0.5, 0.4, 0.3]}",
        "box: {size: [0.8, 0.5, 0.05]}",
        "sphere: {radius: 0.3}",
        "capsule: {radius: 0.12, length: 0.5}",
        "hull: {points: [[0.4, 0, 0], [-0.4, 0, 0], [0, 0.3, 0], [0, -0.3, 0], [0, 0, 0.3], [0.1, 0, -0.3]]}",
        "hull: {points: [[0.3, 0.3, 0.3], [-0.3, -0.3, 0.3], [-0.3, 0.3, -0.3], [0.3, -0.3, -0.3]]}",
        "mesh: " + ring + ", scale: 0.25"};
    const int kind = seed % 5 == 0 ? random.below(7) : random.below(6);
    shapes += fmt::format("  s{}: {{{}, mass: {}}}\n", i, kinds[kind], random.log(1, heaviest));
    const Vec3 place = 1.1 * (Vec3(i % 3, i / 3 % 3, i / 9) - Vec3(1, 1, 0.5 * (count / 9)));
    const double speed = random(0.3, 3);
    bodies += fmt::format(
        "  - {{shape: s{}, position: [{}, {}, {}], orientation: {}, velocity: [{}, {}, {}], spin: {}}}\n", i,
        place.x(), place.y(), place.z(), random.vector(4, 1), -speed * place.x() + 0.5, -speed * place.y(),
        -speed * place.z() + random(-0.2, 0.2), random.vector(3, 5.7));
  }
  trial.text = fmt::format(
      "step: {{dt: {}, duration: 1}}\nrestitution: {}\nccd: {{tolerance: {}}}\n{}shapes:\n{}bodies:\n{}",
      trial.dt, trial.restitution, random.log(1e-8, 1e-4), seed % 2 ? "gyroscopic: true\n" : "", shapes,
      bodies);
  return trial;
}

struct Sums {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero(), moment = Vec3::Zero();
  double mass = 0, linear_size = 0, angular_size = 0, kinetic = 0;

  explicit Sums(const fc::world::World& world) {
    for (const auto& b : world.bodies) {
      const fc::RigidBody& s = b.state;
      const Vec3 own = s.inertia_world() * s.spin;
      linear += s.mass * s.velocity;
      angular += s.mass * s.position.cross(s.velocity) + own;
      moment += s.mass * s.position;
      mass += s.mass;
      linear_size += s.mass * s.velocity.norm();
      angular_size += s.mass * s.position.norm() * s.velocity.norm() + own.norm();
      kinetic += s.kinetic_energy();
    }
  }
};

// The deepest overlap of any two bodies, m; 0 if there is none.
double deepest(const fc::world::World& world) {
  double depth = 0;
  for (int a = 0; a < static_cast<int>(world.bodies.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(world.bodies.size()); ++b) {
      const fc::ca::PairPose pose(world.motion(a, 0), world.motion(b, 0), 0);
      const double far =
          world.shapes[world.bodies[a].shape].reach + world.shapes[world.bodies[b].shape].reach;
      if (pose.offset_world.norm() > far) continue;
      const auto gap = fc::hulls::model_distance(world.model_of(a), world.model_of(b), pose, 1e-9, 1e-6);
      depth = std::max(depth, -gap.lower);
    }
  return depth;
}

TEST(FreeBodies, KeepMomentaAndGoWhereTheseSay) {
  double lost = 0;
  std::int64_t most = 0;
  const int first = from_environment("FC_FIRST", 1), scenes = from_environment("FC_SCENES", kScenes);
  for (int seed = first; seed < first + scenes; ++seed) {
    const Trial trial = random_trial(static_cast<unsigned>(seed));
    SCOPED_TRACE(fmt::format("seed {}\n{}", seed, trial.text));
    auto world = make_world(trial.text);
    const Sums start(world);
    double energy = start.kinetic;
    std::int64_t work = 0;
    for (int frame = 1; frame <= trial.frames; ++frame) {
      const auto report = fc::world::step(world, trial.dt);
      const Sums now(world);
      ASSERT_LE((now.linear - start.linear).norm(), 1e-11 * start.linear_size) << "frame " << frame;
      const Vec3 centre = (start.moment + frame * trial.dt * start.linear) / start.mass;
      ASSERT_LE((now.moment / now.mass - centre).norm(), 1e-9)
          << "frame " << frame << ", lost " << report.lost_time << " s";
      ASSERT_LE(report.momentum_error, 1e-11);
      ASSERT_LE(report.energy_gain, 1e-12 * energy) << "frame " << frame;
      if (world.effects.gyroscopic) {
        ASSERT_LE((now.angular - start.angular).norm(), 1e-10 * start.angular_size) << "frame " << frame;
        ASSERT_LE(now.kinetic, energy * (1 + 1e-11)) << "frame " << frame;
        energy = now.kinetic;
      }
      lost += report.lost_time;
      work += report.node_pairs + 100 * report.solves;
      if (trial.restitution >= 0.9) {
        ASSERT_EQ(report.lost_time, 0) << "frame " << frame;
      }
    }
    EXPECT_LE(deepest(world), 1e-12);
    most = std::max(most, work);
    EXPECT_LE(work, 6'000'000) << "pairs of nodes, and 100 a solve: some seconds";
  }
  std::cout << "lost time " << lost << " s in all; most work " << most << "\n";
}

}  // namespace
