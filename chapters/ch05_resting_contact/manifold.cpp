#include "ch05_resting_contact/manifold.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace fc::resting {
namespace {

constexpr int kMostCorners = 64;    // of a face; a face with more is thinned out
constexpr double kSame = 1e-9;      // of both reaches: corners nearer than this are one
constexpr double kParallel = 1e-3;  // sine of the angle between segments that lie along each other
constexpr double kLeastFacing =
    0.05;  // the least cosine used between the normals of a face and of the manifold

// A corner of a projected polygon: its place in the plane, its height, and the two lines that meet there.
struct Corner {
  double x, y, height;  // m
  int line_in, line_out;
};

struct Polygon {
  std::array<Corner, 2 * kMostCorners> corners;
  int count = 0;
  int face = 0;
  void add(const Corner& corner) {
    if (count < static_cast<int>(corners.size())) corners[static_cast<std::size_t>(count++)] = corner;
  }
  std::span<const Corner> all() const { return {corners.data(), static_cast<std::size_t>(count)}; }
};

// The plane perpendicular to the normal, and its axes.
struct Frame {
  Vec3 u, v, n;
  explicit Frame(const Vec3& normal) : n(normal) {
    u = (std::abs(n.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY()).cross(n).normalized();
    v = n.cross(u);
  }
  Vec3 at(double x, double y, double height) const { return x * u + y * v + height * n; }
};

int best_face(const FaceList& faces, const Vec3& direction) {
  int best = -1;
  double most = -2;
  for (int f = 0; f < faces.size(); ++f) {
    const double along = faces.normals[static_cast<std::size_t>(f)].dot(direction);
    if (along > most) {
      most = along;
      best = f;
    }
  }
  return best;
}

// The outline of a cylinder or cone towards the other body, seen along the normal; anticlockwise there.
void project(const hulls::Outline& outline, const Mat3& rotation, const Vec3& offset, const Frame& frame,
             bool reverse, Polygon& polygon) {
  polygon.count = 0;
  polygon.face = outline.id;
  for (int k = 0; k < outline.count; ++k) {
    const int place = reverse && outline.count > 2 ? outline.count - 1 - k : k;
    const Vec3 x = rotation * outline.corners[static_cast<std::size_t>(place)] + offset;
    polygon.add({frame.u.dot(x), frame.v.dot(x), frame.n.dot(x), k == 0 ? outline.count - 1 : k - 1, k});
  }
}

// The face (or all vertices, for a segment or a point), seen along the normal; anticlockwise there.
void project(const ManifoldSide& side, int face, const Mat3& rotation, const Vec3& offset, const Frame& frame,
             bool reverse, Polygon& polygon) {
  const auto& vertices = side.model.mesh.vertices;
  const hulls::Lists& lists = side.faces.corners;
  const int first = face < 0 ? 0 : lists.start[static_cast<std::size_t>(face)];
  const int all =
      face < 0 ? static_cast<int>(vertices.size()) : lists.start[static_cast<std::size_t>(face) + 1] - first;
  const int step = (all + kMostCorners - 1) / kMostCorners;
  polygon.count = 0;
  polygon.face = face;
  const int count = (all + step - 1) / step;
  for (int k = 0; k < count; ++k) {
    const int place = reverse ? count - 1 - k : k;
    const int vertex = face < 0 ? place * step : lists.items[static_cast<std::size_t>(first + place * step)];
    const Vec3 x = rotation * vertices[static_cast<std::size_t>(vertex)] + offset;
    polygon.add({frame.u.dot(x), frame.v.dot(x), frame.n.dot(x), k == 0 ? count - 1 : k - 1, k});
  }
}

// Cuts the subject along the line from p to q (number `line`); keeps the part on its inner side (Sutherland, Hodgman).
void cut(std::span<const Corner> subject, const Corner& p, const Corner& q, int line, Polygon& result) {
  const double dx = q.x - p.x, dy = q.y - p.y;
  const auto inside = [&](const Corner& c) { return dx * (c.y - p.y) - dy * (c.x - p.x); };
  result.count = 0;
  const std::size_t count = subject.size();
  const bool closed = count > 2;
  for (std::size_t k = 0; k < count; ++k) {
    const Corner& from = subject[k];
    const double here = inside(from);
    if (here >= 0) result.add(from);
    if (k + 1 == count && !closed) break;
    const Corner& to = subject[k + 1 == count ? 0 : k + 1];
    const double there = inside(to);
    if ((here >= 0) == (there >= 0)) continue;
    const double t = here / (here - there);
    // The polygon leaves along the cutting line, and comes back from it.
    const bool leaves = here >= 0;
    result.add({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y),
                from.height + t * (to.height - from.height), leaves ? from.line_out : line,
                leaves ? line : from.line_out});
  }
}

// The height of a face's plane over a place.
struct Plane {
  double x, y, constant;
  Plane(const Vec3& normal, const Corner& corner, const Frame& frame) {
    const double along = normal.dot(frame.n);
    const double size = std::abs(along) < kLeastFacing ? std::copysign(kLeastFacing, along) : along;
    x = -normal.dot(frame.u) / size;
    y = -normal.dot(frame.v) / size;
    constant = corner.height - x * corner.x - y * corner.y;
  }
  double height(const Corner& c) const { return x * c.x + y * c.y + constant; }
};

// A body of the pair, and its face towards the other body.
struct Facing {
  const ManifoldSide& side;
  Mat3 rotation, to_body;  // body axes to world axes, and back
  Vec3 offset;             // m, from A's centre
  ca::Convex core;
  hulls::Outline outline;  // if it is curved
  int face = -1;           // -1: it has none

