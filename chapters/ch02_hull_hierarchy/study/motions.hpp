// Random motions of two equal models: the queries of the study and of bench_ch02.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "ch02_hull_hierarchy/model_distance.hpp"

namespace fc::hulls {

struct MotionPair {
  ca::Motion a, b;
};

// Random motions of one second, in units of the model's size.
class StudyMotions {
 public:
  StudyMotions(const Model& model_of_both, double model_size, std::uint64_t seed)
      : model(model_of_both), size(model_size), random(seed) {}

  // A at the origin, B 1.1 to 2.5 away, no nearer than 0.05 to A's surface. Both fly towards each other's
  // neighbourhood, so that about half of the pairs meet, and turn by up to 1.5 rad.
  MotionPair far() {
    while (true) {
      const Vec3 apart = size * uniform(1.1, 2.5) * direction();
      const Vec3 aim = size * uniform(0, 2.9) * direction();  // where B would arrive, seen from A
      const Vec3 relative = uniform(0.9, 1.5) * (aim - apart), velocity_b = uniform(0.2, 0.8) * relative;
      MotionPair pair{body(Vec3::Zero()), body(apart)};
      pair.a.velocity = velocity_b - relative;
      pair.b.velocity = velocity_b;
      spin(pair.a, uniform(0, 1.5));
      spin(pair.b, uniform(0, 1.5));
      if (distance(pair).upper > 0.05 * size) return pair;
    }
  }
  // A first gap of 1e-3 to 2e-2, evenly in its logarithm; B moves by 0.1 to 0.6, rather towards A than away,
  // so that three quarters of the pairs meet; both turn by up to 0.75 rad.
  MotionPair close() {
    const Vec3 line = direction();
    MotionPair pair = near(std::exp(uniform(std::log(1e-3), std::log(2e-2))), line);
    const Vec3 relative = size * uniform(0.1, 0.6) * (direction() - 0.4 * line).normalized();
    pair.b.velocity = uniform(0.2, 0.8) * relative;
    pair.a.velocity = pair.b.velocity - relative;
    spin(pair.a, uniform(0, 0.75));
    spin(pair.b, uniform(0, 0.75));
    return pair;
  }
  // Both turn by 1.2 rad on the spot, at a first gap of 1e-4.
  MotionPair spinning() {
    MotionPair pair = near(1e-4, direction());
    spin(pair.a, 1.2);
    spin(pair.b, 1.2);
    return pair;
  }

 private:
  const Model& model;
  const double size;
  std::mt19937_64 random;

  double uniform(double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 53>(random);
  }
  Vec3 direction() {
    while (true) {
      const Vec3 d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (d.norm() > 0.1 && d.norm() < 1) return d.normalized();
    }
  }
  ca::Motion body(const Vec3& position) {
    ca::Motion motion;
    motion.position = position;
    const Vec3 axis = direction();
    motion.rotation = ca::rotation_about(axis, uniform(0, 3));
    return motion;
  }
  void spin(ca::Motion& motion, double rate) {
    motion.spin_axis = direction();
    motion.spin_rate = rate;
    motion.spin = rate * motion.spin_axis;
  }
  ModelDistance distance(const MotionPair& pair) const {
    return model_distance(model, model, ca::PairPose(pair.a, pair.b, 0), 1e-9 * size);
  }
  // B approaches along a line through both centres until the gap is `gap`. Each step is the excess of the
  // gap, which never falls below.
  MotionPair near(double gap, const Vec3& line) {
    MotionPair pair{body(Vec3::Zero()), body(3 * size * line)};
    while (true) {
      const double step = distance(pair).upper - gap * size;
      if (step < 1e-3 * gap * size) return pair;
      pair.b.position -= step * line;
    }
  }
};

}  // namespace fc::hulls
