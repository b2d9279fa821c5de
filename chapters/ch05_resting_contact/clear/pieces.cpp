#include "ch05_resting_contact/clear/pieces.hpp"

#include "ch03_impulse_lcp/solver.hpp"

namespace fc::resting::clear {

Pieces::Pieces()
    : solve_lcp([](const MatX& A, const VecX& b, VecX& z) {
        const lcp::LcpResult result = lcp::solve({A, b});
        if (result.status != lcp::Status::solved) return false;
        z = result.z;
        return true;
      }) {}

std::vector<PieceSlot> slots(Pieces& pieces) {
  return {slot("ch05/ex07_resting_step", "the heart of a resting step", pieces.resting_step)};
}

}  // namespace fc::resting::clear
