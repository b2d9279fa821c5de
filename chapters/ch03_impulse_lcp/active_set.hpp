// The solvers' common last steps: from the set of pushing rows to the best z with that set, and to a verdict.
#pragma once

#include <vector>

#include "ch03_impulse_lcp/problem.hpp"

namespace fc::lcp {

// The result of a method that stopped at z (n, within the bounds): w and the residual computed anew; `solved`
// becomes `limit` if the result is not acceptable, or z not finite (then it is zero).
LcpResult judged(const Lcp& problem, VecX z, Status status);

// The result of a method that refused the problem: z = 0.
LcpResult refused(const Lcp& problem, Status status);

// Solves the rows of a standard problem's `active` set for w = 0, all other z being 0, by an LU or, if it is
// singular, a QR decomposition with one step of refinement in extended precision. The result becomes this z
// if that is acceptable and has a smaller residual; its status is then `solved`.
void polish(const Lcp& problem, const std::vector<int>& active, LcpResult& result);

}  // namespace fc::lcp
