#include "tests/bench/ch02_fcl.hpp"

#include <fcl/fcl.h>
#include <fcl/math/motion/interp_motion.h>
#include <fcl/narrowphase/detail/traversal/distance/mesh_conservative_advancement_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/traversal_recurse.h>

#include <algorithm>
#include <limits>
#include <vector>

static_assert(EIGEN_MAX_STATIC_ALIGN_BYTES == 16,
              "else FCL's types are laid out otherwise than in Debian's library");

namespace fc::bench {
namespace {

// After this many steps a pair is given up: it hardly moves, at a distance above the tolerance.
constexpr int kMaxIterations = 10'000;

fcl::Transform3d transform(const Pose& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = pose.rotation;
  t.translation() = pose.position;
  return t;
}

// Its constructor with two poses leaves the reference point unset in 0.7.0, the one with three arguments does
// not compute the velocities.
struct EvenMotion : fcl::InterpMotion<double> {
  EvenMotion(const Pose& from, const Pose& to)
      : fcl::InterpMotion<double>(transform(from), transform(to), fcl::Vector3d::Zero()) {
    computeVelocity();
  }
};

}  // namespace

class FclMesh {
 public:
  fcl::BVHModel<fcl::RSSd> model;
};

std::shared_ptr<const FclMesh> fcl_mesh(const TriangleMesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles)
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  auto made = std::make_shared<FclMesh>();
  made->model.beginModel();
  made->model.addSubModel(mesh.vertices, triangles);
  made->model.endModel();
  made->model.computeLocalAABB();
  return made;
}

FclAnswer fcl_advance(const FclMesh& mesh, const FclEnds& ends, double tolerance, bool statistics) {
  const EvenMotion a(ends.from_a, ends.to_a), b(ends.from_b, ends.to_b);
  fcl::Transform3d pose_a, pose_b;
  a.getCurrentTransform(pose_a);
  b.getCurrentTransform(pose_b);
  fcl::detail::MeshConservativeAdvancementTraversalNodeRSSd node;
  fcl::detail::initialize(node, mesh.model, pose_a, mesh.model, pose_b);
  node.motion1 = &a;
  node.motion2 = &b;
  node.enable_statistics = statistics;
  node.num_bv_tests = node.num_leaf_tests = 0;

  FclAnswer answer;
  double t = 0;
  while (true) {
    // The traversal leaves the smallest distance, and a time during which no pair can meet.
    node.delta_t = 1;
    node.min_distance = std::numeric_limits<double>::max();
    fcl::detail::distanceRecurse<double>(&node, 0, 0, nullptr);
    ++answer.iterations;
    if (node.min_distance <= tolerance) {
      answer.hit = true;
      answer.toc = t;
      answer.gap = node.min_distance;
      break;
    }
    t += node.delta_t;
    if (t >= 1) break;
    if (answer.iterations == kMaxIterations) {
      answer.failed = true;
      break;
    }
    a.integrate(t);
    b.integrate(t);
    a.getCurrentTransform(pose_a);
    b.getCurrentTransform(pose_b);
    const fcl::Transform3d b_in_a = pose_a.inverse(Eigen::Isometry) * pose_b;
    node.R = b_in_a.linear();
    node.T = b_in_a.translation();
  }
  answer.volume_tests = node.num_bv_tests;
  answer.triangle_tests = node.num_leaf_tests;
  return answer;
}

FclAnswer fcl_public(const FclMesh& mesh, const FclEnds& ends, double time_tolerance) {
  const EvenMotion a(ends.from_a, ends.to_a), b(ends.from_b, ends.to_b);
  const fcl::ContinuousCollisionRequestd request(100, time_tolerance, fcl::CCDM_LINEAR, fcl::GST_LIBCCD,
                                                 fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
  fcl::ContinuousCollisionResultd result;
  fcl::continuousCollide(&mesh.model, &a, &mesh.model, &b, request, result);
  FclAnswer answer;
  answer.hit = result.is_collide;
  answer.toc = result.time_of_contact;
  return answer;
}

double fcl_distance(const FclMesh& mesh, const Pose& a, const Pose& b) {
  const fcl::DistanceRequestd request(true);  // with the nearest points, as ours
  fcl::DistanceResultd result;
  return std::max(0.0, fcl::distance(&mesh.model, transform(a), &mesh.model, transform(b), request, result));
}

Pose fcl_pose(const Pose& from, const Pose& to, double t) {
  const EvenMotion motion(from, to);
  motion.integrate(t);
  fcl::Transform3d pose;
  motion.getCurrentTransform(pose);
  return {pose.linear(), pose.translation()};
}

}  // namespace fc::bench
