// A block that sticks, slides, stops, rides on others and tips: closed forms, in all directions.
#include <gtest/gtest.h>

#include "rubbing.hpp"

namespace oracle_slide {  // the chapter's oracles are compiled as one
namespace {

using namespace fc_test;
using fc::Vec3;

constexpr double kH = 1e-3;  // m, the envelope, if nothing else is said
constexpr double kYaws[] = {0, 20 * kDegree, 45 * kDegree};

// A block at rest on the floor, turned by `yaw`. Its sides differ: no two of its inertias are equal.
std::string block(double mu, const Vec3& gravity, double yaw, const Vec3& velocity = Vec3::Zero()) {
  return rough(mu, kH, gravity) + "  block: {box: {size: [1, 0.7, 0.4]}, mass: 2}\n" + on_floor +
         "  - {shape: block, position: " + list({0, 0, 0.2 + 0.5 * kH}) + ", orientation: " + turned(yaw) +
         ", velocity: " + list(velocity) + "}\n";
}

template <class Look>
void in_all_directions(const Look& look) {
  for (int k = 0; k < 16; ++k)
    for (const double yaw : kYaws) look(k * std::numbers::pi / 8, yaw);
}
std::string with(double direction, double yaw, double dt) {
  return fmt::format("direction {:.1f} deg, yaw {:.0f} deg, frames of {:.5f} s", direction / kDegree,
                     yaw / kDegree, dt);
}
double turn_of(const fc::RigidBody& body, double yaw) {  // rad
  return body.orientation.angularDistance(fc::Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ())));
}
double seconds_from_environment(double otherwise) {
  const char* asked = std::getenv("FC_SECONDS");
  return asked ? std::atof(asked) : otherwise;
}

// R1. FC_SECONDS=600 is what the book says.
TEST(Slide, R1StickingMeansSticking) {
  const double seconds = seconds_from_environment(6);
  double most = 0;
  in_all_directions([&](double direction, double yaw) {
    Rubbing sim(block(0.5, slope(26 * kDegree, direction), yaw), 1 / 60.0);
    sim.run(seconds);
    const double drift = (sim.body(1).position - Vec3(0, 0, 0.2 + 0.5 * kH)).norm(),
                 turn = turn_of(sim.body(1), yaw);
    EXPECT_LE(drift, 1e-9) << "m: " << with(direction, yaw, sim.dt);
    EXPECT_LE(turn, 1e-9) << "rad: " << with(direction, yaw, sim.dt);
    most = std::max({most, drift, turn});
    expect_laws(sim, with(direction, yaw, sim.dt));
  });
  tell("R1 26 deg: drift {:.2g} in {} s", most, seconds);
}

TEST(Slide, R1ForcesOfABlockThatSticks) {
  for (const double dt : kSteps) {
    Rubbing sim(block(0.5, slope(26 * kDegree, 1), 0.3), dt);
    for (int frame = 0; frame < 10; ++frame) {
      sim.step();
      EXPECT_LE((sim.forces[1] + 2 * slope(26 * kDegree, 1)).norm(), 1e-10 * 2 * kG) << "N, frame " << frame;
    }
  }
}

// The law is at its edge by a millionth.
TEST(Slide, R1AtTheEdgeOfTheCone) {
  const double angle = 30 * kDegree, edge = std::tan(angle);
  double worst = 0;
  for (const double dt : kSteps)
    for (const double yaw : kYaws) {
      Rubbing holds(block(edge * (1 + 1e-6), slope(angle, 0.5), yaw), dt);
      holds.run(2);
      EXPECT_LE((holds.body(1).position - Vec3(0, 0, 0.2 + 0.5 * kH)).norm(), 1e-9) << with(0.5, yaw, dt);
      Rubbing slides(block(edge * (1 - 1e-6), slope(angle, 0.5), yaw), dt);
      slides.run(2);
      const double a = 1e-6 * kG * std::sin(angle), v = slides.body(1).velocity.norm();
      worst = std::max(worst, std::abs(v / (2 * a) - 1));
      EXPECT_NEAR(v, 2 * a, 1e-10) << "m/s: " << with(0.5, yaw, dt);
      expect_laws(holds, with(0.5, yaw, dt));
      expect_laws(slides, with(0.5, yaw, dt));
    }
  tell("R1 edge: relative error of a {:.2g}", worst);
}

