#include "ex03_islands.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

Sets single_sets(int count) {
  FC_TODO("5.3");
}

int find(Sets& sets, int number) {
  FC_TODO("5.3");
}

bool join(Sets& sets, int a, int b) {
  FC_TODO("5.3");
}

int size(Sets& sets, int number) {
  FC_TODO("5.3");
}

std::vector<Island> islands_of(std::span<const char> fixed, std::span<const Touch> contacts) {
  FC_TODO("5.3");
}

}  // namespace fc::exercises
