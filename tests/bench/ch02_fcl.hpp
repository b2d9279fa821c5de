// FCL's view of the queries of bench_ch02.
#pragma once

#include <cstdint>
#include <memory>

#include "common/mesh.hpp"
#include "common/types.hpp"

namespace fc::bench {

class FclMesh;  // a hierarchy of rectangle swept spheres (RSS) over a mesh

std::shared_ptr<const FclMesh> fcl_mesh(const TriangleMesh& mesh);

// Two bodies whose motion is given by its ends, t = 0 and t = 1 s: between them each moves evenly, and turns
// evenly, by less than pi, about its axes' origin.
struct FclEnds {
  Pose from_a, to_a, from_b, to_b;
};

struct FclAnswer {
  bool hit = false;
  double toc = 1;       // s
  double gap = 0;       // m, at toc
  bool failed = false;  // the iteration limit was reached
  std::int64_t iterations = 0;
  std::int64_t volume_tests = 0, triangle_tests = 0;  // if asked for
};

// Conservative advancement on FCL's oriented RSS traversal, until the meshes are at most `tolerance` (m) apart. FCL's
// public call takes another path, which misses contacts; this is the valid one.
FclAnswer fcl_advance(const FclMesh& mesh, const FclEnds& ends, double tolerance, bool statistics = false);

// FCL's public continuousCollide with CCDC_CONSERVATIVE_ADVANCEMENT, as it is.
FclAnswer fcl_public(const FclMesh& mesh, const FclEnds& ends, double time_tolerance);

// The distance at one pose, m; 0 if the meshes overlap.
double fcl_distance(const FclMesh& mesh, const Pose& a, const Pose& b);

// Where FCL's motion has a body at time t.
Pose fcl_pose(const Pose& from, const Pose& to, double t);

}  // namespace fc::bench
