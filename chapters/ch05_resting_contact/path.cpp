#include "ch05_resting_contact/path.hpp"

#include <algorithm>

namespace fc::resting {
namespace {

// How much a point of `body` is accelerated at most, as seen by one who stands on `viewer` and turns with it
// (m/s^2): p'' = a_p - w x (w x r) - 2 w x u, with r from the viewer's centre and u the velocity that it
// sees.
double bend_seen_from(const Track& viewer, const Track& body, double dt) {
  const Vec3 apart = body.start.position - viewer.start.position, velocity = body.velocity - viewer.velocity;
  const double acceleration = (body.acceleration - viewer.acceleration).norm();
  const double turning = (body.spin - viewer.spin).norm(), w = viewer.spin_rate, speed = velocity.norm();
  const double bend = acceleration + turning * (w + body.spin_rate) * body.reach;
  if (w == 0) return bend;
  const double seen =
      (velocity - viewer.spin.cross(apart)).norm() + dt * (acceleration + w * speed) + turning * body.reach;
  return bend + w * w * (apart.norm() + dt * speed) + 2 * w * seen;
}

// The least that a function can be on [0, 1] that is `start` and `end` at its ends, and lies no more than
// 4 sag x (1 - x) below the line between them.
// ANCHOR: least
double least_between(double start, double end, double sag) {
  const double slope = end - start - 4 * sag;  // at the start
  if (slope >= 0) return start;
  const double x = sag > 0 ? std::min(1.0, -slope / (8 * sag)) : 1.0;
  return start + x * (slope + 4 * sag * x);
}
// ANCHOR_END: least

double bend_in_the_world(const Track& a, const Track& b) {
  return (b.acceleration - a.acceleration).norm() + a.spin_rate * a.spin_rate * a.reach +
         b.spin_rate * b.spin_rate * b.reach;
}

}  // namespace

Track straight_track(const RigidBody& start, const Vec3& velocity, const Vec3& spin, double reach, double dt) {
  Track track;
  track.start = start.pose();
  track.reach = reach;
  track.velocity = velocity;
  track.spin = spin;
  track.spin_rate = spin.norm();
  track.moves = !velocity.isZero(0) || track.spin_rate > 0;
  RigidBody moving = start;
  moving.velocity = velocity;
  moving.spin = spin;
  track.motion = ca::Motion(moving);
  track.end = track.moves ? track.motion.pose_at(dt) : track.start;
  return track;
}

Track track_of(const world::World& world, int body, double now, double dt) {
  Track track;
  track.reach = world.shapes[world.bodies[body].shape].reach;
  track.moves = !world.stays(body);
  track.motion = world.motion(body, now);
  track.start = track.end = {track.motion.rotation, track.motion.position};
  if (!track.moves) return track;
  track.end = track.motion.pose_at(dt);
  track.velocity = track.motion.velocity;
  track.acceleration = track.motion.acceleration;
  track.spin = track.motion.spin;
  track.spin_rate = track.motion.spin_bound();
  track.steady = track.motion.steady();
  return track;
}

PathVerdict check_path(const world::World& world, const Contacts& contacts, PairContacts& pair, const Track& a,
                       const Track& b, double dt, double need, std::int64_t most_pairs) {
  const bool steady = a.steady && b.steady;
  if (steady) {
    const double way =
        dt * ((b.velocity - a.velocity).norm() + 0.5 * dt * (b.acceleration - a.acceleration).norm() +
              a.spin_rate * a.reach + b.spin_rate * b.reach);
    if (pair.gap - way >= need) return {true, dt};
  }
  const bool convex = Contacts::convex(world, pair);
  if (convex && steady && pair.known) {
    const double share = dt * dt / 8;
    const auto from_a = [&] { return share * bend_seen_from(a, b, dt); };
    const auto from_b = [&] { return share * bend_seen_from(b, a, dt); };
    if (!pair.axis_known) pair.axis_gap = contacts.axis_gap(world, pair, a.start, b.start);
    pair.axis_known = true;
    if (pair.axis_gap >= need) {
      const double end = contacts.axis_gap(world, pair, a.end, b.end);
      if (least_between(pair.axis_gap, end, pair.of_b ? from_b() : from_a()) >= need) return {true, dt};
    }
    // The best plane at the end, carried back by either body, or by none.
    const ca::PairPose at_start(a.start, b.start), at_end(a.end, b.end);
    const ca::GjkResult nearest = contacts.nearest(world, pair, at_end);
    if (nearest.lower >= need) {
      const ca::Convex core_a = world.model_of(pair.a).leaf(0), core_b = world.model_of(pair.b).leaf(0);
      const auto proves = [&](const Vec3& normal, double bend) {
        return least_between(ca::support_gap(core_a, core_b, at_start, normal), nearest.lower, bend) >= need;
      };
      if (proves(nearest.normal, share * bend_in_the_world(a, b)) ||
          proves(a.start.rotation * (a.end.rotation.transpose() * nearest.normal), from_a()) ||
          proves(b.start.rotation * (b.end.rotation.transpose() * nearest.normal), from_b()))
        return {true, dt};
    }
  }
  hulls::ReachOptions options;
  options.interval = dt;
  options.tolerance = world.tolerance;
  options.target = need;
  options.slack = 0.25 * std::max(need, world.tolerance);
  options.start = -1;
  options.max_pairs = std::min(world.max_pairs, most_pairs);
  const hulls::Reach reach =
      hulls::first_reach(world.model_of(pair.a), a.motion, world.model_of(pair.b), b.motion, options, world.memory);
  if (reach.status == hulls::Reach::Status::clear) return {true, dt};
  return {false, reach.time};
}

}  // namespace fc::resting
