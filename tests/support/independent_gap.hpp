// An independent overlap check for any two shapes of a scene: balls, rods, blocks, hulls and meshes, each as triangles
// (or a point, or a segment) with a rounding radius. Slow, plain, and without any code of the engine.
#pragma once

#include <optional>

#include "support/independent_overlap.hpp"

namespace independent {

// Everything within `radius` of a core. A core without volume (a ball's point, a rod's segment) is one
// triangle whose corners coincide.
struct Rounded {
  Mesh core;                  // in the shape's own frame
  double reach = 0;           // m, of the core from the frame's origin
  double radius = 0;          // m
  bool closed = false;        // the core has an inside
  std::optional<Solid> tree;  // of many triangles: for two of these
};
Rounded rounded_ball(double radius);
Rounded rounded_rod(double radius, double length);  // along z, without the caps
Rounded rounded_block(const Vec& size);
Rounded rounded_hull(const std::vector<Vec>& points);  // of a handful of points: every triple is tried
Rounded rounded_mesh(const Mesh& mesh);

// The smallest distance of two triangles, or of what is left of them; 0 if they cross.
double distance(const std::array<Vec, 3>& a, const std::array<Vec, 3>& b);

// Whether the two are apart, or overlap by at most `allowed` (m, >= 0). For meshes: whether their surfaces do not cross
// and neither lies inside the other.
bool apart(const Rounded& a, const State& at_a, const Rounded& b, const State& at_b, double allowed);

}  // namespace independent
