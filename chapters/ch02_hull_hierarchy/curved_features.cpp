#include "ch02_hull_hierarchy/curved_features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace fc::hulls {
namespace {

using ca::FeatureKind;
using ca::FeaturePair;
using Vec2 = Eigen::Vector2d;

constexpr double kFacing = 0.05;    // cosine: a face that turns farther away has no height along the normal
constexpr double kParallel = 1e-3;  // sine of the angle between segments that lie along each other
constexpr double kSame = 1e-9;      // of both reaches: corners nearer than this are one
constexpr double kAsGood = 1e-13;   // of both reaches: planes whose gaps differ by less are equally good

double cross2(const Vec2& u, const Vec2& v) {
  return u.x() * v.y() - u.y() * v.x();
}

// The plane across the normal.
struct Frame {
  Vec3 u, v, n;
  explicit Frame(const Vec3& normal) : u(normal.unitOrthogonal()), v(normal.cross(u)), n(normal) {}
  Vec2 flat(const Vec3& x) const { return {u.dot(x), v.dot(x)}; }
  Vec3 at(const Vec2& c, double height) const { return c.x() * u + c.y() * v + height * n; }
};

// A plane of a side's surface, in A's axes.
struct Plane {
  Vec3 normal, point;
};

// One of the two sides, seen along the normal.
struct Seen {
  const Model& model;
  int triangle;  // the leaf's, of a mesh; else -1
  Pose pose;     // to A's axes
  double sign;   // of the normal, outward: +1 for A
  std::vector<Vec2> corners{};
  std::vector<double> heights{};  // m, of the corners along the normal
  std::vector<Plane> planes{};    // of three corners or more: the surface over them
  FeatureKind kind = FeatureKind::vertex;
  int id = 0;

  Vec3 outward(const Frame& frame) const { return pose.rotation.transpose() * (sign * frame.n); }
  void add(const Frame& frame, const Vec3& point) {
    corners.push_back(frame.flat(point));
    heights.push_back(frame.n.dot(point));
  }

  void look(const Frame& frame, double depth) {
    corners.clear();
    heights.clear();
    planes.clear();
    if (model.curved()) {
      const Outline outline = outline_of(model, outward(frame));
      for (int k = 0; k < outline.count; ++k) add(frame, pose * outline.corners[static_cast<std::size_t>(k)]);
      if (outline.count > 2) planes.push_back({pose.rotation * outline.normal, pose * outline.corners[0]});
      if (outline.count > 2 && sign < 0) {  // anticlockwise along the normal
        std::reverse(corners.begin(), corners.end());
        std::reverse(heights.begin(), heights.end());
      }
      kind = outline.kind;
      id = outline.id;
      return;
    }
    look_at_polyhedron(frame, depth);
  }

  // The hull of the vertices that are near the support plane, anticlockwise, and the planes of the faces.
  void look_at_polyhedron(const Frame& frame, double depth) {
    const Vec3 direction = outward(frame);
    const auto& vertices = model.mesh.vertices;
    std::vector<int> near;
    for (int v = 0; triangle < 0 && v < static_cast<int>(vertices.size()); ++v) near.push_back(v);
    if (triangle >= 0)
      near.assign(model.mesh.triangles[triangle].begin(), model.mesh.triangles[triangle].end());
    double most = -std::numeric_limits<double>::infinity();
    for (const int v : near) most = std::max(most, direction.dot(vertices[v]));
    std::erase_if(near, [&](int v) { return direction.dot(vertices[v]) < most - depth; });
    id = near.front();
    std::vector<std::pair<Vec2, double>> points;
    for (const int v : near) {
      const Vec3 x = pose * vertices[v];
      points.emplace_back(frame.flat(x), frame.n.dot(x));
    }
    keep_hull(points);
    if (corners.size() == 2) kind = FeatureKind::edge;
    if (corners.size() == 2) id = edge_between(near);
    if (corners.size() <= 2) return;
    kind = FeatureKind::face;
    double best = -1;
    for (int t = std::max(triangle, 0); t < static_cast<int>(model.mesh.triangles.size()); ++t) {
      if (triangle >= 0 && t > triangle) break;
      const double along = model.mesh.normals[t].dot(direction);
      const double facing = triangle >= 0 ? std::abs(along) : along;  // a triangle alone has two sides
      if (facing < kFacing) continue;
      planes.push_back({pose.rotation * (along < 0 ? Vec3(-model.mesh.normals[t]) : model.mesh.normals[t]),
                        pose * vertices[model.mesh.triangles[t][0]]});
      if (facing > best) id = t;
      best = std::max(best, facing);
    }
  }

