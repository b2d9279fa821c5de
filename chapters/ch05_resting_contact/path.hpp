// Whether two bodies keep apart on their paths through a frame.
#pragma once

#include "ch05_resting_contact/contacts.hpp"

namespace fc::resting {

// A body's path through a frame: the poses at both ends, and bounds of its motion between them.
struct Path {
  Pose start, end;
  Vec3 velocity = Vec3::Zero(), acceleration = Vec3::Zero(), spin = Vec3::Zero();  // m/s, m/s^2, rad/s
  double spin_rate = 0, reach = 0;                                                 // rad/s, m
  bool moves = false;
  bool steady = true;  // constant acceleration, constant spin
  ca::Motion motion;
};

// A body that moves straight on from a pose, with constant spin, for dt seconds.
Path straight_path(const RigidBody& start, const Vec3& velocity, const Vec3& spin, double reach, double dt);
// A body of the world as it moves from `now` on (s in the frame).
Path path_of(const world::World& world, int body, double now, double dt);

struct PathVerdict {
  bool clear = false;
  double time = 0;   // s, not clear: when the gap has come down to about `required_gap`
  double slack = 0;  // m, clear: how far above `required_gap` the gap is proved to stay
};

// How much effort a proof may take.
struct PathOptions {
  double required_gap = 0;  // m
  std::int64_t most_pairs =
      std::numeric_limits<std::int64_t>::max();  // of nodes; and no more than the scene's limit
  bool by_planes = false;  // of convex pairs: no advancement; the time is how far the planes prove the path
  bool whole = false;      // if the end is not clear, nothing more is tried: the time is the whole
};

// Whether the gap stays at least `required_gap` for dt seconds: either proved, or found to come down to it. Tried in
// this order:
//
//   1. by speed       gap - dt |largest relative velocity of two points| >= required_gap;
//   2. by planes      (convex pairs) that go with a body, or turn evenly from the best at the start to the best at the end: if
//                     the gap along one is s_0 and s_1 at the ends of an interval dt, then at the part x of it the gap is at
//                     least (1 - x) s_0 + x s_1 - k dt^2 x (1 - x) / 2, where k bounds how much the path of any point bends,
//                     as seen from the plane; intervals are halved where this bound is too small;
//   3. by conservative advancement (chapter 2).
PathVerdict check_path(const world::World& world, const Contacts& contacts, PairContacts& pair, const Path& a,
                       const Path& b, double dt, const PathOptions& options);

}  // namespace fc::resting
