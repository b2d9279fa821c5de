// Lemke's method: one more unknown makes any problem easy, and is then driven out again.
#pragma once

#include "ch03_impulse_lcp/solver.hpp"

namespace fc::lcp {

// Solves w = A z + b by complementary pivoting (Lemke 1965; Cottle, Pang and Stone 1992, section 4.4): with
// the artificial unknown z_0 >= 0, w = A z + b + c z_0 has the obvious solution z = 0, w >= 0 for a large
// z_0; pivots that keep z_i w_i = 0 then follow the only path that leads from there, until z_0 is 0. Ties are
// decided lexicographically, as if b were perturbed by ever smaller amounts: so no basis comes twice. c is
// (1, ..., 1) in scaled rows; where the path from there ends without a solution or a proof of its absence,
// two other c are tried.
//   A: n by n; for positive semidefinite, P- and strictly copositive matrices the path ends in a solution if
//   there is one. limit: pivots; 0 means 100 + 50 n. tolerance and start are ignored.
// Status: solved; no_solution, where the ray at the end is a certificate; ray, where it proves nothing (a
// solution may still exist); limit; unsuited for bounds. The cost is 2 n^2 multiplications a pivot: a dense
// inverse of the basis is kept.
LcpResult solve_lemke(const Lcp& problem, const SolveOptions& options = {});

}  // namespace fc::lcp
