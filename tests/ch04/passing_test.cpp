// Bodies that slide, roll or turn on others, touching or within the tolerance: where the path is flush nothing happens.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "events.hpp"

namespace {

using namespace fc_test;
using fc::Quat;
using fc::Vec3;

std::string list(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}
std::string list(const Quat& q) {
  return fmt::format("[{}, {}, {}, {}]", q.w(), q.x(), q.y(), q.z());
}

// A unit cube of 12 triangles, or of 6 x 2 n^2 with edges drawn on its faces.
std::string cube_file(int n) {
  const auto path = scratch(fmt::format("cube_{}", n)) / "cube.obj";
  std::ofstream file(path);
  int first = 1;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-0.5, 0.5}) {
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
          Vec3 p;
          p[axis] = side;
          p[(axis + 1) % 3] = static_cast<double>(i) / n - 0.5;
          p[(axis + 2) % 3] = static_cast<double>(j) / n - 0.5;
          file << fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
        }
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const int a = first + i * (n + 1) + j, b = a + n + 1;
          file << (side > 0 ? fmt::format("f {} {} {} {}\n", a, b, b + 1, a + 1)
                            : fmt::format("f {} {} {} {}\n", a, a + 1, b + 1, b));
        }
      first += (n + 1) * (n + 1);
    }
  return path.string();
}

struct Slider {
  std::string name, shape;
  double height;  // m, of its centre above what it lies on
};

struct Floor {
  std::string name, shape;
};

const std::vector<Slider> sliders{
    {"box", "box: {size: [0.8, 0.6, 0.4]}", 0.2},
    {"ball", "sphere: {radius: 0.1}", 0.1},
    {"capsule", "capsule: {radius: 0.1, length: 0.5}", 0.35},
    {"hull", "hull: {points: [[0.3, 0, -0.2], [-0.2, 0.3, -0.2], [-0.2, -0.3, -0.2], [0, 0, 0.3]]}", 0.2},
    {"mesh", "mesh: CUBE1, scale: 0.4", 0.2}};
const std::vector<Floor> floors{
    {"boxes", "box: {size: [1, 1, 1]}"},
    {"hulls",
     "hull: {points: [[-0.5, -0.5, -0.5], [0.5, -0.5, -0.5], [-0.5, 0.5, -0.5], [0.5, 0.5, -0.5], "
     "[-0.5, -0.5, 0.5], [0.5, -0.5, 0.5], [-0.5, 0.5, 0.5], [0.5, 0.5, 0.5], [0, 0, -0.9]]}"},
    {"meshes", "mesh: CUBE1"},
    {"fine_meshes", "mesh: CUBE3"}};

std::string with_files(std::string text) {
  for (const int n : {1, 3}) {
    const std::string name = fmt::format("CUBE{}", n);
    for (auto at = text.find(name); at != std::string::npos; at = text.find(name))
      text.replace(at, name.size(), cube_file(n));
  }
  return text;
}

// A floor of 6 x 2 tiles, a slider on it, all turned by `turn`; after a second the slider is where a straight path leads.
void expect_passes(const Slider& slider, const Floor& floor, double gap, const Quat& turn,
                   const Vec3& velocity, const Vec3& spin) {
  SCOPED_TRACE(fmt::format("{} over {}, gap {}, v {}, spin {}, turned {}", slider.name, floor.name, gap,
                           list(velocity), list(spin), list(turn)));
  std::string text = "step: {dt: 0.02, duration: 1}\nshapes:\n  tile: {" + floor.shape + "}\n  it: {" +
                     slider.shape + ", mass: 2}\nbodies:\n";
  for (int i = 0; i < 12; ++i)
    text += fmt::format("  - {{shape: tile, static: true, position: {}, orientation: {}}}\n",
                        list(turn * Vec3(i % 6, i / 6 - 0.25, -0.5)), list(turn));
  const Vec3 start(0.1, 0.1, slider.height + gap);
  text += fmt::format("  - {{shape: it, position: {}, orientation: {}, velocity: {}, spin: {}}}\n",
                      list(turn * start), list(turn), list(turn * velocity), list(turn * spin));
  auto world = make_world(with_files(text));
  const fc::RigidBody before = body(world, 12);
  const Events events = run_world(world, 0.02, 50);
  const fc::RigidBody& after = body(world, 12);
  EXPECT_EQ(events.lost_time(), 0);
  EXPECT_LE((after.velocity - before.velocity).norm(), 1e-9) << "m/s";
  EXPECT_LE((after.spin - before.spin).norm(), 1e-9) << "rad/s";
  EXPECT_LE((after.position - before.position - before.velocity).norm(), 1e-9) << "m, off the straight path";
}

