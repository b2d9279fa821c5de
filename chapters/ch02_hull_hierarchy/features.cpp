#include "ch02_hull_hierarchy/features.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "ch02_hull_hierarchy/curved_features.hpp"
#include "ch02_hull_hierarchy/model_distance.hpp"
#include "ch02_hull_hierarchy/union_surface.hpp"

namespace fc::hulls {
namespace {

using ca::FeatureKind;
using ca::FeaturePair;

// Sine of the angle by which a normal may leave a cone and count as on its border.
constexpr double kConeSlack = 1e-9;
constexpr double kSameNormal = 1e-6;  // sine of the angle between normals that count as the same
// Sine of the angle below which the cross product of two edges is mostly rounding.
constexpr double kParallelEdges = 1e-7;
// As a share of the model's reach: a vertex that is this far outside a face's border still lies over the face.
constexpr double kOnBorder = 1e-9;
constexpr double kJoined = 1e-12;  // of the models' reach: nearer points have no direction between them

// One model at the pose, in A's axes from A's centre of mass, and the features of one of its leaves that may
// be in contact.
struct Placed {
  const Model& model;
  Pose pose;
  std::vector<int> vertices, edges, triangles;

  Vec3 vertex(int v) const { return pose * model.mesh.vertices[v]; }
  Vec3 turned(const Vec3& direction) const { return pose.rotation * direction; }

  // Keeps the features of a leaf that reach within `depth` (m) of its support plane along n. Whatever is
  // nearer to the other side than the tolerance does.
  void select(int leaf, const Vec3& n, double depth) {
    const Vec3 direction = pose.rotation.transpose() * n;
    const FeatureMesh& mesh = model.mesh;
    const auto height = [&](int v) { return direction.dot(mesh.vertices[v]); };
    double low = direction.dot(ca::support(model.leaf(leaf), direction).point) - depth;
    vertices.clear();
    edges.clear();
    triangles.clear();
    const auto take_vertex = [&](int v) {
      if (height(v) >= low && mesh.vertex_kind[v] != Vertex::on_face) vertices.push_back(v);
    };
    const auto take_edge = [&](int e) {
      const auto& [i, j] = mesh.edges[e].vertex;
      if (!mesh.edges[e].flat && std::max(height(i), height(j)) >= low) edges.push_back(e);
    };
    const int triangle = model.boxes.leaf_item[leaf];
    if (triangle >= 0) {
      for (const int v : mesh.triangles[triangle]) take_vertex(v);
      for_items(mesh.triangle_edges, triangle, take_edge);
      triangles.push_back(triangle);
      return;
    }
    for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) take_vertex(v);
    for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e) take_edge(e);
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      const auto& [i, j, k] = mesh.triangles[t];
      if (std::max({height(i), height(j), height(k)}) >= low) triangles.push_back(t);
    }
  }
  template <class Use>
  static void for_items(const Lists& lists, int list, Use use) {
    for (int k = lists.start[list]; k < lists.start[list + 1]; ++k) use(lists.items[k]);
  }

  // Whether n (towards the other body) lies in the cone of an edge: no neighbouring face leads along n.
  bool edge_cone(int edge, const Vec3& n) const {
    bool inside = true;
    for_items(model.mesh.edge_triangles, edge,
              [&](int t) { inside = inside && n.dot(turned(model.mesh.inward(t, edge))) <= kConeSlack; });
    return inside;
  }
  bool on_edge(int v) const { return model.mesh.vertex_kind[v] == Vertex::on_edge; }
  // The direction of the edge that a vertex is drawn on.
  Vec3 drawn_on(int v) const {
    Vec3 along = Vec3::Zero();
    for_items(model.mesh.vertex_edges, v, [&](int e) {
      const auto& [i, j] = model.mesh.edges[e].vertex;
      if (!model.mesh.edges[e].flat)
        along = turned(model.mesh.vertices[j] - model.mesh.vertices[i]).normalized();
    });
    return along;
  }
  bool vertex_cone(int v, const Vec3& n) const {
    bool inside = true;
    for_items(model.mesh.vertex_edges, v, [&](int e) {
      const auto& [i, j] = model.mesh.edges[e].vertex;
      const Vec3 along = turned(model.mesh.vertices[i == v ? j : i] - model.mesh.vertices[v]).normalized();
      inside = inside && n.dot(along) <= kConeSlack;
    });
    return inside;
  }
};

struct Collector {
  Placed a, b;
  double tolerance;
  double radii;
  Vec3 toward;  // the plane of the pair of pieces that is looked at
  std::vector<FeaturePair> found;

