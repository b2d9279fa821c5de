// Problems with a known answer: z and w are chosen first, with the family's active set, and b = w - A z makes
// them the answer. For tests, studies and benchmarks.
#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <string_view>

#include "ch03_impulse_lcp/problem.hpp"

namespace fc::lcp {

// Natural scale: d_i is the power of two next to sqrt(A_ii), z_i is 1/8 to 1 over d_i and w_i 1/8 to 1 times
// d_i, so that every row has the same weight however different the masses are. Loaded: each face carries 1/8
// m/s times the mass above it, up to the next separating face, without turning anything; w is 1/8 to 1 m/s.
// Then z spans as many decades as the masses, and A z has the size of speeds: the difference of huge numbers.
// (A body over a separating face takes its load alone: there b is load over mass, perhaps thousands.)
enum class Family {
  // Symmetric positive definite.
  random_spd,  // whole numbers G'G, G 2n by n: condition about 30
  spd_1e4,     // Q D Q' with eigenvalues evenly spread in their logarithm, condition 1e4
  spd_1e8,
  spd_1e12,
  all_active,  // random_spd, and w = 0 everywhere: A z = -b, a linear system in disguise
  degenerate,  // random_spd, and a third of the rows has z = w = 0

  // Symmetric positive semidefinite.
  rank_deficient,      // whole numbers G'G, G n/2 by n
  duplicate_contacts,  // a box on the floor, each of its four corners given n/4 times: rank 3
  stack,               // stacked boxes, four corners each, equal masses, loaded: rank 3n/4
  stack_1e4,           // the same, masses rising to 2^14 at the top
  stack_1e8,           // the same, to 2^27
  tower_1e8,           // stacked balls, masses rising to 2^27 at the top, loaded; a quarter separates
  chain_1e8,           // balls in a row between two walls, masses 1 and 2^27 in turn: rank n - 1
  ball_heap,           // balls on a disturbed grid, a contact wherever neighbours touch
  box_heap,            // boxes and balls in random orientations, four contacts where two boxes meet
  graded,              // D A D of random_spd, D falling by powers of two from 1 to 2^-20
  hilbert,             // 1 / (i + j - 1), for n <= 12 times what makes it whole; condition 1.5e10 at n = 8

  // The worst cases of pivoting or interior-point methods; exact in whole numbers.
  murty,          // lower triangular, 1 on the diagonal and 2 below, b = -1: Lemke takes 2^n pivots
  fathi,          // L L' of Murty's L, b = -1 (Fathi 1979)
  fathi_shifted,  // the same with n + 1 rows, without the first row and column; b = -5
  csizmadia,      // lower triangular, 1 on the diagonal and -1 below: its inverse grows like 2^n
  // The same with rows and columns in reverse order: in one of the two orders, a method that only takes row
  // after row needs 2^n - 1 pivots.
  murty_reversed,
  fathi_reversed,
  fathi_shifted_reversed,
  csizmadia_reversed,

  // Not symmetric, with positive principal minors.
  positive_definite,  // random_spd plus a skew matrix as large
  triangular,         // lower triangular, random, diagonal at least the root of n

  // With bounds: a quarter of the rows each between them, at the lower, at the upper, without bounds.
  boxed,            // random_spd
  boxed_deficient,  // rank_deficient

  // Without a solution.
  infeasible,  // rank_deficient with a y >= 0, A y = 0, b'y = -1
  squeezed,    // balls between two walls whose restitutions differ, by assemble()
};

inline constexpr auto kFamilies = [] {
  std::array<Family, static_cast<std::size_t>(Family::squeezed) + 1> all{};
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<Family>(k);
  return all;
}();

// The names above.
std::string_view name(Family family);
inline std::ostream& operator<<(std::ostream& out, Family family) {
  return out << name(family);
}

// A problem and all that is known about it. It owns what lcp() refers to.
struct KnownProblem {
  Family family = Family::random_spd;
  std::uint64_t seed = 0;
  MatX A;             // n by n
  VecX b;             // n
  VecX lower, upper;  // n each, or both empty: z >= 0
  VecX z, w;  // n, the planted answer, w exactly 0 where z is between its bounds; empty if not solvable
  VecX certificate;  // n: y >= 0, A'y = 0, b'y < 0; empty if solvable
  bool solvable = true;
  bool symmetric = true;
  bool semidefinite = true;  // x'Ax >= 0 up to round-off of the entries; false: may be either
  bool p_matrix = true;      // all principal minors > 0, so that z is unique; false: may be either
  bool exact = true;         // w = A z + b without any rounding; otherwise b is the nearest double, and the
                             // residual of (z, A z + b) is up to planted_floor()
  Eigen::Index rank = 0;     // of A; for ball_heap and box_heap an upper bound
  double condition = 0;      // in the 2-norm, to within a tenth; 0: not prescribed

  Lcp lcp() const { return {A, b, lower.size() > 0 ? &lower : nullptr, upper.size() > 0 ? &upper : nullptr}; }
};

// The residual that the rounding of b leaves: half a unit in the last place of b, and the loss of sums in
// extended precision, whatever A's condition; 0 where nothing was rounded. The rounded problem's own z
// differs from the planted one by up to condition times this, relative to its largest entry. Its w does not,
// with one exception: where A has eigenvalues below round-off that are not 0 (hilbert, n > 12), (w - w')'(z -
// z') of two answers at round-off bounds |w - w'| by the root of round-off only, about 1e-8.
double planted_floor(const KnownProblem& problem);

// A problem of the family.
//   n:    rows, 4 to 10,000; a multiple of 4 for duplicate_contacts, stack* and boxed*
//   seed: any; the same seed gives the same problem. Murty's, Fathi's and Csizmadia's do not depend on it.
// Half of the rows (rounded down) are active (z > 0 = w), the others not (z = 0 < w), in random order.
// Exceptions: all_active; degenerate (a third each); stack* (about half, by whole or half faces); tower_1e8
// (a quarter is not active); murty* and fathi* (one active row); boxed* (see there); infeasible and squeezed.
// Throws std::invalid_argument for n outside its range.
KnownProblem make_problem(Family family, Eigen::Index n, std::uint64_t seed);

}  // namespace fc::lcp
