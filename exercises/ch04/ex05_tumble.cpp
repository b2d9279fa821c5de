#include "ex05_tumble.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

int step(Tumbler& body, double h) {
  FC_TODO("4.5");
}

}  // namespace fc::exercises
