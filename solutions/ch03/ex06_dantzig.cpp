// The chapter's clear version is the solution: chapters/ch03_impulse_lcp/clear/dantzig.cpp.
#include "ex06_dantzig.hpp"

#include "ch03_impulse_lcp/clear/dantzig.hpp"

namespace fc::mine {

lcp::LcpResult dantzig(const MatX& A, const VecX& b, int limit) {
  return lcp::clear::dantzig(A, b, limit);
}

}  // namespace fc::mine
