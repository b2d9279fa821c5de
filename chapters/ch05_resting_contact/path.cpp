#include "ch05_resting_contact/path.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace fc::resting {
namespace {

// Intervals are halved down to this part of the whole.
constexpr double kLeastStep = 1.0 / 64, kRoughStep = 1.0 / 32;  // the second where advancement follows

// A plane between two convex bodies at one time (s), and the gap along it (m, certified).
struct PlaneAt {
  double time;
  Pose a, b;
  Vec3 normal;  // unit, from A to B
  double gap;
};

// The motion of axes that go with a body, or with a plane.
struct Moving {
  Vec3 position, velocity, acceleration, spin;
  double spin_rate, reach;

  Moving(const Path& path, double time, const Pose& pose)
      : position(pose.position),
        velocity(path.velocity + time * path.acceleration),
        acceleration(path.acceleration),
        spin(path.spin),
        spin_rate(path.spin_rate),
        reach(path.reach) {}
};

// The largest acceleration of a point of `body`, seen in axes that are fixed to `viewer` and turn with it (m/s^2): p''
// = a_p - w x (w x r) - 2 w x u, with r from the viewer's centre and u the velocity seen from it (centrifugal and
// Coriolis terms).
double bend_seen_from(const Moving& viewer, const Moving& body, double dt) {
  const Vec3 apart = body.position - viewer.position, velocity = body.velocity - viewer.velocity;
  const double acceleration = (body.acceleration - viewer.acceleration).norm();
  const double turning = (body.spin - viewer.spin).norm(), w = viewer.spin_rate, speed = velocity.norm();
  const double bend = acceleration + turning * (w + body.spin_rate) * body.reach;
  if (w == 0) return bend;
  const double seen =
      (velocity - viewer.spin.cross(apart)).norm() + dt * (acceleration + w * speed) + turning * body.reach;
  return bend + w * w * (apart.norm() + dt * speed) + 2 * w * seen;
}

// The least value that a function can have on [0, 1] if it is `start` and `end` at the ends, and lies at most 4 sag x
// (1 - x) below the line between them.
// ANCHOR: least
double least_between(double start, double end, double sag) {
  const double slope = end - start - 4 * sag;  // at the start
  if (slope >= 0) return start;
  const double x = sag > 0 ? std::min(1.0, -slope / (8 * sag)) : 1.0;
  return start + x * (slope + 4 * sag * x);
}
// ANCHOR_END: least

// The gap (m) that planes prove between two times.
double least_gap(const ca::Convex& core_a, const ca::Convex& core_b, const Path& a, const Path& b,
                 const PlaneAt& from, const PlaneAt& to, double enough) {
  const double dt = to.time - from.time, share = dt * dt / 8;
  const Moving moving_a(a, from.time, from.a), moving_b(b, from.time, from.b);
  // A plane that turns evenly, as between two crossing edges, and moves with A's centre.
  Moving plane = moving_a;
  const Vec3 across = from.normal.cross(to.normal);
  const double sine = across.norm();
  plane.spin_rate = std::atan2(sine, from.normal.dot(to.normal)) / dt;
  plane.spin = sine > 0 ? Vec3(plane.spin_rate / sine * across) : Vec3(Vec3::Zero());
  double best = least_between(
      from.gap, to.gap, share * (bend_seen_from(plane, moving_a, dt) + bend_seen_from(plane, moving_b, dt)));
  const auto at = [&](const PlaneAt& place, const Vec3& normal) {
    return ca::support_gap(core_a, core_b, ca::PairPose(place.a, place.b), normal);
  };
  // Planes fixed to one of the bodies: the plane at the start, and the one at the end.
  for (const bool on_a : {true, false}) {
    if (best >= enough) break;
    const Mat3 turn = on_a ? Mat3(to.a.rotation * from.a.rotation.transpose())
                           : Mat3(to.b.rotation * from.b.rotation.transpose());
    const double sag =
        share * (on_a ? bend_seen_from(moving_a, moving_b, dt) : bend_seen_from(moving_b, moving_a, dt));
    best = std::max(best, least_between(from.gap, at(to, turn * from.normal), sag));
    if (best < enough)
      best = std::max(best, least_between(at(from, turn.transpose() * to.normal), to.gap, sag));
  }
  return best;
}

// Whether planes prove the path; nothing if there is no plane to begin with.
std::optional<PathVerdict> by_planes(const world::World& world, const Contacts& contacts, PairContacts& pair,
                                     const Path& a, const Path& b, double dt, const PathOptions& options) {
  const ca::Convex core_a = world.model_of(pair.a).leaf(0), core_b = world.model_of(pair.b).leaf(0);
  const double required_gap = options.required_gap;
  const auto best_at = [&](double time) {
    const Pose pose_a = time == dt ? a.end : a.motion.pose_at(time),
               pose_b = time == dt ? b.end : b.motion.pose_at(time);
    const ca::GjkResult nearest = contacts.nearest(world, pair, ca::PairPose(pose_a, pose_b));
    return PlaneAt{time, pose_a, pose_b, nearest.normal, nearest.lower};
  };
  PlaneAt here{0, a.start, b.start, pair.axis_at(a.start, b.start), pair.axis_gap};
  if (here.gap < required_gap) here = best_at(0);
  if (here.gap < required_gap) return {};
  const PlaneAt end = best_at(dt);
  if (end.gap < required_gap && options.whole) return PathVerdict{false, dt};
  double slack = std::numeric_limits<double>::infinity();
  for (double step = dt; here.time < dt;) {
    const double time = here.time + step;
    const PlaneAt there = time > (1 - 1e-9) * dt ? end : best_at(time);
    const double least =
        there.gap < required_gap ? there.gap : least_gap(core_a, core_b, a, b, here, there, required_gap);
    if (least >= required_gap) {
      slack = std::min(slack, least - required_gap);
      here = there;
      step = std::min(2 * step, dt - here.time);
      continue;
    }
    step *= 0.5;
    if (step < (options.by_planes ? kLeastStep : kRoughStep) * dt) return PathVerdict{false, here.time};
  }
  return PathVerdict{true, dt, slack};
}

}  // namespace

