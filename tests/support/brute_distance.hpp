// Distances by brute force over features, in code that shares nothing with the library.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace fc::test {

template <class T>
using Vec = Eigen::Matrix<T, 3, 1>;
template <class T>
using Triangle = std::array<Vec<T>, 3>;  // may be a segment or a point: corners may repeat
template <class T>
using Soup = std::vector<Triangle<T>>;

template <class T>
T point_segment(const Vec<T>& p, const Vec<T>& a, const Vec<T>& b) {
  const Vec<T> e = b - a;
  const T length2 = e.squaredNorm();
  const T s = length2 > 0 ? std::clamp((p - a).dot(e) / length2, T(0), T(1)) : T(0);
  return (a + s * e - p).norm();
}

// The inside of the triangle only; its edges are handled elsewhere.
template <class T>
T point_triangle_inside(const Vec<T>& p, const Triangle<T>& t) {
  const Vec<T> n = (t[1] - t[0]).cross(t[2] - t[0]);
  const T size = n.norm();
  if (size == 0) return std::numeric_limits<T>::infinity();
  for (int k = 0; k < 3; ++k)
    if (n.cross(t[(k + 1) % 3] - t[k]).dot(p - t[k]) < 0) return std::numeric_limits<T>::infinity();
  return std::abs(n.dot(p - t[0])) / size;
}

template <class T>
T segment_segment(const Vec<T>& a, const Vec<T>& b, const Vec<T>& c, const Vec<T>& d) {
  T best = std::min(
      {point_segment(a, c, d), point_segment(b, c, d), point_segment(c, a, b), point_segment(d, a, b)});
  const Vec<T> u = b - a, v = d - c, n = u.cross(v);
  const T size2 = n.squaredNorm();
  if (size2 == 0) return best;
  const T s = (c - a).cross(v).dot(n) / size2, r = (c - a).cross(u).dot(n) / size2;
  if (s > 0 && s < 1 && r > 0 && r < 1) best = std::min(best, std::abs(n.dot(c - a)) / std::sqrt(size2));
  return best;
}

template <class T>
bool segment_pierces(const Vec<T>& a, const Vec<T>& b, const Triangle<T>& t) {
  const Vec<T> n = (t[1] - t[0]).cross(t[2] - t[0]);
  const T at_a = n.dot(a - t[0]), at_b = n.dot(b - t[0]);
  if (!((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0))) return false;
  const Vec<T> x = a + (b - a) * (at_a / (at_a - at_b));
  for (int k = 0; k < 3; ++k)
    if (n.cross(t[(k + 1) % 3] - t[k]).dot(x - t[k]) < 0) return false;
  return true;
}

template <class T>
bool triangles_cross(const Triangle<T>& s, const Triangle<T>& t) {
  for (int k = 0; k < 3; ++k)
    if (segment_pierces(s[k], s[(k + 1) % 3], t) || segment_pierces(t[k], t[(k + 1) % 3], s)) return true;
  return false;
}

template <class T>
T triangle_triangle(const Triangle<T>& s, const Triangle<T>& t) {
  if (triangles_cross(s, t)) return 0;
  T best = std::numeric_limits<T>::infinity();
  for (int i = 0; i < 3; ++i) {
    best = std::min({best, point_triangle_inside(s[i], t), point_triangle_inside(t[i], s)});
    for (int k = 0; k < 3; ++k)
      best = std::min(best, segment_segment(s[i], s[(i + 1) % 3], t[k], t[(k + 1) % 3]));
  }
  return best;
}

// The smallest distance over all pairs of triangles; pairs whose boxes are farther apart than the best so far
// are passed.
template <class T>
T soup_distance(const Soup<T>& a, const Soup<T>& b, T cutoff = std::numeric_limits<T>::infinity()) {
  using Box = Eigen::AlignedBox<T, 3>;
  const auto boxes = [](const Soup<T>& soup) {
    std::vector<Box> all;
    for (const auto& t : soup) {
      all.emplace_back();
      for (const auto& p : t) all.back().extend(p);
    }
    return all;
  };
  const std::vector<Box> box_a = boxes(a), box_b = boxes(b);
  T best = cutoff;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k)
      if (box_a[i].squaredExteriorDistance(box_b[k]) < best * best)
        best = std::min(best, triangle_triangle(a[i], b[k]));
  return best;
}

// Whether a point lies inside every outward plane of a closed convex surface (false for a flat one with two
// sides).
template <class T>
bool inside_convex(const Vec<T>& p, const Soup<T>& surface) {
  for (const auto& t : surface)
    if ((t[1] - t[0]).cross(t[2] - t[0]).dot(p - t[0]) >= 0) return false;
  return !surface.empty();
}

// Distance of two convex surfaces that are filled, 0 if they overlap.
template <class T>
T convex_distance(const Soup<T>& a, const Soup<T>& b) {
  if (inside_convex(a[0][0], b) || inside_convex(b[0][0], a)) return 0;
  return soup_distance(a, b);
}

}  // namespace fc::test