void expect_slide(double mu, double angle, double a, double bound, const std::string& name) {
  double worst = 0, sideways = 0, turn = 0;
  for (const double dt : kSteps)
    in_all_directions([&](double direction, double yaw) {
      Rubbing sim(block(mu, slope(angle, direction), yaw), dt);
      sim.run(1);
      const Vec3 down(std::cos(direction), std::sin(direction), 0), v = sim.body(1).velocity;
      worst = std::max(worst, std::abs(v.dot(down) / a - 1));
      worst = std::max(worst, std::abs(sim.body(1).position.dot(down) / (0.5 * a) - 1));
      sideways = std::max(sideways, (v - v.dot(down) * down).norm());
      turn = std::max({turn, sim.body(1).spin.norm(), turn_of(sim.body(1), yaw)});
      EXPECT_NEAR(sim.body(1).position.z(), 0.2 + 0.5 * kH, 1e-6 * kH)
          << "the gap stays: " << with(direction, yaw, dt);
      expect_laws(sim, with(direction, yaw, dt));
    });
  tell("{}: relative {:.2g}, sideways {:.2g} m/s, turn {:.2g}", name, worst, sideways, turn);
  EXPECT_LE(worst, bound) << "relative error of the acceleration";
  EXPECT_LE(sideways, 1e-11) << "m/s";
  EXPECT_LE(turn, 1e-11) << "rad/s or rad";
}
TEST(Slide, R1AcceleratesDownTheSlope) {
  const double angle = 27.2 * kDegree;
  expect_slide(0.5, angle, kG * (std::sin(angle) - 0.5 * std::cos(angle)), 1e-9, "R1 27.2 deg");
}
// Rigid IPC's pair: µ = 0.5 stays on 26.565 degrees, µ = 0.49 slides with 0.0877 m/s^2 (at 9.8 m/s^2).
TEST(Slide, R1RigidIpcsPair) {
  const double angle = 26.565 * kDegree;  // tan is 0.5 less 1e-6
  Rubbing stays(block(0.5, slope(angle), 0), 0.01);
  stays.run(5);
  EXPECT_LE(stays.body(1).position.head<2>().norm(), 1e-9) << "m";
  const double a = std::sin(angle) - 0.49 * std::cos(angle);
  EXPECT_NEAR(9.8 * a, 0.0877, 1e-4);
  expect_slide(0.49, angle, kG * a, 1e-9, "R1 rigid-ipc");
}

// R2. 4.90 and 4.91 N on 1 kg and µ = 0.5: the threshold is 4.905 N.
TEST(Slide, R2ThresholdIsTheSameInAllDirections) {
  in_all_directions([&](double direction, double yaw) {
    const Vec3 way(std::cos(direction), std::sin(direction), 0);
    for (const double pull : {4.90, 4.91}) {
      Rubbing sim(block(0.5, Vec3(0, 0, -kG) + pull * way, yaw), 1 / 60.0);
      sim.run(1);
      const double a = std::max(0.0, pull - 0.5 * kG);
      EXPECT_LE((sim.body(1).velocity - a * way).norm(), 1e-10)
          << pull << " N a kg: " << with(direction, yaw, sim.dt);
    }
  });
}

// R3. Stop distance, time, direction, heat; no turn, and no lift (a convex cone lifts by h µ v).
TEST(Slide, R3StopDistance) {
  const double mu = 0.3, speed = 3, stop = speed * speed / (2 * mu * kG), time = speed / (mu * kG);
  double worst = 0, heat = 0, identity = 0;
  for (const double dt : kSteps)
    in_all_directions([&](double direction, double yaw) {
      const Vec3 way(std::cos(direction), std::sin(direction), 0);
      Rubbing sim(block(mu, {0, 0, -kG}, yaw, speed * way), dt);
      double stopped = 0;
      while (sim.time() < 1.5) {
        const double before = sim.mechanical();
        sim.step();
        EXPECT_NEAR(sim.body(1).position.z(), 0.2 + 0.5 * kH, 1e-6 * kH) << with(direction, yaw, dt);
        identity = std::max(identity, std::abs(sim.mechanical() - before - sim.last.tangential_work));
        if (sim.body(1).velocity.norm() > 1e-9) stopped = sim.time();
      }
      worst = std::max(worst, (sim.body(1).position.head<2>() - stop * way.head<2>()).norm() / stop);
      heat = std::max(heat, std::abs(-sim.laws.friction / (0.5 * 2 * speed * speed) - 1));
      EXPECT_LE(std::abs(stopped + 0.5 * dt - time), 0.51 * dt) << "s: " << with(direction, yaw, dt);
      EXPECT_LE(turn_of(sim.body(1), yaw), 1e-12) << with(direction, yaw, dt);
      EXPECT_LE(sim.body(1).velocity.norm() + sim.body(1).spin.norm(), 1e-12) << with(direction, yaw, dt);
      expect_laws(sim, with(direction, yaw, dt));
    });
  tell(
      "R3: relative error of the stop {:.2g}, heat {:.2g}; R24 a frame's energy and friction differ by {:.2g} J",
      worst, heat, identity);
  EXPECT_LE(worst, 1e-9) << "of the distance";
  EXPECT_LE(heat, 1e-9) << "of the energy";
  EXPECT_LE(identity, 1e-12) << "J: R24, a frame loses what friction takes";
}

