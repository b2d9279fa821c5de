// Impacts with friction, and Painlevé's rod.
#include <gtest/gtest.h>

#include <random>

#include "rubbing.hpp"

namespace oracle_impact {  // the chapter's oracles are compiled as one
namespace {

using namespace fc_test;
using fc::Vec3;

constexpr double kH = 2e-5;  // m, the envelope

struct Sum {  // of a run's impulses on body 1
  double normal = 0, gap = 0;
  Vec3 whole = Vec3::Zero();
  void add(const fc::world::ImpactRecord& r) {
    normal += r.impulse.impulse;
    whole += r.impulse.impulse * r.contact.normal + r.tangential;
    gap = r.contact.gap;
  }
};

// R22. While it slides, Δv_T = -µ (1 + e) |v_N|; else the point ends up at rest. (R21, the superball, has another law: this one
// leaves no tangential velocity at the point, never turns it round.)
TEST(Impact, R22BallThatBouncesWithSlip) {
  double worst = 0;
  for (const double dt : kSteps)
    for (const double e : {0.0, 0.5, 1.0})
      for (const double mu : {0.05, 0.2, 0.6, 1000.0})
        for (int k = 0; k < 16; ++k) {
          const double phi = k * std::numbers::pi / 8;
          const Vec3 v(2 * std::cos(phi), 2 * std::sin(phi), -1.5), w(1, -0.5 * k, 3);
          Rubbing sim(rough(mu, kH, Vec3::Zero(), "restitution: " + number(e) + "\n") +
                          "  ball: {sphere: {radius: 0.5}, mass: 2}\n" + on_floor +
                          "  - {shape: ball, position: [0, 0, 0.51], velocity: " + list(v) +
                          ", spin: " + list(w) + "}\n",
                      dt);
          Sum sum;
          sim.on_impact = [&](const auto& r) { sum.add(r); };
          sim.run(0.1);
          const double lever = 0.5 + 0.5 * sum.gap, compliance = 1 + lever * lever / 0.1;  // of 1/m
          const Vec3 u = v + w.cross(Vec3(0, 0, -lever)), slip(u.x(), u.y(), 0);
          const double most = mu * (1 + e) * 1.5, needed = slip.norm() / compliance;
          const Vec3 change = -slip.normalized() * std::min(most, needed);
          worst = std::max(worst, (sim.body(1).velocity - Vec3(v.x(), v.y(), e * 1.5) - change).norm());
          worst = std::max(worst, std::abs(sim.body(1).spin.z() - 3));
          expect_laws(sim, fmt::format("e {}, µ {}, direction {}", e, mu, k));
        }
  tell("R22: {:.2g} m/s", worst);
  EXPECT_LE(worst, 1e-12) << "m/s";
}

// A rod of 1 kg and half-length 1 with I = 1/3 whose lower end, a point, touches the floor; `angle` from the floor. Its end
// points to -x, and moves with `velocity`.
std::string rod(double mu, double angle, const Vec3& velocity, const Vec3& gravity, double e = 0,
                double gap = 0.5 * kH) {
  return rough(mu, kH, gravity, "restitution: " + number(e) + "\n") +
         "  rod: {hull: {points: [[1, 0, 0], [-1, 0, 0], [0, 0.05, 0], [0, -0.05, 0], [0, 0, 0.05], [0, 0, -0.05]]}, mass: 1,"
         " inertia: [0.01, 0.3333333333333333, 0.3333333333333333]}\n" +
         on_floor + "  - {shape: rod, position: " + list({0, 0, std::sin(angle) + gap}) +
         ", orientation: " + turned(-angle, Vec3::UnitY()) + ", velocity: " + list(velocity) + "}\n";
}

// R25: Newton's law with Coulomb's on the velocities after would make it gain half of its energy. Here it keeps 0.619 of it.
TEST(Impact, R25EnergyRod) {
  for (const double dt : kSteps) {
    Rubbing sim(rod(0.5, 45 * kDegree, {0.625, 0, -1}, Vec3::Zero(), 1, 1e-3), dt);
    Sum sum;
    sim.on_impact = [&](const auto& r) { sum.add(r); };
    sim.run(0.1);
    // r1 = (25, -1)/64, then r2 = (25, 12.5)/64.
    tell("R25 rod dt {:.5f}: {:.3g}, {:.3g} N s off", dt, sum.normal - 50 / 64.0, sum.whole.x() - 11.5 / 64);
    EXPECT_NEAR(sum.normal, 50 / 64.0, 2 * kH) << "N s";
    EXPECT_NEAR(sum.whole.x(), 11.5 / 64, 2 * kH) << "N s";
    expect_laws(sim, "energy rod");
  }
}

const double kSteep = std::atan(2.0);  // A = [[1.6, -1.2], [-1.2, 3.4]]

// R25, Painlevé: µ = 1.5 is above 4/3. From a vanishing approach it stops dead: impact without collision.
TEST(Impact, R25PainleveStops) {
  for (const double dt : {1 / 60.0, 1 / 240.0, 1 / 1000.0, 1e-4, 1e-5}) {
    Rubbing sim(rod(1.5, kSteep, {-1, 0, -0.01}, Vec3::Zero()), dt);
    Sum sum;
    sim.on_impact = [&](const auto& r) { sum.add(r); };
    sim.step();
    const double det = 1.6 * 3.4 - 1.2 * 1.2, normal = (3.4 * 0.01 + 1.2) / det,
                 tangent = (1.2 * 0.01 + 1.6) / det;
    tell("R25 Painlevé dt {:.5f}: r - exact = {:.3g}, {:.3g} N s", dt, sum.normal - normal,
         sum.whole.x() - tangent);
    EXPECT_NEAR(sum.normal, normal, 2 * kH) << "N s, " << dt;
    EXPECT_NEAR(sum.whole.x(), tangent, 2 * kH) << "N s, " << dt;
    expect_laws(sim, "Painlevé");
  }
}
TEST(Impact, R25PainleveDragged) {
  for (const double dt : kSteps) {
    Rubbing sim(rod(1.5, kSteep, {1, 0, -0.01}, Vec3::Zero()), dt);
    Sum sum;
    sim.on_impact = [&](const auto& r) { sum.add(r); };
    sim.step();
    const double normal = 0.01 / (1.6 + 1.2 * 1.5);  // u_N = 0
    EXPECT_NEAR(sum.normal, normal, 1e-3 * normal) << "N s, " << dt;
    EXPECT_NEAR(sum.whole.x(), -1.5 * normal, 2e-3 * normal) << "N s, " << dt;
    expect_laws(sim, "dragged");
  }
}
// With gravity it slides towards its tilt at rest on the floor: whatever the frame, an impulse that does not shrink with it.
TEST(Impact, R25PainleveSlides) {
  double normal = 0;
  for (const double dt : {1 / 60.0, 1 / 240.0, 1 / 960.0, 1 / 3840.0, 1 / 15360.0}) {
    Rubbing sim(rod(1.5, kSteep, {-1, 0, 0}, {0, 0, -kG}), dt);
    Sum sum;
    sim.on_impact = [&](const auto& r) { sum.add(r); };
    sim.step();
    tell("R25 slides dt {:.6f}: r = {:.5g}, {:.5g} N s; lost {}", dt, sum.normal, sum.whole.x(), sim.lost);
    normal = sum.normal;
    EXPECT_GE(normal, 0.29) << "N s, " << dt;
    EXPECT_LE(normal, 0.5) << "N s, " << dt;
    EXPECT_LE(sim.body(1).velocity.norm(), 2);
    expect_laws(sim, "slides");
  }
  EXPECT_NEAR(normal, 1.2 / 4, 1e-3) << "N s: as the frame goes to zero";
}

// R24: what an instant takes is half of r'Ar and what friction takes, µ r_N |u_T|. Boxes thrown flat, on an edge, on a corner, one
// on another; the frame is so short that nothing else happens in it but a part of some 1e-8 of it.
TEST(Impact, R24DissipationIdentity) {
  std::mt19937 source(7);
  const auto random = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(source);
  };
  double worst = 0, aside = 0;
  int slides = 0, sticks = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double mu = random(0, 1.5);
    std::string bodies;
    for (int i = 0; i < 1 + trial % 3; ++i)
      bodies += "  - {shape: box, position: " + list({0.1 * i, 0, 0.2 + 0.5 * kH + i * (0.4 + 0.5 * kH)}) +
                ", velocity: " + list({random(-1, 1), random(-1, 1), random(-1, -0.1)}) +
                ", spin: " + list({random(-1, 1), random(-1, 1), random(-1, 1)}) + "}\n";
    Rubbing sim(
        rough(mu, kH, Vec3::Zero()) + "  box: {box: {size: [1, 0.7, 0.4]}, mass: 1}\n" + on_floor + bodies,
        1e-7);
    const double before = sim.kinetic();
    double predicted = 0;
    sim.on_impact = [&](const fc::world::ImpactRecord& r) {
      const double taken = r.impulse.impulse * (r.impulse.v_after - r.impulse.v_before) +
                           r.tangential.dot(r.slip_after - r.slip_before);
      predicted += 0.5 * taken + mu * r.impulse.impulse * r.slip_after.norm();
      aside =
          std::max(aside, (r.tangential.norm() * r.slip_after + r.slip_after.norm() * r.tangential).norm());
      ++(r.slip_after.norm() > 1e-6 ? slides : sticks);
    };
    sim.step();
    worst = std::max(worst, std::abs(before - sim.kinetic() - predicted) / before);
    expect_laws(sim, "thrown");
  }
  tell("R24: {:.2g} of the energy, {:.2g} J aside; {} slide, {} stick", worst, aside, slides, sticks);
  EXPECT_LE(worst, 1e-7) << "of the energy";
  EXPECT_LE(aside, 1e-6) << "J: friction is against the slip";
  EXPECT_GT(slides, 100);
  EXPECT_GT(sticks, 50);
}

}  // namespace
}  // namespace oracle_impact