  int edge_between(const std::vector<int>& near) const {
    for (int e = 0; e < static_cast<int>(model.mesh.edges.size()); ++e) {
      const auto& [i, j] = model.mesh.edges[e].vertex;
      const auto has = [&](int v) { return std::find(near.begin(), near.end(), v) != near.end(); };
      if (has(i) && has(j) && !model.mesh.edges[e].flat) return e;
    }
    return 0;
  }

  // Andrew's monotone chain.
  void keep_hull(std::vector<std::pair<Vec2, double>> points) {
    std::sort(points.begin(), points.end(), [](const auto& p, const auto& q) {
      return p.first.x() != q.first.x() ? p.first.x() < q.first.x() : p.first.y() < q.first.y();
    });
    const double flat = kSame * model.reach;
    std::vector<std::pair<Vec2, double>> hull;
    for (const bool back : {false, true}) {
      const std::size_t start = hull.size();
      for (std::size_t k = 0; k < points.size(); ++k) {
        const auto& p = back ? points[points.size() - 1 - k] : points[k];
        while (hull.size() >= start + 2) {
          const Vec2 side = hull.back().first - hull[hull.size() - 2].first;
          if (cross2(side, p.first - hull.back().first) > flat * side.norm()) break;
          hull.pop_back();
        }
        hull.push_back(p);
      }
      hull.pop_back();  // it begins the other half
    }
    if (hull.empty()) hull.push_back(points.front());
    for (const auto& [place, height] : hull) {
      corners.push_back(place);
      heights.push_back(height);
    }
  }

  // The height of the surface over a place among the corners.
  double height(const Frame& frame, const Vec2& place) const {
    if (corners.size() == 1) return heights[0];
    if (corners.size() == 2) {
      const Vec2 line = corners[1] - corners[0];
      const double s = std::clamp(line.dot(place - corners[0]) / line.squaredNorm(), 0.0, 1.0);
      return heights[0] + s * (heights[1] - heights[0]);
    }
    double height = std::numeric_limits<double>::infinity();  // outward; a convex surface is under its planes
    for (const Plane& plane : planes)
      height = std::min(
          height, plane.normal.dot(plane.point - frame.at(place, 0)) / (sign * plane.normal.dot(frame.n)));
    return sign * height;
  }
};

// The part of a polygon, a segment or a point that lies left of the line from p to q, or no more than the
// border (m) right of it.
std::vector<Vec2> cut(const std::vector<Vec2>& subject, const Vec2& p, const Vec2& q, double border) {
  std::vector<Vec2> left;
  const auto side = [&](const Vec2& c) { return cross2(q - p, c - p) / (q - p).norm(); };
  const std::size_t lines = subject.size() > 2 ? subject.size() : subject.size() - 1;
  for (std::size_t k = 0; k < subject.size(); ++k) {
    const double here = side(subject[k]);
    if (here >= -border) left.push_back(subject[k]);
    if (k >= lines) break;
    const Vec2& to = subject[(k + 1) % subject.size()];
    const double there = side(to);
    if ((here >= -border) == (there >= -border)) continue;
    left.push_back(subject[k] + std::clamp(here / (here - there), 0.0, 1.0) * (to - subject[k]));
  }
  return left;
}

// Where two segments lie over each other: a point, or two ends if they are parallel.
std::vector<Vec2> shared_segment(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  const Vec2 d = a[1] - a[0], e = b[1] - b[0];
  const double across = cross2(d, e);
  if (std::abs(across) > kParallel * d.norm() * e.norm()) {
    const double s = cross2(b[0] - a[0], e) / across, t = cross2(b[0] - a[0], d) / across;
    if (s < 0 || s > 1 || t < 0 || t > 1) return {};
    return {a[0] + s * d};
  }
  const double s0 = d.dot(b[0] - a[0]) / d.squaredNorm(), s1 = d.dot(b[1] - a[0]) / d.squaredNorm();
  const double from = std::max(0.0, std::min(s0, s1)), to = std::min(1.0, std::max(s0, s1));
  if (from > to) return {};
  return {a[0] + from * d, a[0] + to * d};
}

std::vector<Vec2> shared_corners(const std::vector<Vec2>& a, const std::vector<Vec2>& b, double border) {
  if (a.size() == 1) return a;
  if (b.size() == 1) return b;
  if (a.size() == 2 && b.size() == 2) return shared_segment(a, b);
  const bool cut_a = b.size() > 2 && (a.size() <= b.size() || a.size() == 2);
  std::vector<Vec2> shared = cut_a ? a : b;
  const std::vector<Vec2>& cutter = cut_a ? b : a;
  for (std::size_t k = 0; k < cutter.size() && !shared.empty(); ++k)
    shared = cut(shared, cutter[k], cutter[(k + 1) % cutter.size()], border);
  return shared;
}

// The best separating plane of two leaves among those tried. A later one also wins if it is as good up to
// rounding: those with exact normals come last.
struct BestPlane {
  const ca::Convex leaf_a, leaf_b;
  const ca::PairPose& pose;
  double as_good;  // m
  Vec3 normal;     // unit, world, from A to B
  double gap;      // m

