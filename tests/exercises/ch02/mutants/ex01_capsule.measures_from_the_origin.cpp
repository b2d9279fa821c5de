// Caught by: Ex01Capsule.ItDoesNotMatterWhereTheOriginIs
// Right, but places are differences of large numbers where the bodies are far from the origin.
#include "ex01_capsule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ch01_convex_advancement/motion_bound.hpp"

namespace fc::exercises {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// More than all roundings of a sum or a product of vectors, as a part of what is added or multiplied.
constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

// |n x w|, rad/s, rounded up: it is a difference where the two are nearly parallel.
double across(const Vec3& n, const Vec3& spin) {
  return n.cross(spin).norm() + kRounding * spin.norm();
}

// The most that a turn moves an end along n: |n x w| times its distance from the line of the spin through the
// centre of mass, for (n x w).x is all that n sees of w x x, and n x w is perpendicular to w.
double turning(const Capsule& c, const Vec3& n) {
  const double rate = c.spin.norm();
  if (rate == 0) return 0;
  const double distance = std::max(c.p.cross(c.spin).norm(), c.q.cross(c.spin).norm()) / rate;
  return across(n, c.spin) * (distance + kRounding * std::max(c.p.norm(), c.q.norm()));
}

// What the turn does to an end, as the plane sees it, d being the way to the other body. Places are seen from
// the body's centre of mass: how far that is from the origin must not cost digits.
struct End {
  double place, speed, bend;  // m, m/s rounded up, m/s^2 rounded up

  End(const Capsule& c, const Vec3& x, const Vec3& d)
      : place(d.dot(c.middle + x)),
        speed(d.dot(c.spin.cross(x)) + kRounding * c.spin.norm() * x.norm()),
        bend(across(d, c.spin) * c.spin.cross(x).norm()) {}
};

// How fast the centres of mass close in, m/s, rounded up.
double flying(const Capsule& a, const Capsule& b, const Vec3& n) {
  const Vec3 velocity = a.velocity - b.velocity;
  return n.dot(velocity) + kRounding * velocity.norm();
}

}  // namespace

// The radius takes no part: the ball about an end turns in place, and reaches no farther for it. A's way to B
// is n, and B's way to A is -n. The sum is taken with its signs; only the whole tells whether the two part.
double closing_speed(const Capsule& a, const Capsule& b, const Vec3& n) {
  const double fly = flying(a, b, n), turn = turning(a, n) + turning(b, -n);
  return fly + turn + kRounding * (std::abs(fly) + turn);
}

// Farthest along n is one of the two ends, so the gap is the least of four: of each pair of ends. Each starts
// with at least `room`, and with how much more we know.
double safe_step(const Capsule& a, const Capsule& b, const Vec3& n, double room) {
  const double speed = closing_speed(a, b, n);
  if (speed <= 0) return kNever;
  const double fly = flying(a, b, n), size = a.p.norm() + a.q.norm() + b.p.norm() + b.q.norm();
  const End ends_a[] = {{a, a.p, n}, {a, a.q, n}}, ends_b[] = {{b, b.p, -n}, {b, b.q, -n}};
  const double first_a = std::max(ends_a[0].place, ends_a[1].place);
  const double first_b = std::max(ends_b[0].place, ends_b[1].place);
  double step = kNever;
  for (const End& x : ends_a)
    for (const End& y : ends_b) {
      const double behind = (first_a - x.place) + (first_b - y.place), turn = x.speed + y.speed;
      const double more = std::max(0.0, behind - kRounding * size);
      const double closing = fly + turn + kRounding * (std::abs(fly) + std::abs(turn));
      step = std::min(step, ca::crossing_time(closing, 0.5 * (x.bend + y.bend), room + more));
    }
  return std::max(step, room / speed) * (1 - kRounding);
}

}  // namespace fc::exercises
