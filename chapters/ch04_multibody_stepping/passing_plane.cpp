#include "ch04_multibody_stepping/passing_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ch02_hull_hierarchy/steps.hpp"

namespace fc::world {
namespace {

// A face passes through a point if its plane is no farther from it than this share of the body's reach. Consequence:
// with less, rounding of coordinates makes the search miss faces; with more, it tries faces beside the contact in vain.
constexpr double kOnFace = 1e-5;

// Steps along one plane: a pair that slides or parts needs one or two, and one that closes in does not pass.
constexpr int kPlaneSteps = 8;

// What rounding in double precision takes off a step, as a share of it.
constexpr double kShorter = 1e-12;

// Calls `look` with each triangle at a vertex.
template <class Look>
void for_triangles_at(const hulls::FeatureMesh& mesh, int vertex, Look&& look) {
  for (int k = mesh.vertex_edges.start[vertex]; k < mesh.vertex_edges.start[vertex + 1]; ++k) {
    const int edge = mesh.vertex_edges.items[k];
    for (int m = mesh.edge_triangles.start[edge]; m < mesh.edge_triangles.start[edge + 1]; ++m)
      look(mesh.edge_triangles.items[m]);
  }
}

// Collects normals, turned into world axes, each once.
struct Normals {
  const Mat3& rotation;
  double sign;
  std::vector<Vec3>& all;

  void add(const Vec3& normal) {
    const Vec3 n = sign * (rotation * normal);
    if (std::find(all.begin(), all.end(), n) == all.end()) all.push_back(n);
  }
};

// The faces at a feature of a convex part, or of a mesh. Of a cylinder the two caps are always taken.
void add_faces(const hulls::Model& model, ca::FeatureKind kind, int id, Normals normals) {
  const hulls::FeatureMesh& mesh = model.mesh;
  if (model.curved()) {
    normals.add(model.axis);
    normals.add(-model.axis);
  }
  if (mesh.triangles.empty()) return;
  if (kind == ca::FeatureKind::face) normals.add(mesh.normals[id]);
  if (kind == ca::FeatureKind::edge)
    for (int k = mesh.edge_triangles.start[id]; k < mesh.edge_triangles.start[id + 1]; ++k)
      normals.add(mesh.normals[mesh.edge_triangles.items[k]]);
  if (kind == ca::FeatureKind::vertex)
    for_triangles_at(mesh, id, [&](int t) { normals.add(mesh.normals[t]); });
}

// The faces of a leaf, and of its neighbours in a mesh, that pass through a point of it (m, body axes).
void add_faces(const hulls::Model& model, int leaf, const Vec3& point, Normals normals) {
  if (!model.parts.empty()) return add_faces(model.part_of(leaf), 0, point, normals);
  if (model.curved()) return add_faces(model, ca::FeatureKind::face, 0, normals);
  const hulls::FeatureMesh& mesh = model.mesh;
  const auto look = [&](int t) {
    const double off = mesh.normals[t].dot(point - mesh.vertices[mesh.triangles[t][0]]);
    if (std::abs(off) <= kOnFace * model.reach) normals.add(mesh.normals[t]);
  };
  const int triangle = model.boxes.leaf_item[leaf];
  if (triangle < 0)
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) look(t);
  else
    for (const int vertex : mesh.triangles[triangle]) for_triangles_at(mesh, vertex, look);
}

// The same for a feature of any model. In a compound the feature is one of its parts', and numbered there.
void add_faces_of(const hulls::Model& model, ca::FeatureKind kind, int id, Normals normals) {
  if (model.parts.empty()) return add_faces(model, kind, id, normals);
  const auto after = std::upper_bound(model.first_name.begin(), model.first_name.end(), id);
  const auto part = static_cast<std::size_t>(after - model.first_name.begin() - 1);
  add_faces(model.parts[part], kind, id - model.first_name[part], normals);
}

// Calls `look` with convex bodies that together contain the model: its parts, itself if it is convex, or a mesh's hull.
template <class Look>
void for_hulls(const hulls::Model& model, Look&& look) {
  for (const hulls::Model& part : model.parts) look(part.leaf(0));
  if (model.parts.empty()) look(model.filled ? model.leaf(0) : model.whole());
}
template <class Look>
void for_hulls(const hulls::Model& a, const hulls::Model& b, Look&& look) {
  for_hulls(a,
            [&](const ca::Convex& of_a) { for_hulls(b, [&](const ca::Convex& of_b) { look(of_a, of_b); }); });
}

double gap_at(const NearPair& pair, const ca::PairPose& pose, const Vec3& normal) {
  double least = std::numeric_limits<double>::infinity();
  for_hulls(pair.a, pair.b, [&](const ca::Convex& a, const ca::Convex& b) {
    least = std::min(least, ca::support_gap(a, b, pose, normal));
  });
  return least;
}

}  // namespace

double closing_speed(const NearPair& pair, const Vec3& normal, const Witnesses& at) {
  const Vec3 centres = ca::relative_velocity(pair.motion_a, pair.motion_b, pair.time);
  const Vec3 turning = pair.motion_a.spin_at(pair.time).cross(at.point_a) -
                       pair.motion_b.spin_at(pair.time).cross(at.point_b - pair.pose.offset_world);
  return normal.dot(centres + turning);
}

std::vector<Vec3> faces_beside(const NearPair& pair, const ca::FeaturePair& features) {
  std::vector<Vec3> normals;
  add_faces_of(pair.a, features.kind_a, features.id_a, {pair.pose.rotation_a, 1, normals});
  add_faces_of(pair.b, features.kind_b, features.id_b, {pair.pose.rotation_b, -1, normals});
  return normals;
}

std::vector<Vec3> faces_beside(const NearPair& pair, const hulls::LeafPair& leaves, const Witnesses& at) {
  std::vector<Vec3> normals;
  const ca::PairPose& pose = pair.pose;
  add_faces(pair.a, leaves.a, pose.rotation_a.transpose() * at.point_a, {pose.rotation_a, 1, normals});
  add_faces(pair.b, leaves.b, pose.rotation_b.transpose() * (at.point_b - pose.offset_world),
            {pose.rotation_b, -1, normals});
  return normals;
}

double gap_along(const NearPair& pair, const Vec3& normal) {
  return gap_at(pair, pair.pose, normal);
}

std::optional<Vec3> slowest_plane(const NearPair& pair, const std::vector<Vec3>& normals, const Witnesses& at,
                                  double fastest, double least) {
  std::optional<Vec3> best;
  for (const Vec3& n : normals) {
    const double speed = closing_speed(pair, n, at);
    if (speed > fastest || gap_along(pair, n) < least) continue;
    fastest = speed;
    best = n;
  }
  return best;
}

double clear_along(const NearPair& pair, const Vec3& normal, double target, double interval) {
  const double end = pair.time + interval;
  double t = pair.time;
  for (int k = 0; k < kPlaneSteps; ++k) {
    const ca::PairPose pose(pair.motion_a, pair.motion_b, t);
    const double room = gap_at(pair, pose, normal) - target;
    if (!(room > 0)) break;
    double step = std::numeric_limits<double>::infinity();
    for_hulls(pair.a, pair.b, [&](const ca::Convex& a, const ca::Convex& b) {
      const hulls::SafeStep safe =
          hulls::points_step(pair.motion_a, a, pair.motion_b, b, pose, normal, t, end, room);
      step = std::min(step, safe.time);
    });
    step *= 1 - kShorter;
    if (t + step >= end) return interval;
    if (!(step > std::numeric_limits<double>::epsilon() * end)) break;
    t += step;
  }
  return t - pair.time;
}

}  // namespace fc::world
