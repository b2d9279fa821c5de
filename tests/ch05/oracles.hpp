// A scene's text stepped in chapter 5's way, by its law or another, with what each frame reported: for the oracles.
#pragma once

#include <cmath>
#include <cstdio>

#include "ch05_resting_contact/resting.hpp"
#include "support/gallery.hpp"

namespace fc_test {

// s: the frames of the oracles that take longest. Sanitizers run only the longest frame: the same code, in a seventh of
// the time; the results for the other frames are tested without sanitizers.
#ifdef FC_SANITIZED
inline const std::vector<double> kFrames = {1 / 60.0};
#else
inline const std::vector<double> kFrames = {1 / 60.0, 1 / 120.0, 1 / 240.0};
#endif

inline std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

// Makes the law of a world's contacts; none: chapter 5's.
using LawFactory = std::function<std::unique_ptr<fc::resting::ContactLaw>(fc::world::World&)>;

struct Simulation {
  fc::Scene scene;
  fc::world::World world;
  double dt;
  fc::resting::Resting resting;
  int frame = 0;
  double lost = 0;                 // s, all frames
  double corrected = 0;            // J, all frames
  double smallest_gap = INFINITY;  // m, certified, of all frames' pairs
  double penetration = 0;          // m
  double residual = 0;             // of all frames' problems, the worst
  fc::resting::RestReport last;

  Simulation(const fc::Scene& scene_, double dt_, const fc::resting::RestOptions& options = {},
             const LawFactory& law = {})
      : scene(scene_),
        world(fc::world::build_world(scene)),
        dt(dt_),
        resting(scene, world, dt_, options, law ? law(world) : nullptr) {}
  Simulation(const std::string& text, double dt_, const fc::resting::RestOptions& options = {})
      : Simulation(read(text), dt_, options) {}

  static fc::Scene read(const std::string& text, int chapter = 5) {
    const auto file = scratch("scenes") / "scene.yaml";
    std::ofstream(file) << text;
    return fc::read_scene({file, {}, {}, chapter});
  }
  void step(const fc::world::Listeners& listeners = {}) {
    last = resting.step(world, listeners);
    ++frame;
    lost += last.step.lost_time;
    corrected += last.correction_energy;
    smallest_gap = std::min(smallest_gap, last.step.min_gap);
    penetration = std::max(penetration, last.step.max_penetration);
    residual = std::max(residual, last.step.lcp_residual);
  }
  void run(double seconds, const fc::world::Listeners& listeners = {}) {
    const int frames = static_cast<int>(std::lround(seconds / dt));
    for (int i = 0; i < frames; ++i) step(listeners);
  }
  double time() const { return frame * dt; }
  const fc::RigidBody& body(int i) const { return world.bodies[static_cast<std::size_t>(i)].state; }
  double kinetic() const {
    double sum = 0;
    for (const auto& b : world.bodies) sum += b.state.kinetic_energy();
    return sum;
  }
  double potential() const {  // J, zero at the world's origin
    double sum = 0;
    for (const auto& b : world.bodies)
      if (!b.state.is_static()) sum -= b.state.mass * world.effects.gravity->dot(b.state.position);
    return sum;
  }
  double energy() const { return kinetic() + potential(); }
};

}  // namespace fc_test
