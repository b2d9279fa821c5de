// Sixty-four cylinders piled between walls. Scenes have no shape `cylinder`: these are prisms with sixteen
// sides.
#include <gtest/gtest.h>

#include <numbers>

#include "oracles.hpp"

namespace oracle_cylinders {  // the chapter's oracles are compiled as one
namespace {

using namespace fc_test;
using independent::Rounded;
using independent::State;
using independent::Vec;

constexpr double kRadius = 0.15, kLength = 0.5, kGravity = 10;  // m, m, m/s^2
constexpr int kSides = 16;

std::vector<Vec> prism() {  // along y, a side down
  std::vector<Vec> points;
  for (const double y : {-0.5 * kLength, 0.5 * kLength})
    for (int k = 0; k < kSides; ++k) {
      const double phi = 2 * std::numbers::pi * (k + 0.5) / kSides;
      points.push_back({kRadius * std::cos(phi), y, kRadius * std::sin(phi)});
    }
  return points;
}

std::string prism_text() {
  std::string text;
  for (const Vec& p : prism())
    text += (text.empty() ? "[" : ", [") + number(p.x) + ", " + number(p.y) + ", " + number(p.z) + "]";
  return "  prism: {hull: {points: [" + text + "]}, density: 500}\n";
}

// The independent overlap check on all pairs of a world: a plane across a normal of a prism's sides, or across an axis
// of the world, that separates the two proves that they are apart; pairs that have none of these get the slow test.
class Judge {
 public:
  explicit Judge(const fc::Scene& scene) : scene_(scene) {
    for (const fc::ShapeSpec& spec : scene.shapes) shapes_.push_back(shape_of(spec));
    for (int k = 0; k < kSides / 2; ++k) {
      const double phi = 2 * std::numbers::pi * k / kSides;
      normals_.push_back({std::cos(phi), 0, std::sin(phi)});
    }
    normals_.push_back({0, 1, 0});
  }
  // The first two bodies that overlap, in words; empty if none do.
  std::string look(const std::vector<State>& states) const {
    const int count = static_cast<int>(states.size());
    std::vector<std::vector<Vec>> points(states.size());
    for (int i = 0; i < count; ++i) points[at(i)] = moved(shape(i).core.vertices, states[at(i)]);
    for (int a = 0; a < count; ++a)
      for (int b = a + 1; b < count; ++b) {
        if (scene_.bodies[at(a)].is_static && scene_.bodies[at(b)].is_static) continue;
        if (norm(states[at(a)].position - states[at(b)].position) > shape(a).reach + shape(b).reach) continue;
        bool apart = false;
        for (const Vec& n : {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}})
          apart = apart || parted(points[at(a)], points[at(b)], n);
        for (const int i : {a, b})
          for (std::size_t k = 0; k < normals_.size() && !apart && !scene_.bodies[at(i)].is_static; ++k)
            apart = parted(points[at(a)], points[at(b)],
                           independent::rotation(states[at(i)].orientation) * normals_[k]);
        if (!apart && !independent::apart(shape(a), states[at(a)], shape(b), states[at(b)], kTouch))
          return "bodies " + std::to_string(a) + " and " + std::to_string(b) + " overlap";
      }
    return {};
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const Rounded& shape(int body) const {
    return shapes_[static_cast<std::size_t>(scene_.bodies[at(body)].shape)];
  }
  static std::vector<Vec> moved(std::vector<Vec> points, const State& state) {
    const independent::Matrix turn = independent::rotation(state.orientation);
    for (Vec& x : points) x = state.position + turn * x;
    return points;
  }
  static bool parted(const std::vector<Vec>& a, const std::vector<Vec>& b, const Vec& n) {
    double high_a = -INFINITY, low_a = INFINITY, high_b = -INFINITY, low_b = INFINITY;
    for (const Vec& p : a) {
      high_a = std::max(high_a, dot(n, p));
      low_a = std::min(low_a, dot(n, p));
    }
    for (const Vec& p : b) {
      high_b = std::max(high_b, dot(n, p));
      low_b = std::min(low_b, dot(n, p));
    }
    return low_b > high_a || low_a > high_b;
  }

