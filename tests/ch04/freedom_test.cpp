// Bodies that may not move as they like, kinematic bodies on a path, and curved and compound bodies: each
// against its closed form.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "events.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;

const std::string head = R"(
step: {dt: 0.01, duration: 1}
ccd: {tolerance: 1.0e-9}
restitution: 0.5
shapes:
  ball: {sphere: {radius: 0.1}, mass: 0.5}
  bead: {box: {size: [0.2, 0.2, 0.2]}, mass: 2}
  door: {box: {size: [1, 0.1, 2]}, mass: 3}
  floor: {box: {size: [10, 10, 1]}}
  rod: {cylinder: {radius: 0.2, length: 1}, mass: 2}
  cone: {cone: {radius: 0.3, length: 0.4}, mass: 2}
  paddle: {box: {size: [0.2, 1, 1]}}
  dumbbell: {parts: [{sphere: {radius: 0.2}, position: [-0.5, 0, 0]}, {sphere: {radius: 0.2}, position: [0.5, 0, 0]},
                     {cylinder: {radius: 0.1, length: 1}, rotation: {axis: [0, 1, 0], degrees: 90}}], density: 1000}
bodies:
)";

TEST(CurvedBodies, ACylinderLandsOnItsSideInTime) {
  auto world =
      make_world(head +
                     "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n"
                     "  - {shape: rod, position: [0, 0, 1.2], rotation: {axis: [0, 1, 0], degrees: 90}}\n",
                 {"gravity=[0, 0, -10]"});
  const Events events = run_world(world, 0.01, 60);
  expect_sound(events);
  ASSERT_EQ(events.all.size(), 2u);  // the two ends of its line
  const double t = std::sqrt(2 * 1.0 / 10), v = 10 * t;
  for (const Event& e : events.all) {
    EXPECT_NEAR(e.t, t, 1e-9);
    EXPECT_NEAR(e.impulse.impulse, 2 * v * 1.5 / 2, 1e-6);
    EXPECT_NEAR(std::abs(e.contact.point.x()), 0.5, 1e-9);
  }
  EXPECT_NEAR(body(world, 1).velocity.z(), 0.5 * v - 10 * (0.6 - t), 1e-7);
  EXPECT_LT(body(world, 1).spin.norm(), 1e-6);
}

TEST(CurvedBodies, AConeLandsOnItsBaseAndBouncesUpright) {
  auto world = make_world(head +
                              "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n"
                              "  - {shape: cone, position: [0, 0, 1]}\n",
                          {"gravity=[0, 0, -10]"});
  const Events events = run_world(world, 0.01, 60);
  ASSERT_GE(events.all.size(), 2u);                             // some of eight points carry all of it
  EXPECT_NEAR(events.all[0].t, std::sqrt(2 * 0.8 / 10), 1e-9);  // its base is 0.2 m under its origin
  EXPECT_LT(body(world, 1).spin.norm(), 1e-6);
}

TEST(Fixed, ADoorTurnsAboutItsHinge) {
  auto world = make_world(head +
                          "  - {shape: door, fixed: [x, y, z, rx, ry]}\n"
                          "  - {shape: ball, position: [0.4, -0.3, 0.2], velocity: [0, 3, 0]}\n");
  const Events events = run_world(world, 0.01, 20);
  ASSERT_GE(events.all.size(), 1u);
  const double inertia = 3 * (1 + 0.01) / 12, a = 0.4, m = 0.5;
  const double j = 1.5 * 3 / (1 / m + a * a / inertia);
  EXPECT_NEAR(events.all[0].impulse.impulse, j, 1e-7);
  EXPECT_LT((body(world, 0).spin - Vec3(0, 0, j * a / inertia)).norm(), 1e-7);
  EXPECT_EQ(body(world, 0).velocity, Vec3::Zero());
  EXPECT_EQ(body(world, 0).position, Vec3::Zero());
  EXPECT_NEAR(body(world, 1).velocity.y(), 3 - j / m, 1e-7);
  // The ball's and the door's angular momentum about the hinge is what it was.
  const double before = a * m * 3,
               after = a * m * body(world, 1).velocity.y() + inertia * body(world, 0).spin.z();
  EXPECT_NEAR(after, before, 1e-7);
}

