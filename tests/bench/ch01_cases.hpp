// The queries of bench_ch01: pairs of random convex hulls, the same for every engine.
#pragma once

#include <random>
#include <vector>

#include "ch01_convex_advancement/advance.hpp"
#include "common/convex_hull.hpp"

namespace fc::bench {

struct HullPair {
  TriangleMesh hull_a, hull_b;
  ca::ConvexCore core_a, core_b;
  ca::Motion motion_a, motion_b;
};

// Hulls of `vertices` points on ellipsoids with radii of 0.5 to 1 m, all of them vertices of the hull; A at
// the origin, B 2.5 to 4 m away. In one second both fly towards each other's neighbourhood, so that about
// half of the pairs meet, and turn by up to `turn` rad (at most pi/4: Bullet turns no body farther).
inline std::vector<HullPair> hull_pairs(int count, int vertices, double turn, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 53>(random);
  };
  const auto direction = [&] {
    while (true) {
      const Vec3 d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (d.norm() > 0.1 && d.norm() < 1) return Vec3(d.normalized());
    }
  };
  const auto hull = [&] {
    const Vec3 radii(uniform(0.5, 1), uniform(0.5, 1), uniform(0.5, 1));
    std::vector<Vec3> points;
    for (int i = 0; i < vertices; ++i) points.push_back(direction().cwiseProduct(radii));
    return hull_mesh(points).value();
  };
  const auto body = [&](const Vec3& position, const Vec3& velocity) {
    RigidBody b;
    b.position = position;
    b.orientation = Quat(Eigen::AngleAxisd(uniform(0, 3), direction()));
    b.velocity = velocity;
    b.spin = uniform(0, turn) * direction();
    return ca::Motion(b);
  };
  std::vector<HullPair> pairs;
  for (int i = 0; i < count; ++i) {
    TriangleMesh a = hull(), b = hull();
    const Vec3 apart = uniform(2.5, 4) * direction();
    const Vec3 aim =
        uniform(0, 3.3) * direction();  // where B would be, seen from A, had it gone on for all the way
    const Vec3 relative = uniform(0.9, 1.5) * (aim - apart), half = uniform(0.2, 0.8) * relative;
    ca::ConvexCore core_a(a.vertices), core_b(b.vertices);
    const ca::Motion motion_a = body(Vec3::Zero(), half - relative), motion_b = body(apart, half);
    pairs.push_back({std::move(a), std::move(b), std::move(core_a), std::move(core_b), motion_a, motion_b});
  }
  return pairs;
}

}  // namespace fc::bench
