// Caught by: Ex04OneBody.AGapIsNoneThatRoundingMade
// A gap of 1e-16 m that only rounding made is said to be a proof.
#include "ex04_one_body.hpp"

namespace fc::exercises {
Vec3 support(const Rounded& body, const Vec3& direction) {
  const Vec3 unit = (direction / direction.cwiseAbs().maxCoeff()).normalized();
  const Vec3 local = body.rotation.transpose() * unit;
  Vec3 best = body.points.front();
  for (const Vec3& p : body.points)
    if (local.dot(p) > local.dot(best)) best = p;
  return body.position + body.rotation * best + body.radius * unit;
}

Vec3 difference_support(const Rounded& a, const Rounded& b, const Vec3& direction) {
  return support(b, direction) - support(a, -direction);
}

Vec3 swept_support(const Rounded& a, const Rounded& b, const Vec3& travel, const Vec3& direction) {
  const Vec3 along = direction.dot(travel) > 0 ? travel : Vec3(Vec3::Zero());
  return difference_support(a, b, direction) + along;
}

double gap_on_the_way(const Rounded& a, const Rounded& b, const Vec3& travel, const Vec3& n) {
  return n.dot(swept_support(a, b, travel, -n));
}

}  // namespace fc::exercises