  // Whether two points at this distance (m) have a direction between them, or only rounding.
  bool has_direction(double apart) const { return apart > kJoined * (a.model.reach + b.model.reach); }

  // Points are on the cores; n from A to B. `gap` is between the rounded surfaces.
  void add(const Vec3& core_a, const Vec3& core_b, const Vec3& n, FeatureKind kind_a, int id_a,
           FeatureKind kind_b, int id_b) {
    FeaturePair pair;
    pair.gap = n.dot(core_b - core_a) - radii;
    if (std::abs(pair.gap) > tolerance) return;
    pair.point_a = core_a + a.model.radius * n;
    pair.point_b = core_b - b.model.radius * n;
    pair.normal = n;
    pair.kind_a = kind_a;
    pair.kind_b = kind_b;
    pair.id_a = id_a;
    pair.id_b = id_b;
    found.push_back(pair);
  }

  // A vertex of one body over a face of the other. `sign`: +1 if the vertex is A's.
  // A vertex that is drawn on an edge adds nothing to the edge's end, or to its crossing with the face's
  // border.
  void vertex_face(const Placed& with_vertex, int v, const Placed& with_face, int t, double sign) {
    if (with_vertex.model.mesh.vertex_kind[v] == Vertex::on_edge) return;
    const Vec3 x = with_vertex.vertex(v);
    const auto& corner = with_face.model.mesh.triangles[t];
    Vec3 outward = with_face.turned(with_face.model.mesh.normals[t]);
    const Vec3 p = with_face.vertex(corner[0]);
    double height = outward.dot(x - p);
    if (std::abs(std::abs(height) - radii) > tolerance) return;
    if (-sign * outward.dot(toward) <= 0) {  // the face faces away; a mere surface has two sides
      if (with_face.model.mesh.solid) return;
      outward = -outward;
      height = -height;
    }
    const double border = kOnBorder * with_face.model.reach;
    for (int k = 0; k < 3; ++k) {
      const Vec3 from = with_face.vertex(corner[k]);
      const Vec3 inward = with_face.turned(with_face.model.mesh.normals[t])
                              .cross(with_face.vertex(corner[(k + 1) % 3]) - from);
      if (inward.dot(x - from) < -border * inward.norm()) return;
    }
    const Vec3 foot = x - height * outward;
    if (sign > 0)
      add(x, foot, -outward, FeatureKind::vertex, v, FeatureKind::face, t);
    else
      add(foot, x, outward, FeatureKind::face, t, FeatureKind::vertex, v);
  }

  void edge_edge(int e, int f) {
    const auto& [a0, a1] = a.model.mesh.edges[e].vertex;
    const auto& [b0, b1] = b.model.mesh.edges[f].vertex;
    const Vec3 p = a.vertex(a0), u = a.vertex(a1) - p, q = b.vertex(b0), v = b.vertex(b1) - q;
    const Vec3 cross = u.cross(v);
    const double size2 = cross.squaredNorm();
    if (size2 <= kParallelEdges * kParallelEdges * u.squaredNorm() * v.squaredNorm()) return;
    const double s = (q - p).cross(v).dot(cross) / size2;
    const double r = (q - p).cross(u).dot(cross) / size2;
    if (!(s > 0 && s < 1 && r > 0 && r < 1)) return;
    Vec3 n = cross / std::sqrt(size2);
    const Vec3 x = p + s * u, y = q + r * v;
    const double apart = n.dot(y - x);
    // The direction from A to B: where the gap is more than rounding, the gap decides; else the cones do.
    if (apart < -tolerance || (std::abs(apart) <= tolerance && n.dot(toward) < 0)) n = -n;
    if (!a.edge_cone(e, n) || !b.edge_cone(f, -n)) return;
    add(x, y, n, FeatureKind::edge, e, FeatureKind::edge, f);
  }

  // For two edges that cross at a vertex drawn on one of them, or on both: moves x and y (on the edges along
  // u and v) there, and sets n, on its own side, to the exact cross product. False if the edges are parallel
  // (their ends decide), or cross elsewhere (edge_edge decides).
  bool cross_here(Vec3& x, const Vec3& u, Vec3& y, const Vec3& v, Vec3& n) const {
    const Vec3 cross = u.cross(v);
    const double size2 = cross.squaredNorm();
    if (size2 <= kParallelEdges * kParallelEdges * u.squaredNorm() * v.squaredNorm()) return false;
    const Vec3 along_u = (y - x).cross(v).dot(cross) / size2 * u,
               along_v = (y - x).cross(u).dot(cross) / size2 * v;
    const double here = kOnBorder * (a.model.reach + b.model.reach);
    if (along_u.norm() > here || along_v.norm() > here) return false;
    x += along_u;
    y += along_v;
    n = cross.normalized() * (cross.dot(n) < 0 ? -1 : 1);
    return true;
  }