  BestPlane(const ca::Convex& a, const ca::Convex& b, const ca::PairPose& at, const Vec3& first)
      : leaf_a(a),
        leaf_b(b),
        pose(at),
        as_good(kAsGood * (a.reach + b.reach + at.b_in_a.position.norm())),
        normal(first),
        gap(ca::support_gap(a, b, at, first)) {}

  void look(const Vec3& other) {
    const double along = ca::support_gap(leaf_a, leaf_b, pose, other);
    if (!(along >= gap - as_good)) return;
    gap = std::max(gap, along);
    normal = other;
  }
};

// The normal of a polyhedron's face that faces there best; of a mesh's triangle, its normal turned towards
// there.
std::optional<Vec3> face_towards(const Seen& side, const Vec3& outward) {
  const FeatureMesh& mesh = side.model.mesh;
  int face = side.triangle;
  for (int t = 0; side.triangle < 0 && t < static_cast<int>(mesh.triangles.size()); ++t)
    if (face < 0 || mesh.normals[t].dot(outward) > mesh.normals[face].dot(outward)) face = t;
  if (face < 0) return std::nullopt;
  return mesh.normals[face].dot(outward) < 0 ? Vec3(-mesh.normals[face]) : mesh.normals[face];
}

// The unit normal (world, from A to B) of the best separating plane: GJK's, that of a curved side's line, a
// cap's, or a face's.
void look_at_surfaces(const Seen& a, const Seen& b, BestPlane& best) {
  const Vec3 found = best.normal;
  enum { side, cap, face };
  for (const int kind : {side, cap, face})
    for (const Seen* seen : {&a, &b}) {
      const Mat3& turn = seen == &b ? best.pose.rotation_b : best.pose.rotation_a;
      const Vec3 outward = turn.transpose() * (seen->sign * found);
      std::optional<Vec3> normal;
      if (seen->model.curved()) {
        const Outline outline = outline_of(seen->model, outward);
        if (kind != face && outline.count == (kind == side ? 2 : Outline::kRim)) normal = outline.normal;
      } else if (kind == face) {
        normal = face_towards(*seen, outward);
      }
      if (normal) best.look(seen->sign * (turn * *normal));
    }
}

// The normal of the plane along two crossing lines, if each side shows a line (A's axes, from A to B).
std::optional<Vec3> crossing_normal(const Seen& a, const Seen& b, const Frame& frame) {
  if (a.corners.size() != 2 || b.corners.size() != 2) return std::nullopt;
  const auto line = [&](const Seen& side) {
    return Vec3(frame.at(side.corners[1], side.heights[1]) - frame.at(side.corners[0], side.heights[0]));
  };
  const Vec3 cross = line(a).cross(line(b));
  if (cross.norm() <= kParallel * line(a).norm() * line(b).norm()) return std::nullopt;
  return Vec3(cross.normalized() * (cross.dot(frame.n) < 0 ? -1 : 1));
}

// Whether a mesh shows this normal (outward, A's axes) at a point of one of its triangles: no neighbour of it
// leads farther along the normal.
bool shows(const Seen& side, const Vec3& point, const Vec3& outward) {
  if (side.triangle < 0) return true;
  const FeatureMesh& mesh = side.model.mesh;
  const Vec3 x = side.pose.rotation.transpose() * (point - side.pose.position),
             n = side.pose.rotation.transpose() * outward;
  const auto leads = [&](int edge) {
    for (int k = mesh.edge_triangles.start[edge]; k < mesh.edge_triangles.start[edge + 1]; ++k)
      if (n.dot(mesh.inward(mesh.edge_triangles.items[k], edge)) > kSame) return true;
    return false;
  };
  for (int k = mesh.triangle_edges.start[side.triangle]; k < mesh.triangle_edges.start[side.triangle + 1];
       ++k) {
    const int edge = mesh.triangle_edges.items[k];
    const auto& [i, j] = mesh.edges[edge].vertex;
    const Vec3 along = mesh.vertices[j] - mesh.vertices[i];
    const double off = along.cross(x - mesh.vertices[i]).norm() / along.norm();
    if (off <= kSame * side.model.reach && leads(edge)) return false;
  }
  return true;
}

}  // namespace

