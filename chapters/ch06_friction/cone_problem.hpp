// The frictional contact problem, what a solver of it returns, and the check that stands between the two:
//
//     u = A r + b,   and at every contact   K* ∋ û ⟂ r ∈ K   (cone.hpp)
//
// r are impulses (N s), u the velocities after (m/s), b the velocities without them, A = J M⁻¹ J' (1/kg).
// Contact i owns the rows 3i (normal), 3i+1 and 3i+2 (two tangents at right angles). Whatever the µ, the number
// of contacts and the rank of A, a solution loses energy:
//     ΔE = ½ r·(u + b) = r·u - ½ r'Ar = -½ r'Ar - Σ µ_i r_N,i |u_T,i|.
#pragma once

#include <limits>

#include "ch03_impulse_lcp/problem.hpp"
#include "common/types.hpp"

namespace fc::friction {

// solved, no_solution, ray, limit and unsuited mean what they mean in chapter 3.
using lcp::Status;

// A problem as a solver takes it. It holds references: all must outlive the solve.
struct ConeProblem {
  const MatX& A;   // 3n by 3n, symmetric, positive semidefinite, of any rank
  const VecX& b;   // 3n
  const VecX& mu;  // n, >= 0, finite. The rough surface of a text, µ = ∞, is one with a µ of 1000

  Eigen::Index contacts() const { return mu.size(); }
  Mat3 block(Eigen::Index i) const { return A.block<3, 3>(3 * i, 3 * i); }
};

// The same violation in physical units, as an engineer would ask for it. Of contacts without friction worth the name
// (µ r_N that changes no velocity by more than 1e-6 max|b|) only the first two.
struct PhysicalErrors {
  double approach = 0;     // m/s, max -u_N: how fast bodies still approach
  double cone_excess = 0;  // N s, max |r_T| - µ r_N: friction that the normal impulse does not pay for
  double creep = 0;        // m/s, max |u_T| of a contact inside its cone (|r_T| < (1 - 1e-6) µ r_N)
  double angle = 0;        // rad, max angle of r_T and -u_T where a contact slides (|u_T| > 1e-6 max|b|)
};

// What every solver returns. Unless solved, r and u are where the method stopped: finite, and not to be used as
// an answer.
struct ConeResult {
  Status status = Status::limit;
  VecX r;                 // 3n, N s
  VecX u;                 // 3n, m/s, always A r + b, computed anew from r
  double residual = 0;    // of (r, u), see residual()
  int sweeps = 0;         // Gauss-Seidel's, over all contacts
  int steps = 0;          // Newton's, each with a factorisation of a 3n by 3n matrix
  int pivots = 0;         // Lemke's or Dantzig's, of all their solves
  double relaxation = 1;  // the smallest that Gauss-Seidel used; 1: plain
};

// Throws std::invalid_argument unless A is 3n by 3n, b is 3n and mu n long, every entry is finite and mu >= 0.
void check_arguments(const ConeProblem& problem);

// Whether A is of the class: symmetric to within 1e-10 of its largest entry, its diagonal not negative. That it
// is positive semidefinite is not looked at.
bool is_suited(const ConeProblem& problem);

// s_i: n, 1/kg, the largest entry of contact i's own block; 1 if the block is zero.
VecX contact_scales(const ConeProblem& problem);

// How far (r, u) is from the law, without a unit: the largest cone_violation of a contact with scale s_i, by
// max(max|b|, max(|A||r|)). Multiplying A, b or r by a positive number changes nothing (siconos/siconos adds
// impulses to velocities here; that does not). r and u: 3n. A NaN anywhere gives NaN.
double residual(const ConeProblem& problem, const VecX& r, const VecX& u);

// What round-off alone may leave of the residual, 8 (3n) (1 + max µ) epsilon: u is a sum of 3n products, and
// De Saxcé's shift multiplies its error by µ.
double residual_rounding(const ConeProblem& problem);

PhysicalErrors physical_errors(const ConeProblem& problem, const VecX& r, const VecX& u);

// Whether (r, u) may be called solved. True only if
//   every r_N >= 0 exactly, and |r_T| <= µ r_N to within 8 epsilon of it;
//   u is A r + b to within 8 (3n) epsilon max(|A||r|) =: ρ and the round-off of b;
//   the largest violation is at most 1e-6 max|b| + (1 + max µ) ρ, and ρ <= 1e-3 max|b| (see lcp::acceptable).
// Guarantee: what fails this is never called solved. Limit: it bounds an error in velocities. With friction
// neither impulses nor velocities need be unique: there may be other answers.
bool acceptable(const ConeProblem& problem, const VecX& r, const VecX& u);

// ΔE of the impulses, J: r·b + ½ r'Ar, what they do to the kinetic energy.
double energy_change(const ConeProblem& problem, const VecX& r);

// Sets result.r, u, residual, and status: solved if acceptable() and the residual is at most `tolerance`, or at
// most residual_rounding(); else `otherwise`.
void judge(const ConeProblem& problem, const VecX& r, double tolerance, Status otherwise, ConeResult& result);

}  // namespace fc::friction