  // A vertex that is nearest to the inside of an edge, or to a vertex: the normal joins them. `v` is
  // with_vertex's.
  void vertex_edge(const Placed& with_vertex, int v, const Placed& with_edge, int e, double sign) {
    const auto& [i, j] = with_edge.model.mesh.edges[e].vertex;
    Vec3 x = with_vertex.vertex(v);
    const Vec3 p = with_edge.vertex(i), u = with_edge.vertex(j) - p;
    const double s = u.dot(x - p) / u.squaredNorm();
    if (!(s > 0 && s < 1)) return;
    Vec3 foot = p + s * u;
    const double apart = (foot - x).norm();
    if (std::abs(apart - radii) > tolerance || !has_direction(apart)) return;
    Vec3 n = sign * (foot - x) / apart;
    if (with_vertex.on_edge(v) && !cross_here(x, with_vertex.drawn_on(v), foot, u, n)) return;
    const Vec3 strict = sign * n;  // from the vertex's body to the edge's
    if (n.dot(toward) <= 0) return;
    if (!with_vertex.vertex_cone(v, strict) || !with_edge.edge_cone(e, -strict)) return;
    if (sign > 0)
      add(x, foot, n, FeatureKind::vertex, v, FeatureKind::edge, e);
    else
      add(foot, x, n, FeatureKind::edge, e, FeatureKind::vertex, v);
  }
  void vertex_vertex(int v, int w) {
    Vec3 x = a.vertex(v), y = b.vertex(w);
    const double apart = (y - x).norm();
    if (std::abs(apart - radii) > tolerance || !has_direction(apart)) return;
    Vec3 n = (y - x) / apart;
    if (a.on_edge(v) && b.on_edge(w) && !cross_here(x, a.drawn_on(v), y, b.drawn_on(w), n)) return;
    if (n.dot(toward) <= 0 || !a.vertex_cone(v, n) || !b.vertex_cone(w, -n)) return;
    add(x, y, n, FeatureKind::vertex, v, FeatureKind::vertex, w);
  }

  void leaves(const LeafPair& pair, const Vec3& normal_in_a) {
    toward = normal_in_a;
    const double depth = 2 * tolerance + std::max(0.0, -pair.gjk.lower);
    a.select(pair.a, toward, depth);
    b.select(pair.b, -toward, depth);
    for (const int v : a.vertices)
      for (const int t : b.triangles) vertex_face(a, v, b, t, 1);
    for (const int v : b.vertices)
      for (const int t : a.triangles) vertex_face(b, v, a, t, -1);
    for (const int e : a.edges)
      for (const int f : b.edges) edge_edge(e, f);
    for (const int v : a.vertices)
      for (const int e : b.edges) vertex_edge(a, v, b, e, 1);
    for (const int v : b.vertices)
      for (const int e : a.edges) vertex_edge(b, v, a, e, -1);
    for (const int v : a.vertices)
      for (const int w : b.vertices) vertex_vertex(v, w);
  }
};

// The feature that GJK's simplex spans on one side: a vertex, an edge or a face of the leaf.
void name_feature(const Model& model, int leaf, const std::array<ca::SupportPoint, 4>& simplex, int count,
                  const Vec3& outward, FeatureKind& kind, int& id) {
  if (!model.parts.empty()) {
    name_feature(model.part_of(leaf), 0, simplex, count, outward, kind, id);
    id += model.first_name[static_cast<std::size_t>(model.boxes.leaf_item[leaf])];
    return;
  }
  if (model.curved()) {
    const Outline outline = outline_of(model, outward);
    kind = outline.kind;
    id = outline.id;
    return;
  }
  const FeatureMesh& mesh = model.mesh;
  const int triangle = model.boxes.leaf_item[leaf];
  std::vector<int> corners;
  for (int k = 0; k < count; ++k)
    corners.push_back(triangle >= 0 ? mesh.triangles[triangle][simplex[k].index] : simplex[k].index);
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const auto has_all = [&](const auto& of) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](int v) { return std::find(of.begin(), of.end(), v) != of.end(); });
  };
  kind = FeatureKind::vertex;
  id = corners.empty() ? 0 : corners[0];
  if (corners.size() <= 1) return;
  for (int k = mesh.vertex_edges.start[id]; k < mesh.vertex_edges.start[id + 1]; ++k)
    if (corners.size() == 2 && has_all(mesh.edges[mesh.vertex_edges.items[k]].vertex)) {
      kind = FeatureKind::edge;
      id = mesh.vertex_edges.items[k];
      return;
    }
  for (int t = std::max(triangle, 0); t < static_cast<int>(mesh.triangles.size()); ++t)
    if (t == triangle ||
        has_all(mesh.triangles[t])) {  // a diagonal of a face lies on one of its triangles, or on none
      kind = FeatureKind::face;
      id = t;
      return;
    }
}