Path straight_path(const RigidBody& start, const Vec3& velocity, const Vec3& spin, double reach, double dt) {
  Path path;
  path.start = start.pose();
  path.reach = reach;
  path.velocity = velocity;
  path.spin = spin;
  path.spin_rate = spin.norm();
  path.moves = !velocity.isZero(0) || path.spin_rate > 0;
  RigidBody moving = start;
  moving.velocity = velocity;
  moving.spin = spin;
  path.motion = ca::Motion(moving);
  path.end = path.moves ? path.motion.pose_at(dt) : path.start;
  return path;
}

Path path_of(const world::World& world, int body, double now, double dt) {
  Path path;
  path.reach = world.shapes[world.bodies[body].shape].reach;
  path.moves = !world.is_stationary(body);
  path.motion = world.motion(body, now);
  path.start = path.end = {path.motion.rotation, path.motion.position};
  if (!path.moves) return path;
  path.end = path.motion.pose_at(dt);
  path.velocity = path.motion.velocity;
  path.acceleration = path.motion.acceleration;
  path.spin = path.motion.spin;
  path.spin_rate = path.motion.spin_bound();
  path.steady = path.motion.steady();
  return path;
}

PathVerdict check_path(const world::World& world, const Contacts& contacts, PairContacts& pair, const Path& a,
                       const Path& b, double dt, const PathOptions& options) {
  const double required_gap = options.required_gap;
  const bool steady = a.steady && b.steady;
  if (steady) {
    const double distance =
        dt * ((b.velocity - a.velocity).norm() + 0.5 * dt * (b.acceleration - a.acceleration).norm() +
              a.spin_rate * a.reach + b.spin_rate * b.reach);
    if (pair.gap - distance >= required_gap) return {true, dt, pair.gap - distance - required_gap};
  }
  if (steady && pair.known && Contacts::convex(world, pair)) {
    if (!pair.axis_known) pair.axis_gap = contacts.axis_gap(world, pair, a.start, b.start);
    pair.axis_known = true;
    if (pair.axis_gap >= required_gap) {  // the known plane, without a search
      const Moving moving_a(a, 0, a.start), moving_b(b, 0, b.start);
      const double sag =
          dt * dt / 8 *
          (pair.of_b ? bend_seen_from(moving_b, moving_a, dt) : bend_seen_from(moving_a, moving_b, dt));
      const double least = least_between(pair.axis_gap, contacts.axis_gap(world, pair, a.end, b.end), sag);
      if (least >= required_gap) return {true, dt, least - required_gap};
    }
    const std::optional<PathVerdict> verdict = by_planes(world, contacts, pair, a, b, dt, options);
    if (verdict && (verdict->clear || options.by_planes)) return *verdict;
  }
  hulls::TocOptions asked;
  asked.interval = dt;
  asked.tolerance = world.tolerance;
  asked.target = required_gap;
  asked.slack = 0.25 * std::max(required_gap, world.tolerance);
  asked.start = -1;
  asked.max_pairs = std::min(world.max_pairs, options.most_pairs);
  const hulls::TimeOfContact toc = hulls::time_of_contact(
      world.model_of(pair.a), a.motion, world.model_of(pair.b), b.motion, asked, world.memory);
  if (toc.status == hulls::TimeOfContact::Status::clear) return {true, dt};
  return {false, toc.time};
}

}  // namespace fc::resting
