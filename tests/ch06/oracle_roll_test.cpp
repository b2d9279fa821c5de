// Balls, cylinders and hoops that slip, roll, ride on others and go in circles. The contact point lies in the middle of
// the gap h/2, so the lever arm is R + h/4: closed forms hold for that to rounding, and for R to the constant times h/R
// that is stated.
#include <gtest/gtest.h>

#include "rubbing.hpp"

namespace oracle_roll {  // the chapter's oracles are compiled as one
namespace {

using namespace fc_test;
using fc::Vec3;

constexpr double kRadius = 0.5, kMass = 2, kH = 5e-5;  // m, kg, m: the envelope is 1e-4 of the radius
constexpr double kLever = kRadius + 0.25 * kH;

// A ball with I = kappa m R^2.
std::string round_body(double kappa, const std::string& name = "ball") {
  const double i = kappa * kMass * kRadius * kRadius;
  return "  " + name + ": {sphere: {radius: " + number(kRadius) + "}, mass: " + number(kMass) +
         ", inertia: " + list({i, i, i}) + "}\n";
}
std::string ball_on_floor(double kappa, double mu, const Vec3& gravity, const Vec3& velocity,
                          const Vec3& spin, const Vec3& place = {0, 0, 0}, double table = 0) {
  return rough(mu, kH, gravity) + round_body(kappa) + "bodies:\n  - {shape: floor, " +
         (table != 0 ? "kinematic: true, spin: [0, 0, " + number(table) + "]" : std::string("static: true")) +
         ", position: [0, 0, -0.5]}\n  - {shape: ball, position: " +
         list(place + Vec3(0, 0, kRadius + 0.5 * kH)) + ", velocity: " + list(velocity) +
         ", spin: " + list(spin) + "}\n";
}
// Of I / (m L^2), with the lever arm as it is.
double share(double kappa) {
  return kappa * kRadius * kRadius / (kLever * kLever);
}
Vec3 slip_of(const fc::RigidBody& s) {
  return s.velocity + s.spin.cross(Vec3(0, 0, -kLever));
}

// R4. The slip keeps its direction, so friction is constant and the path a parabola, until the ball rolls: massé and draw shots,
// in 16 directions, for solid and hollow balls, cylinders (1/2) and hoops (1).
TEST(Roll, R4SlipThenRoll) {
  const double mu = 0.2;
  double worst = 0, of_book = 0;
  for (const double dt : kSteps)
    for (const double kappa : {0.4, 2.0 / 3, 0.5, 1.0})
      for (int k = 0; k < 16; ++k) {
        const double phi = k * std::numbers::pi / 8;
        const Vec3 v0(1.5 * std::cos(phi), 1.5 * std::sin(phi), 0),
            w0(3 - 0.2 * k, -4, 2);  // the spin about z stays
        Rubbing sim(ball_on_floor(kappa, mu, {0, 0, -kG}, v0, w0), dt);
        const Vec3 u0 = slip_of(sim.body(1)), way = u0.normalized();
        const double c = share(kappa), time = c * u0.norm() / ((1 + c) * mu * kG);
        sim.run(1.5);
        const Vec3 end = v0 - c / (1 + c) * u0,
                   place = v0 * time - 0.5 * mu * kG * time * time * way + (1.5 - time) * end;
        const Vec3 missed = sim.body(1).position - place - Vec3(0, 0, kRadius + 0.5 * kH);
        ASSERT_LT(time, 1.4);
        worst = std::max({worst, (sim.body(1).velocity - end).norm(), slip_of(sim.body(1)).norm(),
                          missed.head<2>().norm()});
        const Vec3 book = v0 - kappa / (1 + kappa) * (v0 + w0.cross(Vec3(0, 0, -kRadius)));
        of_book = std::max(of_book, (sim.body(1).velocity - book).norm() / u0.norm());
        EXPECT_NEAR(sim.body(1).spin.z(), 2, 1e-9);
        expect_laws(sim, "massé");
      }
  tell("R4: {:.2g} m/s or m with the lever R + h/4; {:.3g} h/R of the slip with R", worst,
       of_book * kRadius / kH);
  EXPECT_LE(worst, 1e-8) << "m/s or m";
  EXPECT_LE(of_book, 0.4 * kH / kRadius) << "of the slip: the book's, with R for the lever";
}

// R5. Rolling down, as long as µ >= tan θ κ/(1 + κ); else it slips and spins up.
TEST(Roll, R5DownASlope) {
  const double angle = 20 * kDegree;
  double worst = 0, of_book = 0;
  for (const double dt : kSteps)
    for (const double kappa : {0.4, 0.5, 1.0})
      for (const double of_edge : {1 + 1e-4, 1 - 1e-4, 0.5}) {
        const double c = share(kappa), edge = std::tan(angle) * c / (1 + c), mu = of_edge * edge, time = 1;
        Rubbing sim(ball_on_floor(kappa, mu, slope(angle, 0.7), Vec3::Zero(), Vec3::Zero()), dt);
        sim.run(time);
        const bool rolls = of_edge > 1;
        const double a =
            rolls ? kG * std::sin(angle) / (1 + c) : kG * (std::sin(angle) - mu * std::cos(angle));
        const double turn =
            rolls ? a / kLever : mu * kG * std::cos(angle) * kLever / (kappa * kRadius * kRadius);
        const Vec3 way(std::cos(0.7), std::sin(0.7), 0);
        worst = std::max(worst, (sim.body(1).velocity - a * time * way).norm() / (a * time));
        worst = std::max(worst,
                         (sim.body(1).spin - turn * time * Vec3(0, 0, 1).cross(way)).norm() / (turn * time));
        worst =
            std::max(worst, std::abs(sim.body(1).position.head<2>().norm() / (0.5 * a * time * time) - 1));
        if (rolls) of_book = std::max(of_book, std::abs(a / (kG * std::sin(angle) / (1 + kappa)) - 1));
        expect_laws(sim, "down");
      }
  tell("R5: {:.2g}; of the book's a: {:.3g} h/R", worst, of_book * kRadius / kH);
  EXPECT_LE(worst, 1e-9) << "relative";
  EXPECT_LE(of_book, 0.26 * kH / kRadius) << "relative";
}
// A cylinder that rolls on its side, by two points.
TEST(Roll, R5CylinderShape) {
  const double angle = 20 * kDegree;
  for (const double dt : kSteps) {
    Rubbing sim(rough(0.5, kH, slope(angle)) + "  can: {cylinder: {radius: 0.5, length: 1}, mass: 2}\n" +
                    on_floor + "  - {shape: can, position: " + list({0, 0, kRadius + 0.5 * kH}) +
                    ", rotation: {axis: [1, 0, 0], degrees: 90}}\n",
                dt);
    sim.run(1);
    const double a = kG * std::sin(angle) / (1 + share(0.5));
    tell("R5 cylinder dt {:.5f}: v {:.3g}, sideways {:.2g}, tilt {:.2g}", dt,
         sim.body(1).velocity.x() / a - 1, sim.body(1).velocity.y(), sim.body(1).spin.x());
    EXPECT_NEAR(sim.body(1).velocity.x() / a, 1, 1e-6) << dt;
    EXPECT_NEAR(sim.body(1).position.x() / (0.5 * a), 1, 1e-6) << dt;
    EXPECT_LE(
        std::abs(sim.body(1).velocity.y()) + std::abs(sim.body(1).spin.x()) + std::abs(sim.body(1).spin.z()),
        1e-6);
    expect_laws(sim, "cylinder");
  }
}

// R6. On a plank that is accelerated, by steps of its speed: a = A κ/(1 + κ), and it slips if A > µ g (1 + κ)/κ.
TEST(Roll, R6OnAnAcceleratedPlank) {
  double worst = 0;
  for (const double dt : kSteps)
    for (const double kappa : {0.4, 0.5}) {
      const double c = share(kappa), mu = 0.1, edge = mu * kG * (1 + c) / c;
      for (const double of_edge : {0.3, 0.999, 1.2}) {
        Rubbing sim(ball_on_floor(kappa, mu, {0, 0, -kG}, Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 1e-300),
                    dt);
        const double a = of_edge * edge;
        sim.world.bodies[0].state.spin.setZero();
        while (sim.time() < 0.999) {
          sim.world.bodies[0].state.velocity.x() = a * (sim.time() + dt);
          sim.step();
        }
        const double expected = of_edge < 1 ? a * c / (1 + c) : mu * kG;
        worst = std::max(worst, std::abs(sim.body(1).velocity.x() / expected - 1));
        const double slip = sim.world.bodies[0].state.velocity.x() - slip_of(sim.body(1)).x();
        EXPECT_NEAR(slip, of_edge < 1 ? 0 : (of_edge - 1) * edge, 1e-6 * edge) << of_edge << ", " << dt;
        expect_laws(sim, "plank");
      }
    }
  tell("R6: relative {:.2g}", worst);
  EXPECT_LE(worst, 1e-6);
}

// R7. A ball on a turntable goes in a circle with Ω' = Ω κ/(1 + κ) in the lab.
TEST(Roll, R7Turntable) {
  const double omega = 3;
  for (const double kappa : {0.4, 2.0 / 3}) {
    const double c = share(kappa), rate = omega * c / (1 + c);
    const Vec3 x0(1, 0.5, 0), v0(0.2, 0.6, 0), z(0, 0, 1);
    const Vec3 d = omega * z.cross(x0) - v0;  // what the spin adds at the contact point
    const Vec3 spin(d.y() / kLever, -d.x() / kLever, 0);
    std::vector<double> errors;
    for (const double dt : kSteps) {
      Rubbing sim(ball_on_floor(kappa, 1, {0, 0, -kG}, v0, spin, x0, omega), dt);
      ASSERT_LE((slip_of(sim.body(1)) - omega * z.cross(x0)).norm(), 1e-12);
      sim.run(4);
      const Vec3 centre = x0 + z.cross(v0) / rate;
      const Vec3 end = centre + Eigen::AngleAxisd(rate * sim.time(), z) * (x0 - centre);
      errors.push_back((sim.body(1).position - end).head<2>().norm());
      tell("R7 kappa {:.3f} dt {:.5f}: {:.3g} m = {:.3g} dt^2 = {:.3g} dt after 4 s", kappa, dt,
           errors.back(), errors.back() / dt / dt, errors.back() / dt);
      expect_laws(sim, "turntable");
    }
    tell("R7 order {:.2f}", order_of(errors));
    EXPECT_GE(order_of(errors), 1.8);
  }
}
// At rest in the lab it stays, if it spins without slip.
TEST(Roll, R7AtRestOnATurntable) {
  const double omega = 3;
  const Vec3 x0(1, 0.5, 0);
  const Vec3 d = omega * Vec3(0, 0, 1).cross(x0);
  for (const double dt : kSteps) {
    Rubbing sim(
        ball_on_floor(0.4, 1, {0, 0, -kG}, Vec3::Zero(), {d.y() / kLever, -d.x() / kLever, 0}, x0, omega),
        dt);
    sim.run(4);
    tell("R7 at rest dt {:.5f}: {:.3g} m", dt, (sim.body(1).position - x0).head<2>().norm());
    EXPECT_LE((sim.body(1).position - x0).head<2>().norm(), 1e-9) << dt;
    expect_laws(sim, "at rest");
  }
}

// R23. A ball in a trough of 90 degrees.
TEST(Roll, R23Trough) {
  double worst = 0;
  const double mu = 0.2, c = share(0.4), edge = std::atan(mu * std::numbers::sqrt2 * (1 + 2 * c) / (2 * c));
  for (const double dt : kSteps)
    for (const double of_edge : {0.5, 0.9999, 1.0001, 1.2}) {
      const double angle = of_edge * edge, depth = kRadius + 0.5 * kH + 0.5;
      std::string walls;
      for (const double side : {-1.0, 1.0})
        walls += "  - {shape: wall, static: true, position: " +
                 list({0, side * depth * std::sqrt(0.5), -depth * std::sqrt(0.5)}) +
                 ", rotation: {axis: [1, 0, 0], degrees: " + number(side * 45) + "}}\n";
      Rubbing sim(rough(mu, kH, slope(angle)) + "  wall: {box: {size: [200, 1.2, 1]}}\n" + round_body(0.4) +
                      "bodies:\n" + walls + "  - {shape: ball}\n",
                  dt);
      sim.run(1);
      const double a = of_edge < 1 ? kG * std::sin(angle) / (1 + 2 * c)
                                   : kG * (std::sin(angle) - std::numbers::sqrt2 * mu * std::cos(angle));
      worst = std::max(worst, std::abs(sim.body(2).velocity.x() / a - 1));
      worst = std::max(worst, std::abs(sim.body(2).velocity.y()) + std::abs(sim.body(2).spin.z()) +
                                  std::abs(sim.body(2).spin.x()));
      expect_laws(sim, "trough");
    }
  tell("R23: {:.2g}", worst);
  EXPECT_LE(worst, 1e-8);
}

}  // namespace
}  // namespace oracle_roll
