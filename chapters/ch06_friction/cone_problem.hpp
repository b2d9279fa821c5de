// The frictional contact problem, the result of a solver, and the check that every result must pass:
//
//     u = A r + b,   and at every contact   K* ∋ û ⟂ r ∈ K   (cone.hpp)
//
// r are impulses (N s), u the velocities after (m/s), b the velocities without them, A = J M⁻¹ J' (1/kg).
// r are impulses (N s), u the velocities afterwards (m/s), b the velocities without them, A = J M⁻¹ J' (1/kg). Contact
// i owns the rows 3i (normal), 3i+1 and 3i+2 (two perpendicular tangents). Whatever µ, the number of contacts and the
// rank of A, a solution loses energy:
#pragma once

#include <limits>

#include "ch03_impulse_lcp/problem.hpp"
#include "common/types.hpp"

namespace fc::friction {

// The status values mean what they mean in chapter 3.
using lcp::Status;

// A problem for a solver. It holds references: all must outlive the solve.
struct ConeProblem {
  const MatX& A;  // 3n by 3n, symmetric, positive semidefinite, of any rank
  const VecX& b;  // 3n
  const VecX&
      mu;  // n, >= 0, finite. The ideally rough surface of textbooks, µ = ∞, is approximated by µ = 1000

  Eigen::Index contacts() const { return mu.size(); }
  Mat3 block(Eigen::Index i) const { return A.block<3, 3>(3 * i, 3 * i); }
};

// The same violation in physical units, for engineers. Of contacts whose friction is negligible (µ r_N changes no
// velocity by more than 1e-6 max|b|) only the first two are measured.
struct PhysicalErrors {
  double approach = 0;     // m/s, max -u_N: how fast bodies still approach
  double cone_excess = 0;  // N s, max |r_T| - µ r_N: friction above its limit
  double creep = 0;        // m/s, max |u_T| of a contact inside its cone (|r_T| < (1 - 1e-6) µ r_N)
  double angle = 0;        // rad, max angle of r_T and -u_T where a contact slides (|u_T| > 1e-6 max|b|)
};

// What every solver returns. Unless solved, r and u are where the method stopped: finite, but not an answer.
struct ConeResult {
  Status status = Status::limit;
  VecX r;                 // 3n, N s
  VecX u;                 // 3n, m/s, always A r + b, recomputed from r
  double residual = 0;    // of (r, u), see residual()
  int sweeps = 0;         // Gauss-Seidel's, over all contacts
  int steps = 0;          // Newton's, each with a factorisation of a 3n by 3n matrix
  int pivots = 0;         // Lemke's or Dantzig's, of all their solves
  double relaxation = 1;  // the smallest that Gauss-Seidel used; 1: plain
};

// Throws std::invalid_argument unless A is 3n by 3n, b is 3n and mu n long, every entry is finite and mu >= 0.
void check_arguments(const ConeProblem& problem);

// Whether A is of the right kind: symmetric to within 1e-10 of its largest entry, with no negative diagonal entry.
// Whether it is positive semidefinite is not checked.
bool is_suited(const ConeProblem& problem);

// s_i: n, 1/kg, the largest entry of contact i's own block; 1 if the block is zero.
VecX contact_scales(const ConeProblem& problem);

// How far (r, u) is from the law, without a unit: the largest cone_violation of a contact with scale s_i, over
// max(max|b|, max(|A||r|)). Multiplying A, b or r by a positive number changes nothing (siconos/siconos adds impulses
// to velocities here, which is not scale-free). r and u: 3n. A NaN anywhere gives NaN.
double residual(const ConeProblem& problem, const VecX& r, const VecX& u);

// The residual that round-off alone may leave, 8 (3n) (1 + max µ) epsilon: u is a sum of 3n products, and De Saxcé's
// shift multiplies its error by µ.
double residual_rounding(const ConeProblem& problem);

PhysicalErrors physical_errors(const ConeProblem& problem, const VecX& r, const VecX& u);

// Whether (r, u) may be called solved. True only if
//   every r_N >= 0 exactly, and |r_T| <= µ r_N to within 8 epsilon of it;
//   u is A r + b to within 8 (3n) epsilon max(|A||r|) =: ρ and the round-off of b;
//   the largest violation is at most 1e-6 max|b| + (1 + max µ) ρ, and ρ <= 1e-3 max|b| (see lcp::acceptable).
// Guarantee: what fails this is never called solved. Limit: it bounds an error in velocities. With friction, neither
// impulses nor velocities need be unique: other answers may exist.
bool acceptable(const ConeProblem& problem, const VecX& r, const VecX& u);

// ΔE, J: r·b + ½ r'Ar, the change that the impulses make to the kinetic energy.
double energy_change(const ConeProblem& problem, const VecX& r);

// Sets result.r, u, residual, and status: solved if acceptable() and the residual is at most `tolerance`, or at
// most residual_rounding(); else `otherwise`.
void judge(const ConeProblem& problem, const VecX& r, double tolerance, Status otherwise, ConeResult& result);

}  // namespace fc::friction
