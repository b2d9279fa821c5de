// Chapter 1 beside Bullet and FCL: distance, and first contact of moving convex hulls. See --help of Google
// Benchmark; every row has median_ns and p95_ns over its queries, and what the method got wrong.
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <fcl/fcl.h>
#include <fcl/math/motion/interp_motion.h>

#include <memory>

#include "tests/bench/bench.hpp"
#include "tests/bench/ch01_cases.hpp"

namespace {

using namespace fc;
using namespace fc::bench;

constexpr double kTolerance = 1e-6;  // m

// The truth of one query: our answer at a hundred-thousandth of the tolerance (tests/ch01 holds that to
// closed forms and to a slow reference).
struct Truth {
  bool hit = false;
  double toc = 1;
  double distance = 0;  // at the start
};

ca::AdvanceResult ours(const HullPair& pair, double tolerance) {
  ca::AdvanceOptions options;
  options.tolerance = tolerance;
  return ca::advance(pair.core_a.convex(0), pair.motion_a, pair.core_b.convex(0), pair.motion_b, options);
}

std::vector<Truth> truths(const std::vector<HullPair>& pairs) {
  std::vector<Truth> all;
  for (const HullPair& pair : pairs) {
    const ca::AdvanceResult exact = ours(pair, 1e-11);
    const ca::GjkResult g = ca::distance(pair.core_a.convex(0), pair.core_b.convex(0),
                                         ca::PairPose(pair.motion_a, pair.motion_b, 0), {0, 1e-15, 128});
    all.push_back({exact.status == ca::Status::contact, exact.toc, g.upper});
  }
  return all;
}

void count(Verdict& verdict, const Truth& truth, bool hit, double toc) {
  if (truth.hit && !hit) ++verdict.misses;
  if (truth.hit && hit && toc > truth.toc + 1e-9) ++verdict.late;
}

// Bullet's view of a pair.
struct BulletPair {
  std::unique_ptr<btConvexHullShape> a, b;
  btTransform from_a, to_a, from_b, to_b;
};
btTransform bullet(const Pose& pose) {
  const Quat q(pose.rotation);
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()),
                     btVector3(pose.position.x(), pose.position.y(), pose.position.z()));
}
std::vector<BulletPair> bullet_pairs(const std::vector<HullPair>& pairs) {
  const auto shape = [](const TriangleMesh& mesh) {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vec3& p : mesh.vertices) hull->addPoint(btVector3(p.x(), p.y(), p.z()), false);
    hull->setMargin(0);
    hull->recalcLocalAabb();
    return hull;
  };
  std::vector<BulletPair> all;
  for (const HullPair& p : pairs)
    all.push_back({shape(p.hull_a), shape(p.hull_b), bullet(p.motion_a.pose_at(0)),
                   bullet(p.motion_a.pose_at(1)), bullet(p.motion_b.pose_at(0)),
                   bullet(p.motion_b.pose_at(1))});
  return all;
}

// FCL's. Its constructor with two poses leaves the reference point unset in 0.7.0, the one with three does
// not compute the velocities.
struct FclMotion : fcl::InterpMotion<double> {
  FclMotion(const fcl::Transform3d& from, const fcl::Transform3d& to)
      : fcl::InterpMotion<double>(from, to, fcl::Vector3d::Zero()) {
    computeVelocity();
  }
};
struct FclPair {
  std::shared_ptr<fcl::Convexd> a, b;
  fcl::Transform3d from_a, to_a, from_b, to_b;
};
std::vector<FclPair> fcl_pairs(const std::vector<HullPair>& pairs) {
  const auto shape = [](const TriangleMesh& mesh) {
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>(mesh.vertices.begin(), mesh.vertices.end());
    auto faces = std::make_shared<std::vector<int>>();
    for (const auto& t : mesh.triangles) faces->insert(faces->end(), {3, t[0], t[1], t[2]});
    auto convex = std::make_shared<fcl::Convexd>(vertices, static_cast<int>(mesh.triangles.size()), faces);
    convex->computeLocalAABB();
    return convex;
  };
  const auto transform = [](const Pose& pose) {
    fcl::Transform3d t = fcl::Transform3d::Identity();
    t.linear() = pose.rotation;
    t.translation() = pose.position;
    return t;
  };
  std::vector<FclPair> all;
  for (const HullPair& p : pairs)
    all.push_back({shape(p.hull_a), shape(p.hull_b), transform(p.motion_a.pose_at(0)),
                   transform(p.motion_a.pose_at(1)), transform(p.motion_b.pose_at(0)),
                   transform(p.motion_b.pose_at(1))});
  return all;
}

// first contact
// -----------------------------------------------------------------------------------------------

struct Answer {
  bool hit = false;
  double toc = 1;
  bool failed = false;
};

