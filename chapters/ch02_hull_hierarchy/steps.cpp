#include "ch02_hull_hierarchy/steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fc::hulls {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

// One body as the plane sees it: along the direction n, towards the other body.
struct Side {
  Vec3 direction;  // n in the body's axes
  Vec3 turn;       // n x w in the body's axes: a vertex x moves with speed + turn.x along n
  Vec3 spin;       // w in the body's axes
  double turn_size;
  double speed;                       // of the centre of mass along n
  double support = -kInfinity;        // largest direction.x
  double support_speed = -kInfinity;  // and the fastest speed there

  Side(const ca::Motion& m, const Mat3& rotation, const Vec3& n, double t, const ca::Convex& node)
      : direction(rotation.transpose() * n),
        turn(rotation.transpose() * n.cross(m.spin)),
        spin(rotation.transpose() * m.spin),
        turn_size(turn.norm()),
        speed(n.dot(m.velocity_at(t))) {
    for (const Vec3& x : node.points) {
      const double height = direction.dot(x);
      if (height < support) continue;
      support = height;
      support_speed = speed + turn.dot(x);
    }
  }

  // When a vertex of this side could first have used up `room` against a plane of speed plane_speed; `bend`
  // is what the accelerations of body and plane add.
  double time(const ca::Convex& node, double plane_speed, double bend, double room, double best) const {
    const double noise = kRounding * (std::abs(speed) + std::abs(plane_speed) + turn_size * node.reach);
    for (const Vec3& x : node.points) {
      const double free = room + (support - direction.dot(x));
      const double closing = speed + turn.dot(x) - plane_speed + noise;
      const double k = bend + 0.5 * turn_size * spin.cross(x).norm();
      if (best < kInfinity && closing * best + std::max(k, 0.0) * best * best <= free) continue;
      best = std::min(best, ca::crossing_time(closing, k, free));
    }
    return best;
  }
};

}  // namespace

SafeStep ball_step(const ca::Motion& a, const ca::Convex& node_a, double radius_a, const ca::Motion& b,
                   const ca::Convex& node_b, double radius_b, const ca::PairPose& pose, const Vec3& n,
                   double t, double end, double room) {
  const Vec3 turn_a = n.cross(a.spin), turn_b = n.cross(b.spin);
  const double rate_a = turn_a.norm(), rate_b = turn_b.norm();
  const Vec3 middle_a = pose.rotation_a * node_a.center, middle_b = pose.rotation_b * node_b.center;
  const Vec3 velocity = (a.velocity - b.velocity) + t * (a.acceleration - b.acceleration);
  const double fall = n.dot(a.acceleration - b.acceleration);
  const double linear = n.dot(velocity);

  // About the nodes' own middles.
  const double noise = kRounding * (velocity.norm() + rate_a * node_a.reach + rate_b * node_b.reach);
  const double c =
      linear + turn_a.dot(middle_a) - turn_b.dot(middle_b) + rate_a * radius_a + rate_b * radius_b + noise;
  const double k = 0.5 * (rate_a * a.spin.cross(middle_a).norm() + rate_b * b.spin.cross(middle_b).norm()) +
                   0.5 * std::max(0.0, fall);
  SafeStep step;
  step.time = ca::crossing_time(c, k, room);
  // About the centres of mass: chapter 1's bound, which does not grow with time.
  const double whole =
      linear + std::max(0.0, fall * (end - t)) + rate_a * node_a.reach + rate_b * node_b.reach + noise;
  step.time = std::max(step.time, whole > 0 ? room / whole : kInfinity);
  step.speed = step.time < kInfinity ? room / step.time : 0;
  return step;
}

SafeStep plane_step(const ca::Motion& a, const ca::Convex& node_a, const ca::Motion& b,
                    const ca::Convex& node_b, const ca::PairPose& pose, const Vec3& n, double t,
                    double room) {
  const Side side_a(a, pose.rotation_a, n, t, node_a);
  const Side side_b(b, pose.rotation_b, -n, t, node_b);
  const double plane_speed = 0.5 * (side_a.support_speed - side_b.support_speed);  // along n
  // Against a plane of the mean acceleration either body has half of the relative one.
  const double bend = 0.25 * n.dot(a.acceleration - b.acceleration);
  SafeStep step;
  step.time = side_a.time(node_a, plane_speed, bend, 0.5 * room, kInfinity);
  step.time = side_b.time(node_b, -plane_speed, bend, 0.5 * room, step.time);
  step.speed = step.time < kInfinity ? room / step.time : 0;
  return step;
}

}  // namespace fc::hulls