  // direction: unit, world, outward.
  Facing(const ManifoldSide& its_side, const Mat3& its_rotation, const Vec3& its_offset,
         const Vec3& direction)
      : side(its_side),
        rotation(its_rotation),
        to_body(its_rotation.transpose()),
        offset(its_offset),
        core(its_side.model.leaf(0)),
        face(best_face(its_side.faces, to_body * direction)) {
    if (side.model.curved()) outline = hulls::outline_of(side.model, to_body * direction);
    if (outline.count > 1) face = outline.id;
  }
  Vec3 normal() const {  // unit, world, outward
    if (side.model.curved()) return rotation * outline.normal;
    return rotation * side.faces.normals[static_cast<std::size_t>(face)];
  }
  // Whether the plane can turn with the face. A round side rolls out of its plane.
  bool has_plane() const { return face >= 0 && (!side.model.curved() || outline.count > 2); }
  void project_to(const Frame& frame, const Vec3& direction, bool reverse, Polygon& polygon) const {
    if (side.model.curved())
      project(hulls::outline_of(side.model, to_body * direction), rotation, offset, frame, reverse, polygon);
    else
      project(side, face, rotation, offset, frame, reverse && face >= 0, polygon);
  }
};

// Fills a manifold whose plane is known.
struct ManifoldPoints {
  const Facing &a, &b;
  Frame frame;
  double far, radii, same;
  double least;  // m, the least of the points' gaps
  Manifold& manifold;

  ManifoldPoints(const Facing& facing_a, const Facing& facing_b, double farthest, Manifold& filled)
      : a(facing_a),
        b(facing_b),
        frame(filled.normal),
        far(farthest),
        radii(facing_a.side.model.radius + facing_b.side.model.radius),
        same(kSame * (facing_a.side.model.reach + facing_b.side.model.reach)),
        least(farthest),
        manifold(filled) {}