Answer ask_ours(const HullPair& pair) {
  const ca::AdvanceResult r = ours(pair, kTolerance);
  return {r.status == ca::Status::contact, r.toc, r.status == ca::Status::unresolved};
}
Answer ask_bullet(const BulletPair& pair) {
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btContinuousConvexCollision cast(pair.a.get(), pair.b.get(), &simplex, &depth);
  btConvexCast::CastResult result;
  const bool hit = cast.calcTimeOfImpact(pair.from_a, pair.to_a, pair.from_b, pair.to_b, result);
  return {hit, result.m_fraction};
}
Answer ask_fcl(const FclPair& pair, fcl::GJKSolverType solver) {
  const FclMotion a(pair.from_a, pair.to_a), b(pair.from_b, pair.to_b);
  const fcl::ContinuousCollisionRequestd request(10, 1e-6, fcl::CCDM_LINEAR, solver,
                                                 fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
  fcl::ContinuousCollisionResultd result;
  fcl::continuousCollide(pair.a.get(), &a, pair.b.get(), &b, request, result);
  return {result.is_collide, result.time_of_contact};
}

template <class Pairs, class Ask>
void add_contact_row(const std::string& name, std::shared_ptr<Pairs> pairs,
                     std::shared_ptr<std::vector<Truth>> truth, const Ask& ask) {
  const int n = static_cast<int>(pairs->size());
  add_row(
      name, n, [=](int i) { return ask((*pairs)[i]).toc; },
      [=] {
        Verdict verdict;
        for (int i = 0; i < n; ++i) {
          const Answer answer = ask((*pairs)[i]);
          count(verdict, (*truth)[i], answer.hit, answer.toc);
          verdict.failed += answer.failed;
        }
        return verdict;
      });
}

// distance
// ----------------------------------------------------------------------------------------------------

double distance_ours(const HullPair& pair) {
  return ca::distance(pair.core_a.convex(0), pair.core_b.convex(0),
                      ca::PairPose(pair.motion_a, pair.motion_b, 0), {0, 1e-9, 128})
      .upper;
}
double distance_bullet(const BulletPair& pair) {
  btVoronoiSimplexSolver simplex;
  btGjkPairDetector gjk(pair.a.get(), pair.b.get(), &simplex, nullptr);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = pair.from_a;
  input.m_transformB = pair.from_b;
  btPointCollector result;
  gjk.getClosestPoints(input, result, nullptr);
  return result.m_hasResult ? result.m_distance : -1;
}
double distance_fcl(const FclPair& pair, fcl::GJKSolverType solver) {
  fcl::DistanceRequestd request(true);
  request.gjk_solver_type = solver;
  fcl::DistanceResultd result;
  return fcl::distance(pair.a.get(), pair.from_a, pair.b.get(), pair.from_b, request, result);
}

// An answer is wrong if it is off by more than 1e-4 of the distance.
template <class Pairs, class Ask>
void add_distance_row(const std::string& name, std::shared_ptr<Pairs> pairs,
                      std::shared_ptr<std::vector<Truth>> truth, const Ask& ask) {
  const int n = static_cast<int>(pairs->size());
  add_row(
      name, n, [=](int i) { return ask((*pairs)[i]); },
      [=] {
        Verdict verdict;
        for (int i = 0; i < n; ++i)
          verdict.failed +=
              !(std::abs(ask((*pairs)[i]) - (*truth)[i].distance) <= 1e-4 * (*truth)[i].distance);
        return verdict;
      });
}

void add_cases(int vertices) {
  const std::string size = std::to_string(vertices);
  const auto libccd = fcl::GST_LIBCCD, own = fcl::GST_INDEP;
  for (const bool rotating : {true, false}) {
    const auto pairs =
        std::make_shared<std::vector<HullPair>>(hull_pairs(1000, vertices, rotating ? 0.75 : 0, 1));
    const auto truth = std::make_shared<std::vector<Truth>>(truths(*pairs));
    const auto bullets = std::make_shared<std::vector<BulletPair>>(bullet_pairs(*pairs));
    const auto fcls = std::make_shared<std::vector<FclPair>>(fcl_pairs(*pairs));
    const std::string name = (rotating ? "rotating_hull_" : "translating_hull_") + size;
    add_contact_row(name + "/ours", pairs, truth, ask_ours);
    add_contact_row(name + "/bullet", bullets, truth, ask_bullet);
    add_contact_row(name + "/fcl_libccd", fcls, truth, [=](const FclPair& p) { return ask_fcl(p, libccd); });
    add_contact_row(name + "/fcl_own", fcls, truth, [=](const FclPair& p) { return ask_fcl(p, own); });
    if (!rotating) continue;
    add_distance_row("distance_hull_" + size + "/ours", pairs, truth, distance_ours);
    add_distance_row("distance_hull_" + size + "/bullet", bullets, truth, distance_bullet);
    add_distance_row("distance_hull_" + size + "/fcl_libccd", fcls, truth,
                     [=](const FclPair& p) { return distance_fcl(p, libccd); });
    add_distance_row("distance_hull_" + size + "/fcl_own", fcls, truth,
                     [=](const FclPair& p) { return distance_fcl(p, own); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  for (const int vertices : {32, 128, 512}) add_cases(vertices);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
