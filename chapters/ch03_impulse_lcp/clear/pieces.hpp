// Chapter 3's method in its clear form: one piece, which is an exercise.
#pragma once

#include <vector>

#include "ch03_impulse_lcp/clear/dantzig.hpp"
#include "common/pieces.hpp"

namespace fc::lcp::clear {

// 3.6: an LCP by Dantzig's pivoting method; the contract is dantzig.hpp's.
using DantzigFunction = LcpResult(const MatX& A, const VecX& b, int limit);

struct Pieces {
  DantzigFunction* dantzig = clear::dantzig;
};
std::vector<PieceSlot> slots(Pieces& pieces);

}  // namespace fc::lcp::clear
