// Bodies that turn on the spot, slide and turn, or fall over an edge.
#include <gtest/gtest.h>

#include "rubbing.hpp"

namespace oracle_spin {  // the chapter's oracles are compiled as one
namespace {

using namespace fc_test;
using fc::Vec3;

constexpr double kH = 1e-4;  // m, the envelope

// A flat prism of n corners on a circle of 0.5 m.
std::string prism(int n, double height) {
  std::string points;
  for (const double z : {-0.5 * height, 0.5 * height})
    for (int k = 0; k < n; ++k) {
      const double phi = 2 * std::numbers::pi * k / n;
      points += (points.empty() ? "" : ", ") + list({0.5 * std::cos(phi), 0.5 * std::sin(phi), z});
    }
  return "  prism: {hull: {points: [" + points + "]}, mass: 2}\n";
}
double inertia_of(int n) {  // kg m^2, about its axis
  return 2 * 0.25 * (2 + std::cos(2 * std::numbers::pi / n)) / 6;
}
std::string spinning(int n, double height, double mu, const Vec3& velocity, double spin) {
  return rough(mu, kH) + prism(n, height) + on_floor +
         "  - {shape: prism, position: " + list({0, 0, 0.5 * (height + kH)}) +
         ", velocity: " + list(velocity) + ", spin: [0, 0, " + number(spin) + "]}\n";
}

// R19. Corners at one radius R: it stops after ω I/(µ m g R), a square of side s with 3 √2 µ g/s. Its centre does not move.
TEST(Spin, R19OnTheSpot) {
  const double mu = 0.2, spin = 5;
  for (const int n : {3, 4, 16}) {
    const double slowing = mu * 2 * kG * 0.5 / inertia_of(n);
    EXPECT_TRUE(n != 4 || std::abs(slowing - 3 * std::sqrt(2) * mu * kG / std::sqrt(0.5)) < 1e-12);
    const double time = spin / slowing, turn = 0.5 * spin * time;
    std::vector<double> errors;
    for (const double dt : kSteps) {
      Rubbing sim(spinning(n, 0.1, mu, Vec3::Zero(), spin), dt);
      double stopped = 0;
      sim.run(time + 0.2, [&] {
        if (sim.body(1).spin.z() > 1e-9) stopped = sim.time();
        EXPECT_LE(sim.body(1).position.head<2>().norm(), 1e-9) << "m: " << n;
      });
      const fc::Quat q = sim.body(1).orientation;
      const double missed = std::remainder(2 * std::atan2(q.z(), q.w()) - turn, 2 * std::numbers::pi);
      errors.push_back(std::abs(missed));
      tell("R19 n {} dt {:.5f}: angle off by {:.3g} rad = {:.3g} dt^2; stopped after {:.5f} of {:.5f} s", n,
           dt, missed, missed / dt / dt, stopped, time);
      EXPECT_LE(std::abs(stopped + 0.5 * dt - time), 0.6 * dt + 1e-3) << n << ", " << dt;
      EXPECT_LE(sim.body(1).spin.norm() + sim.body(1).velocity.norm(), 1e-12) << n;
      expect_laws(sim, fmt::format("{} corners, frames of {}", n, dt));
    }
    tell("R19 n {}: order {:.2f}", n, order_of(errors));
    EXPECT_GE(order_of(errors), 1.8) << n;
  }
}

// The motion of a prism with three corners, whose loads follow from statics: Runge and Kutta's method with tiny steps.
struct Sliding {
  Vec3 state;  // v_x, v_y, ω
  Vec3 place;  // x, y, the angle
};
Sliding rate(const Sliding& s, double mu, double lever) {
  Eigen::Matrix3d balance;
  Vec3 corners[3], slips[3];
  for (int i = 0; i < 3; ++i) {
    const double phi = s.place.z() + 2 * std::numbers::pi * i / 3;
    corners[i] = 0.5 * Vec3(std::cos(phi), std::sin(phi), 0);
    slips[i] =
        (Vec3(s.state.x(), s.state.y(), 0) + s.state.z() * Vec3(0, 0, 1).cross(corners[i])).normalized();
    const Vec3 friction = -mu * slips[i];
    balance.col(i) << 1, corners[i].x() + lever * friction.x(), corners[i].y() + lever * friction.y();
  }
  const Vec3 loads = balance.partialPivLu().solve(Vec3(2 * kG, 0, 0));
  Vec3 force = Vec3::Zero();
  double torque = 0;
  for (int i = 0; i < 3; ++i) {
    force -= mu * loads[i] * slips[i];
    torque -= mu * loads[i] * corners[i].cross(slips[i]).z();
  }
  return {{force.x() / 2, force.y() / 2, torque / inertia_of(3)}, s.state};
}
Sliding after(Sliding s, double time, double mu, double lever) {
  constexpr int kCount = 20000;
  const double dt = time / kCount;
  const auto add = [](const Sliding& a, double t, const Sliding& b) {
    return Sliding{a.state + t * b.state, a.place + t * b.place};
  };
  for (int i = 0; i < kCount; ++i) {
    const Sliding a = rate(s, mu, lever), b = rate(add(s, 0.5 * dt, a), mu, lever),
                  c = rate(add(s, 0.5 * dt, b), mu, lever), d = rate(add(s, dt, c), mu, lever);
    s.state += dt / 6 * (a.state + 2 * b.state + 2 * c.state + d.state);
    s.place += dt / 6 * (a.place + 2 * b.place + 2 * c.place + d.place);
  }
  return s;
}
TEST(Spin, R20SlidesAndTurnsOnThreeCorners) {
  const double mu = 0.2, height = 0.2, time = 0.5;
  const Sliding exact = after({{1.5, 0.5, 6}, Vec3::Zero()}, time, mu, 0.5 * height + 0.25 * kH);
  std::vector<double> errors;
  for (const double dt : kSteps) {
    Rubbing sim(spinning(3, height, mu, {1.5, 0.5, 0}, 6), dt);
    sim.run(time);
    const fc::RigidBody& s = sim.body(1);
    errors.push_back((s.position - exact.place).head<2>().norm() +
                     (s.velocity - exact.state).head<2>().norm() +
                     0.5 * std::abs(s.spin.z() - exact.state.z()));
    tell("R20 dt {:.5f}: {:.3g} = {:.3g} dt^2", dt, errors.back(), errors.back() / dt / dt);
    expect_laws(sim, "slides and turns");
    // Both stop together.
    double last_slide = 0, last_turn = 0;
    sim.run(1.5, [&] {
      if (s.velocity.norm() > 1e-6) last_slide = sim.time();
      if (std::abs(s.spin.z()) > 1e-6) last_turn = sim.time();
    });
    EXPECT_NEAR(last_slide, last_turn, 1.01 * dt);
    EXPECT_LE(s.velocity.norm() + s.spin.norm(), 1e-12);
    expect_laws(sim, "slides and turns");
  }
  tell("R20: order {:.2f}", order_of(errors));
  // The plan's half of friction is against the slip in its middle, the instant's against that at its end: of first order.
  EXPECT_GE(order_of(errors), 0.95);
  EXPECT_LE(errors[2], 1.0 * kSteps[2]) << "m and m/s";
}

// R18. A pencil that falls from upright on an edge: the edge of its end is the pivot, at the distance d from its centre, and
// I = m d^2/3. F/N = 3 sin θ (3 cos θ - 2)/(3 cos θ - 1)^2.
constexpr double kLength = 1, kThick = 0.02;
const double kArm = 0.5 * std::hypot(kLength, kThick);
std::string pencil(double mu, double theta) {
  const double lean = theta + std::atan(kThick / kLength),
               rate = std::sqrt(1.5 * kG * (1 - std::cos(theta)) / kArm);
  return rough(mu, 2e-5) + "  pencil: {box: {size: " + list({kThick, 0.1, kLength}) + "}, mass: 1}\n" +
         on_floor + "  - {shape: pencil, position: " + list({0, 0, kArm * std::cos(theta) + 1e-5}) +
         ", orientation: " + turned(lean, Vec3::UnitY()) +
         ", velocity: " + list({rate * kArm * std::cos(theta), 0, -rate * kArm * std::sin(theta)}) +
         ", spin: [0, " + number(rate) + ", 0]}\n";
}
double tilt_of(const fc::RigidBody& s) {
  return std::acos((s.orientation * Vec3::UnitZ()).z()) - std::atan(kThick / kLength);
}
TEST(Spin, R18ForcesOfAFallingPencil) {
  std::vector<double> errors;
  for (const double dt : kSteps) {
    Rubbing sim(pencil(1, 10 * kDegree), dt);
    double worst = 0, before = 10 * kDegree;
    while (before < 40 * kDegree) {
      sim.step();
      const double now = tilt_of(sim.body(1)), middle = 0.5 * (before + now), c = std::cos(middle);
      const double normal = 0.25 * kG * (3 * c - 1) * (3 * c - 1),
                   friction = 0.75 * kG * std::sin(middle) * (3 * c - 2);
      if (sim.frame > 1 && now < 40 * kDegree)
        worst =
            std::max({worst, std::abs(sim.forces[1].z() - normal), std::abs(sim.forces[1].x() - friction)});
      before = now;
      ASSERT_LT(sim.time(), 3);
    }
    tell("R18 dt {:.5f}: forces off by {:.3g} N; {:.3g} J of corrections, of 4.9 J", dt, worst,
         sim.corrected);
    errors.push_back(worst);
    EXPECT_LE(sim.corrected, 5e-5 * 4.9) << "J: what plans borrow from their ends is reported";
    expect_laws(sim, "pencil");
  }
  EXPECT_GE(order_of(errors), 1.8);
  EXPECT_LE(errors[0], 0.005) << "N, of 9.81";
}
// Which way it slips first.
TEST(Spin, R18WhichWayAPencilSlips) {
  const auto needed = [](double theta) {  // F/N
    const double c = std::cos(theta);
    return 3 * std::sin(theta) * (3 * c - 2) / ((3 * c - 1) * (3 * c - 1));
  };
  for (const double dt : kSteps)
    for (const double mu : {0.3, 0.365, 0.376, 0.8}) {
      const bool backwards = mu < 0.37058;
      double low = (backwards ? 10 : 48.19) * kDegree, high = (backwards ? 35.1 : 70.5) * kDegree;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high), f = needed(middle);
        ((backwards ? f < mu : f > -mu) ? low : high) = middle;
      }
      Rubbing sim(pencil(mu, 10 * kDegree), dt);
      double earlier = 0, before = 0, now = 10 * kDegree, share = 0;  // a whole frame has to slip
      while (now < 70 * kDegree && std::abs(share) < mu * (1 - 1e-6)) {
        sim.step();
        earlier = before;
        before = now;
        now = tilt_of(sim.body(1));
        share = sim.forces[1].x() / sim.forces[1].z();
        ASSERT_LT(sim.time(), 3);
      }
      tell("R18 µ {} dt {:.5f}: slips {} between {:.2f} and {:.2f} deg, exact {:.2f}", mu, dt,
           share > 0 ? "backwards" : "forwards", before / kDegree, now / kDegree, low / kDegree);
      EXPECT_EQ(share > 0, backwards) << mu << ", " << dt;
      EXPECT_LE(earlier, low + 0.1 * kDegree) << mu << ", " << dt;
      EXPECT_GE(now, low - 0.1 * kDegree) << mu << ", " << dt;
      expect_laws(sim, fmt::format("pencil, µ {}, frames of {}", mu, dt));
    }
}

}  // namespace
}  // namespace oracle_spin
