// Structures that stand by friction alone: ladders, tents, arches, drawers that jam, ropes over drums, stacks and
// houses of cards. Statics in closed form say when; contact points lie in the middle of the gap.
#include <gtest/gtest.h>

#include "rubbing.hpp"

namespace oracle_stand {  // the chapter's oracles are compiled as one
namespace {

using namespace fc_test;
using fc::Vec3;

std::string points_of(const std::vector<Vec3>& points) {
  std::string text;
  for (const Vec3& p : points) text += (text.empty() ? "" : ", ") + list(p);
  return "hull: {points: [" + text + "]}";
}
// A plank along x of length 2 with an edge along y at either end, thick in the middle.
std::string spindle(double half, double thick = 0.02, double wide = 0.3) {
  return points_of({{half, wide, 0},
                    {half, -wide, 0},
                    {-half, wide, 0},
                    {-half, -wide, 0},
                    {0, wide, thick},
                    {0, -wide, thick},
                    {0, wide, -thick},
                    {0, -wide, -thick}});
}

// The largest distance that a body has moved from its start, and the largest turn of one.
struct Drift {
  std::vector<fc::RigidBody> start;
  explicit Drift(const Rubbing& sim) {
    for (const auto& b : sim.world.bodies) start.push_back(b.state);
  }
  double of(const Rubbing& sim) const {
    double worst = 0;
    for (std::size_t i = 0; i < start.size(); ++i) {
      const fc::RigidBody& now = sim.world.bodies[i].state;
      worst = std::max({worst, (now.position - start[i].position).norm(),
                        now.orientation.angularDistance(start[i].orientation)});
    }
    return worst;
  }
};

// Steps until something has moved by this much; false if nothing has after this many seconds.
bool moves(Rubbing& sim, double seconds, double far) {
  const Drift drift(sim);
  while (sim.time() < seconds && drift.of(sim) < far) sim.step();
  return drift.of(sim) >= far;
}

// R13. A ladder, its foot on a rough floor, its top at a wall with µ_w. Its ends are at half an envelope from both.
constexpr double kH = 1e-4;
std::string ladder(double mu, double mu_wall, double angle) {
  return rough(mu, kH, {0, 0, -kG}, "pairs: [{a: ladder, b: wall, friction: " + number(mu_wall) + "}]\n") +
         "  wall: {box: {size: [1, 4, 4]}}\n  ladder: {" + spindle(1) + ", mass: 3}\n" + on_floor +
         "  - {shape: wall, static: true, position: " + list({0.5 + std::cos(angle) + 0.5 * kH, 0, 2}) +
         "}\n  - {shape: ladder, position: " + list({0, 0, std::sin(angle) + 0.5 * kH}) +
         ", orientation: " + turned(-angle, Vec3::UnitY()) + "}\n";
}
TEST(Stand, R13Ladder) {
  const double angle = 60 * kDegree;
  for (const double wall : {0.0, 0.3}) {
    // µ N = W and µ_w W = F_w, with the lever arms of the contact points: found by bisection.
    const double x = std::cos(angle), z = std::sin(angle), q = 0.25 * kH;
    const auto turns = [&](double mu) {  // > 0: it falls
      const double weight = 1, n = weight / (1 + mu * wall), w = mu * n, f = wall * w;
      return n * x - w * (z + q) - w * z - f * (x + q);
    };
    double low = 0, high = 2;
    while (high - low > 1e-14) (turns(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
    EXPECT_NEAR(std::tan(angle), (1 - low * wall) / (2 * low), 1e-3) << "the book's formula";
    for (const double dt : kSteps) {
      Rubbing stands(ladder(low * 1.0001, wall, angle), dt);
      const Drift drift(stands);
      stands.run(3);
      tell("R13 wall {} dt {:.5f}: drift {:.2g}", wall, dt, drift.of(stands));
      EXPECT_LE(drift.of(stands), 1e-9) << wall << ", " << dt;
      Rubbing falls(ladder(low * 0.999, wall, angle), dt);
      EXPECT_TRUE(moves(falls, 3, 0.1)) << wall << ", " << dt;
      expect_laws(stands, "ladder stands");
      expect_laws(falls, "ladder falls");
    }
  }
}

// R14. Two cards lean against each other.
std::string tent(double mu, double angle) {
  const double x = std::cos(angle) + 0.25 * kH, z = std::sin(angle) + 0.5 * kH;
  return rough(mu, kH) + "  card: {" + spindle(1) + ", mass: 0.1}\n" + on_floor +
         "  - {shape: card, position: " + list({-x, 0, z}) +
         ", orientation: " + turned(-angle, Vec3::UnitY()) +
         "}\n  - {shape: card, position: " + list({x, 0, z}) +
         ", orientation: " + turned(angle, Vec3::UnitY()) + "}\n";
}
TEST(Stand, R14Tent) {
  const double angle = 65 * kDegree, edge = std::cos(angle) / (2 * std::sin(angle) + 0.25 * kH);
  EXPECT_NEAR(edge, 0.2332, 1e-4);
  for (const double dt : kSteps) {
    Rubbing stands(tent(edge * 1.001, angle), dt);
    const Drift drift(stands);
    stands.run(3);
    tell("R14 dt {:.5f}: drift {:.2g}", dt, drift.of(stands));
    EXPECT_LE(drift.of(stands), 1e-9) << dt;
    EXPECT_NEAR(stands.forces[1].z(), 0.1 * kG, 1e-9);
    Rubbing falls(tent(edge * 0.99, angle), dt);
    EXPECT_TRUE(moves(falls, 3, 0.1)) << dt;
    expect_laws(stands, "tent stands");
    expect_laws(falls, "tent falls");
  }
}

// R15. A semicircular arch of n straight voussoirs, ends on the floor. Its stones are half an envelope apart.
std::string arch(int n, double thickness, double mu, double h) {
  const double inner = 1 - 0.5 * thickness, outer = 1 + 0.5 * thickness, step = std::numbers::pi / n;
  std::string shapes, bodies;
  // A stone's joints lie on rays through the centre, moved apart by h/4 on either side.
  for (int i = 0; i < n; ++i) {
    std::vector<Vec3> points;
    for (const double side : {-1.0, 1.0}) {
      const double phi = step * (i + 0.5 + 0.5 * side);
      const Vec3 ray(-std::cos(phi), 0, std::sin(phi)), across(std::sin(phi), 0, std::cos(phi));
      for (const double r : {inner, outer})
        for (const double y : {-0.1, 0.1})
          points.push_back(r * ray - side * 0.25 * h * across + Vec3(0, y, 0.25 * h));
    }
    shapes += fmt::format("  stone{}: {{{}, density: 1000}}\n", i, points_of(points));
    bodies += fmt::format("  - {{shape: stone{}}}\n", i);
  }
  return rough(mu, h) + shapes + on_floor + bodies;
}
TEST(Stand, R15ArchLeastThickness) {
  struct Case {
    int stones;
    double least;
  };
  for (const Case c : {Case{5, 0.09498}, Case{7, 0.0957}, Case{9, 0.10153}})
    for (const double dt : {1 / 60.0, 1 / 240.0}) {
      if (c.stones == 9 && dt < 1 / 100.0) continue;  // slow
      const double h = 2e-5;
      Rubbing stands(arch(c.stones, 1.03 * c.least, 2, h), dt);
      const Drift drift(stands);
      stands.run(1);
      Rubbing falls(arch(c.stones, 0.97 * c.least, 2, h), dt);
      tell("R15 n {} dt {:.5f}: drift {:.3g} stands", c.stones, dt, drift.of(stands));
      EXPECT_LE(drift.of(stands), 1e-6) << c.stones << ", " << dt;
      if (c.stones < 9 && dt > 0.01) {
        EXPECT_TRUE(moves(falls, 2, 0.02)) << c.stones << ", " << dt;
      }
      expect_laws(stands, fmt::format("arch of {} stands", c.stones));
      expect_laws(falls, fmt::format("arch of {} falls", c.stones));
    }
}
TEST(Stand, R15ArchLeastFriction) {
  const double h = 2e-5, dt = 1 / 60.0;
  Rubbing stands(arch(25, 0.15, 0.36, h), dt);
  const Drift drift(stands);
  stands.run(0.5);
  Rubbing falls(arch(25, 0.15, 0.33, h), dt);
  tell("R15 µ: drift {:.3g} stands", drift.of(stands));
  EXPECT_LE(drift.of(stands), 1e-6);
  EXPECT_TRUE(moves(falls, 2, 0.01));
  expect_laws(stands, "arch of 25 stands");
  expect_laws(falls, "arch of 25 falls");
}

// R16. A drawer of length L between two walls is pushed at x off its middle. The walls' forces N have the arm L, so N = Q x / L, and
// friction takes 2 µ N: of the push Q there is left 1 - µ 2 x / L, and it jams if that is not positive.
// It is tilted, so that two corners touch, and not four: forces between four are not determined.
std::string drawer(double mu, double length, double offset, double speed) {
  const double h = 1e-4, r = 0.05, tilt = 1e-3;
  const double wall = 0.25 * std::cos(tilt) + 0.5 * length * std::sin(tilt) + 0.5 * h + 0.5;
  const double finger =
      -0.5 * length / std::cos(tilt) + offset * std::tan(tilt) - (r + 0.5 * h) / std::cos(tilt);
  return rough(mu, h, Vec3::Zero(), "pairs: [{a: drawer, b: finger, friction: 0}]\n") +
         "  wall: {box: {size: [20, 1, 1]}}\n  finger: {sphere: {radius: 0.05}}\n  drawer: {box: {size: " +
         list({length, 0.5, 0.2}) +
         "}, mass: 2}\nbodies:\n  - {shape: finger, kinematic: true, position: " + list({finger, offset, 0}) +
         ", velocity: " + list({speed, 0, 0}) +
         "}\n  - {shape: wall, static: true, position: " + list({0, -wall, 0}) +
         "}\n  - {shape: wall, static: true, position: " + list({0, wall, 0}) +
         "}\n  - {shape: drawer, fixed: [z, rx, ry], orientation: " + turned(-tilt) + "}\n";
}
TEST(Stand, R16DrawerJams) {
  const double length = 0.4, offset = 0.2, edge = length / (2 * offset), speed = 0.5;
  for (const double dt : kSteps)
    for (const double of_edge : {0.0, 0.5, 0.9}) {
      Rubbing sim(drawer(of_edge * edge, length, offset, speed), dt);
      double push = 0;
      sim.on_impact = [&](const fc::world::ImpactRecord& r) {
        if (r.contact.body_a == 0) push += r.impulse.impulse * r.contact.normal.x();
      };
      sim.step();
      tell("R16 {} dt {:.5f}: v - exact {:.3g}, push {:.6g} of {:.6g}, {}", of_edge, dt,
           sim.body(3).velocity.x() - speed, push, 2 * speed / (1 - of_edge), sim.last.largest_island);
      EXPECT_NEAR(push * (1 - of_edge), 2 * speed, 0.02) << of_edge << ", " << dt;
      EXPECT_NEAR(sim.body(3).velocity.x(), speed, 1e-3) << of_edge << ", " << dt;
      expect_laws(sim, "drawer");
    }
}

// R17. A rope over a drum, in compression: a row of balls that do not turn is pressed through a half circle, along a wall of as many
// flat faces as there are balls. A corner of turn δ multiplies the force by (1 + µ tan δ/2)/(1 - µ tan δ/2) at most; at both ends
// a weight presses.
std::string rope(double mu, int corners, double ratio, double ball) {
  const double h = 1e-4, r = 0.1, turn = std::numbers::pi / corners, d = 2 * r + 0.5 * h;
  std::string bodies,
      shapes =
          "  ball: {sphere: {radius: 0.1}, mass: " + number(ball) +
          "}\n  face: {box: {size: [0.09, 1, 0.2]}}\n"
          "  light: {box: {size: [0.2, 0.2, 0.2]}, mass: 1}\n  heavy: {box: {size: [0.2, 0.2, 0.2]}, mass: " +
          number(ratio) + "}\n";
  Vec3 place = Vec3::Zero();
  std::string faces, balls;
  for (int i = 0; i < corners; ++i) {
    const double into = -0.5 * std::numbers::pi + turn * i, out = into + turn, middle = 0.5 * (into + out);
    const Vec3 away(std::sin(middle), 0, -std::cos(middle));  // from the half circle's centre
    const Vec3 face = place + (r + 0.5 * h + 0.1) * away;
    faces += "  - {shape: face, static: true, position: " + list(face) +
             ", orientation: " + turned(-middle, Vec3::UnitY()) + "}\n";
    balls += "  - {shape: ball, position: " + list(place) + ", fixed: [rx, ry, rz]}\n";
    if (i == 0)
      bodies += "  - {shape: light, position: " + list(place + Vec3(0, 0, r + 0.5 * h + 0.1)) +
                ", fixed: [x, y, rx, ry, rz]}\n";
    if (i == corners - 1)
      bodies += "  - {shape: heavy, position: " + list(place + Vec3(0, 0, r + 0.5 * h + 0.1)) +
                ", fixed: [x, y, rx, ry, rz]}\n";
    place += d * Vec3(std::cos(out), 0, std::sin(out));
  }
  return rough(
             mu, h, {0, 0, -kG},
             "pairs: [{a: ball, b: ball, friction: 0}, {a: ball, b: light, friction: 0}, {a: ball, b: heavy, friction: 0}]\n") +
         shapes + "bodies:\n" + bodies + balls + faces;
}
// The balls have a weight, too: `slack` is what is left of the ratio for them.
void expect_rope(double ball, double slack) {
  const double mu = 0.3;
  for (const int corners : {4, 12}) {
    const double t = mu * std::tan(0.5 * std::numbers::pi / corners),
                 ratio = std::pow((1 + t) / (1 - t), corners);
    EXPECT_TRUE(corners != 12 || std::abs(ratio - 2.5816) < 5e-5);
    for (const double dt : {1 / 60.0, 1 / 120.0}) {
      Rubbing holds(rope(mu, corners, (1 - slack) * ratio, ball), dt),
          slips(rope(mu, corners, (1 + slack) * ratio, ball), dt);
      const Drift drift(holds), slip(slips);
      holds.run(0.2);
      slips.run(0.2);
      tell("R17 balls of {} kg, {} corners, dt {:.5f}: {:.3g} holds, {:.3g} slips", ball, corners, dt,
           drift.of(holds), slip.of(slips));
      EXPECT_LE(drift.of(holds), 1e-8) << corners << ", " << dt;
      EXPECT_GE(slip.of(slips), 2e-4) << corners << ", " << dt;
      expect_laws(holds, "rope holds");
      expect_laws(slips, "rope slips");
    }
  }
}
TEST(Stand, R17RopeOverADrum) {
  expect_rope(1e-3, 0.02);
}
TEST(Stand, R17RopeOfLightBalls) {
  expect_rope(1e-6, 0.005);
}

// Stands: from their places with all gaps at h/2 nothing may move in ten seconds.
void expect_stands(const std::string& text, double dt, double seconds, double bound,
                   const std::string& name) {
  Rubbing sim(text, dt);
  const Drift drift(sim);
  const Judge judge(sim);
  const auto begin = std::chrono::steady_clock::now();
  sim.run(seconds);
  const double ms =
      1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / sim.frame;
  tell("{}: drift {:.3g} in {} s, {:.3g} ms a frame, largest island {}, sweeps {}", name, drift.of(sim),
       seconds, ms, sim.last.largest_island, sim.last.sweeps);
  EXPECT_LE(drift.of(sim), bound) << name;
  EXPECT_FALSE(judge.overlap()) << name;
  expect_laws(sim, name);
}
std::string pile(const std::vector<double>& masses, double mu, double h, double turn = 0) {
  std::string shapes, bodies;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const double k = static_cast<double>(i);
    shapes += fmt::format("  b{}: {{box: {{size: [1, 1, 0.5]}}, mass: {}}}\n", i, masses[i]);
    bodies += fmt::format("  - {{shape: b{}, position: {}, orientation: {}}}\n", i,
                          list({0, 0, 0.25 + 0.5 * k + 0.5 * (k + 1) * h}), turned(turn * k));
  }
  return rough(mu, h) + shapes + on_floor + bodies;
}
TEST(Stand, TenBoxes) {
  expect_stands(pile(std::vector<double>(10, 1.0), 0.5, 5e-4), 1 / 60.0, 10, 1e-9, "10 boxes");
}
TEST(Stand, TenTurnedBoxes) {
  expect_stands(pile(std::vector<double>(10, 1.0), 0.5, 5e-4, 0.1), 1 / 60.0, 2, 1e-9, "10 turned boxes");
}
TEST(Stand, FiftyBoxes) {
  expect_stands(pile(std::vector<double>(50, 1.0), 0.5, 5e-4), 1 / 60.0, 0.5, 1e-9, "50 boxes");
}
// 276 boxes, with gaps of a twentieth of the envelope: they are put right, and what stands then is only repeated.
TEST(Stand, PyramidOf23Rows) {
  constexpr int kRows = 23;
  std::string bodies;
  for (int row = 0; row < kRows; ++row)
    for (int i = 0; i < kRows - row; ++i)
      bodies += "  - {shape: box, position: " +
                list({1.01 * (i - 0.5 * (kRows - row - 1)), 0, row + 0.5 + 1e-4 * (row + 1)}) + "}\n";
  Rubbing sim(rough(0.6, 2e-3) + "  box: {box: {size: [1, 1, 1]}, mass: 1}\n" + on_floor + bodies, 1 / 60.0);
  const Drift start(sim);
  int corrections = 0, points = 0, sweeps = 0;
  const auto look = [&] {
    corrections += sim.last.correction > 0;
    points = std::max(points, sim.last.largest_island);
    sweeps += sim.last.sweeps;
  };
  sim.run(1, look);
  const Drift settled(sim);
  sim.run(9, look);
  double aside = 0;
  for (std::size_t i = 0; i < start.start.size(); ++i)
    aside = std::max(aside, (sim.world.bodies[i].state.position - start.start[i].position).head<2>().norm());
  tell("23 rows: aside {:.3g}, corrections in {} frames, {} points", aside, corrections, points);
  EXPECT_LE(aside, 1e-7) << "m";
  EXPECT_LE(settled.of(sim), 1e-9) << "m";
  EXPECT_LE(corrections, 55) << "frames";
  EXPECT_EQ(sim.last.step.solves, 0) << "it is repeated";
  EXPECT_EQ(sweeps, 0) << "it is no pile,";
  EXPECT_GE(points, 2100) << "large as it is";
  EXPECT_FALSE(Judge(sim).overlap());
  expect_laws(sim, "23 rows", 2e-10);
}
TEST(Stand, HeavyOnLight) {
  expect_stands(pile({1, 1, 1000}, 0.5, 5e-4), 1 / 60.0, 10, 1e-9, "1000 on 1 on 1 kg");
}
// Two tents, a card across them, and a third tent on it.
TEST(Stand, HouseOfCards) {
  const double angle = 65 * kDegree, h = 1e-4, x = std::cos(angle) + 0.25 * h, z = std::sin(angle) + 0.5 * h;
  std::string bodies;
  const auto add = [&](double at, double up) {
    bodies += "  - {shape: card, position: " + list({at - x, 0, up + z}) +
              ", orientation: " + turned(-angle, Vec3::UnitY()) + "}\n";
    bodies += "  - {shape: card, position: " + list({at + x, 0, up + z}) +
              ", orientation: " + turned(angle, Vec3::UnitY()) + "}\n";
  };
  const double top = 2 * std::sin(angle) + h;
  add(-1, 0);
  add(1, 0);
  bodies += "  - {shape: deck, position: " + list({0, 0, top + 0.01}) + "}\n";
  add(0, top + 0.02);
  const std::string text = rough(0.6, h) + "  card: {" + spindle(1) +
                           ", mass: 0.1}\n  deck: {box: {size: [3, 0.6, 0.02]}, mass: 0.1}\n" + on_floor +
                           bodies;
  for (const double dt : kSteps)
    expect_stands(text, dt, 3, 1e-9, fmt::format("house of cards, frames of {:.5f}", dt));
}

}  // namespace
}  // namespace oracle_stand
