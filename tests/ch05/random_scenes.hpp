// Random scenes with an envelope, and what must hold in each frame, whatever happens. FC_SCENES=2000 runs so many; CI runs a share.
// FC_FIRST=n begins with seed n. FC_STRICT=1 asks for speed, too.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <iostream>
#include <random>

#include "ch02_hull_hierarchy/model_distance.hpp"
#include "ch05_resting_contact/resting.hpp"
#include "support/worlds.hpp"

namespace fc_test {

#ifdef FC_SANITIZED
inline constexpr int kScenes = 10;
inline constexpr double kSlower = 1000;
#else
inline constexpr int kScenes = 60;
inline constexpr double kSlower = 60;  // than what is asked for: the slowest scene
#endif

using fc::Mat3;
using fc::Vec3;

inline int from_environment(const char* name, int otherwise) {
  const char* asked = std::getenv(name);
  return asked ? std::atoi(asked) : otherwise;
}

// Processor time of this thread, ms: whoever else is busy does not count.
inline double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Random {
  std::mt19937_64 engine;
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  double log(double low, double high) { return std::exp((*this)(std::log(low), std::log(high))); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine); }
  bool chance(double share) { return (*this)(0, 1) < share; }
  std::string vector(int n, double size) {
    std::string text = "[";
    for (int i = 0; i < n; ++i) text += (i ? ", " : "") + fmt::format("{}", (*this)(-size, size));
    return text + "]";
  }
};

// 2 to 40 bodies on a lattice, each within a ball of 0.5 m, that fly towards the middle, or fall on a floor or into a pit.
inline std::string random_scene(unsigned seed) {
  Random random{std::mt19937_64(seed)};
  const int count = 2 + random.below(seed % 4 == 0 ? 39 : 8);
  const bool falls = !random.chance(0.25), pit = random.chance(0.3), paddle = random.chance(0.2),
             mixed = random.chance(0.3);
  const double dt = random.log(1.0 / 240, random.chance(0.2) ? 0.5 : 0.05);
  const std::string ring =
      std::string(FC_SOURCE_DIR) + "/chapters/ch04_multibody_stepping/scenes/parts/ring.obj";
  const double restitution = random.chance(0.3) ? 0 : random(0, 1);
  const double heaviest = random.chance(0.5) ? 1 : random.log(1, 1e6);
  std::string shapes = "  floor: {box: {size: [40, 40, 1]}}\n  wall: {box: {size: [1, 8, 8]}}\n", bodies;
  if (paddle) shapes += "  paddle: {box: {size: [0.6, 0.6, 0.6]}}\n";
  for (int i = 0; i < count; ++i) {
    const std::array<std::string, 9> kinds{
        "box: {size: [0.5, 0.4, 0.3]}",
        "box: {size: [0.8, 0.5, 0.05]}",
        "sphere: {radius: 0.3}",
        "capsule: {radius: 0.12, length: 0.5}",
        "hull: {points: [[0.4, 0, 0], [-0.4, 0, 0], [0, 0.3, 0], [0, -0.3, 0], [0, 0, 0.3], [0.1, 0, -0.3]]}",
        "hull: {points: [[0.3, 0.3, 0.3], [-0.3, -0.3, 0.3], [-0.3, 0.3, -0.3], [0.3, -0.3, -0.3]]}",
        "cylinder: {radius: 0.25, length: 0.4}",
        "cone: {radius: 0.25, length: 0.5}",
        "mesh: " + ring + ", scale: 0.25"};
    const int kind = seed % 5 == 0 ? random.below(9) : random.below(8);
    shapes += fmt::format("  s{}: {{{}, mass: {}{}}}\n", i, kinds[kind], random.log(1, heaviest),
                          mixed ? fmt::format(", restitution: {}", random(0, 1)) : "");
    Vec3 place = 1.1 * (Vec3(i % 3, i / 3 % 3, i / 9) - Vec3(1, 1, 0.5 * (count / 9)));
    if (falls) place.z() = 0.6 + 1.1 * (i / 9);
    const double speed = falls ? random(-0.5, 0.5) : random(0.3, 3);
    bodies += fmt::format(
        "  - {{shape: s{}, position: [{}, {}, {}], orientation: {}, velocity: [{}, {}, {}], spin: {}}}\n", i,
        place.x(), place.y(), place.z(), random.vector(4, 1), -speed * place.x(), -speed * place.y(),
        falls ? random(-2, 0.5) : -speed * place.z() + random(-0.2, 0.2), random.vector(3, falls ? 3 : 5.7));
  }
  if (falls) {
    bodies += "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n";
    if (pit)
      for (const double x : {-2.3, 2.3})
        bodies += fmt::format("  - {{shape: wall, static: true, position: [{}, 0, 3.9]}}\n", x);
    if (paddle)
      bodies += fmt::format(
          "  - {{shape: paddle, kinematic: true, position: [-4, {}, 0.31], velocity: [{}, 0, 0]}}\n",
          random(-0.5, 0.5), random(0.5, 3));
  }
  return fmt::format(
      "step: {{dt: {}, duration: 1.5}}\nrestitution: {}\nenvelope: {}\nccd: {{tolerance: 1.0e-7}}\n{}{}shapes:\n{}bodies:\n{}",
      dt, restitution, random.log(5e-5, 1e-2), falls ? "gravity: [0, 0, -9.81]\n" : "",
      random.chance(0.3) ? "gyroscopic: true\n" : "", shapes, bodies);
}

