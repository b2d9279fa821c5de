#include "ex02_momentum.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

double largest_eigenvalue(Products& A, int products) {
  FC_TODO("3.2");
}

VecX momentum_gradients(Products& A, const VecX& b, double largest, int products) {
  FC_TODO("3.2");
}

}  // namespace fc::exercises
