#include "ch02_hull_hierarchy/steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fc::hulls {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

constexpr int kMostLooks = 16;

// One body, seen along the direction n towards the other body.
struct Side {
  Vec3 direction;  // n in the body's axes
  Vec3 turn;       // n x w in the body's axes: a point x moves with n.v + turn.x along n
  double rate;     // rad/s, |n x w|, the most from now on
  double bend;     // m/s^2, the most that a point's speed along n changes in a second
  double noise;    // m/s, what a point's speed along n may be off by, in units of kRounding

  Side(const ca::Motion& m, const Mat3& rotation, double turned, const Vec3& n, double t,
       const ca::Convex& shape) {
    const Vec3 spin_world = m.spin_at(t), spin = rotation.transpose() * spin_world;
    direction = rotation.transpose() * n;
    turn = rotation.transpose() * n.cross(spin_world);
    rate = turn.norm() + m.wander();
    double sweep2 = 0;
    if (shape.table != nullptr)  // many points: the farthest one represents all
      sweep2 = spin.squaredNorm() * shape.reach * shape.reach;
    else
      for (std::size_t i = 0; i < shape.points.size(); ++i) {
        const double rim = shape.disks.empty() ? 0 : shape.disks[i] * spin.norm();
        const double of_point = spin.cross(shape.points[i]).squaredNorm();
        sweep2 = std::max(sweep2, rim == 0 ? of_point : std::pow(std::sqrt(of_point) + rim, 2));
      }
    bend = rate * (std::sqrt(sweep2) + m.wander() * shape.reach) + m.spin_change_bound() * shape.reach;
    noise = (m.free ? turned * m.spin_bound() : rate) * shape.reach;
  }
};

}  // namespace

double whole_step(const ca::Motion& a, const ca::Convex& shape_a, const ca::Motion& b,
                  const ca::Convex& shape_b, const Vec3& n, double t, double end, double room) {
  const Vec3 acceleration = ca::relative_acceleration(a, b, t), velocity = ca::relative_velocity(a, b, t);
  const double turning = a.turning_bound(n) * shape_a.reach + b.turning_bound(n) * shape_b.reach;
  const double speed = n.dot(velocity) + std::max(0.0, n.dot(acceleration) * (end - t)) + turning +
                       kRounding * (velocity.norm() + turning);
  return speed > 0 ? room / speed : kInfinity;
}

SafeStep ball_step(const ca::Motion& a, const ca::Convex& node_a, double radius_a, const ca::Motion& b,
                   const ca::Convex& node_b, double radius_b, const ca::PairPose& pose, const Vec3& n,
                   double t, double end, double room) {
  const Vec3 spin_a = a.spin_at(t), spin_b = b.spin_at(t);
  const Vec3 turn_a = n.cross(spin_a), turn_b = n.cross(spin_b);
  const double rate_a = turn_a.norm() + a.wander(), rate_b = turn_b.norm() + b.wander();
  const Vec3 middle_a = pose.rotation_a * node_a.center, middle_b = pose.rotation_b * node_b.center;
  const Vec3 velocity = ca::relative_velocity(a, b, t);
  const double fall = n.dot(ca::relative_acceleration(a, b, t));
  const double linear = n.dot(velocity);

  // Relative to the nodes' own middles.
  const double noise = kRounding * (velocity.norm() + rate_a * node_a.reach + rate_b * node_b.reach +
                                    (a.free ? pose.turned_a * a.spin_bound() * node_a.reach : 0) +
                                    (b.free ? pose.turned_b * b.spin_bound() * node_b.reach : 0));
  const double c =
      linear + turn_a.dot(middle_a) - turn_b.dot(middle_b) + rate_a * radius_a + rate_b * radius_b + noise;
  const auto bend = [](const ca::Motion& m, double rate, const Vec3& spin, const Vec3& middle) {
    return rate * spin.cross(middle).norm() + (rate * m.wander() + m.spin_change_bound()) * middle.norm();
  };
  const double k = 0.5 * (bend(a, rate_a, spin_a, middle_a) + bend(b, rate_b, spin_b, middle_b)) +
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
  const Side side_a(a, pose.rotation_a, pose.turned_a, n, t, shape_a),
      side_b(b, pose.rotation_b, pose.turned_b, -n, t, shape_b);
  const Vec3 velocity = ca::relative_velocity(a, b, t);
  const double pull = std::max(0.0, n.dot(ca::relative_acceleration(a, b, t)));
  const double k = 0.5 * (side_a.bend + side_b.bend + pull);
  const double noise = kRounding * (velocity.norm() + side_a.noise + side_b.noise);
  const double straight = n.dot(velocity) + noise, remaining = end - t;

  // The points that are ahead now: the supports, from which the room is measured.
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
