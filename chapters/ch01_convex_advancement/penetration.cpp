#include "ch01_convex_advancement/penetration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "ch01_convex_advancement/gjk.hpp"
#include "ch01_convex_advancement/rounding.hpp"

namespace fc::ca {
namespace {

// As a share of the shapes' sizes: a thickness below this counts as none, and a point that is this far outside a
// face counts as on it.
constexpr double kFlat = 64 * kEpsilon;

// The Minkowski difference A - B of the cores, in A's axes, and the best direction found so far to part them.
struct Difference {
  const Convex& a;
  const Convex& b;
  const Pose& b_in_a;
  double least = std::numeric_limits<double>::infinity();  // m, the smallest h(n) so far
  Vec3 direction = Vec3::UnitX();
  int supports = 0;

  // The point that lies farthest along a unit n.
  Vec3 farthest(const Vec3& n) {
    ++supports;
    const Vec3 point = support(a, n).point - b_in_a * support(b, -(b_in_a.rotation.transpose() * n)).point;
    if (n.dot(point) < least) {
      least = n.dot(point);
      direction = n;
    }
    return point;
  }
};

struct Face {
  std::array<int, 3> corners;  // counter-clockwise, seen from outside
  Vec3 normal;                 // unit, outward
  double offset;               // m, of its plane from the origin along the normal
};

// A polytope whose corners lie on the surface of the difference.
class Polytope {
 public:
  // A first tetrahedron. False if the difference is flat: then the best direction is across it, or there is
  // none.
  bool begin(Difference& difference, double size) {
    // The longest of three edges, the corner farthest from it, the corner farthest from all three.
    double length = -1;
    std::array<Vec3, 2> edge;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 low = difference.farthest(-Vec3::Unit(axis)), high = difference.farthest(Vec3::Unit(axis));
      if ((high - low).norm() <= length) continue;
      length = (high - low).norm();
      edge = {low, high};
    }
    if (length <= kFlat * size) return false;
    const Vec3 along = (edge[1] - edge[0]) / length, across = along.unitOrthogonal();
    Vec3 third = farther(difference, edge[0], across, along);
    if (const Vec3 other = farther(difference, edge[0], along.cross(across), along);
        from_line(other, edge[0], along) > from_line(third, edge[0], along))
      third = other;
    if (from_line(third, edge[0], along) <= kFlat * size) {
      difference.farthest(across);
      return false;
    }
    const Vec3 normal = along.cross(third - edge[0]).normalized();
    const Vec3 up = difference.farthest(normal), down = difference.farthest(-normal);
    const double height = normal.dot(up - edge[0]), depth = -normal.dot(down - edge[0]);
    if (std::max(height, depth) <= kFlat * size) return false;
    corners_ = {edge[0], edge[1], third, height >= depth ? up : down};
    middle_ = 0.25 * (corners_[0] + corners_[1] + corners_[2] + corners_[3]);
    add_face({0, 1, 2});
    add_face({0, 1, 3});
    add_face({0, 2, 3});
    add_face({1, 2, 3});
    return true;
  }

  // The face whose plane is nearest to the origin.
  const Face& nearest() const {
    return *std::min_element(faces_.begin(), faces_.end(),
                             [](const Face& p, const Face& q) { return p.offset < q.offset; });
  }

  // Grows to hold the point, which lies outside at least one face: the faces that see it are removed, and
  // their rim is joined to it. False if rounding left nothing to join.
  bool grow(const Vec3& point, double rounding) {
    std::vector<std::pair<int, int>> rim;
    const auto sees = [&](const Face& face) { return face.normal.dot(point) > face.offset + rounding; };
    for (const Face& face : faces_) {
      if (!sees(face)) continue;
      for (int k = 0; k < 3; ++k) {
        const std::pair<int, int> edge{face.corners[k], face.corners[(k + 1) % 3]};
        const auto twin = std::find(rim.begin(), rim.end(), std::pair(edge.second, edge.first));
        if (twin == rim.end())
          rim.push_back(edge);
        else
          rim.erase(twin);  // between two faces that are both removed
      }
    }
    if (rim.empty()) return false;
    std::erase_if(faces_, sees);
    corners_.push_back(point);
    const int tip = static_cast<int>(corners_.size()) - 1;
    for (const auto& [from, to] : rim) add_face({from, to, tip});
    return true;
  }

 private:
  static double from_line(const Vec3& point, const Vec3& start, const Vec3& along) {
    return (point - start).cross(along).norm();
  }
  // Takes the farthest points along n and along -n; returns the one that is farther from the line.
  static Vec3 farther(Difference& difference, const Vec3& start, const Vec3& n, const Vec3& along) {
    const Vec3 p = difference.farthest(n), q = difference.farthest(-n);
    return from_line(p, start, along) >= from_line(q, start, along) ? p : q;
  }

  void add_face(std::array<int, 3> c) {
    const Vec3 &p = corners_[c[0]], &q = corners_[c[1]], &r = corners_[c[2]];
    Vec3 normal = (q - p).cross(r - p);
    const double area = normal.norm();
    if (area == 0) return;  // its three corners are in line: a neighbour has the same plane
    normal /= area;
    if (normal.dot(p - middle_) < 0) {
      normal = -normal;
      std::swap(c[1], c[2]);
    }
    // The plane of a sliver is only as good as its corners: it lies as far out as any of them.
    faces_.push_back({c, normal, std::max({normal.dot(p), normal.dot(q), normal.dot(r)})});
  }

  std::vector<Vec3> corners_;
  std::vector<Face> faces_;
  Vec3 middle_ = Vec3::Zero();
};

// The cores share a point: grows a polytope where it is nearest to the origin. Returns a lower bound of the
// depth.
double expand(Difference& difference, double size, double radii, const PenetrationOptions& options) {
  Polytope polytope;
  if (!polytope.begin(difference, size)) return difference.least;
  while (true) {
    const Face face = polytope.nearest();
    const Vec3 point = difference.farthest(face.normal);
    const double enough = std::max(options.relative * (difference.least + radii), kFlat * size);
    const bool done =
        difference.least - face.offset <= enough || difference.supports >= options.most_supports;
    if (done || !polytope.grow(point, kFlat * size)) return std::min(face.offset, difference.least);
  }
}

}  // namespace

Penetration penetration(const Convex& a, const Convex& b, const PairPose& pose,
                        const PenetrationOptions& options) {
  const double radii = a.radius + b.radius;
  const GjkResult g = distance(a, b, pose, {0, 1e-12, 128});
  Difference difference{a, b, pose.b_in_a};
  double lower = 0;
  if (g.cache.count > 0) {  // the cores are apart
    difference.farthest(pose.rotation_a.transpose() * g.normal);
    lower = difference.least;
  } else {
    lower = expand(difference, a.reach + b.reach + pose.b_in_a.position.norm(), radii, options);
  }
  return {difference.least + radii, pose.rotation_a * difference.direction, lower + radii,
          difference.supports + g.iterations};
}

}  // namespace fc::ca
