// Where two solids overlap, the shared volume has corners, and from each of them runs a piece of an edge of one
// of the two that lies within the other, or flush with its surface. So we cut every edge where it meets another
// part, go to the middle of each piece, from there a little way into the edge's triangle and under it, and ask
// how often the surface winds around that point. Where parts keep clear of each other no edge is cut, and one
// point shows whether one lies within the other.
#include "common/mesh_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unsupported/Eigen/BVH>

namespace fc {
namespace {

using Box = Eigen::AlignedBox3d;
using Tree = Eigen::KdBVH<double, 3, int>;

// The depth under a surface at which we look, as a share of the mesh's extent: well above the rounding of
// floats, 6e-8, so that parts drawn flush in a file of floats do not overlap.
constexpr double kDepth = 1e-6;
// The distance from an edge into its triangle, in depths: far enough that the point under it lies inside
// every wedge of more than 6 degrees.
constexpr double kWayIn = 10;

// A ray from a point to infinity, and how often a surface winds around that point.
struct Ray {
  const TriangleMesh& mesh;
  Vec3 from, direction;
  int windings = 0;     // crossings outwards less those inwards
  bool unsure = false;  // it passes an edge so closely that rounding decides

  bool intersectVolume(const Box& box) const {
    const Vec3 low = (box.min() - from).cwiseQuotient(direction);
    const Vec3 high = (box.max() - from).cwiseQuotient(direction);
    const double margin = 1e-9 * box.diagonal().norm();
    return low.cwiseMin(high).maxCoeff() <= low.cwiseMax(high).minCoeff() + margin &&
           low.cwiseMax(high).minCoeff() >= -margin;
  }

  bool intersectObject(int t) {
    std::array<Vec3, 3> v;
    for (int i = 0; i < 3; ++i) v[i] = mesh.vertices[mesh.triangles[t][i]] - from;
    int left = 0, right = 0;  // edges that the ray certainly passes on their left, right
    for (int i = 0; i < 3; ++i) {
      const Vec3 &a = v[i], &b = v[(i + 1) % 3];
      const double side = direction.dot(a.cross(b));
      const double rounding = 16 * std::numeric_limits<double>::epsilon() * a.norm() * b.norm();
      left += side > rounding;
      right += side < -rounding;
    }
    if (left > 0 && right > 0) return false;
    if (left < 3 && right < 3) return unsure = true;
    const Vec3 normal = (v[1] - v[0]).cross(v[2] - v[0]);
    const bool leaves = normal.dot(direction) > 0;
    if ((normal.dot(v[0]) > 0) == leaves) windings += leaves ? 1 : -1;
    return false;
  }
};

Box box_of(const TriangleMesh& mesh, int t) {
  Box box;
  for (int v : mesh.triangles[t]) box.extend(mesh.vertices[v]);
  return box;
}

// The triangles whose box meets a given one.
struct Near {
  const TriangleMesh& mesh;
  Box box;
  std::vector<int> triangles = {};

  bool intersectVolume(const Box& other) const { return box.intersects(other); }
  bool intersectObject(int t) {
    if (box.intersects(box_of(mesh, t))) triangles.push_back(t);
    return false;
  }
};

// A component: what lies inside it lies in its box.
struct Part {
  std::vector<int> triangles;
  Box box;
  std::vector<int> partners;  // the parts whose box shares more than the depth with this one
  Tree tree;                  // of its triangles, if it has partners
  bool overlaps = false;
  int looks_left = 8;  // at edges with nothing near
};

class Overlaps {
 public:
  Overlaps(const TriangleMesh& mesh, const std::vector<int>& component, int components)
      : mesh_(mesh), parts_(components) {
    Box all;
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      Part& part = parts_[component[t]];
      part.triangles.push_back(t);
      part.box.extend(box_of(mesh, t));
      all.extend(box_of(mesh, t));
    }
    depth_ = kDepth * std::max(all.diagonal().norm(), all.min().cwiseMin(-all.max()).cwiseAbs().maxCoeff());
  }

  int count() {
    find_partners();
    for (Part& part : parts_) {
      if (part.partners.empty()) continue;
      std::vector<Box> boxes;
      for (int t : part.triangles) boxes.push_back(box_of(mesh_, t));
      part.tree.init(part.triangles.begin(), part.triangles.end(), boxes.begin(), boxes.end());
    }
    for (Part& part : parts_) {
      if (part.partners.empty()) continue;
      for (int t : part.triangles) look_under(part, t);
    }
    return static_cast<int>(
        std::count_if(parts_.begin(), parts_.end(), [](const Part& part) { return part.overlaps; }));
  }

 private:
  void find_partners() {
    std::vector<int> order(parts_.size());
    std::iota(order.begin(), order.end(), 0);
    const auto start = [&](int part) { return parts_[part].box.min().x(); };
    std::sort(order.begin(), order.end(), [&](int a, int b) { return start(a) < start(b); });
    for (std::size_t i = 0; i < order.size(); ++i) {
      Part& a = parts_[order[i]];
      for (std::size_t k = i + 1; k < order.size() && start(order[k]) < a.box.max().x(); ++k) {
        Part& b = parts_[order[k]];
        if ((a.box.intersection(b.box).sizes().array() <= depth_).any()) continue;
        a.partners.push_back(order[k]);
        b.partners.push_back(order[i]);
      }
    }
  }

