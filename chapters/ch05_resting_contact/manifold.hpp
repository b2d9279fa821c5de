// The contact manifold of two convex bodies: where their nearest faces lie over each other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ch02_hull_hierarchy/model_distance.hpp"
#include "ch02_hull_hierarchy/outline.hpp"

namespace fc::resting {

// The faces of a convex shape as polygons; a segment and a point have none.
struct FaceList {
  hulls::Lists corners;       // vertices of each face, anticlockwise as seen from outside
  std::vector<Vec3> normals;  // unit, outward, shape axes

  int size() const { return static_cast<int>(normals.size()); }
};

FaceList build_face_list(const hulls::FeatureMesh& mesh);

struct ManifoldPoint {
  static constexpr std::uint64_t kBroughtTogether =
      4;  // key of a point where the two bodies do not face each other
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  // m, on the surfaces, each in its body's axes
  double gap = 0;                                       // m, along the manifold's normal
  std::uint64_t key = 0;  // which edges meet there: the same point keeps its key in the next frame
};

// Points at which two bodies face each other along one plane that separates them.
struct Manifold {
  static constexpr int kMost = 24;
  Vec3 normal = Vec3::UnitZ();  // unit, world, from A to B
  bool of_b = false;            // the plane is a face of B; else it is one of A, or crosses two edges
  double gap = 0;               // m, certified, along the normal
  std::array<ManifoldPoint, kMost> points;
  int count = 0;
};

// One body of the pair.
struct ManifoldSide {
  const hulls::Model& model;
  const FaceList& faces;
};

// The manifold at a pose. Its plane is the one that `nearest` found; or that of a face, if it separates the bodies as
// well up to `slack` (m): a face's normal is exact. The two nearest faces are projected onto each other along the
// normal, and the corners of their common area are the points; those with a gap above `far` (m) are left out. Where the
// faces give no point, the witness points of `nearest` do. A segment or a point counts as a face, and so does the
// outline of a cylinder or cone towards the other body (outline.hpp).
void find_manifold(const ManifoldSide& a, const ManifoldSide& b, const ca::PairPose& pose,
                   const ca::GjkResult& nearest, double slack, double far, Manifold& manifold);

}  // namespace fc::resting
