#include "ex03_one_by_one.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

Sequence resolve_one_by_one(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                            Choice choice, double slowest, int most) {
  FC_TODO("3.3");
}

}  // namespace fc::exercises