// R8. A block on a turntable slips if Ω^2 r > µ g.
std::string on_turntable(double mu, double rate, double radius) {
  return rough(mu, kH) +
         "  block: {box: {size: [0.1, 0.07, 0.04]}, mass: 2}\nbodies:\n"
         "  - {shape: floor, kinematic: true, position: [0, 0, -0.5], spin: [0, 0, " +
         number(rate) +
         "]}\n"
         "  - {shape: block, position: " +
         list({radius, 0, 0.02 + 0.5 * kH}) + ", velocity: [0, " + number(rate * radius) +
         ", 0], spin: [0, 0, " + number(rate) + "]}\n";
}
// A plan looks at slips in its middle, so that what sticks keeps its distance.
TEST(Slide, R8BlockOnATurntable) {
  const double mu = 0.5, edge = std::sqrt(mu * kG);  // rad/s, at 1 m
  for (const double dt : kSteps) {
    const double rate = 0.995 * edge;
    Rubbing holds(on_turntable(mu, rate, 1), dt), slips(on_turntable(mu, edge * 1.001, 1), dt);
    holds.run(5);
    const fc::RigidBody& s = holds.body(1);
    const double drift = s.position.head<2>().norm() - 1;
    const Vec3 slip = s.velocity - rate * Vec3(0, 0, 1).cross(s.position);
    slips.run(3);
    const double slipped = slips.body(1).position.head<2>().norm() - 1;
    tell("R8 dt {:.5f}: drift {:.3g} m, slipped {:.3g} m", dt, drift, slipped);
    EXPECT_LE(std::abs(drift), 1e-6 * kH * holds.frame) << "m: a plan closes up to 1e-6 envelopes; " << dt;
    EXPECT_LE(slip.head<2>().norm(), 1e-9) << "m/s: it sticks";
    EXPECT_GE(slipped, 1e-3) << "m: it slips, frames of " << dt;
    expect_laws(holds, "turntable");
    expect_laws(slips, "turntable");
  }
}

// R9. A block put on a belt.
TEST(Slide, R9Conveyor) {
  const double mu = 0.4, speed = 2, time = speed / (mu * kG);
  double worst = 0;
  for (const double dt : kSteps)
    in_all_directions([&](double direction, double yaw) {
      if (yaw > 0) return;
      const Vec3 way(std::cos(direction), std::sin(direction), 0);
      Rubbing sim(
          rough(mu, kH) +
              "  block: {box: {size: [1, 0.7, 0.4]}, mass: 2}\nbodies:\n  - {shape: floor, kinematic: true, position: [0, 0, -0.5], velocity: " +
              list(speed * way) + "}\n  - {shape: block, position: " + list({0, 0, 0.2 + 0.5 * kH}) +
              ", orientation: " + turned(yaw) + "}\n",
          dt);
      double work = 0;
      sim.run(1, [&] { work += sim.last.step.kinematic_work; });
      const Vec3 end = (sim.time() - 0.5 * time) * speed * way;
      worst = std::max(worst, (sim.body(1).position.head<2>() - end.head<2>()).norm());
      worst = std::max(worst, (sim.body(1).velocity - speed * way).norm());
      worst = std::max(worst, std::abs(work - 2 * speed * speed) / (2 * speed * speed));
      worst = std::max(worst, std::abs(sim.kinetic() - 0.5 * 2 * speed * speed));
      expect_laws(sim, with(direction, yaw, dt));
    });
  tell("R9: m, m/s, J {:.2g}", worst);
  EXPECT_LE(worst, 1e-9);
}

