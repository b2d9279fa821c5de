// Exercise 2.4: an oriented box.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/types.hpp"

namespace fc::exercises {

// A box in single precision: half the memory, and twice as many in a register. It is the set of all points
//   center + s_0 u_0 + s_1 u_1 + s_2 u_2,   |s_i| <= half_i,
// with u_i the columns of `axes` as they stand: floats are seldom exactly unit or exactly perpendicular.
struct Box {
  Eigen::Vector3f center;  // m
  Eigen::Matrix3f axes;    // columns: unit and perpendicular up to 1e-6, right-handed
  Eigen::Vector3f half;    // m, >= 0
};

// The nearest floats. Given; use it for every float that you compare with afterwards: where a double is
// converted to float and back, GCC 12 may use the double from before. This goes through memory.
inline Eigen::Vector3f nearest_floats(const Vec3& x) {
  Eigen::Vector3f result;
  for (int k = 0; k < 3; ++k) {
    volatile float nearest = static_cast<float>(x[k]);
    result[k] = nearest;
  }
  return result;
}

// Half the surface, m^2: proportional to how often, on average, something else hits the box.
inline double surface(const Box& box) {
  const Vec3 h = box.half.cast<double>();
  return 4 * (h[0] * h[1] + h[1] * h[2] + h[2] * h[0]);
}

// A small box around some points (m; at least one; all finite, within 1e6 m of the origin; perhaps all in a
// plane, on a line, or in one place).
//   It contains them, in exact arithmetic, up to 1e-12 of their distance from the origin.
//   Its surface is at most 1.1 times that of the best box (there is no formula for that one; the tests know
//   it for their points), and never larger than that of the box along x, y, z: both up to the rounding of
//   floats, about 1e-7 of the distance from the origin in each half side.
Box fit_box(std::span<const Vec3> points);

// ---- Given: a hierarchy that uses your boxes, and the question that the tests ask it. ----

using Triangle = std::array<Vec3, 3>;  // m
using Fit = Box (*)(std::span<const Vec3>);

// A binary tree over triangles, split at the median along the box's longest side; node 0 is the root.
struct Tree {
  struct Node {
    Box box;
    int left = -1, right = -1;  // -1: a leaf
  };
  std::vector<Node> nodes;

  Tree(std::vector<Triangle> triangles, Fit fit) { build(triangles.begin(), triangles.end(), fit); }

 private:
  int build(std::vector<Triangle>::iterator begin, std::vector<Triangle>::iterator end, Fit fit) {
    std::vector<Vec3> points;
    for (auto t = begin; t != end; ++t) points.insert(points.end(), t->begin(), t->end());
    const int own = static_cast<int>(nodes.size());
    nodes.push_back({fit(points)});
    if (end - begin == 1) return own;
    int longest = 0;
    nodes[own].box.half.maxCoeff(&longest);
    const Vec3 along = nodes[own].box.axes.col(longest).cast<double>();
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [&](const Triangle& s, const Triangle& t) {
      return along.dot(s[0] + s[1] + s[2]) < along.dot(t[0] + t[1] + t[2]);
    });
    nodes[own].left = build(begin, middle, fit);
    const int right = build(middle, end, fit);
    nodes[own].right = right;
    return own;
  }
};

// A lower bound of the distance of two boxes, m: the widest slab across one of 15 directions. 0: no slab.
inline double gap(const Box& a, const Box& b) {
  const Mat3 u = a.axes.cast<double>(), v = b.axes.cast<double>();
  const Vec3 apart = (b.center - a.center).cast<double>();
  double best = 0;
  const auto slab = [&](const Vec3& n) {
    if (n.squaredNorm() < 1e-8) return;
    const double room = std::abs(n.dot(apart)) - (u.transpose() * n).cwiseAbs().dot(a.half.cast<double>()) -
                        (v.transpose() * n).cwiseAbs().dot(b.half.cast<double>());
    best = std::max(best, room / n.norm());
  };
  for (int i = 0; i < 3; ++i) {
    slab(u.col(i));
    slab(v.col(i));
    for (int k = 0; k < 3; ++k) slab(u.col(i).cross(v.col(k)));
  }
  return best;
}

// The number of pairs of nodes that it takes to find which pairs of leaves can be within `near` (m) of each
// other.
inline std::int64_t node_pairs(const Tree& a, const Tree& b, double near, int i = 0, int j = 0) {
  const Tree::Node &x = a.nodes[i], &y = b.nodes[j];
  if (gap(x.box, y.box) > near || (x.left < 0 && y.left < 0)) return 1;
  if (x.left >= 0 && (y.left < 0 || x.box.half.norm() >= y.box.half.norm()))
    return 1 + node_pairs(a, b, near, x.left, j) + node_pairs(a, b, near, x.right, j);
  return 1 + node_pairs(a, b, near, i, y.left) + node_pairs(a, b, near, i, y.right);
}

}  // namespace fc::exercises