struct Sums {
  double energy = 0, size = 0;

  explicit Sums(const fc::world::World& world) {
    for (const auto& b : world.bodies) {
      const fc::RigidBody& s = b.state;
      if (s.is_static()) continue;
      const double kinetic = s.kinetic_energy();
      const double potential = world.effects.gravity ? -s.mass * world.effects.gravity->dot(s.position) : 0;
      energy += kinetic + potential;
      size += kinetic + std::abs(potential);
    }
  }
};

// The deepest overlap of any two bodies, m; 0 if there is none.
inline double deepest(const fc::world::World& world) {
  double depth = 0;
  for (int a = 0; a < static_cast<int>(world.bodies.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(world.bodies.size()); ++b) {
      if (!world.is_dynamic(a) && !world.is_dynamic(b)) continue;
      const fc::ca::PairPose pose(world.bodies[a].state.pose(), world.bodies[b].state.pose());
      const double far =
          world.shapes[world.bodies[a].shape].reach + world.shapes[world.bodies[b].shape].reach;
      if (pose.offset_world.norm() > far) continue;
      const auto gap = fc::hulls::model_distance(world.model_of(a), world.model_of(b), pose, 1e-9, 1e-6);
      depth = std::max(depth, -gap.lower);
    }
  return depth;
}

struct Worst {
  double lost = 0, rise = 0, newton = 0, ms = 0, gap = 0, impulse = 0;
  int shortened = 0;
  double lost_impulse = 0, reported = 0;
};

inline fc::Scene read_rest_scene(const std::string& text, int chapter) {
  const auto file = scratch("scenes") / "scene.yaml";
  std::ofstream(file) << text;
  return fc::read_scene({file, {}, {}, chapter});
}

// The contact law that a later chapter puts in; none: chapter 5's.
using MakeLaw = std::function<std::unique_ptr<fc::resting::ContactLaw>(fc::world::World&)>;

// Runs a scene; returns what it broke, or nothing.
inline std::string broken_by(Worst& worst, const fc::Scene& scene, const MakeLaw& law) {
  fc::world::World world = fc::world::build_world(scene);
  const double dt = scene.step->dt;
  fc::resting::Resting resting(scene, world, dt, {}, law ? law(world) : nullptr);
  std::string faults;
  const auto fault = [&](int frame, const std::string& what) {
    if (faults.size() < 400) faults += fmt::format("  frame {}: {}\n", frame, what);
  };
  for (int frame = 1; frame <= scene.step->frames; ++frame) {
    const Sums before(world);
    std::vector<Vec3> momentum, impulse(world.bodies.size(), Vec3::Zero());
    std::vector<double> pushed(world.bodies.size(), 0.0);
    for (const auto& b : world.bodies) momentum.push_back(b.state.momentum());
    double widest = 0;
    const double begun = thread_ms();
    const auto report = resting.step(world, {[&](const fc::world::ImpactRecord& r) {
                                       const Vec3 j = r.impulse.impulse * r.contact.normal + r.tangential;
                                       impulse[static_cast<std::size_t>(r.contact.body_a)] -= j;
                                       impulse[static_cast<std::size_t>(r.contact.body_b)] += j;
                                       for (const int body : {r.contact.body_a, r.contact.body_b})
                                         pushed[static_cast<std::size_t>(body)] += j.norm();
                                       widest = std::max(widest, r.contact.gap);
                                     }});
    worst.ms += (thread_ms() - begun) / scene.step->frames;
    const Sums after(world);
    double newton = 0;
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      const fc::RigidBody& s = world.bodies[i].state;
      if (s.is_static()) continue;
      const Vec3 weight =
          world.effects.gravity ? Vec3(s.mass * dt * *world.effects.gravity) : Vec3(Vec3::Zero());
      // What moves a point by less than 1e-9 of the envelope in a frame is taken as rest.
      const double size =
          momentum[i].norm() + weight.norm() + pushed[i] + 10 * s.mass * resting.envelope() / dt;
      newton = std::max(newton, (s.momentum() - momentum[i] - weight - impulse[i]).norm() / size);
    }
    const double kinematic = report.step.kinematic_work;
    const double rise = after.energy - before.energy - kinematic - report.correction_energy;
    worst.newton = std::max(worst.newton, report.shortened ? 0 : newton);
    worst.rise = std::max(worst.rise, rise / before.size);
    worst.lost += report.step.lost_time;
    worst.gap = std::max(worst.gap, widest / resting.envelope());
    worst.shortened += report.shortened;
    worst.lost_impulse += report.lost_impulse;
    worst.reported = std::max(worst.reported, report.correction_energy / before.size);
    if (rise > 1e-9 * before.size)
      fault(frame, fmt::format("energy rises by {:.3g} of {:.3g} J, reported {:.3g}",
                               rise + report.correction_energy, before.size, report.correction_energy));
    if (report.correction_energy > 0.02 * before.size)
      fault(frame, fmt::format("corrections add {:.3g} of {:.3g} J", report.correction_energy, before.size));
    if (newton > 1e-10 && !report.shortened)
      fault(frame, fmt::format("Newton's law is off by {:.2g}", newton));
    if (widest > 1.0001 * resting.envelope())
      fault(frame, fmt::format("an impulse across {:.3g} envelopes", widest / resting.envelope()));
    if (report.step.lost_time > 0) fault(frame, fmt::format("{:.3g} s are lost", report.step.lost_time));
    const double depth = deepest(world);
    if (depth > 1e-12) fault(frame, fmt::format("an overlap of {:.3g} m", depth));
  }
  // What is asked for is 5 ms a frame and ten bodies (FC_STRICT=1); a few scenes take longer.
  const double allowed = (std::getenv("FC_STRICT") ? 1 : kSlower) *
                         std::max(5.0, 0.5 * static_cast<double>(world.bodies.size()));
  if (worst.ms > allowed)
    fault(0, fmt::format("{:.1f} ms a frame for {} bodies", worst.ms, world.bodies.size()));
  return faults;
}

