// Manifolds and paths through a frame against brute force, and a block that tips in closed form.
#include "ch05_resting_contact/path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ch05_resting_contact/resting.hpp"
#include "support/run_files.hpp"

namespace {

#ifdef FC_SANITIZED
constexpr int kTrials = 800;
#else
constexpr int kTrials = 4000;
#endif

using namespace fc_test;
using fc::Pose;
using fc::Quat;
using fc::Vec3;
using fc::resting::Contacts;
using fc::resting::PairContacts;

fc::Scene scene_of(const std::string& text) {
  const auto file = scratch("scenes") / "scene.yaml";
  std::ofstream(file) << text;
  return fc::read_scene({file, {}, {}, 5});
}

// Two shapes apart, to be placed by the tests.
fc::world::World two(const std::string& a, const std::string& b) {
  return fc::world::build_world(scene_of(
      "step: {dt: 0.01, duration: 1}\nenvelope: 2.0e-3\nshapes:\n"
      "  box: {box: {size: [1, 0.8, 0.6]}, mass: 1}\n"
      "  slab: {box: {size: [4, 3, 0.5]}, mass: 1}\n"
      "  pill: {capsule: {radius: 0.2, length: 0.7}, mass: 1}\n"
      "  ball: {sphere: {radius: 0.3}, mass: 1}\n"
      "  wedge: {hull: {points: [[-0.5, -0.4, -0.3], [0.5, -0.4, -0.3], [0.5, 0.4, -0.3], [-0.5, 0.4, "
      "-0.3], [-0.5, -0.4, 0.4], [-0.5, 0.4, 0.4]]}, mass: 1}\n"
      "bodies:\n  - {shape: " +
      a + "}\n  - {shape: " + b + ", position: [9, 0, 0]}\n"));
}

double distance(const fc::world::World& world, const Pose& a, const Pose& b) {
  return fc::hulls::model_distance(world.model_of(0), world.model_of(1), fc::ca::PairPose(a, b), 1e-9).lower;
}

struct Random {
  std::mt19937 source;
  explicit Random(unsigned seed) : source(seed) {}
  double operator()() { return 2.0 * source() / std::mt19937::max() - 1; }
  Vec3 vector() { return Vec3((*this)(), (*this)(), (*this)()); }
  Quat rotation() { return Quat(1.5 * (*this)(), (*this)(), (*this)(), (*this)()).normalized(); }
};

// Places B beside A, along a random direction, at about the wanted gap.
bool place(fc::world::World& world, Random& random, double gap) {
  fc::RigidBody &a = world.bodies[0].state, &b = world.bodies[1].state;
  a.position = random.vector();
  a.orientation = random.rotation();
  b.orientation = random() > 0 ? random.rotation() : a.orientation;  // often face to face
  Vec3 along = random() > 0 ? random.vector().normalized()
                            : Vec3(a.orientation * Vec3::Unit(static_cast<int>(random.source() % 3)));
  double low = 0, high = 8;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    b.position = a.position + middle * along;
    (distance(world, a.pose(), b.pose()) > gap ? high : low) = middle;
  }
  b.position = a.position + high * along;
  return distance(world, a.pose(), b.pose()) < 2 * gap;
}

// The smallest gap of a manifold is the distance; its plane separates the two; every point lies on both surfaces' sides
// of it.
TEST(Manifold, HasTheDistance) {
  Random random(7);
  const char* const shapes[] = {"box", "slab", "pill", "ball", "wedge"};
  int many = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    fc::world::World world = two(shapes[random.source() % 5], shapes[random.source() % 5]);
    if (!place(world, random, 1e-3)) continue;
    Contacts contacts(world, 2e-3);
    const double gap = distance(world, world.bodies[0].state.pose(), world.bodies[1].state.pose());
    const fc::Pose a = world.bodies[0].state.pose(), b = world.bodies[1].state.pose();
    PairContacts& pair = contacts.pair(0, 1);
    contacts.update(world, pair, a, b);
    EXPECT_NEAR(pair.gap, gap, 1e-7);
    ASSERT_GT(pair.points.size(), 0u);
    double least = 1e300;
    for (const auto& c : pair.points) {
      least = std::min(least, c.gap_at(a, b));
      EXPECT_NEAR(c.normal_at(a, b).norm(), 1, 1e-12);
      EXPECT_NEAR((c.normal_at(a, b) - pair.points[0].normal_at(a, b)).norm(), 0, 1e-12) << "one plane";
    }
    EXPECT_GE(least, gap - 2e-3 / 64 - 1e-9) << "trial " << trial;
    EXPECT_LE(least, gap + 2e-3 / 64 + 1e-7) << "trial " << trial << ": who is nearest is among the points";
    many += pair.points.size() > 2;
  }
  EXPECT_GT(many, 300) << "faces that lie over each other";
}

