// The shell's contacts, kept from frame to frame.
#pragma once

#include <limits>
#include <vector>

#include "ch04_multibody_stepping/world.hpp"
#include "ch05_resting_contact/patch.hpp"

namespace fc::resting {

// A contact that lasts: where it is on both bodies, and what its rows are made of now.
struct ShellContact {
  lcp::Contact contact;   // restitution: the pair's; gap in m
  Vec3 local_a, local_b;  // m, on the surfaces, each in its body's axes
  Vec3 local_normal;      // from A to B, in the axes of A, or of B if `of_b`
  bool of_b = false;
  std::uint64_t key = 0;               // see PatchPoint
  double impulse = 0;                  // N s, of the last frame, or 0 if it is new
  double bounce = 0, bounce_next = 0;  // m/s, with which it is to part in this frame, and in the next, since
                                       // it came in so fast in the frame before
  double lift = 0;  // m, by how much more its gap must grow until the frame's end: it is narrower before
  double before = 0, after = 0;  // m/s, its velocity without and with the frame's impulses

  Vec3 normal_at(const Pose& a, const Pose& b) const { return (of_b ? b : a).rotation * local_normal; }
  double gap_at(const Pose& a, const Pose& b) const {
    return normal_at(a, b).dot((b.position - a.position) + (b.rotation * local_b - a.rotation * local_a));
  }
};

// Two bodies that are near each other, and what is known of the gap between them.
struct ShellPair {
  int a = 0, b = 0;          // a < b
  int first = 0, count = 0;  // contacts
  double gap = 0;            // m, certified, at the frame's start
  // When it was last searched: the smaller body as seen from the larger, and the gap.
  Pose searched;
  double searched_gap = 0;  // m, certified
  bool known = false;       // it was searched at all
  bool fresh = false;       // it has just come into the list
  bool stale = false;       // its contacts were found elsewhere than where the bodies stand
  bool proved = false;      // its way through the frame
  bool open = false;        // that is still to be mended, from this time on (s)
  double nearest_time = 0;
  // The plane that certified it.
  Vec3 axis = Vec3::UnitZ();  // unit, from A to B, in the axes of A, or of B if `of_b`
  double axis_gap = 0;        // m, along it, certified, at the frame's start; if `axis_known`
  bool axis_known = false;
  bool of_b = false;
  ca::SimplexCache simplex;

  Vec3 axis_at(const Pose& a_now, const Pose& b_now) const { return (of_b ? b_now : a_now).rotation * axis; }
};

// How far a body goes within a frame, at most: its centre near a straight line, and its axes.
struct Sweep {
  Vec3 end = Vec3::Zero();  // m
  double turn = 0;          // rad
  double sag = 0;           // m, by how much the centre leaves the line
};

class Shell {
 public:
  Shell(const world::World& world, double envelope);
  double envelope() const { return envelope_; }

  // All contacts between bodies of the world as they stand now, by pairs in order. Pairs are those whose
  // bodies can come within two envelopes of each other in their sweeps, one for each body.
  void find(const world::World& world, const std::vector<Sweep>& sweeps);
  // The same with wider sweeps: pairs that come in have their contacts at the end of contacts().
  void extend(const world::World& world, const std::vector<Sweep>& sweeps);
  // The certified gap of a convex pair along its axis, at other poses.
  double axis_gap(const world::World& world, const ShellPair& pair, const Pose& a, const Pose& b) const;

  const std::vector<Pose>& poses() const { return poses_; }  // of all bodies, when find() was called
  std::vector<ShellPair>& pairs() { return pairs_; }
  std::vector<ShellContact>& contacts() { return contacts_; }
  const std::vector<ShellContact>& contacts() const { return contacts_; }
  double smallest_gap() const { return smallest_gap_; }  // m, certified; infinite if no pair is in the shell
  std::int64_t searched() const { return searched_; }    // pairs, in the last find()

  // The pair's contacts as they are at other poses, beside those that it has: they stand at the end of
  // contacts(), and are what it is known by from now on. The gap there, in m, certified.
  double search_at(const world::World& world, ShellPair& pair, const Pose& a, const Pose& b);
  // The nearest points of the two at a pose, as GJK finds them. Convex shapes only.
  ca::GjkResult nearest(const world::World& world, ShellPair& pair, const ca::PairPose& pose) const;
  bool convex(const world::World& world, const ShellPair& pair) const {
    return world.convex(pair.a) && world.convex(pair.b);
  }

 private:
  void list_pairs(const world::World& world, const std::vector<Sweep>& sweeps);
  void update(const world::World& world, ShellPair& pair);
  void keep(ShellPair& pair, const Pose& a, const Pose& b);
  double search(const world::World& world, ShellPair& pair, const Pose& a, const Pose& b);

  double envelope_;
  std::vector<Facets> facets_;  // of each shape
  std::vector<Pose> poses_;
  std::vector<world::Bounds> listed_;  // with which the list was made
  world::BoundsTree tree_;
  std::vector<ShellPair> pairs_, pairs_before_;
  std::vector<ShellContact> contacts_, before_;
  std::int64_t searched_ = 0;
  double smallest_gap_ = 0;
};

}  // namespace fc::resting
