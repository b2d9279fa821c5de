// Distance of two convex cores by the method of Gilbert, Johnson and Keerthi, with a bound on each side.
#pragma once

#include <array>
#include <ostream>

#include "ch01_convex_advancement/convex.hpp"
#include "ch01_convex_advancement/motion.hpp"

namespace fc::ca {

// The pairs of support points at which GJK stopped, each in its own body's axes. GJK can start from them at a
// nearby pose.
struct SimplexCache {
  std::array<SupportPoint, 4> a, b;
  int count = 0;
};

struct GjkOptions {
  double absolute = 1e-9;  // m; stop when upper - lower is at most this ...
  double relative = 1e-6;  // ... or this times upper
  int max_iterations = 128;
};

struct GjkResult {
  enum class Status {
    separated,    // lower > 0
    overlapping,  // the cores share a point, or come closer than rounding can tell; no plane was found
    limit         // max_iterations was reached; the bounds hold all the same
  };
  Status status = Status::limit;
  double upper = 0;  // m, distance of the witness points; 0 if overlapping
  double lower = 0;  // m, certified: the gap between the shapes along `normal`, less the rounding term
  Vec3 normal = Vec3::UnitX();  // unit, from A to B, world: the plane that certifies `lower`
  Vec3 point_a = Vec3::Zero();  // witness points: where A and B are `upper` apart;
  Vec3 point_b = Vec3::Zero();  //   world axes, from A's centre of mass
  int iterations = 0;
  SimplexCache cache;  // empty if the cores overlap: then there are no witness points either
};
inline std::ostream& operator<<(std::ostream& out, GjkResult::Status status) {
  constexpr const char* kNames[] = {"separated", "overlapping", "limit"};
  return out << kNames[static_cast<int>(status)];
}

// The rounding term in m: how far a support gap computed in double precision can lie above the true one. A
// support value is n.(R b + p - a): a product of rotations, a rotated vector, two sums and a dot product,
// each of relative error of a few eps = 2.2e-16; together at most 32 eps times the size of what is summed.
// The pose itself is known to a few eps times the distance and the angle that led to it: a body that came
// from afar, or has spun for long, has that error in its place.
double rounding_term(const Convex& a, const Convex& b, const PairPose& pose);

// Distance of A and B at the given pose. For every unit n the support gap  min n.b - max n.a  is a lower
// bound of the distance, converged or not; `lower` is the largest that the iterations saw. Works for every
// simplex, flat shapes and single points included. `cache` (optional) is read as the first simplex. Gilbert,
// Johnson, Keerthi (1988); van den Bergen (1999) for the bound.
GjkResult distance(const Convex& a, const Convex& b, const PairPose& pose, const GjkOptions& options,
                   const SimplexCache* cache = nullptr);

// The certified gap along a given unit normal (world, from A to B), in m; negative where the shapes overlap
// along it.
double support_gap(const Convex& a, const Convex& b, const PairPose& pose, const Vec3& normal);

// For cores that touch or overlap: the best plane out of eight. B is pushed aside by `push` (m, small against
// the shapes, large against the overlap that matters) in eight directions, one of them `hint` (world; the
// best normal so far), and GJK finds the plane there. `lower` is the certified gap along it at the true pose:
// a lower bound of the signed distance, negative where the shapes overlap. The witness points are where the
// pushed shapes are nearest, each on its shape at the true pose.
constexpr int kTouchingPlaneCalls = 8;
GjkResult touching_plane(const Convex& a, const Convex& b, const PairPose& pose, double push,
                         const Vec3& hint);

}  // namespace fc::ca
