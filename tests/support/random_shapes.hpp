// Shapes and motions for tests, their poses in long double, and gaps by dense sampling.
#pragma once

#include <numbers>
#include <random>
#include <string>

#include "ch01_convex_advancement/gjk.hpp"
#include "common/convex_hull.hpp"
#include "common/mesh.hpp"
#include "tests/support/brute_distance.hpp"

namespace fc::test {

using Long = long double;
using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
inline int integer(Random& random, int low, int high) {  // both included
  return std::uniform_int_distribution<int>(low, high)(random);
}
inline double magnitude(Random& random, double low, double high) {  // evenly over the exponents
  return std::exp(uniform(random, std::log(low), std::log(high)));
}
inline Vec3 unit_vector(Random& random) {
  std::normal_distribution<double> normal;
  while (true) {
    const double x = normal(random), y = normal(random), z = normal(random);
    const double size = Vec3(x, y, z).norm();
    if (size > 1e-3) return Vec3(x, y, z) / size;
  }
}
inline Quat rotation(Random& random) {
  return Quat(Eigen::AngleAxisd(uniform(random, 0, std::numbers::pi), unit_vector(random)));
}

// A convex core of any dimension with its rounding radius. Its triangles cover the core's surface; of a point
// or a segment they have no area.
struct Solid {
  std::string name;
  TriangleMesh core;
  double radius = 0;

  ca::Convex convex() const { return {core.vertices, radius, ca::reach_of(core.vertices)}; }
  double reach() const { return ca::reach_of(core.vertices) + radius; }
};

inline TriangleMesh box_core(const Vec3& half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back((i & 1) ? half.x() : -half.x(), (i & 2) ? half.y() : -half.y(),
                               (i & 4) ? half.z() : -half.z());
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}
inline Solid sphere(double radius) {
  return {"sphere", {{Vec3::Zero()}, {{0, 0, 0}}}, radius};
}
inline Solid capsule(double radius, double length) {
  return {"capsule", {{Vec3(0, 0, -length / 2), Vec3(0, 0, length / 2)}, {{0, 1, 1}}}, radius};
}
inline Solid box(const Vec3& size) {
  return {"box", box_core(size / 2), 0};
}
inline Solid hull(const std::vector<Vec3>& points, double radius = 0) {
  return {"hull", hull_mesh(points).value(), radius};
}
inline Solid polygon(double reach, int corners) {  // flat
  Solid s{"polygon", {}, 0};
  for (int i = 0; i < corners; ++i) {
    const double phi = 2 * std::numbers::pi * i / corners;
    s.core.vertices.emplace_back(reach * std::cos(phi), reach * std::sin(phi), 0);
    if (i < 2) continue;
    s.core.triangles.push_back({0, i - 1, i});  // both sides, so that it has an inside: none
    s.core.triangles.push_back({0, i, i - 1});
  }
  return s;
}
inline Solid random_hull(Random& random, double size, int points) {
  std::vector<Vec3> all;
  for (int i = 0; i < points; ++i) all.push_back(size * uniform(random, 0.5, 1) * unit_vector(random));
  return hull(all);
}

// Any kind of shape, needles, plates and flat ones included; `size` in m is about its largest extent.
inline Solid random_solid(Random& random, double size) {
  switch (integer(random, 0, 7)) {
    case 0:
      return sphere(size * uniform(random, 0.05, 0.5));
    case 1:
      return capsule(size * uniform(random, 0.05, 0.3), size * uniform(random, 0.1, 1));
    case 2:
      return box(size * Vec3(uniform(random, 0.1, 1), uniform(random, 0.1, 1), uniform(random, 0.1, 1)));
    case 3:
      return box(size * Vec3(1, magnitude(random, 1e-4, 1e-2), magnitude(random, 1e-4, 1e-2)));  // needle
    case 4:
      return box(size * Vec3(1, uniform(random, 0.3, 1), magnitude(random, 1e-5, 1e-2)));  // plate
    case 5:
      return polygon(size / 2, integer(random, 3, 8));
    case 6: {
      Solid s = random_hull(random, size / 2, integer(random, 5, 30));
      s.radius = size * 0.05;
      return s;
    }
    default:
      return random_hull(random, size / 2, integer(random, 5, 40));
  }
}

inline ca::Motion motion(const Vec3& position, const Quat& orientation = Quat::Identity(),
                         const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero(),
                         const Vec3& acceleration = Vec3::Zero()) {
  RigidBody body;
  body.position = position;
  body.orientation = orientation;
  body.velocity = velocity;
  body.spin = spin;
  return ca::Motion(body, acceleration);
}

// The exact pose of the motion at t, in long double, with B's coordinates less A's position at t = 0: what
// rounds in the library does not round here.
struct LongPose {
  Eigen::Matrix<Long, 3, 3> rotation;
  Vec<Long> position;

