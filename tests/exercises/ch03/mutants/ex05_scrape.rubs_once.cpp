// Caught by: Ex05Scrape.KeepsTheLawForBoxes
// The normal impulse without friction sets the bounds, and is never asked again.
#include "ex05_scrape.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "ch03_impulse_lcp/solver.hpp"

namespace fc::exercises {

Scrape scrape(RigidBody& body, const Touch& touch) {
  // Three rows at the same point: the normal and two tangents. A = J M^-1 J' for one moving body.
  const std::array<Vec3, 3> directions = {touch.normal, touch.along, touch.normal.cross(touch.along)};
  const Vec3 arm = touch.point - body.position;
  const Mat3 inverse_inertia = body.inverse_inertia_world();
  MatX A(3, 3);
  VecX b(3);
  for (int i = 0; i < 3; ++i) {
    b[i] = directions[i].dot(body.velocity_at(touch.point));
    for (int j = 0; j < 3; ++j) {
      A(i, j) = body.inverse_mass * directions[i].dot(directions[j]) +
                arm.cross(directions[i]).dot(inverse_inertia * arm.cross(directions[j]));
    }
  }
  const double speed = b.lpNorm<Eigen::Infinity>();
  b[0] *= 1 + touch.restitution;

  // The bounds of friction need the normal impulse, which needs friction: in turn, until nothing changes.
  const double infinity = std::numeric_limits<double>::infinity();
  VecX z = VecX::Zero(3);
  for (int round = 0; round < 200; ++round) {
    const double bound = touch.friction * z[0];
    // A row with bounds that are both 0 is none; the solver wants lower < upper.
    const int rows = bound > 0 ? 3 : 1;
    const MatX block = A.topLeftCorner(rows, rows);
    const VecX right = b.head(rows);
    VecX lower = VecX::Constant(rows, -bound), upper = VecX::Constant(rows, bound);
    lower[0] = 0;
    upper[0] = infinity;
    const lcp::LcpResult result = lcp::solve({block, right, &lower, &upper});
    if (result.status != lcp::Status::solved) return {};
    VecX next = VecX::Zero(3);
    next.head(rows) = result.z;
    const double change = (A * (next - z)).lpNorm<Eigen::Infinity>();
    z = next;
    if (change > 1e-12 * speed && round < 1) continue;

    for (int i = 0; i < 3; ++i) {
      body.velocity += body.inverse_mass * z[i] * directions[i];
      body.spin += inverse_inertia * arm.cross(z[i] * directions[i]);
    }
    return {true, z[0], z[1], z[2]};
  }
  return {};
}

}  // namespace fc::exercises