// The point of a triangle that is nearest to x; both in the triangle's axes.
Vec3 nearest_on(const ca::Convex& triangle, const Vec3& x) {
  const ca::GjkResult g = ca::distance(ca::Convex{{&x, 1}}, triangle, ca::PairPose(Pose{}, Pose{}), {});
  return g.status == ca::GjkResult::Status::separated ? g.point_b : x;
}

// The witness points of two triangles that touch or overlap are those of a pose in which one was pushed aside. The contact
// is where the two have a point in common: A's point is projected to the other triangle and back until it stays.
void meet_in_one_point(const Model& a, const Model& b, const LeafPair& pair, const ca::PairPose& pose,
                       FeaturePair& w) {
  constexpr int kRounds = 32;
  const Pose& b_in_a = pose.b_in_a;
  w.kind_a = w.kind_b = FeatureKind::face;
  w.id_a = a.boxes.leaf_item[pair.a];
  w.id_b = b.boxes.leaf_item[pair.b];
  for (int round = 0; round < kRounds; ++round) {
    const Vec3 on_b = nearest_on(b.leaf(pair.b), b_in_a.rotation.transpose() * (w.point_a - b_in_a.position));
    w.point_b = b_in_a * on_b;
    const Vec3 back = nearest_on(a.leaf(pair.a), w.point_b);
    if (back == w.point_a) break;
    w.point_a = back;
  }
  w.gap = w.normal.dot(w.point_b - w.point_a);
}

FeaturePair witness(const Model& a, const Model& b, const LeafPair& pair, const ca::PairPose& pose,
                    const Mat3& to_a) {  // in A's axes, like the others
  FeaturePair w;
  w.point_a = to_a * pair.gjk.point_a;
  w.point_b = to_a * pair.gjk.point_b;
  w.normal = to_a * pair.gjk.normal;
  w.gap = std::max(pair.gjk.lower, std::min(pair.gjk.upper, w.normal.dot(w.point_b - w.point_a)));
  name_feature(a, pair.a, pair.gjk.cache.a, pair.gjk.cache.count, w.normal, w.kind_a, w.id_a);
  name_feature(b, pair.b, pair.gjk.cache.b, pair.gjk.cache.count,
               -(pose.b_in_a.rotation.transpose() * w.normal), w.kind_b, w.id_b);
  const bool triangles = !a.filled && !b.filled;
  if (triangles && pair.gjk.status == ca::GjkResult::Status::overlapping)
    meet_in_one_point(a, b, pair, pose, w);
  return w;
}

// The features of one pair of leaves where a part of a compound, or something curved, takes part; only those
// on the surface of the union.
void add_features_of_leaves(const Model& a, const Model& b, const ca::PairPose& pose, const LeafPair& pair,
                            double tolerance, std::vector<FeaturePair>& found) {
  const Model &one = a.parts.empty() ? a : a.part_of(pair.a),
              &other = b.parts.empty() ? b : b.part_of(pair.b);
  const LeafPair local{a.parts.empty() ? pair.a : 0, b.parts.empty() ? pair.b : 0, pair.gjk};
  std::vector<FeaturePair> features;
  if (one.curved() || other.curved()) {
    features = curved_features(one, other, pose, local, tolerance);
  } else {
    Collector collector{{one, {}, {}, {}, {}},
                        {other, pose.b_in_a, {}, {}, {}},
                        tolerance,
                        one.radius + other.radius,
                        {},
                        {}};
    collector.leaves(local, pose.rotation_a.transpose() * pair.gjk.normal);
    features = std::move(collector.found);
    // At a distance that is large for their size, features near an edge can be near each other in directions
    // that separate nothing.
    if (one.filled && other.filled)
      std::erase_if(features, [&](const FeaturePair& f) {
        return ca::support_gap(one.leaf(0), other.leaf(0), pose, pose.rotation_a * f.normal) < -tolerance;
      });
  }
  const Mat3 to_b = pose.b_in_a.rotation.transpose();
  for (FeaturePair& f : features) {
    const bool of_face = f.kind_a == FeatureKind::face || f.kind_b == FeatureKind::face;
    if (!a.parts.empty()) {
      const int part = a.boxes.leaf_item[pair.a];
      if (!of_face && !shows(a, part, f.point_a, f.normal)) continue;
      f.id_a += a.first_name[static_cast<std::size_t>(part)];
    }
    if (!b.parts.empty()) {
      const int part = b.boxes.leaf_item[pair.b];
      if (!of_face && !shows(b, part, to_b * (f.point_b - pose.b_in_a.position), -(to_b * f.normal)))
        continue;
      f.id_b += b.first_name[static_cast<std::size_t>(part)];
    }
    found.push_back(f);
  }
}

