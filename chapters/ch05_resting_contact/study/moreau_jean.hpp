// Velocity-level time stepping after Moreau (1988) and Jean (1999), for the study alone: this chapter's step without an
// envelope and without proofs.
#pragma once

#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch04_multibody_stepping/world.hpp"
#include "ch05_resting_contact/manifold.hpp"

namespace fc::resting {

// Contact points of two convex bodies, also where they overlap, and how deep: the bodies are examined after being
// pushed apart along the last normal.
class Facing {
 public:
  // Remembers the shapes of the world, and a normal for each pair.
  explicit Facing(const world::World& world);
  // The points of the pair with a gap of at most `far` (m); null if their boxes are farther apart than that. A gap is
  // negative by as much as the bodies overlap along the manifold's normal. The reference is valid until the next call.
  // Overlaps of up to a fifth of the smaller body's reach are reported correctly.
  const Manifold* find(const world::World& world, int a, int b, double far);
  std::int64_t searches() const { return searches_; }

 private:
  std::vector<FaceList> face_lists_;
  std::map<std::pair<int, int>, Vec3> normals_;
  Manifold manifold_;
  std::int64_t searches_ = 0;
};

// The smallest gap of all pairs nearer than `far` (m), negative for an overlap; infinite if there is none.
double smallest_gap(Facing& facing, const world::World& world, double far);

// Frames of one length. A contact takes part if its gap is not positive at the frame's start, or would not be at its
// end if nothing changed: g + dt v <= 0 (up to the world's tolerance: otherwise rounding would decide what lies on
// what). For those
//
//   w = v+ + e v- >= 0,  j >= 0,  j'w = 0,     v+ = v- + dt gravity + M^-1 J' j,
//
// and then all bodies move on with v+ (theta = 1). No times of contact are computed, paths are not checked, and
// positions are never corrected.
class MoreauJean {
 public:
  struct Report {
    int rows = 0;
    double residual = 0;
    std::int64_t searches = 0;  // of pairs
    std::int64_t ns = 0;
  };
  MoreauJean(const world::World& world, double dt) : facing_(world), dt_(dt) {}
  // Reports each impulse to `impact`. Throws NumericalFailure if the contacts cannot be solved.
  Report step(world::World& world, const world::OnImpact& impact = {});

 private:
  void find_contacts(const world::World& world);

  Facing facing_;
  double dt_;  // s
  std::vector<RigidBody> bodies_;
  std::vector<lcp::Contact> contacts_;
  lcp::DantzigSolver solver_;
};

}  // namespace fc::resting
