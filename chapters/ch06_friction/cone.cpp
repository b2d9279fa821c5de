#include "ch06_friction/cone.hpp"

#include <cmath>

namespace fc::friction {

Vec3 project_onto_cone(const Vec3& x, double mu) {
  const double slip = std::hypot(x[1], x[2]);
  if (slip <= mu * x[0]) return x;
  if (mu * slip <= -x[0]) return Vec3::Zero();
  const double normal = (x[0] + mu * slip) / (1 + mu * mu);
  if (slip == 0) return {normal, 0, 0};  // µ = 0, or x on the axis
  const double share = mu * normal / slip;
  return {normal, share * x[1], share * x[2]};
}

Vec3 de_saxce(const Vec3& u, double mu) {
  return {u[0] + mu * std::hypot(u[1], u[2]), u[1], u[2]};
}

double cone_violation(const Vec3& r, const Vec3& u, double mu, double scale) {
  return scale * (r - project_onto_cone(r - de_saxce(u, mu) / scale, mu)).norm();
}

}  // namespace fc::friction
