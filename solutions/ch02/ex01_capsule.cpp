#include "ex01_capsule.hpp"

#include <algorithm>
#include <limits>

#include "ch01_convex_advancement/motion_bound.hpp"

namespace fc::exercises {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// The most that a turn moves an end along n: |n x w| times its distance from the line of the spin through the
// centre of mass, for (n x w).x is all that n sees of w x x, and n x w is perpendicular to w.
double turning(const Capsule& c, const Vec3& n) {
  const double rate = c.spin.norm();
  if (rate == 0) return 0;
  return n.cross(c.spin).norm() * std::max(c.p.cross(c.spin).norm(), c.q.cross(c.spin).norm()) / rate;
}

// An end as the plane sees it, d being the way to the other body.
struct End {
  double place, speed, bend;  // m, m/s, m/s^2

  End(const Capsule& c, const Vec3& x, const Vec3& d)
      : place(d.dot(c.middle + x)),
        speed(d.dot(c.velocity + c.spin.cross(x))),
        bend(d.cross(c.spin).norm() * c.spin.cross(x).norm()) {}
};

}  // namespace

// The radius takes no part: the ball about an end turns in place, and reaches no farther for it. A's way to B
// is n, and B's way to A is -n. The sum is taken with its signs; only the whole tells whether the two part.
double closing_speed(const Capsule& a, const Capsule& b, const Vec3& n) {
  return n.dot(a.velocity) - n.dot(b.velocity) + turning(a, n) + turning(b, -n);
}

// Farthest along n is one of the two ends, so the gap is the least of four: of each pair of ends. Each starts
// with at least `room`, and with how much more we know.
double safe_step(const Capsule& a, const Capsule& b, const Vec3& n, double room) {
  const double speed = closing_speed(a, b, n);
  if (speed <= 0) return kNever;
  const End ends_a[] = {{a, a.p, n}, {a, a.q, n}}, ends_b[] = {{b, b.p, -n}, {b, b.q, -n}};
  const double first_a = std::max(ends_a[0].place, ends_a[1].place);
  const double first_b = std::max(ends_b[0].place, ends_b[1].place);
  double step = kNever;
  for (const End& x : ends_a)
    for (const End& y : ends_b) {
      const double more = (first_a - x.place) + (first_b - y.place);
      step = std::min(step, ca::crossing_time(x.speed + y.speed, 0.5 * (x.bend + y.bend), room + more));
    }
  return std::max(step, room / speed);
}

}  // namespace fc::exercises