  const fc::Scene& scene_;
  std::vector<Rounded> shapes_;
  std::vector<Vec> normals_;
};

double weight_of(const Simulation& sim) {  // N, of all that moves
  double mass = 0;
  for (const auto& b : sim.world.bodies) mass += b.state.is_static() ? 0 : b.state.mass;
  return kGravity * mass;
}
double momentum_of(const Simulation& sim) {  // N s, upwards
  double sum = 0;
  for (const auto& b : sim.world.bodies) sum += b.state.is_static() ? 0 : b.state.momentum().z();
  return sum;
}

// Lying in eight layers of eight, each in the dips of the one below, with a little room; they fall into
// place. That is a pile: some 600 rows, solved by sweeps to a residual of about a thousandth. What that
// leaves may not make energy that is not reported. Walls push sideways, so that the floor's impulses are the weight's and the
// change of momentum, exactly, whatever the residual; in the last second, when they lie, that is the weight.
TEST(Cylinders, PiledBetweenWalls) {
  const fc::Scene scene =
      fc::read_scene({FC_SOURCE_DIR "/chapters/ch05_resting_contact/scenes/cylinders.yaml", {}, {}, 5});
  ASSERT_EQ(scene.bodies.size(), 69U);
  const Judge judge(scene);
  for (const double dt : kFrames) {
    const std::string with = " with frames of " + number(dt) + " s";
    Simulation sim(scene, dt);
    const double weight = weight_of(sim), start = sim.energy();
    double rise = 0, energy = start, most = 0, pushed = 0, momentum = 0, kinetic = 0;
    int from = 0;  // the frame before which pushes are not counted
    while (sim.time() < 5 - 0.5 * dt) {
      if (sim.time() < 4 - 0.5 * dt) {
        pushed = kinetic = 0;
        momentum = momentum_of(sim);
        from = sim.frame;
      }
      sim.step({.impact = [&](const fc::world::ImpactRecord& r) {
        if (r.contact.body_a == 0) pushed += r.impulse.impulse * r.contact.normal.z();
      }});
      rise = std::max(rise, sim.energy() - energy - sim.last.correction_energy);
      energy = sim.energy();
      kinetic += sim.kinetic();
      most = std::max(most, energy - sim.corrected);
      const std::string overlap = judge.look(states_of(sim.world, 0));
      ASSERT_EQ(overlap, "") << "in frame " << sim.frame << with;
    }
    EXPECT_EQ(sim.lost, 0) << "s" << with;
    EXPECT_GT(sim.smallest_gap, 0) << "m" << with;
    EXPECT_LE(rise, 1e-9 * start) << "J in a frame" << with;
    EXPECT_LE(most, start * (1 + 1e-9)) << "J" << with;
    EXPECT_LE(kinetic / (sim.frame - from), 2e-5 * start) << "J, mean of the last second: they lie" << with;
    const double seconds = (sim.frame - from) * dt;
    EXPECT_NEAR(pushed, weight * seconds + momentum_of(sim) - momentum, 1e-9 * weight) << "N s" << with;
    EXPECT_NEAR(pushed / (weight * seconds), 1, 1e-3) << "of the weight in the last second" << with;
  }
}

// Standing on each other, four on each of sixteen places: every level carries what is above it.
TEST(Cylinders, StandOnEachOther) {
  const std::string text =
      "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -10]\nenvelope: 1.0e-3\nshapes:\n" + prism_text() +
      "  floor: {box: {size: [6, 6, 1]}}\nbodies:\n  - {shape: floor, static: true, position: [0, 0, -0.5]}\n"
      "  - {shape: prism, grid: {count: [4, 4, 4], spacing: [0.4, 0.4, " +
      number(kLength) + "]}, position: [0, 0, " + number(0.5 * kLength) +
      "], orientation: [0.7071067811865476, 0.7071067811865476, 0, 0]}\n";
  const fc::Scene scene = Simulation::read(text);
  const Judge judge(scene);
  for (const double dt : kFrames) {
    const std::string with = " with frames of " + number(dt) + " s";
    Simulation sim(scene, dt);
    double rise = 0, energy = sim.energy();
    while (sim.time() < 3) {
      sim.step();
      rise = std::max(rise, sim.energy() - energy - sim.last.correction_energy);
      energy = sim.energy();
      ASSERT_EQ(judge.look(states_of(sim.world, 0)), "") << "in frame " << sim.frame << with;
    }
    std::vector<double> under(65, 0);
    sim.step({.impact = [&](const fc::world::ImpactRecord& r) {
      under[static_cast<std::size_t>(r.contact.body_b)] += r.impulse.impulse * r.contact.normal.z() / dt;
    }});
    for (int i = 0; i < 64; ++i)
      EXPECT_NEAR(under[static_cast<std::size_t>(i + 1)], (4 - i / 16) * weight_of(sim) / 64,
                  1e-6 * weight_of(sim) / 16)
          << "N under cylinder " << i << with;
    EXPECT_LE(sim.kinetic(), 1e-15) << "J" << with;
    EXPECT_LE(rise, 1e-12 * energy) << "J in a frame" << with;
    EXPECT_EQ(sim.lost, 0) << "s" << with;
  }
}

}  // namespace
}  // namespace oracle_cylinders