// Faces first, then edges, then vertices, so that of equivalent pairs the one with the best normal stays.
void sort_and_merge(std::vector<FeaturePair>& pairs, double tolerance) {
  const auto rank = [](const FeaturePair& p) {
    const bool face = p.kind_a == FeatureKind::face || p.kind_b == FeatureKind::face;
    const bool edges = p.kind_a == FeatureKind::edge && p.kind_b == FeatureKind::edge;
    return face ? 0 : edges ? 1 : 2;
  };
  std::sort(pairs.begin(), pairs.end(), [&](const FeaturePair& x, const FeaturePair& y) {
    return std::tuple(rank(x), x.kind_a, x.id_a, x.kind_b, x.id_b) <
           std::tuple(rank(y), y.kind_a, y.id_a, y.kind_b, y.id_b);
  });
  // Leaves share vertices and edges: a pair of features is found once for each pair of their leaves.
  pairs.erase(std::unique(pairs.begin(), pairs.end(),
                          [&](const FeaturePair& x, const FeaturePair& y) {
                            return (x.point_a - y.point_a).norm() <= tolerance && x.kind_a == y.kind_a &&
                                   x.id_a == y.id_a && x.kind_b == y.kind_b && x.id_b == y.id_b &&
                                   x.normal.dot(y.normal) > 0;
                          }),
              pairs.end());
  std::vector<FeaturePair> kept;
  for (const FeaturePair& pair : pairs) {
    const bool same = std::any_of(kept.begin(), kept.end(), [&](const FeaturePair& other) {
      return (pair.point_a - other.point_a).norm() <= tolerance && pair.normal.dot(other.normal) > 0 &&
             pair.normal.cross(other.normal).norm() <= kSameNormal;
    });
    if (!same) kept.push_back(pair);
  }
  pairs.swap(kept);
}

}  // namespace

std::vector<ca::FeaturePair> contact_features(const Model& a, const Model& b, const ca::PairPose& pose,
                                              const Vec3& origin_a, double tolerance, double* gap) {
  const Mat3 to_a = pose.rotation_a.transpose();
  Collector collector{
      {a, {}, {}, {}, {}}, {b, pose.b_in_a, {}, {}, {}}, tolerance, a.radius + b.radius, {}, {}};
  const std::vector<LeafPair> near = leaf_pairs_within(a, b, pose, tolerance, tolerance);
  const LeafPair* nearest = nullptr;
  const bool plain = a.parts.empty() && b.parts.empty() && !a.curved() && !b.curved();
  for (const LeafPair& pair : near) {
    if (plain)
      collector.leaves(pair, to_a * pair.gjk.normal);
    else
      add_features_of_leaves(a, b, pose, pair, tolerance, collector.found);
    if (nearest == nullptr || pair.gjk.lower < nearest->gjk.lower) nearest = &pair;
  }
  if (nearest != nullptr) {
    if (gap != nullptr) *gap = nearest->gjk.lower;
    // The plane at which advancement stopped must be among the contacts, or the impulse would not stop the
    // approach.
    const FeaturePair w = witness(a, b, *nearest, pose, to_a);
    const bool covered = std::any_of(collector.found.begin(), collector.found.end(),
                                     [&](const FeaturePair& f) { return f.normal.dot(w.normal) > 1 - 1e-6; });
    if (!covered) collector.found.push_back(w);
  }
  std::vector<FeaturePair> pairs = std::move(collector.found);
  sort_and_merge(pairs, tolerance);
  for (FeaturePair& pair : pairs) {
    pair.point_a = origin_a + pose.rotation_a * pair.point_a;
    pair.point_b = origin_a + pose.rotation_a * pair.point_b;
    pair.normal = (pose.rotation_a * pair.normal).normalized();
  }
  return pairs;
}

}  // namespace fc::hulls
