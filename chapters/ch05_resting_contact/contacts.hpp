// The contacts of pairs of bodies: found once, and kept while the two move little relative to each other.
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ch04_multibody_stepping/world.hpp"
#include "ch05_resting_contact/manifold.hpp"

namespace fc::resting {

inline std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

// A place on a body's surface, where a plane touches it. On a face, edge or corner it is fixed in the body. On a round
// surface it moves with the plane: a ball's lies on its radius along the normal, that of a disk's rim where the rim is
// farthest out.
struct SurfacePoint {
  Vec3 local = Vec3::Zero();  // m, body axes: the point; of a rim the disk's centre
  double radius = 0;          // m, the body's rounding radius
  double rim = 0;             // m, the disk's radius; 0: none
  Vec3 axis = Vec3::UnitZ();  // unit, body axes, of the disk

  // direction: unit, world, from the body outwards.
  Vec3 at(const Pose& body, const Vec3& direction) const {
    Vec3 point = body * local + radius * direction;
    if (rim == 0) return point;
    const Vec3 across = body.rotation * axis;
    return point + rim * (direction - direction.dot(across) * across).normalized();
  }
};

// One point of contact of two bodies. The plane between the two moves with one of them.
struct ContactPoint {
  SurfacePoint a, b;
  Vec3 local_normal = Vec3::UnitZ();  // unit, from A to B, in the axes of A, or of B if `of_b`
  bool of_b = false;
  bool balls = false;         // two balls: the normal is along the line of their centres
  std::uint64_t key = 0;      // see ManifoldPoint
  Vec3 force = Vec3::Zero();  // N, on B, mean of the last plan: a guess for the next
  bool lasts = false;         // in contact during the whole of the last plan, which pushed the two bodies

  // ANCHOR: gap
  Vec3 normal_at(const Pose& pose_a, const Pose& pose_b) const {
    if (balls) return (pose_b * b.local - pose_a * a.local).normalized();
    return (of_b ? pose_b : pose_a).rotation * local_normal;
  }
  Vec3 on_a(const Pose& pose_a, const Pose& pose_b) const { return a.at(pose_a, normal_at(pose_a, pose_b)); }
  Vec3 on_b(const Pose& pose_a, const Pose& pose_b) const { return b.at(pose_b, -normal_at(pose_a, pose_b)); }
  double gap_at(const Pose& pose_a, const Pose& pose_b) const {
    const Vec3 normal = normal_at(pose_a, pose_b);
    return normal.dot(b.at(pose_b, -normal) - a.at(pose_a, normal));
  }
  // ANCHOR_END: gap
  Vec3 middle(const Pose& pose_a, const Pose& pose_b) const {
    const Vec3 normal = normal_at(pose_a, pose_b);
    return 0.5 * (a.at(pose_a, normal) + b.at(pose_b, -normal));
  }
  // Whether another point of the same pair is at the same place, within `near` (m), and has the same normal.
  bool is_same(const ContactPoint& other, double near) const {
    return key == other.key && of_b == other.of_b && (local_normal - other.local_normal).norm() < 1e-6 &&
           (a.local - other.a.local).norm() + (b.local - other.b.local).norm() < near;
  }
};

// Two bodies that come near each other, and what is known of the gap between them.
struct PairContacts {
  int a = 0, b = 0;                  // a < b
  std::vector<ContactPoint> points;  // none if the gap is wider than the margin, or was at the last search
  double gap = 0;                    // m, certified, at the poses of the last update()
  // At the last search: the pose of the smaller body seen from the larger, and the gap.
  Pose searched;
  double searched_gap = 0;  // m, certified
  bool known = false;       // it has been searched
  // The plane that certified it, and the gap along it at the poses of the last update().
  Vec3 axis = Vec3::UnitZ();  // unit, from A to B, in the axes of A, or of B if `of_b`
  bool of_b = false;
  double axis_gap = 0;  // m, certified
  bool axis_known = false;
  ca::SimplexCache simplex;
  std::int64_t used = 0;  // the last frame that used it
  std::int64_t plan = 0;  // the plan that queried it last, and its place there
  int place = -1;

  int rank() const { return static_cast<int>(std::min<std::size_t>(points.size(), 6)); }
  Vec3 axis_at(const Pose& a_now, const Pose& b_now) const { return (of_b ? b_now : a_now).rotation * axis; }
};

// What update() has to find.
struct SearchOptions {
  double reach = 0;  // m: contact points of convex pairs with a gap up to this; 0: the margin
  double again = 0;  // m: the relative motion after which they are found anew; 0: a quarter of the margin
};

class Contacts {
 public:
  // margin: m; bodies with a smaller gap are in contact.
  Contacts(const world::World& world, double margin);
  double margin() const { return margin_; }
  // Knows all pairs that `before` knows, of the same bodies and with the same margin.
  void take_over(const Contacts& before) {
    pairs_ = before.pairs_;
    frame_ = before.frame_;
    number_ = before.number_;
  }

  // The pair of two bodies, a != b; created if it is not known. The reference stays valid.
  PairContacts& pair(int a, int b);
  // Marks the pair as used in this frame.
  void use(PairContacts& pair) const { pair.used = frame_; }
  std::int64_t frame() const { return frame_; }
  // A number that no plan has had.
  std::int64_t next_number() { return ++number_; }
  // Forgets pairs that no frame has used for some time.
  void next_frame();
  std::int64_t searched() const { return searched_; }  // pairs, in total

  // Updates the pair's gap and points to these poses of its bodies.
  void update(const world::World& world, PairContacts& pair, const Pose& a, const Pose& b,
              const SearchOptions& options = {});
  // A certified bound of the gap (m) at these poses, from what is known already, without a search.
  double least_gap(const world::World& world, const PairContacts& pair, const Pose& a, const Pose& b) const;
  // The points that the two bodies have at other poses, and the gap there (m, certified). The pair keeps its own.
  std::vector<ContactPoint> points_at(const world::World& world, PairContacts& pair, const Pose& a,
                                      const Pose& b, double& gap);
  // The certified gap along the pair's plane, at other poses. Convex pairs only.
  double axis_gap(const world::World& world, const PairContacts& pair, const Pose& a, const Pose& b) const;
  // The nearest points of the two at a pose, as GJK finds them. Convex pairs only.
  ca::GjkResult nearest(const world::World& world, PairContacts& pair, const ca::PairPose& pose) const;
  static bool convex(const world::World& world, const PairContacts& pair) {
    return world.convex(pair.a) && world.convex(pair.b);
  }

 private:
  double search(const world::World& world, PairContacts& pair, const Pose& a, const Pose& b, double reach);
  ca::GjkResult known_plane(const world::World& world, const PairContacts& pair, const Pose& a,
                            const Pose& b) const;
  double search_convex(const world::World& world, PairContacts& pair, const Pose& a, const Pose& b,
                       double reach);
  double search_mesh(const world::World& world, PairContacts& pair, const Pose& a, const Pose& b);
  static void add(PairContacts& pair, const ContactPoint& point, const std::vector<ContactPoint>& before);

  double margin_;
  std::vector<FaceList> face_lists_;  // of each shape
  std::unordered_map<std::uint64_t, PairContacts> pairs_;
  std::int64_t frame_ = 0, searched_ = 0, number_ = 0;
};

}  // namespace fc::resting
