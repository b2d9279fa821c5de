#include "ex04_one_body.hpp"

#include <algorithm>
#include <limits>

namespace fc::exercises {
namespace {

// How far (m) from the world's origin anything of the body can be.
double extent(const Rounded& body) {
  double farthest = 0;
  for (const Vec3& p : body.points) farthest = std::max(farthest, p.norm());
  return body.position.norm() + farthest + body.radius;
}

}  // namespace

// Farthest along d is farthest of the points along d, seen in the body's axes; and of its ball, the point at
// d. (The direction may be so long, or so short, that its square is no double.)
Vec3 support(const Rounded& body, const Vec3& direction) {
  const Vec3 unit = (direction / direction.cwiseAbs().maxCoeff()).normalized();
  const Vec3 local = body.rotation.transpose() * unit;
  Vec3 best = body.points.front();
  for (const Vec3& p : body.points)
    if (local.dot(p) > local.dot(best)) best = p;
  return body.position + body.rotation * best + body.radius * unit;
}

// d.(b - a) is largest where d.b is largest and d.a smallest.
Vec3 difference_support(const Rounded& a, const Rounded& b, const Vec3& direction) {
  return support(b, direction) - support(a, -direction);
}

// What is swept is the Minkowski sum with the segment from 0 to `travel`, and supports of sums add.
Vec3 swept_support(const Rounded& a, const Rounded& b, const Vec3& travel, const Vec3& direction) {
  const Vec3 along = direction.dot(travel) > 0 ? travel : Vec3(Vec3::Zero());
  return difference_support(a, b, direction) + along;
}

// The least n.(b - a) is that of the point farthest against n. A gap that rounding made would be a lie, so
// all that rounding can have made is taken off.
double gap_on_the_way(const Rounded& a, const Rounded& b, const Vec3& travel, const Vec3& n) {
  constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
  return n.dot(swept_support(a, b, travel, -n)) - kRounding * (extent(a) + extent(b) + travel.norm());
}

}  // namespace fc::exercises
