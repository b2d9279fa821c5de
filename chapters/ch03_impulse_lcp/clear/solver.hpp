// The piece behind the chapter's solver interface.
#pragma once

#include "ch03_impulse_lcp/clear/pieces.hpp"
#include "ch03_impulse_lcp/solver.hpp"

namespace fc::lcp::clear {

// The solver that a scene asks for, where "dantzig" is the piece; the other methods are the chapter's own.
// Guarantee: the piece's result is checked. w and the residual are computed anew; `solved` stays only if the result
// passes acceptable() and the scene's tolerance, `no_solution` only if its certificate proves it; else they become
// `limit`. Problems with bounds, and matrices that are not symmetric, are `unsuited`: the piece is not made for
// them.
Solver solver_of(const SolverSpec& spec, const Pieces& pieces);

}  // namespace fc::lcp::clear