const Quat tilted = Quat(0.8, 0.3, -0.4, 0.33).normalized();

TEST(Seams, AreNothingToWhatSlidesOverThem) {
  for (const Slider& slider : sliders)
    for (const Floor& floor : floors)
      for (const double gap : {0.0, 1e-9, 1e-7, 4e-7, 9e-7, 2e-6})
        for (const Quat& turn : {Quat::Identity(), tilted})
          expect_passes(slider, floor, gap, turn, Vec3(3, 0.4, 0), Vec3::Zero());
}

TEST(Seams, AreNothingToWhatTurnsOnThem) {
  for (const Slider& slider : {sliders[0], sliders[1], sliders[2], sliders[3]})
    for (const double gap : {0.0, 1e-7, 4e-7})
      for (const Quat& turn : {Quat::Identity(), tilted})
        expect_passes(slider, floors[0], gap, turn, Vec3(3, 0.4, 0), Vec3(0, 0, 2.5));
}

TEST(Seams, AreNothingToABallThatRolls) {
  for (const double gap : {0.0, 1e-9, 1e-7, 4e-7, 9e-7})
    for (const Quat& turn : {Quat::Identity(), tilted})
      expect_passes(sliders[1], floors[0], gap, turn, Vec3(3, 0.4, 0), Vec3(-4, 30, 0));
}

// A step up is no seam: what slides against it is stopped.
TEST(Seams, AStepUpStops) {
  for (const double step : {1e-5, 1e-3}) {
    auto world = make_world(fmt::format(
        "step: {{dt: 0.02, duration: 1}}\nshapes:\n  tile: {{box: {{size: [1, 1, 1]}}}}\n  it: {{box: {{size: [0.8, 0.6, 0.4]}}, "
        "mass: 2}}\nbodies:\n  - {{shape: tile, static: true, position: [0, 0, -0.5]}}\n"
        "  - {{shape: tile, static: true, position: [1, 0, {}]}}\n"
        "  - {{shape: it, position: [0, 0, 0.2], velocity: [3, 0, 0]}}\n",
        step - 0.5));
    run_world(world, 0.02, 50);
    EXPECT_LT(body(world, 2).velocity.x(), 2.9) << "a step of " << step << " m";
  }
}

