#include "ch05_resting_contact/clear/pieces.hpp"

#include "ch03_impulse_lcp/clear/solver.hpp"
#include "common/scene.hpp"

namespace fc::resting::clear {

LcpFunction Pieces::solve_lcp() const {
  return [solver = lcp::clear::solver_of(SolverSpec{}, world.lcp)](const MatX& A, const VecX& b, VecX& z) {
    lcp::LcpResult result = solver({A, b});
    // Many contacts of few bodies depend on each other, and round-off may prevail: the fast form tries longer.
    if (result.status == lcp::Status::limit) result = lcp::solve({A, b});
    if (result.status != lcp::Status::solved) return false;
    z = result.z;
    return true;
  };
}

std::vector<PieceSlot> slots(Pieces& pieces) {
  std::vector<PieceSlot> all = world::clear::slots(pieces.world);
  all.push_back(slot("ch05/ex07_resting_step", "the heart of a resting step", pieces.resting_step));
  return all;
}

}  // namespace fc::resting::clear