// R10. Lever arms end in the middle of the gap, a quarter of the envelope below the face: the edge of tipping is at
// tan θ = b / (H + h/2).
std::string tower(double mu, const Vec3& gravity, double base, double height,
                  const Vec3& velocity = Vec3::Zero()) {
  return rough(mu, kH, gravity) + "  tower: {box: {size: " + list({base, 0.6, height}) + "}, mass: 2}\n" +
         on_floor + "  - {shape: tower, position: " + list({0, 0, 0.5 * (height + kH)}) +
         ", velocity: " + list(velocity) + "}\n";
}
TEST(Slide, R10TipOrSlide) {
  const double edge = 0.4 / (1 + 0.5 * kH);
  for (const double dt : kSteps) {
    Rubbing stands(tower(1, slope(std::atan(edge * (1 - 1e-5))), 0.4, 1), dt);
    stands.run(3);
    EXPECT_LE(turn_of(stands.body(1), 0), 1e-9) << dt;
    EXPECT_LE(stands.body(1).position.head<2>().norm(), 1e-9) << dt;
    Rubbing tips(tower(1, slope(std::atan(edge * (1 + 1e-3))), 0.4, 1), dt);
    tips.run(3);
    EXPECT_GE(turn_of(tips.body(1), 0), 0.2) << dt;
    Rubbing slides(tower(0.39, slope(std::atan(0.5)), 0.4, 1), dt);
    slides.run(1);
    EXPECT_LE(turn_of(slides.body(1), 0), 1e-9) << dt;
    const double angle = std::atan(0.5);
    EXPECT_NEAR(slides.body(1).velocity.x() / (kG * (std::sin(angle) - 0.39 * std::cos(angle))), 1, 1e-9)
        << dt;
    expect_laws(stands, "stands");
    expect_laws(tips, "tips");
    expect_laws(slides, "slides");
  }
}
// A box that is braked keeps its feet if µ < b/H, and its front corners carry more.
TEST(Slide, R10BrakedBox) {
  for (const double dt : kSteps) {
    const double base = 0.55, height = 1, mu = 0.5;
    Rubbing keeps(tower(mu, {0, 0, -kG}, base, height, {6, 0, 0}), dt);
    double worst = 0, front = 0, rear = 0;
    keeps.on_impact = [&](const fc::world::ImpactRecord& r) {
      (r.contact.point.x() > keeps.body(1).position.x() ? front : rear) += r.impulse.impulse / dt;
    };
    keeps.run(1, [&] {
      const double share = mu * (height + 0.5 * kH) / base, half = 0.5 * 2 * kG;
      if (keeps.frame > 2)
        worst = std::max({worst, std::abs(front / half - 1 - share), std::abs(rear / half - 1 + share)});
      front = rear = 0;
    });
    EXPECT_LE(worst, 1e-9) << "of half the weight, " << dt;
    keeps.run(1);
    EXPECT_LE(turn_of(keeps.body(1), 0), 1e-9) << dt;
    EXPECT_NEAR(keeps.body(1).position.x(), 36 / (2 * mu * kG), 1e-9) << dt;
    Rubbing falls(tower(mu, {0, 0, -kG}, 0.45, height, {6, 0, 0}), dt);
    falls.run(1);
    EXPECT_GE(turn_of(falls.body(1), 0), 0.1) << dt;
    expect_laws(keeps, "keeps its feet");
    expect_laws(falls, "tips");
    tell("R10 dt {:.5f}: loads {:.2g} of half the weight", dt, worst);
  }
}

