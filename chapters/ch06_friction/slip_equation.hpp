// The scalar equation of a contact that slips: f(α) = |r_T(α)| - µ r_N(α) = 0 of one_contact.hpp, in the eigenbasis of
// D̂.
#pragma once

#include "common/types.hpp"

namespace fc::friction {

struct SlipEquation {
  using Vec2 = Eigen::Vector2d;

  // ANCHOR: slip
  double mu = 0;    // > 0
  double free = 0;  // N s, > 0: r_N without friction, -β/a
  Vec2 c, d;        // c/a, and d̂ in m/s, not both 0
  Vec2 delta;       // 1/kg, eigenvalues of D̂, >= 0, ascending

  // N s. α > 0, in 1/kg; it may be 0 where no direction with a d̂ is dead.
  Vec2 tangent(double alpha) const { return -d.cwiseQuotient((delta.array() + alpha).matrix()); }
  double normal(const Vec2& tangent) const { return free - c.dot(tangent); }
  // ANCHOR_END: slip
  double excess(double alpha) const;  // f

  // The least root, provided that f(0) > 0. `one_root`: there are known to be no others.
  double least_root(bool one_root) const;

 private:
  double beyond_all_roots() const;
  double root_between(double low, double high) const;
};

}  // namespace fc::friction
