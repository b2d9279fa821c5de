#include "ex03_many_contacts.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

double residual(const Problem& problem, const VecX& r) {
  FC_TODO("6.3");
}

Result solve(const Problem& problem, double tolerance, int most) {
  FC_TODO("6.3");
}

double heat(const Problem& problem, const VecX& r) {
  FC_TODO("6.3");
}

}  // namespace fc::exercises