// R11, in the axes of free fall along the slope: the floor drags the lower block by F = µ2 (m1 + m2) g. The two go together if
// F <= µ1 (m1 + m2) g.
std::string two(double mass_above, double mass_below, double mu_above, double mu_below, const Vec3& gravity) {
  return rough(mu_below, kH, gravity, "pairs: [{a: above, b: below, friction: " + number(mu_above) + "}]\n") +
         "  above: {box: {size: [1, 1, 0.4]}, mass: " + number(mass_above) +
         "}\n  below: {box: {size: [2, 2, 0.4]}, mass: " + number(mass_below) + "}\n" + on_floor +
         "  - {shape: above, position: " + list({0, 0, 0.6 + kH}) +
         "}\n  - {shape: below, position: " + list({0, 0, 0.2 + 0.5 * kH}) + "}\n";
}
TEST(Slide, R11TwoBlocks) {
  const double angle = 35 * kDegree, n = kG * std::cos(angle), along = kG * std::sin(angle);
  double worst = 0;
  for (const double dt : kSteps)
    for (const double ratio : {1e-6, 1e-3, 1.0, 1e3, 1e6})
      for (const double mu_above : {0.45, 0.35}) {
        const double below = 1, above = ratio, mu = 0.4;
        Rubbing sim(two(above, below, mu_above, mu, slope(angle)), dt);
        sim.run(0.3);
        const bool together = mu_above >= mu;
        const double a1 = along - (together ? mu : mu_above) * n,
                     a2 = along - (together ? mu * n : (mu * (above + below) - mu_above * above) * n / below);
        // If the load is so heavy that the floor holds the lower one, it stands.
        const double stands = std::max(0.0, a2);
        const double error = std::max(std::abs(sim.body(1).velocity.x() / (0.3 * a1) - 1),
                                      std::abs(sim.body(2).velocity.x() - 0.3 * stands) / (0.3 * a1));
        worst = std::max(worst, error);
        EXPECT_LE(error, 1e-9 + 1e-12 * std::max(ratio, 1 / ratio))
            << ratio << ", " << mu_above << ", " << dt;
        expect_laws(sim, "two blocks");
      }
  tell("R11: relative error {:.2g}", worst);
}

// R12. A stack on an accelerated floor, in the floor's axes.
std::string stack(const std::vector<double>& mu, const Vec3& gravity, double base = 1) {
  std::string text = "pairs: [{a: floor, b: b1, friction: " + number(mu[0]) +
                     "}, {a: b1, b: b2, friction: " + number(mu[1]) +
                     "}, {a: b2, b: b3, friction: " + number(mu[2]) + "}]\n",
              shapes, bodies;
  for (int i = 1; i <= 3; ++i) {
    shapes += fmt::format("  b{}: {{box: {{size: [{}, 1, 0.4]}}, mass: 2}}\n", i, base);
    bodies +=
        fmt::format("  - {{shape: b{}, position: {}}}\n", i, list({0, 0, 0.4 * i - 0.2 + 0.5 * i * kH}));
  }
  return rough(0.5, kH, gravity, text) + shapes + on_floor + bodies;
}
TEST(Slide, R12ShearedStack) {
  for (const double dt : kSteps)
    for (const double direction : {0.0, 0.4}) {
      const auto along = [&](double a) {
        return Vec3(a * std::cos(direction), a * std::sin(direction), -kG);
      };
      const std::vector<double> mu{0.5, 0.3, 0.4};
      Rubbing holds(stack(mu, along(0.2999 * kG)), dt);
      holds.run(2);
      for (int i = 1; i <= 3; ++i)
        EXPECT_LE(holds.body(i).position.head<2>().norm(), 1e-9) << i << ", " << dt;
      Rubbing slips(stack(mu, along(0.35 * kG)), dt);
      slips.run(1);
      const Vec3 way(std::cos(direction), std::sin(direction), 0);
      EXPECT_LE(slips.body(1).position.head<2>().norm(), 1e-9) << dt;
      for (const int i : {2, 3})
        EXPECT_LE((slips.body(i).velocity - 0.05 * kG * way).norm(), 1e-9) << i << ", " << dt;
      expect_laws(holds, "holds");
      expect_laws(slips, "slips");
    }
  // As a whole it tips at A/g = b/H of all three, if no joint slips first.
  for (const double share : {0.9999, 1.001}) {
    Rubbing sim(stack({1, 1, 1}, {share * kG * 0.5 / (1.2 + 1.5 * kH), 0, -kG}, 0.5), 1 / 120.0);
    sim.run(3);
    if (share < 1)
      EXPECT_LE(turn_of(sim.body(2), 0), 1e-9) << share;
    else
      EXPECT_GE(turn_of(sim.body(2), 0), 0.1) << share;
    expect_laws(sim, "tips");
  }
}

}  // namespace
}  // namespace oracle_slide