// A square metre on a square metre, turned by 45 degrees: an octagon, by Pythagoras.
TEST(Manifold, OctagonOfTwoSquares) {
  fc::world::World world = fc::world::build_world(scene_of(
      "step: {dt: 0.01, duration: 1}\nenvelope: 2.0e-3\nshapes:\n  box: {box: {size: [1, 1, 1]}, mass: "
      "1}\nbodies:\n  - {shape: box}\n  - {shape: box, position: [0, 0, 1.001], orientation: "
      "[0.9238795325112867, 0, 0, 0.3826834323650898]}\n"));
  Contacts contacts(world, 2e-3);
  PairContacts& pair = contacts.pair(0, 1);
  const fc::Pose a = world.bodies[0].state.pose(), b = world.bodies[1].state.pose();
  contacts.update(world, pair, a, b);
  ASSERT_EQ(pair.points.size(), 8u);
  for (const auto& c : pair.points) {
    const Vec3 point = c.on_a(a, b);
    EXPECT_NEAR(c.gap_at(a, b), 1e-3, 1e-12);
    EXPECT_NEAR(c.normal_at(a, b).z(), 1, 1e-12);
    EXPECT_NEAR(std::max(std::abs(point.x()), std::abs(point.y())), 0.5, 1e-9);
    EXPECT_NEAR(point.head<2>().norm(), std::hypot(0.5, std::sqrt(0.5) - 0.5), 1e-9);
  }
}

// Whatever is called clear is clear, at two hundred times in between; other pairs come as near as the answer says.
TEST(Path, ProvesOnlyWhatIsClear) {
  Random random(11);
  const double dt = 1 / 60.0, required_gap = 1e-4;
  const char* const shapes[] = {"box", "slab", "pill", "wedge"};
  int clear = 0, reached = 0, turning = 0, by_planes = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    fc::world::World world = two(shapes[random.source() % 4], shapes[random.source() % 4]);
    if (!place(world, random, 1e-3)) continue;
    fc::RigidBody &a = world.bodies[0].state, &b = world.bodies[1].state;
    const bool together = random() > 0;  // as if they were one body, or nearly
    a.spin = (random() > 0 ? 0.3 : 6) * random.vector();
    a.velocity = random.vector();
    b.spin = together ? Vec3(a.spin + 0.05 * random.vector()) : Vec3(3 * random.vector());
    b.velocity = together ? Vec3(a.velocity_at(b.position) + 0.03 * random.vector())
                          : Vec3(a.velocity + 0.3 * random.vector());
    world.effects.gravity = Vec3(0, 0, -9.81);
    world.bodies[0].plan = {0, a.velocity, a.spin};  // one falls, the other does not
    Contacts contacts(world, 2e-3);
    PairContacts& pair = contacts.pair(0, 1);
    contacts.update(world, pair, a.pose(), b.pose());
    const fc::resting::Path path_a = fc::resting::path_of(world, 0, 0, dt),
                            path_b = fc::resting::path_of(world, 1, 0, dt);
    const auto verdict =
        fc::resting::check_path(world, contacts, pair, path_a, path_b, dt, {.required_gap = required_gap});
    const fc::ca::Motion motion_a = world.motion(0, 0), motion_b = world.motion(1, 0);
    const auto gap_at = [&](double t) { return distance(world, motion_a.pose_at(t), motion_b.pose_at(t)); };
    double least = 1e300;
    for (int k = 0; k <= 200; ++k) least = std::min(least, gap_at(dt * k / 200));
    if (verdict.clear) {
      EXPECT_GE(least, required_gap + verdict.slack - 1e-7) << "trial " << trial;
      ++clear;
      turning += together && a.spin.norm() > 2;
    } else {
      EXPECT_LE(gap_at(verdict.time), 1.3 * required_gap) << "trial " << trial;
      ++reached;
    }
    // Planes alone prove less; but what they prove, up to that time, is clear.
    const auto planes = fc::resting::check_path(world, contacts, pair, path_a, path_b, dt,
                                                {.required_gap = required_gap, .by_planes = true});
    by_planes += planes.clear;
    EXPECT_TRUE(verdict.clear || !planes.clear) << "trial " << trial;
    for (int k = 0; k <= 200; ++k) {
      const double t = dt * k / 200;
      if (t <= planes.time) {
        EXPECT_GE(gap_at(t), required_gap + planes.slack - 1e-7) << "trial " << trial;
      }
    }
  }
  EXPECT_GT(by_planes, 0.9 * clear);
  EXPECT_GT(clear, kTrials / 8);
  EXPECT_GT(reached, kTrials / 8);
  EXPECT_GT(turning, kTrials / 80) << "pairs that turn fast, and together";
}