  // The triangles near triangle t that belong to other parts not yet known to overlap.
  std::vector<int> near(const Part& part, int t) const {
    const Box own = box_of(mesh_, t);
    Near found{mesh_, Box(own.min().array() - 2 * depth_, own.max().array() + 2 * depth_)};
    for (int partner : part.partners) {
      const Part& other = parts_[partner];
      if ((part.overlaps && other.overlaps) || !found.box.intersects(other.box)) continue;
      Eigen::BVIntersect(other.tree, found);
    }
    return std::move(found.triangles);
  }

  // Looks under triangle t, in the middle of each piece into which other parts cut its edges.
  void look_under(Part& part, int t) {
    const std::vector<int> others = near(part, t);
    if (others.empty() && (part.overlaps || part.looks_left-- <= 0)) return;
    std::array<Vec3, 3> v;
    for (int i = 0; i < 3; ++i) v[i] = mesh_.vertices[mesh_.triangles[t][i]];
    const Vec3 normal = (v[1] - v[0]).cross(v[2] - v[0]);
    if (normal.isZero(0)) return;
    const Vec3 down = -normal.normalized();
    for (int i = 0; i < 3; ++i) {
      const Vec3 &a = v[i], &b = v[(i + 1) % 3];
      const double length = (b - a).norm();
      std::vector<double> cuts = {0, 1};
      for (int other : others) add_cuts(a, b, other, cuts);
      std::sort(cuts.begin(), cuts.end());
      const Vec3 outward = down.cross(b - a).normalized();
      for (std::size_t k = 1; k < cuts.size(); ++k) {
        if ((cuts[k] - cuts[k - 1]) * length <= depth_) continue;
        const Vec3 middle = a + (cuts[k - 1] + cuts[k]) / 2 * (b - a);
        look_at(part, middle + depth_ * (down - kWayIn * outward));
      }
    }
  }

  // Where the edge from a to b passes through a triangle, or meets its corners or edges, in shares of its
  // length.
  void add_cuts(const Vec3& a, const Vec3& b, int triangle, std::vector<double>& cuts) const {
    const Vec3 along = b - a;
    const auto add = [&](double share, const Vec3& there) {
      if (share > 0 && share < 1 && (a + share * along - there).norm() <= 2 * depth_) cuts.push_back(share);
    };
    std::array<Vec3, 3> v;
    for (int i = 0; i < 3; ++i) v[i] = mesh_.vertices[mesh_.triangles[triangle][i]] - a;
    const Vec3 normal = (v[1] - v[0]).cross(v[2] - v[0]);
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
      const Vec3 &p = v[i], side = v[(i + 1) % 3] - p;
      add(p.dot(along) / along.squaredNorm(), a + p);
      const Vec3 across = along.cross(side);
      if (across.squaredNorm() > 0) {
        const double on_side = p.cross(along).dot(across) / across.squaredNorm();
        const double share = p.cross(side).dot(across) / across.squaredNorm();
        if (on_side >= 0 && on_side <= 1) add(share, a + p + on_side * side);
      }
      inside = inside && p.cross(v[(i + 1) % 3]).dot(along) * normal.dot(along) >= 0;
    }
    if (!inside || normal.dot(along) == 0) return;
    const double share = normal.dot(v[0]) / normal.dot(along);
    add(share, a + share * along);
  }

  // How often a part winds around a point; 0 where rounding leaves that in doubt.
  int windings(const Part& part, const Vec3& point) const {
    if (!part.box.contains(point)) return 0;
    for (const Vec3& direction : {Vec3(0.834, 0.441, 0.332), Vec3(-0.371, 0.873, -0.316),
                                  Vec3(-0.291, -0.413, 0.863), Vec3(0.536, -0.523, -0.663)}) {
      Ray ray{mesh_, point, direction};
      Eigen::BVIntersect(part.tree, ray);
      if (!ray.unsure) return ray.windings;
    }
    return 0;
  }

  // At a point just under a triangle of `part`: if the whole surface winds around it more than once, the parts
  // that do overlap.
  void look_at(Part& part, const Vec3& point) {
    int total = 0;
    std::vector<Part*> around;
    const auto add = [&](Part& one) {
      const int more = windings(one, point);
      if (more > 0) around.push_back(&one);
      total += more;
    };
    add(part);
    for (int partner : part.partners) add(parts_[partner]);
    if (total < 2 || around.size() < 2 || is_on_surface(around, point)) return;
    for (Part* one : around) one->overlaps = true;
  }

  // Whether some surface is so close that rounding may have decided.
  bool is_on_surface(const std::vector<Part*>& parts, const Vec3& point) const {
    Near found{mesh_, Box(point.array() - depth_ / 2, point.array() + depth_ / 2)};
    for (const Part* part : parts) Eigen::BVIntersect(part->tree, found);
    return std::any_of(found.triangles.begin(), found.triangles.end(), [&](int t) {
      const auto& [i, j, k] = mesh_.triangles[t];
      const Vec3 normal =
          (mesh_.vertices[j] - mesh_.vertices[i]).cross(mesh_.vertices[k] - mesh_.vertices[i]);
      return std::abs(normal.dot(point - mesh_.vertices[i])) < depth_ / 2 * normal.norm();
    });
  }

  const TriangleMesh& mesh_;
  std::vector<Part> parts_;
  double depth_ = 0;  // m
};

}  // namespace

int count_overlapping(const TriangleMesh& mesh, const std::vector<int>& component, int components) {
  if (components < 2) return 0;
  return Overlaps(mesh, component, components).count();
}

}  // namespace fc