// Scenes by their seeds; `with` changes their text, `law` what contacts do.
inline void expect_laws_kept(int scenes, int chapter, const MakeLaw& law,
                             const std::function<std::string(unsigned seed, const std::string&)>& with,
                             int from = 1) {
  const int first = from_environment("FC_FIRST", from), count = from_environment("FC_SCENES", scenes);
  int bad = 0, shortened = 0;
  double lost_impulse = 0, reported = 0;
  for (int seed = first; seed < first + count; ++seed) {
    const auto number = static_cast<unsigned>(seed);
    const std::string text = with ? with(number, random_scene(number)) : random_scene(number);
    const fc::Scene scene = read_rest_scene(text, chapter);
    if (std::getenv("FC_PRINT")) std::cout << text << "\n";
    Worst worst;
    std::string faults;
    try {
      faults = broken_by(worst, scene, law);
    } catch (const std::exception& error) {
      faults = fmt::format("  {}\n", error.what());
    }
    if (!faults.empty()) ++bad;
    if (worst.shortened > 0) ++shortened;
    lost_impulse += worst.lost_impulse;
    reported = std::max(reported, worst.reported);
    if (!faults.empty() && bad <= 12)
      ADD_FAILURE() << fmt::format("seed {}: bodies {}, dt {:.4f}, shortened {}\n", seed, scene.bodies.size(),
                                   scene.step->dt, worst.shortened)
                    << faults;
  }
  std::cout << bad << " of " << count << " scenes break a law; in " << shortened
            << " paths are shortened, which takes " << lost_impulse
            << " N s; most that corrections add in a frame: " << reported << " of the energy\n";
}

}  // namespace fc_test
