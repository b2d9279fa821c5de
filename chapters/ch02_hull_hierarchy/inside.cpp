#include "ch02_hull_hierarchy/inside.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace fc::hulls {
namespace {

constexpr double kTripleRounding = 32 * std::numeric_limits<double>::epsilon();

// Counts the triangles through which a ray from `point` along `direction` leaves the mesh, less those through
// which it enters. Empty if the ray comes too close to an edge, or begins too close to a triangle, to be
// sure.
struct Ray {
  const Model& model;
  Vec3 point, direction;  // shape axes; unit
  int leaving = 0;

  bool may_meet(const BoxQuad& quad,
                int lane) const {  // the box's ball, with room for the rounding of floats
    const Vec3 c = Vec3(quad.center.x[lane], quad.center.y[lane], quad.center.z[lane]) - point;
    const double along = c.dot(direction), radius = quad.radius[lane] * (1 + 1e-5) + 1e-6 * model.reach;
    return along >= -radius && c.squaredNorm() - along * along <= radius * radius;
  }
  bool triangle(std::span<const Vec3> corners) {  // false: too close to call
    const Vec3 a = corners[0] - point, b = corners[1] - point, c = corners[2] - point;
    const double size = std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
    const double ab = direction.dot(a.cross(b)), bc = direction.dot(b.cross(c)),
                 ca = direction.dot(c.cross(a));
    const double doubt = kTripleRounding * size;
    if ((ab > doubt || bc > doubt || ca > doubt) && (ab < -doubt || bc < -doubt || ca < -doubt)) return true;
    if (std::min({std::abs(ab), std::abs(bc), std::abs(ca)}) <= doubt) return false;
    const double height = a.dot((b - a).cross(c - a));  // > 0: the triangle is seen from behind
    if (std::abs(height) <= doubt * std::sqrt(size)) return false;
    if ((height > 0) == (ab > 0)) leaving += ab > 0 ? 1 : -1;  // ahead of the point, not behind it
    return true;
  }
  bool node(int quad_id, int lane) {
    const BoxQuad& quad = model.boxes.quads[quad_id];
    if (!may_meet(quad, lane)) return true;
    const int child = quad.child[lane];
    if (child < 0) return triangle(model.boxes.leaf_points(~child));
    for (int k = 0; k < 4 && model.boxes.quads[child].child[k] != 0; ++k)
      if (!node(child, k)) return false;
    return true;
  }
  std::optional<int> count() { return node(0, 0) ? std::optional(leaving) : std::nullopt; }
};

// By the first of a few rays that keeps clear of all edges. If none does, and for a convex shape, which is
// one leaf: by the solid angles of all triangles.
double windings(const Model& model, const Vec3& point) {
  if (model.filled) return winding_number(model.mesh, point);
  static constexpr std::array<std::array<double, 3>, 4> kDirections{
      {{0.31, 0.52, 0.796}, {-0.67, 0.23, 0.705}, {0.41, -0.83, 0.378}, {-0.29, -0.37, -0.883}}};
  for (const auto& [x, y, z] : kDirections)
    if (const auto count = Ray{model, point, Vec3(x, y, z).normalized()}.count()) return *count;
  return winding_number(model.mesh, point);
}

bool component_inside(const Model& inner, const Model& outer, const Pose& inner_in_outer, double tolerance) {
  if (outer.filled || !outer.mesh.solid)
    return false;  // a filled hull meets what is inside it; a surface has no inside
  const auto near = [&](const Vec3& x) { return (inner_in_outer * x).norm() < outer.reach; };
  const auto inside = [&](const Vec3& x) { return near(x) && windings(outer, inner_in_outer * x) > 0.5; };
  if (!inner.parts.empty() || inner.curved()) {  // the middle of a convex leaf is inside it
    for (int leaf = 0; leaf < inner.boxes.leaves(); ++leaf)
      if (inside(inner.leaf(leaf).center)) return true;
    return false;
  }
  if (inner.component_triangle.empty()) return inside(inner.mesh.vertices[0]);
  for (const int t : inner.component_triangle) {
    const auto& [i, j, k] = inner.mesh.triangles[t];
    const Vec3 on = (inner.mesh.vertices[i] + inner.mesh.vertices[j] + inner.mesh.vertices[k]) / 3;
    const Vec3 below = on - 2 * tolerance * inner.mesh.normals[t];
    if (!near(on) && !near(below)) continue;
    // Where the body is thinner than that, the point below is outside again: then a point of the surface
    // itself is tested.
    const bool thick = inner.mesh.solid && windings(inner, below) > 0.5;
    if (inside(thick ? below : on)) return true;
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

bool one_inside_other(const Model& a, const Model& b, const ca::PairPose& pose, double tolerance) {
  const Pose& b_in_a = pose.b_in_a;
  const Pose a_in_b{b_in_a.rotation.transpose(), -(b_in_a.rotation.transpose() * b_in_a.position)};
  return component_inside(a, b, a_in_b, tolerance) || component_inside(b, a, b_in_a, tolerance);
}

}  // namespace fc::hulls