  Vec<Long> operator*(const Vec3& x) const { return rotation * x.cast<Long>() + position; }
};
inline LongPose long_pose(const ca::Motion& m, Long t, const Vec3& origin) {
  // With drag: what is left of the time t, and of t^2/2; as series where the differences would cancel.
  const auto left = [&](Long k) { return k > 0 ? -std::expm1(-k * t) / k : t; };
  const auto square = [&](Long k) {
    if (k * t > 0.5L) return (t - left(k)) / k;
    Long term = 0.5L, sum = 0.5L;
    for (int n = 3; n <= 30; ++n) sum += term *= -k * t / n;
    return t * t * sum;
  };
  LongPose pose;
  pose.position = m.position.cast<Long>() - origin.cast<Long>() + left(m.drag) * m.velocity.cast<Long>() +
                  square(m.drag) * m.acceleration.cast<Long>();
  const Vec<Long> spin = m.spin.cast<Long>();
  const Long rate = spin.norm();
  pose.rotation = m.rotation.cast<Long>();
  if (m.free)  // chapter 1's tests hold this to an integration
    pose.rotation = m.free->rotation_at(m.free_time(static_cast<double>(t))).cast<Long>();
  else if (rate > 0)
    pose.rotation =
        Eigen::AngleAxis<Long>(rate * left(m.spin_drag), spin / rate).toRotationMatrix() * pose.rotation;
  return pose;
}

template <class T = Long>
Soup<T> placed(const TriangleMesh& mesh, const LongPose& pose) {
  std::vector<Vec<T>> x;
  for (const Vec3& v : mesh.vertices) x.push_back((pose * v).template cast<T>());
  Soup<T> soup;
  for (const auto& t : mesh.triangles) soup.push_back({x[t[0]], x[t[1]], x[t[2]]});
  return soup;
}

// The true distance of two moving shapes at t (negative: rounding radii overlap; 0: the cores overlap).
template <class T = Long>
T gap_at(const Solid& a, const ca::Motion& ma, const Solid& b, const ca::Motion& mb, Long t) {
  return convex_distance<T>(placed<T>(a.core, long_pose(ma, t, ma.position)),
                            placed<T>(b.core, long_pose(mb, t, ma.position))) -
         T(a.radius) - T(b.radius);
}

// The support gap along n (from A to B) in long double.
inline Long true_support_gap(const Solid& a, const ca::Motion& ma, const Solid& b, const ca::Motion& mb,
                             Long t, const Vec3& normal) {
  const Vec<Long> n = normal.cast<Long>().normalized();
  const LongPose pa = long_pose(ma, t, ma.position), pb = long_pose(mb, t, ma.position);
  Long top = -std::numeric_limits<Long>::infinity(), bottom = std::numeric_limits<Long>::infinity();
  for (const Vec3& v : a.core.vertices) top = std::max(top, n.dot(pa * v));
  for (const Vec3& v : b.core.vertices) bottom = std::min(bottom, n.dot(pb * v));
  return bottom - top - Long(a.radius) - Long(b.radius);
}

}  // namespace fc::test
