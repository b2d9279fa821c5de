#include "ex06_dantzig.hpp"

#include "common/todo.hpp"

namespace fc::mine {

lcp::LcpResult dantzig(const MatX& A, const VecX& b, int limit) {
  FC_TODO("3.6");
}

}  // namespace fc::mine
