// Scenes with friction stepped by Coulomb's law, with all that must hold in every frame: for chapter 6's oracles.
#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <numbers>

#include "ch05/oracles.hpp"
#include "ch06_friction/coulomb_law.hpp"

namespace fc_test {

inline constexpr double kG = 9.81;  // m/s^2
inline constexpr double kDegree = std::numbers::pi / 180;
inline constexpr double kSteps[] = {1 / 60.0, 1 / 120.0, 1 / 240.0};  // s

// With FC_TELL set: what was measured, for tables.
template <class... Values>
void tell(const char* text, const Values&... values) {
  if (std::getenv("FC_TELL")) fmt::print(fmt::runtime(std::string(text) + "\n"), values...);
}
// The power of the step with which errors fall, from those of three steps.
inline double order_of(const std::vector<double>& errors) {
  return 0.5 * std::log2(errors.front() / errors.back());
}

inline std::string list(const fc::Vec3& v) {
  return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]";
}
// A turn about z, or another axis.
inline std::string turned(double angle, const fc::Vec3& axis = fc::Vec3::UnitZ()) {
  const fc::Vec3 v = std::sin(0.5 * angle) * axis.normalized();
  return "[" + number(std::cos(0.5 * angle)) + ", " + number(v.x()) + ", " + number(v.y()) + ", " +
         number(v.z()) + "]";
}
// Gravity as on a slope of this angle that falls towards `azimuth`, in axes that lie in the slope: the floor stays flat.
inline fc::Vec3 slope(double angle, double azimuth = 0) {
  return kG *
         fc::Vec3(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), -std::cos(angle));
}

// A scene's text up to the floor's shape; `more` are keys of the scene.
inline std::string rough(double mu, double envelope, const fc::Vec3& gravity = {0, 0, -kG},
                         const std::string& more = "") {
  return "step: {dt: 0.01, duration: 1}\nfriction: " + number(mu) + "\nenvelope: " + number(envelope) +
         "\nccd: {tolerance: " + number(std::min(1e-6, 1e-3 * envelope)) + "}\ngravity: " + list(gravity) +
         "\n" + more + "shapes:\n  floor: {box: {size: [2000, 2000, 1]}}\n";
}
// After the other shapes.
inline const std::string on_floor = "bodies:\n  - {shape: floor, static: true, position: [0, 0, -0.5]}\n";

// What must hold in every frame of every scene: the worst of all frames so far.
struct FrameLaws {
  double newton = 0;    // |m (v - v before) - m g dt - impulses|, of the sum of sizes
  double rise = 0;      // J, of the energy, beyond what corrections report and kinematic bodies do
  double excess = 0;    // of a friction beyond its cone, of µ times the normal impulse
  double across = 0;    // envelopes, the widest gap with an impulse
  int shortened = 0;    // bodies
  double size = 0;      // J, the largest sum of the energies' sizes
  double friction = 0;  // J, all work of friction
};

class Rubbing : public Simulation {
 public:
  FrameLaws laws;
  std::vector<fc::Vec3> forces;  // N, of the contacts on each body in the last frame, in the mean
  fc::world::OnImpact on_impact;
  fc::world::OnInstant on_instant;

  Rubbing(const std::string& text, double dt_, const fc::resting::RestOptions& options = {})
      : Simulation(read(text, 6), dt_, options,
                   [](fc::world::World& w) { return std::make_unique<fc::friction::CoulombLaw>(w); }) {}