  // Points of the cores, m, from A's centre.
  void add(const Vec3& core_point_a, const Vec3& core_point_b, double gap, std::uint64_t key) {
    if (gap > far || manifold.count == Manifold::kMost) return;
    ManifoldPoint point;
    point.point_a = a.to_body * (core_point_a + a.side.model.radius * manifold.normal);
    point.point_b = b.to_body * (core_point_b - b.side.model.radius * manifold.normal - b.offset);
    point.gap = gap;
    point.key = key;
    for (int i = 0; i < manifold.count; ++i)
      if ((manifold.points[static_cast<std::size_t>(i)].point_a - point.point_a).squaredNorm() <= same * same)
        return;
    manifold.points[static_cast<std::size_t>(manifold.count++)] = point;
  }
  void add_at(double x, double y, double height_a, double height_b, std::uint64_t key) {
    const double gap = height_b - height_a - radii;
    least = std::min(least, gap);
    add(frame.at(x, y, height_a), frame.at(x, y, height_b), gap, key);
  }

  // Two faces, or a face and an edge or point: the one with fewer corners is cut by the sides of the other one.
  void cut_faces(const Polygon& first, const Polygon& second) {
    static thread_local Polygon results[2];
    const bool swap = second.count < first.count;
    const Polygon &subject = swap ? second : first, &cutter = swap ? first : second;
    const Plane plane((swap ? a : b).normal(), cutter.corners[0], frame);
    std::span<const Corner> shared = subject.all();
    for (int k = 0; k < cutter.count; ++k) {
      Polygon& result = results[k % 2];
      cut(shared, cutter.corners[static_cast<std::size_t>(k)],
          cutter.corners[static_cast<std::size_t>(k + 1 == cutter.count ? 0 : k + 1)], kMostCorners + k,
          result);
      shared = result.all();
    }
    const auto bits = [](int value) { return static_cast<std::uint64_t>(value + 1) & 0xffff; };
    for (const Corner& c : shared) {
      const double across = plane.height(c);
      add_at(c.x, c.y, swap ? across : c.height, swap ? c.height : across,
             bits(a.face) << 48 | bits(b.face) << 32 | bits(c.line_in) << 16 | bits(c.line_out));
    }
  }

  // Two segments along each other: the ends of their common part.
  void join_segments(const Polygon& first, const Polygon& second) {
    const auto &p = first.corners, &q = second.corners;
    const double dx = p[1].x - p[0].x, dy = p[1].y - p[0].y, length = std::hypot(dx, dy);
    const double ex = q[1].x - q[0].x, ey = q[1].y - q[0].y;
    if (!(length > 0) || std::abs(dx * ey - dy * ex) > kParallel * length * std::hypot(ex, ey)) return;
    const auto along = [&](const Corner& c) {
      return ((c.x - p[0].x) * dx + (c.y - p[0].y) * dy) / (length * length);
    };
    const double s0 = along(q[0]), s1 = along(q[1]);
    const double from = std::max(0.0, std::min(s0, s1)), to = std::min(1.0, std::max(s0, s1));
    for (const double s : {from, to}) {
      if (from > to) return;
      const double t = s1 != s0 ? (s - s0) / (s1 - s0) : 0;
      add_at(p[0].x + s * dx, p[0].y + s * dy, p[0].height + s * (p[1].height - p[0].height),
             q[0].height + t * (q[1].height - q[0].height), s == from ? 1 : 2);
    }
  }

  // The bodies touch, up to rounding, and have no nearest points: takes those farthest along the normal, and brings
  // them over each other.
  void bring_together() {
    const Vec3 far_a = a.rotation * ca::support(a.core, a.to_body * manifold.normal).point;
    const Vec3 far_b = b.rotation * ca::support(b.core, -(b.to_body * manifold.normal)).point + b.offset;
    const Vec3 between = 0.5 * (far_a + far_b);
    add(between + manifold.normal.dot(far_a - between) * manifold.normal,
        between + manifold.normal.dot(far_b - between) * manifold.normal, manifold.gap,
        ManifoldPoint::kBroughtTogether);
  }
};

// The plane that was found, or a face's, if that one separates the bodies as well up to the slack.
void choose_plane(const Facing& a, const Facing& b, const ca::PairPose& pose, const ca::GjkResult& nearest,
                  double slack, Manifold& manifold) {
  manifold.normal = nearest.normal;
  manifold.gap = nearest.lower;
  manifold.of_b = false;
  double best = nearest.lower - slack;
  for (const bool of_b : {false, true}) {
    if (!(of_b ? b : a).has_plane()) continue;
    const Vec3 normal = of_b ? Vec3(-b.normal()) : a.normal();
    const double gap = ca::support_gap(a.core, b.core, pose, normal);
    if (gap < best) continue;
    best = gap;
    manifold.normal = normal;
    manifold.gap = gap;
    manifold.of_b = of_b;
  }
}

}  // namespace

