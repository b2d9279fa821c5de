#include "ch02_hull_hierarchy/inside.hpp"

#include <cmath>
#include <numbers>

namespace fc::hulls {
namespace {

bool component_inside(const Model& inner, const Model& outer, const Pose& inner_in_outer) {
  if (outer.filled || !outer.mesh.solid)
    return false;  // a filled hull meets what is inside it; a surface has no inside
  for (const int v : inner.component_vertex) {
    const Vec3 p = inner_in_outer * inner.mesh.vertices[v];
    if (p.norm() < outer.reach && winding_number(outer.mesh, p) > 0.5) return true;
  }
  return false;
}

}  // namespace

double winding_number(const FeatureMesh& mesh, const Vec3& point) {
  double angle = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = mesh.vertices[i] - point, b = mesh.vertices[j] - point, c = mesh.vertices[k] - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (2 * std::numbers::pi);
}

bool one_inside_other(const Model& a, const Model& b, const ca::PairPose& pose) {
  const Pose& b_in_a = pose.b_in_a;
  const Pose a_in_b{b_in_a.rotation.transpose(), -(b_in_a.rotation.transpose() * b_in_a.position)};
  return component_inside(a, b, a_in_b) || component_inside(b, a, b_in_a);
}

}  // namespace fc::hulls