TEST(Fixed, ABeadStaysOnItsWire) {
  auto world = make_world(
      head +
          "  - {shape: bead, fixed: [y, z, rx, ry, rz]}\n"
          "  - {shape: ball, position: [-0.5, 0.05, 0.04], velocity: [2, 0, 0], spin: [0, 0, 3]}\n",
      {"gravity=[0.5, 0, -10]"});
  const double start = energy(world);
  const Events events = run_world(world, 0.01, 30);
  EXPECT_NEAR(energy(world) - start, 0, 5);  // some is lost at the impact
  EXPECT_EQ(body(world, 0).velocity.y(), 0);
  EXPECT_EQ(body(world, 0).velocity.z(), 0);
  EXPECT_EQ(body(world, 0).position.z(), 0);
  EXPECT_EQ(body(world, 0).spin, Vec3::Zero());
  ASSERT_GE(events.all.size(), 1u);
  EXPECT_GT(body(world, 0).velocity.x(), 0.5 * 0.3);
  // Before anything hits it: free fall along the wire alone.
  auto alone = make_world(head + "  - {shape: bead, fixed: [y, z, rx, ry, rz]}\n", {"gravity=[0.5, 0, -10]"});
  run_world(alone, 0.01, 100);
  EXPECT_LT((body(alone, 0).position - Vec3(0.25, 0, 0)).norm(), 1e-12);
}

TEST(Fixed, OneFixedTurnLetsTheOthersGoOn) {
  auto world = make_world(head +
                          "  - {shape: door, fixed: [rx], spin: [0, 1, 2]}\n"
                          "  - {shape: ball, position: [0.4, -2, 0.3], velocity: [0, 30, 0]}\n");
  const double start = kinetic_energy(world);
  const Events events = run_world(world, 0.01, 30);
  ASSERT_GE(events.all.size(), 1u);
  const Vec3 turns = body(world, 0).orientation.conjugate() * body(world, 0).spin;
  EXPECT_NEAR(turns.x(), 0, 1e-12 * turns.norm());
  EXPECT_LE(kinetic_energy(world), start);
  for (const auto& report : events.reports) EXPECT_LE(report.energy_error, 1e-10 * start);
}

TEST(Fixed, AllSixAreAsStatic) {
  auto world = make_world(head +
                          "  - {shape: bead, fixed: [x, y, z, rx, ry, rz]}\n"
                          "  - {shape: ball, position: [-0.5, 0, 0], velocity: [2, 0, 0]}\n");
  run_world(world, 0.01, 30);
  EXPECT_EQ(body(world, 0).position, Vec3::Zero());
  EXPECT_NEAR(body(world, 1).velocity.x(), -1, 1e-9);
}

