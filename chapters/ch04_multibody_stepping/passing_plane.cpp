#include "ch04_multibody_stepping/passing_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ch02_hull_hierarchy/steps.hpp"

namespace fc::world {
namespace {

// A face passes through a point if its plane is no farther from it than this share of the body's reach. Consequence: with
// less, faces are missed where coordinates are rounded; with more, faces beside the contact are tried in vain.
constexpr double kOnFace = 1e-5;

// Steps along one plane: a pair that slides or parts needs one or two, and one that closes in does not pass.
constexpr int kPlaneSteps = 8;

// A step in double precision: its own rounding.
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

// Adds normals turned into the world, each once.
struct Normals {
  const Mat3& rotation;
  double sign;
  std::vector<Vec3>& all;

  void add(const Vec3& normal) {
    const Vec3 n = sign * (rotation * normal);
    if (std::find(all.begin(), all.end(), n) == all.end()) all.push_back(n);
  }
};

void add_faces(const hulls::FeatureMesh& mesh, ca::FeatureKind kind, int id, Normals normals) {
  if (mesh.triangles.empty()) return;
  if (kind == ca::FeatureKind::face) normals.add(mesh.normals[id]);
  if (kind == ca::FeatureKind::edge)
    for (int k = mesh.edge_triangles.start[id]; k < mesh.edge_triangles.start[id + 1]; ++k)
      normals.add(mesh.normals[mesh.edge_triangles.items[k]]);
  if (kind == ca::FeatureKind::vertex)
    for_triangles_at(mesh, id, [&](int t) { normals.add(mesh.normals[t]); });
}

void add_faces(const hulls::Model& model, int leaf, const Vec3& point, Normals normals) {
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

// The convex hull of a model: the quicker view of it where the model is convex itself.
ca::Convex hull_of(const hulls::Model& model) {
  return model.filled ? model.leaf(0) : model.whole();
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
  add_faces(pair.a.mesh, features.kind_a, features.id_a, {pair.pose.rotation_a, 1, normals});
  add_faces(pair.b.mesh, features.kind_b, features.id_b, {pair.pose.rotation_b, -1, normals});
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
  return ca::support_gap(hull_of(pair.a), hull_of(pair.b), pair.pose, normal);
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
  const ca::Convex hull_a = hull_of(pair.a), hull_b = hull_of(pair.b);
  const double end = pair.time + interval;
  double t = pair.time;
  for (int k = 0; k < kPlaneSteps; ++k) {
    const ca::PairPose pose(pair.motion_a, pair.motion_b, t);
    const double room = ca::support_gap(hull_a, hull_b, pose, normal) - target;
    if (!(room > 0)) break;
    const hulls::SafeStep step =
        hulls::points_step(pair.motion_a, hull_a, pair.motion_b, hull_b, pose, normal, t, end, room);
    if (t + (1 - kShorter) * step.time >= end) return interval;
    if (!(step.time > std::numeric_limits<double>::epsilon() * end)) break;
    t += (1 - kShorter) * step.time;
  }
  return t - pair.time;
}

}  // namespace fc::world
