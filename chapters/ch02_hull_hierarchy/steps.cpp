#include "ch02_hull_hierarchy/steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fc::hulls {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

constexpr int kMostLooks = 16;

// One body as the plane sees it: along the direction n, towards the other body.
struct Side {
  Vec3 direction;  // n in the body's axes
  Vec3 turn;       // n x w in the body's axes: a point x moves with n.v + turn.x along n
  double rate;     // rad/s, |n x w|
  double bend;     // m/s^2, the most that a point's speed along n changes in a second

  Side(const ca::Motion& m, const Mat3& rotation, const Vec3& n, const ca::Convex& shape)
      : direction(rotation.transpose() * n), turn(rotation.transpose() * n.cross(m.spin)), rate(turn.norm()) {
    const Vec3 spin = rotation.transpose() * m.spin;
    double sweep2 = 0;
    if (shape.table != nullptr)  // many points: the farthest one stands for all
      sweep2 = spin.squaredNorm() * shape.reach * shape.reach;
    else
      for (const Vec3& x : shape.points) sweep2 = std::max(sweep2, spin.cross(x).squaredNorm());
    bend = rate * std::sqrt(sweep2);
  }
};

}  // namespace

double whole_step(const ca::Motion& a, const ca::Convex& shape_a, const ca::Motion& b,
                  const ca::Convex& shape_b, const Vec3& n, double t, double end, double room) {
  const Vec3 acceleration = a.acceleration - b.acceleration,
             velocity = (a.velocity - b.velocity) + t * acceleration;
  const double turning = n.cross(a.spin).norm() * shape_a.reach + n.cross(b.spin).norm() * shape_b.reach;
  const double speed = n.dot(velocity) + std::max(0.0, n.dot(acceleration) * (end - t)) + turning +
                       kRounding * (velocity.norm() + turning);
  return speed > 0 ? room / speed : kInfinity;
}

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
  step.time = std::max(step.time, whole_step(a, node_a, b, node_b, n, t, end, room));
  step.speed = step.time < kInfinity ? room / step.time : 0;
  return step;
}

SafeStep points_step(const ca::Motion& a, const ca::Convex& shape_a, const ca::Motion& b,
                     const ca::Convex& shape_b, const ca::PairPose& pose, const Vec3& n, double t, double end,
                     double room) {
  const Side side_a(a, pose.rotation_a, n, shape_a), side_b(b, pose.rotation_b, -n, shape_b);
  const Vec3 velocity = (a.velocity - b.velocity) + t * (a.acceleration - b.acceleration);
  const double k = 0.5 * (side_a.bend + side_b.bend + std::max(0.0, n.dot(a.acceleration - b.acceleration)));
  const double noise =
      kRounding * (velocity.norm() + side_a.rate * shape_a.reach + side_b.rate * shape_b.reach);
  const double straight = n.dot(velocity) + noise, remaining = end - t;

  // Ahead now: the supports, which the room is measured from.
  Vec3 x = ca::support(shape_a, side_a.direction).point, y = ca::support(shape_b, side_b.direction).point;
  const double supports = side_a.direction.dot(x) + side_b.direction.dot(y);
  SafeStep step;
  double h = kInfinity;
  for (int looks = 0; looks < kMostLooks; ++looks) {
    const double free = room + supports - side_a.direction.dot(x) - side_b.direction.dot(y);
    const double closing = straight + side_a.turn.dot(x) + side_b.turn.dot(y);
    const double crossing = ca::crossing_time(closing, k, std::max(free, 0.0));
    if (looks > 0 && !(crossing < h)) {  // the same points, or others that are no worse: h is proved
      step.time = h < remaining ? h : kInfinity;
      break;
    }
    h = std::min(crossing, remaining);
    x = ca::support(shape_a, side_a.direction + h * side_a.turn).point;
    y = ca::support(shape_b, side_b.direction + h * side_b.turn).point;
  }
  step.speed = step.time < kInfinity && step.time > 0 ? room / step.time : 0;
  return step;
}

}  // namespace fc::hulls