// What is known of a pair's gap from the frame before, moved on, is never more than the gap; and where it says so
// little that the path's proof would allow almost an overlap, the pair is searched again.
TEST(Contacts, KnowSmallGapsWell) {
  Random random(5);
  const double envelope = 2e-3;
  const char* const shapes[] = {"box", "slab", "pill", "wedge"};
  int small = 0, kept = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    fc::world::World world = two(shapes[random.source() % 4], shapes[random.source() % 4]);
    if (!place(world, random, 2e-4)) continue;
    Contacts contacts(world, envelope);
    PairContacts& pair = contacts.pair(0, 1);
    fc::RigidBody &a = world.bodies[0].state, &b = world.bodies[1].state;
    contacts.update(world, pair, a.pose(), b.pose());
    const auto searched = contacts.searched();
    b.position += 1e-4 * random.vector();
    const Vec3 turn = 2e-4 * random.vector();
    b.orientation = (Quat(1, turn.x(), turn.y(), turn.z()) * b.orientation).normalized();
    const double gap = distance(world, a.pose(), b.pose());
    if (gap < 1e-6) continue;
    contacts.update(world, pair, a.pose(), b.pose());
    EXPECT_LE(pair.gap, gap + 1e-9) << "trial " << trial;
    EXPECT_GE(pair.gap, std::min(envelope / 16, gap - 1e-7)) << "trial " << trial;
    small += pair.gap < envelope / 16;
    kept += contacts.searched() == searched;
  }
  EXPECT_GT(small, 300);
  EXPECT_GT(kept, 300);
}

// A block that tips over an edge on a smooth floor: no force acts sideways, so its centre falls straight
// down, h(t) = b cos t + a sin t over the edge (a, b: half its width and height), and energy tells its spin:
//   m g (h_0 - h) = m h'^2 w^2 / 2 + I w^2 / 2.
TEST(Tipping, OnASmoothFloor) {
  const double a = 0.2, b = 0.5, mass = 2, g = 10, inertia = mass * (4 * a * a + 4 * b * b) / 12;
  const double start = 0.5;  // rad, beyond atan(a / b) = 0.38: it falls
  double last = 0;
  for (const double dt : {1 / 60.0, 1 / 120.0, 1 / 240.0}) {
    const double h0 = b * std::cos(start) + a * std::sin(start);
    const std::string text =
        "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -10]\nenvelope: 4.0e-4\nshapes:\n"
        "  block: {box: {size: [0.4, 1, 1]}, mass: 2}\n  floor: {box: {size: [40, 40, 1]}}\nbodies:\n"
        "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n  - {shape: block, position: [0, 0, " +
        std::to_string(h0 + 2e-4) + "], orientation: [" + std::to_string(std::cos(0.5 * start)) + ", 0, " +
        std::to_string(std::sin(0.5 * start)) + ", 0]}\n";
    const fc::Scene scene = scene_of(text);
    fc::world::World world = fc::world::build_world(scene);
    fc::resting::Resting resting(scene, world, dt);
    const auto angle = [&] {
      const Quat& q = world.bodies[1].state.orientation;
      return 2 * std::atan2(q.y(), q.w());
    };
    double lost = 0;
    while (angle() < 1.2) lost += resting.step(world).step.lost_time;
    const double t = angle(), h = b * std::cos(t) + a * std::sin(t),
                 slope = -b * std::sin(t) + a * std::cos(t);
    const double spin = std::sqrt(2 * mass * g * (h0 - h) / (mass * slope * slope + inertia));
    const double error = std::abs(world.bodies[1].state.spin.y() / spin - 1);
    EXPECT_EQ(lost, 0) << "s";
    EXPECT_LE(world.bodies[1].state.velocity.head<2>().norm(), 1e-9) << "m/s: nothing pushes sideways";
    EXPECT_LE(error, 3 * dt) << "of the spin, with frames of " << dt << " s";
    if (last > 0) {
      EXPECT_LE(error, 0.7 * last) << "half the step, about half the error";
    }
    last = error;
  }
}

}  // namespace