FaceList build_face_list(const hulls::FeatureMesh& mesh) {
  // Triangles across a flat edge belong to one face.
  const int count = static_cast<int>(mesh.triangles.size());
  std::vector<int> parent(static_cast<std::size_t>(count));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int t) {
    while (parent[static_cast<std::size_t>(t)] != t) t = parent[static_cast<std::size_t>(t)];
    return t;
  };
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const int first = mesh.edge_triangles.start[e], end = mesh.edge_triangles.start[e + 1];
    for (int k = first; mesh.edges[e].flat && k < end; ++k)
      parent[static_cast<std::size_t>(root(mesh.edge_triangles.items[static_cast<std::size_t>(k)]))] =
          root(mesh.edge_triangles.items[static_cast<std::size_t>(first)]);
  }
  FaceList faces;
  for (int face = 0; face < count; ++face) {
    if (root(face) != face) continue;
    std::vector<int> corners;
    for (int t = 0; t < count; ++t)
      if (root(t) == face)
        for (const int v : mesh.triangles[static_cast<std::size_t>(t)])
          if (mesh.vertex_kind[static_cast<std::size_t>(v)] == hulls::Vertex::corner) corners.push_back(v);
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    const Vec3 normal = mesh.normals[static_cast<std::size_t>(face)];
    const Frame frame(normal);
    Vec3 middle = Vec3::Zero();
    for (const int v : corners)
      middle += mesh.vertices[static_cast<std::size_t>(v)] / static_cast<double>(corners.size());
    const auto angle = [&](int v) {
      const Vec3 from = mesh.vertices[static_cast<std::size_t>(v)] - middle;
      return std::atan2(frame.v.dot(from), frame.u.dot(from));
    };
    std::sort(corners.begin(), corners.end(), [&](int v, int w) { return angle(v) < angle(w); });
    faces.normals.push_back(normal);
    faces.corners.items.insert(faces.corners.items.end(), corners.begin(), corners.end());
    faces.corners.start.push_back(static_cast<int>(faces.corners.items.size()));
  }
  return faces;
}

void find_manifold(const ManifoldSide& side_a, const ManifoldSide& side_b, const ca::PairPose& pose,
                   const ca::GjkResult& nearest, double slack, double far, Manifold& manifold) {
  const Facing a(side_a, pose.rotation_a, Vec3::Zero(), nearest.normal),
      b(side_b, pose.rotation_b, pose.offset_world, -nearest.normal);
  manifold.count = 0;
  choose_plane(a, b, pose, nearest, slack, manifold);
  static thread_local Polygon first, second;
  ManifoldPoints points(a, b, far, manifold);
  a.project_to(points.frame, manifold.normal, false, first);
  b.project_to(points.frame, -manifold.normal, true, second);
  if (std::max(first.count, second.count) > 2)
    points.cut_faces(first, second);
  else if (first.count == 2 && second.count == 2)
    points.join_segments(first, second);
  const bool has_witnesses = nearest.status != ca::GjkResult::Status::overlapping;
  if (has_witnesses && (manifold.count == 0 || points.least > nearest.lower + slack))
    points.add(nearest.point_a - side_a.model.radius * nearest.normal,
               nearest.point_b + side_b.model.radius * nearest.normal, std::max(manifold.gap, nearest.lower),
               3);
  if (manifold.count == 0) points.bring_together();
}

}  // namespace fc::resting