std::vector<FeaturePair> curved_features(const Model& a, const Model& b, const ca::PairPose& pose,
                                         const LeafPair& pair, double tolerance) {
  const auto triangle_of = [](const Model& model, int leaf) {
    return model.filled ? -1 : model.boxes.leaf_item[leaf];
  };
  Seen side_a{a, triangle_of(a, pair.a), {}, 1}, side_b{b, triangle_of(b, pair.b), pose.b_in_a, -1};
  BestPlane best(a.leaf(pair.a), b.leaf(pair.b), pose, pair.gjk.normal);
  const ca::GjkResult sharp = ca::distance(best.leaf_a, best.leaf_b, pose, {0, 1e-12, 128});
  if (sharp.status != ca::GjkResult::Status::overlapping) best.look(sharp.normal);
  look_at_surfaces(side_a, side_b, best);
  const auto frame_of = [&] { return Frame((pose.rotation_a.transpose() * best.normal).normalized()); };
  Frame frame = frame_of();
  side_a.look(frame, 2 * tolerance);
  side_b.look(frame, 2 * tolerance);
  if (const std::optional<Vec3> across = crossing_normal(side_a, side_b, frame)) {
    best.look(pose.rotation_a * *across);
    frame = frame_of();
    side_a.look(frame, 2 * tolerance);
    side_b.look(frame, 2 * tolerance);
  }
  const double reaches = a.reach + b.reach;
  std::vector<FeaturePair> features;
  for (const Vec2& place : shared_corners(side_a.corners, side_b.corners, kSame * reaches)) {
    const double height_a = side_a.height(frame, place), height_b = side_b.height(frame, place);
    FeaturePair contact;
    contact.gap = height_b - height_a - a.radius - b.radius;
    const Vec3 core_a = frame.at(place, height_a), core_b = frame.at(place, height_b);
    contact.point_a = core_a + a.radius * frame.n;
    contact.point_b = core_b - b.radius * frame.n;
    contact.normal = frame.n;
    contact.kind_a = side_a.kind;
    contact.kind_b = side_b.kind;
    contact.id_a = side_a.id;
    contact.id_b = side_b.id;
    const bool known = std::any_of(features.begin(), features.end(), [&](const FeaturePair& other) {
      return (other.point_a - contact.point_a).norm() <= kSame * reaches;
    });
    if (!known && std::abs(contact.gap) <= tolerance && shows(side_a, core_a, frame.n) &&
        shows(side_b, core_b, -frame.n))
      features.push_back(contact);
  }
  return features;
}

}  // namespace fc::hulls