// A plate turns in its own plane under (or over) a box that touches it: nothing happens to either.
TEST(TurningPlate, UnderATouchingBoxDoesNothing) {
  std::mt19937_64 engine(5);
  const auto random = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  for (int k = 0; k < 60; ++k) {
    SCOPED_TRACE(k);
    const Quat turn = Quat(random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1)).normalized();
    const Vec3 base(random(-3, 3), random(-3, 3), random(-3, 3));
    const double gap = std::array<double, 4>{0, 1e-9, 1e-7, 4e-7}[static_cast<std::size_t>(k % 4)];
    const std::string kind = k % 2 ? ", mass: 100" : "", how = k % 2 ? "" : "kinematic: true, ";
    const double dt = std::array<double, 3>{1.0 / 240, 1.0 / 60, 0.1}[static_cast<std::size_t>(k % 3)];
    auto world = make_world(fmt::format(
        "step: {{dt: {}, duration: 1}}\nshapes:\n  plate: {{box: {{size: [2, 2, 0.2]}}{}}}\n  it: {{box: {{size: [0.5, 0.4, "
        "0.3]}}, mass: 1}}\nbodies:\n  - {{shape: plate, {}position: {}, orientation: {}, spin: {}}}\n"
        "  - {{shape: it, position: {}, orientation: {}}}\n",
        dt, kind, how, list(base + turn * Vec3(0, 0, -0.1)), list(turn),
        list(turn * Vec3(0, 0, random(0.5, 10))),
        list(base + turn * Vec3(random(-1.2, 1.2), random(-1.2, 1.2), 0.15 + gap)), list(turn)));
    const Events events = run_world(world, dt, static_cast<int>(0.5 / dt));
    std::int64_t advances = 0;
    for (const auto& report : events.reports) advances += report.advances;
    EXPECT_EQ(events.lost_time(), 0);
    EXPECT_LE(body(world, 1).velocity.norm(), 1e-9) << "m/s";
    EXPECT_LE(advances, 100 * static_cast<std::int64_t>(events.reports.size())) << "steps proved";
  }
}

// Two plates press on each other in free flight, with nothing else near (shared case held_in_free_flight).
const std::string pressing_plates = R"(
step: {dt: 0.016666666666666666, duration: 0.5}
shapes:
  plate: {box: {size: [0.8, 0.5, 0.05]}, density: 1000}
bodies:
  - {shape: plate, position: [-0.7, 0, 0], orientation: [0.1, -0.33, 0.13, -1.99], velocity: [3, 0, 0], spin: [36.25, 23.41, 4.57]}
  - {shape: plate, position: [0.7, -0.05, 0.06], orientation: [-1.0, -1.06, 0.76, -0.25], velocity: [-1, 0, 0], spin: [-4.04, -2.54, -31.3]}
)";

TEST(HeldInFreeFlight, TheCentreOfMassGoesOn) {
  auto world = make_world(pressing_plates);
  double lost = 0;
  for (int frame = 1; frame <= 30; ++frame) {
    lost += fc::world::step(world, 1.0 / 60).lost_time;
    EXPECT_NEAR(0.5 * (body(world, 0).position.x() + body(world, 1).position.x()), frame / 60.0, 1e-12);
  }
  EXPECT_GT(lost, 0) << "or this tests nothing";
}

// What acts on all bodies alike acts on a group that is frozen, too: on its path, and on the velocities that it keeps.
TEST(HeldInFreeFlight, TheGroupFallsAndIsSlowedDown) {
  struct Force {
    const char *text, *name;
    double gravity, drag;
  };
  for (const Force& force : {Force{"gravity: [0, 0, -9.81]\n", "gravity", 9.81, 0},
                             Force{"drag: {linear: 0.7}\n", "drag", 0, 0.7}}) {
    SCOPED_TRACE(force.name);
    auto world = make_world(force.text + pressing_plates);
    const double height = 0.5 * (body(world, 0).position.z() + body(world, 1).position.z());
    double lost = 0;
    for (int frame = 1; frame <= 30; ++frame) {
      lost += fc::world::step(world, 1.0 / 60).lost_time;
      const double t = frame / 60.0, k = force.drag, left = std::exp(-k * t);
      const Vec3 centre = 0.5 * (body(world, 0).position + body(world, 1).position);
      const Vec3 velocity = 0.5 * (body(world, 0).velocity + body(world, 1).velocity);
      EXPECT_NEAR(centre.x(), k > 0 ? (1 - left) / k : t, 1e-12) << "m, at " << t << " s";
      EXPECT_NEAR(centre.z(), height - 0.5 * force.gravity * t * t, 1e-12) << "m, at " << t << " s";
      EXPECT_NEAR(velocity.x(), left, 1e-12) << "m/s, at " << t << " s";
      EXPECT_NEAR(velocity.z(), -force.gravity * t, 1e-12) << "m/s, at " << t << " s";
    }
    EXPECT_GT(lost, 0) << "or this tests nothing";
  }
}

}  // namespace
