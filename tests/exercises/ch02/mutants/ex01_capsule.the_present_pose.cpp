// Caught by: Ex01Capsule.NoEndIsFaster
// The fastest end just now: it turns on, and another one is fastest then.
#include "ex01_capsule.hpp"

#include <algorithm>
#include <limits>

#include "ch01_convex_advancement/motion_bound.hpp"

namespace fc::exercises {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double turning(const Capsule& c, const Vec3& n) {
  const double rate = c.spin.norm();
  if (rate == 0) return 0;
  return std::max(n.dot(c.spin.cross(c.p)), n.dot(c.spin.cross(c.q)));
}

struct End {
  double place, speed, bend;  // m, m/s, m/s^2

  End(const Capsule& c, const Vec3& x, const Vec3& d)
      : place(d.dot(c.middle + x)),
        speed(d.dot(c.velocity + c.spin.cross(x))),
        bend(d.cross(c.spin).norm() * c.spin.cross(x).norm()) {}
};

}  // namespace

double closing_speed(const Capsule& a, const Capsule& b, const Vec3& n) {
  return n.dot(a.velocity) - n.dot(b.velocity) + turning(a, n) + turning(b, -n);
}

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