  void step() {
    const double before = mechanical(), size = energies();
    std::vector<fc::Vec3> momentum;
    for (const auto& b : world.bodies) momentum.push_back(b.state.momentum());
    forces.assign(world.bodies.size(), fc::Vec3::Zero());
    std::vector<double> pushed(world.bodies.size(), 0);
    double excess = 0;
    Simulation::step({.impact =
                          [&](const fc::world::ImpactRecord& r) {
                            const fc::Vec3 j = r.impulse.impulse * r.contact.normal + r.tangential;
                            const auto a = static_cast<std::size_t>(r.contact.body_a),
                                       b = static_cast<std::size_t>(r.contact.body_b);
                            forces[a] -= j / dt;
                            forces[b] += j / dt;
                            pushed[a] += j.norm();
                            pushed[b] += j.norm();
                            laws.across = std::max(laws.across, r.contact.gap / resting.envelope());
                            const double cone = mu(r) * r.impulse.impulse;
                            excess = std::max(
                                excess, (r.tangential.norm() - cone) / std::max(cone, r.impulse.impulse));
                            if (on_impact) on_impact(r);
                          },
                      .instant = on_instant});
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      const fc::RigidBody& s = world.bodies[i].state;
      if (s.is_static()) continue;
      const fc::Vec3 weight = s.mass * dt * world.gravity_on(s);
      const fc::Vec3 error = s.momentum() - momentum[i] - weight - dt * forces[i];
      // What moves a point by less than 1e-9 of the envelope in a frame is taken as rest.
      const double of =
          momentum[i].norm() + weight.norm() + pushed[i] + 10 * s.mass * resting.envelope() / dt;
      laws.newton = std::max(laws.newton, error.cwiseProduct(s.free_moves).norm() / of);
    }
    laws.rise =
        std::max(laws.rise, mechanical() - before - last.correction_energy - last.step.kinematic_work);
    if (last.sweeps == 0) laws.excess = std::max(laws.excess, excess);  // a pile has one cone for each pair
    laws.size = std::max({laws.size, size, energies()});
    laws.shortened += last.shortened;
    laws.friction += last.tangential_work;
  }
  void run(double seconds, const std::function<void()>& look = {}) {
    const int frames = static_cast<int>(std::lround(seconds / dt));
    for (int i = 0; i < frames; ++i) {
      step();
      if (look) look();
    }
  }
  double mu(const fc::world::ImpactRecord& r) const {
    const auto shape = [&](int body) { return world.bodies[static_cast<std::size_t>(body)].shape; };
    return world.pair_rules.friction(world.shapes, shape(r.contact.body_a), shape(r.contact.body_b));
  }
  double mechanical() const {  // J
    double sum = 0;
    for (const auto& b : world.bodies) sum += energy_of(b.state);
    return sum;
  }
  double energies() const {  // J, of the sizes
    double sum = 0;
    for (const auto& b : world.bodies)
      if (!b.state.is_static())
        sum +=
            b.state.kinetic_energy() + std::abs(b.state.mass * world.effects.gravity->dot(b.state.position));
    return sum;
  }

 private:
  double energy_of(const fc::RigidBody& s) const {
    if (s.is_static()) return 0;
    return s.kinetic_energy() - s.mass * world.gravity_on(s).dot(s.position);
  }
};

// The independent overlap check on all pairs of which one can be moved.
class Judge {
 public:
  explicit Judge(const Simulation& sim) : sim_(sim) {
    for (const fc::ShapeSpec& spec : sim.scene.shapes) shapes_.push_back(shape_of(spec));
  }
  bool overlap() const {
    const auto states = states_of(sim_.world, 0);
    for (std::size_t a = 0; a < states.size(); ++a)
      for (std::size_t b = a + 1; b < states.size(); ++b) {
        const independent::Rounded &one = shape(a), &other = shape(b);
        const double reach = one.reach + one.radius + other.reach + other.radius;
        if (!sim_.world.is_dynamic(static_cast<int>(a)) && !sim_.world.is_dynamic(static_cast<int>(b)))
          continue;
        if (norm(states[a].position - states[b].position) > reach) continue;
        if (!independent::apart(one, states[a], other, states[b], kTouch)) return true;
      }
    return false;
  }

 private:
  const independent::Rounded& shape(std::size_t body) const {
    return shapes_[static_cast<std::size_t>(sim_.scene.bodies[body].shape)];
  }
  const Simulation& sim_;
  std::vector<independent::Rounded> shapes_;
};

// newton: the share of impulses that a body may lose when it comes to stand, see ContactLaw::left().
inline void expect_laws(const Rubbing& sim, const std::string& with, double newton = 1e-10) {
  const double energy = std::max(sim.laws.size, 1e-300);
  EXPECT_LE(sim.laws.newton, newton) << "impulses and weight make the momentum: " << with;
  EXPECT_LE(sim.laws.rise / energy, 1e-12) << "of the energies, which rose in a frame: " << with;
  EXPECT_LE(sim.laws.excess, 1e-9) << "of the normal impulse, beyond the cone: " << with;
  EXPECT_LE(sim.laws.across, 1.0001) << "envelopes: no impulse acts from afar: " << with;
  EXPECT_EQ(sim.laws.shortened, 0) << with;
  EXPECT_EQ(sim.lost, 0) << "s: " << with;
  EXPECT_EQ(sim.penetration, 0) << "m: " << with;
}

}  // namespace fc_test