TEST(Fixed, ContradictionsAreRefused) {
  const auto refusal = [](const std::string& keys) {
    try {
      make_world(head + "  - {shape: bead, " + keys + "}\n");
      return std::string("accepted");
    } catch (const fc::InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_NE(refusal("fixed: [x], velocity: [1, 0, 0]").find("'velocity' has 1 m/s along x, which is fixed"),
            std::string::npos);
  EXPECT_NE(refusal("fixed: [rx], spin: [1, 0, 0]").find("'spin' has 1 rad/s about the body's x"),
            std::string::npos);
  EXPECT_EQ(refusal("fixed: [rx], spin: [0, 1, 0]"), "accepted");
  EXPECT_EQ(refusal("fixed: [rx], rotation: {axis: [0, 0, 1], degrees: 90}, spin: [1, 0, 0]"), "accepted");
  EXPECT_NE(refusal("fixed: [q]").find("'q' is none of x, y, z, rx, ry, rz"), std::string::npos);
  EXPECT_NE(refusal("fixed: [x, x]").find("'x' is given twice"), std::string::npos);
  EXPECT_NE(refusal("fixed: [x], static: true").find("no impulse moves a static body"), std::string::npos);
}

struct PathFile {
  std::filesystem::path file = scratch("paths") / "path.csv";
  explicit PathFile(const std::string& rows) { std::ofstream(file) << "t,px,py,pz,qw,qx,qy,qz\n" << rows; }
  std::string body(const std::string& shape) const {
    return "  - {shape: " + shape + ", kinematic: true, path: " + file.string() + "}\n";
  }
};

TEST(Paths, APaddleThatStartsWithinAFramePushesABall) {
  const PathFile path("0.0137,-1,0,0,1,0,0,0\n0.5137,1,0,0,1,0,0,0\n");  // 4 m/s
  auto world = make_world(head + path.body("paddle") + "  - {shape: ball}\n");
  const Events events = run_world(world, 0.01, 100);
  ASSERT_EQ(events.all.size(), 1u);
  EXPECT_NEAR(events.all[0].t, 0.0137 + 0.8 / 4, 1e-9);
  EXPECT_NEAR(body(world, 1).velocity.x(), 1.5 * 4, 1e-9);
  EXPECT_EQ(body(world, 0).position, Vec3(1, 0, 0));  // and there it stays
  EXPECT_EQ(body(world, 0).velocity, Vec3::Zero());
}

TEST(Paths, AreMetAtEveryRowAndStraightBetween) {
  const PathFile path("-1,0,0,0,1,0,0,0\n0.005,1,0,0,1,0,0,0\n0.035,1,3,0,0,0,0,1\n0.0375,1,3,1,0,0,0,-1\n");
  auto world = make_world(head + path.body("cone"));
  const Vec3 up(0, 0, -0.1);  // the cone's centre of mass, under its origin
  const auto place = [&] { return fc::frame_position(world.shapes[world.bodies[0].shape], body(world, 0)); };
  EXPECT_LT((place() - Vec3(1 / 1.005, 0, 0)).norm(), 1e-14);
  run_world(world, 0.01, 2);  // 0.02 s: half way from the second row to the third
  EXPECT_LT((place() - Vec3(1, 1.5, 0)).norm(), 1e-14);
  EXPECT_NEAR(std::abs(body(world, 0).orientation.w()), std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(body(world, 0).spin.norm(), std::numbers::pi / 0.03, 1e-10);
  run_world(world, 0.01, 2);
  EXPECT_LT((place() - Vec3(1, 3, 1)).norm(), 1e-14);
  EXPECT_EQ(body(world, 0).spin, Vec3::Zero());
  EXPECT_LT((body(world, 0).position - Vec3(1, 3, 1) - up).norm(), 1e-14);
}

// A lift under a block: impacts pile up, and both are frozen again and again. The lift is late then, and never
// jumps into what lies on it.
TEST(Paths, WhoIsFrozenOnThemGoesOnLate) {
  const PathFile path("0,0,0,0,1,0,0,0\n1,0,0,0.5,1,0,0,0\n");
  auto world = make_world(head + path.body("floor") + "  - {shape: bead, position: [0, 0, 0.601]}\n",
                          {"gravity=[0, 0, -10]"});
  double lost = 0, last = 0;
  for (int frame = 0; frame < 150; ++frame) {
    const auto report = fc::world::step(world, 0.01);
    lost += report.lost_time;
    const double lift = body(world, 0).position.z();
    ASSERT_GT(body(world, 1).position.z() - 0.1 - lift - 0.5, 0) << frame;
    ASSERT_GT(report.min_gap, 0) << frame;
    ASSERT_LE(lift - last, 0.5 * 0.01 + 1e-12) << frame;
    last = lift;
  }
  EXPECT_GT(lost, 0.1);
  EXPECT_NEAR(last, std::min(0.5, 0.5 * (1.5 - lost)), 1e-9);
}

TEST(Paths, ABadFileIsRefusedAtItsCell) {
  const auto refusal = [](const std::string& rows, const std::string& more = "") {
    const PathFile path(rows);
    try {
      make_world(head + "  - {shape: paddle, kinematic: true, path: " + path.file.string() + more + "}\n");
      return std::string("accepted");
    } catch (const fc::InputError& error) {
      const std::string text = error.what();
      return text.substr(text.rfind(".csv") == std::string::npos ? 0 : text.find("path.csv"));
    }
  };
  EXPECT_EQ(refusal("0,0,0,0,1,0,0,0\n"), "accepted");
  EXPECT_EQ(refusal("0,0,0,0,1,0,0,0\n0,1,0,0,1,0,0,0\n"),
            "path.csv:3:1: 0 s is not later than the row before, 0 s; times must ascend");
  EXPECT_EQ(refusal("0,nan,0,0,1,0,0,0\n"),
            "path.csv:2:3: \"nan\" is not a finite number; write one, for example 0.5");
  EXPECT_EQ(refusal("0,0,0,0,0,0,0,0\n"),
            "path.csv:2:9: the quaternion is zero; write 1,0,0,0 for no rotation");
  EXPECT_EQ(refusal(""), "path.csv: has no rows; write one pose at least below the header");
  EXPECT_NE(refusal("0,0,0,0,1,0,0,0\n", ", position: [1, 0, 0]").find("'position' beside 'path'"),
            std::string::npos);
}

TEST(Compounds, ADumbbellThatIsHitAtOneEndTurns) {
  auto world = make_world(head +
                          "  - {shape: dumbbell}\n"
                          "  - {shape: ball, position: [0.5, -0.5, 0], velocity: [0, 2, 0]}\n");
  const fc::RigidBody dumbbell = body(world, 0);
  const Events events = run_world(world, 0.01, 30);
  ASSERT_EQ(events.all.size(), 1u);
  const double a = 0.5, m = 0.5, mass = dumbbell.mass, inertia = dumbbell.inertia_body(2, 2);
  const double j = 1.5 * 2 / (1 / m + 1 / mass + a * a / inertia);
  EXPECT_NEAR(events.all[0].impulse.impulse, j, 1e-7);
  EXPECT_NEAR(events.all[0].t, 0.2 / 2, 1e-8);
  EXPECT_LT((body(world, 0).spin - Vec3(0, 0, a * j / inertia)).norm(), 1e-7);
  EXPECT_LT((body(world, 0).velocity - Vec3(0, j / mass, 0)).norm(), 1e-7);
}

// Random bodies in a closed tray. A prism and a pyramid inside the cylinder and the cone are judged by the
// independent overlap check, and an L by its own mesh.
independent::Mesh turned(double low, double high, double length) {
  constexpr int around = 24;
  independent::Mesh mesh;
  for (int k = 0; k < around; ++k) {
    const double angle = 2 * std::numbers::pi * k / around, c = std::cos(angle), s = std::sin(angle);
    mesh.vertices.push_back({low * c, low * s, -length / 2});
    mesh.vertices.push_back({high * c, high * s, length / 2});
  }
  mesh.vertices.push_back({0, 0, -length / 2});
  mesh.vertices.push_back({0, 0, length / 2});
  for (int k = 0; k < around; ++k) {
    const int i = 2 * k, j = 2 * ((k + 1) % around), bottom = 2 * around, top = bottom + 1;
    mesh.triangles.push_back({i, j, j + 1});
    mesh.triangles.push_back({i, j + 1, i + 1});
    mesh.triangles.push_back({bottom, j, i});
    mesh.triangles.push_back({top, i + 1, j + 1});
  }
  return mesh;
}

independent::Mesh angle_iron() {
  independent::Mesh mesh;
  const double corners[6][2] = {{0, 0}, {0.8, 0}, {0.8, 0.2}, {0.2, 0.2}, {0.2, 0.8}, {0, 0.8}};
  for (const double z : {0.0, 0.2})
    for (const auto& c : corners) mesh.vertices.push_back({c[0], c[1], z});
  for (int k = 1; k < 5; ++k) {
    mesh.triangles.push_back({0, k + 1, k});
    mesh.triangles.push_back({6, 6 + k, 7 + k});
  }
  for (int k = 0; k < 6; ++k) {
    const int next = (k + 1) % 6;
    mesh.triangles.push_back({k, next, 6 + next});
    mesh.triangles.push_back({k, 6 + next, 6 + k});
  }
  return mesh;
}

TEST(Thrown, CurvedAndCompoundBodiesNeverOverlap) {
  const std::string scene = R"(
step: {dt: 0.02, duration: 1}
restitution: 0.8
shapes:
  slab: {box: {size: [5, 5, 1]}}
  rod: {cylinder: {radius: 0.2, length: 0.7}, density: 1000}
  hat: {cone: {radius: 0.35, length: 0.5}, density: 1000}
  iron: {parts: [{box: {size: [0.8, 0.2, 0.2]}, position: [0.4, 0.1, 0.1]},
                 {box: {size: [0.2, 0.6, 0.2]}, position: [0.1, 0.5, 0.1]}], density: 1000}
bodies:
  - {shape: slab, static: true, position: [0, 0, -2.5]}
  - {shape: slab, static: true, position: [0, 0, 2.5]}
  - {shape: slab, static: true, position: [-2.5, 0, 0], orientation: [1, 0, 1, 0]}
  - {shape: slab, static: true, position: [2.5, 0, 0], orientation: [1, 0, 1, 0]}
  - {shape: slab, static: true, position: [0, -2.5, 0], orientation: [1, 1, 0, 0]}
  - {shape: slab, static: true, position: [0, 2.5, 0], orientation: [1, 1, 0, 0]}
)";
  int instants = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 engine(seed);
    const auto any = [&](double size) {
      return std::to_string(std::uniform_real_distribution<double>(-size, size)(engine));
    };
    std::string bodies;
    for (int i = 0; i < 8; ++i) {
      const auto at = [&](int bit) { return std::string(i & bit ? "0.9" : "-0.9"); };
      bodies += std::string("  - {shape: ") +
                (i % 3 == 0   ? "rod"
                 : i % 3 == 1 ? "hat"
                              : "iron") +
                ", position: [" + at(1) + ", " + at(2) + ", " + at(4) + "], rotation: {axis: [" + any(1) +
                ", " + any(1) + ", 1], degrees: " + any(180) + "}, velocity: [" + any(3) + ", " + any(3) +
                ", " + any(3) + "], spin: [" + any(4) + ", " + any(4) + ", " + any(4) + "]}\n";
    }
    auto world = make_world(scene + bodies);
    std::vector<independent::Solid> solids;
    for (const auto& b : world.bodies) {
      const std::string& name = world.shapes[b.shape].name;
      solids.push_back(name == "slab"  ? independent::make_solid(independent::box({5, 5, 1}), 1)
                       : name == "rod" ? independent::make_solid(turned(0.2, 0.2, 0.7), 1000)
                       : name == "hat" ? independent::make_solid(turned(0.35, 1e-9, 0.5), 1000)
                                       : independent::make_solid(angle_iron(), 1000));
      solids.back().is_static = b.state.is_static();
    }
    const Film seen = film(world, solids, 0.02, 40, 2, independent::How::tree);
    EXPECT_EQ(seen.watch.overlap, "");
    instants += static_cast<int>(seen.jumps.size());
    for (const auto& report : seen.reports) {
      EXPECT_EQ(report.max_penetration, 0);
      EXPECT_GT(report.min_gap, 0);
      EXPECT_LE(report.lcp_residual, 1e-10);
      EXPECT_LE(report.momentum_error, 1e-10);
    }
  }
  EXPECT_GT(instants, 60);
}

}  // namespace
