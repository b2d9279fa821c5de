#include "ex04_sweep.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

double effective_mass(std::span<const RigidBody> bodies, const lcp::Contact& contact) {
  FC_TODO("5.4");
}

void apply(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
           std::span<const double> impulses) {
  FC_TODO("5.4");
}

double sweep(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
             std::span<const double> approach_limits, std::span<double> impulses) {
  FC_TODO("5.4");
}

int solve(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
          std::span<const double> approach_limits, std::span<double> impulses, double enough, int most) {
  FC_TODO("5.4");
}

}  // namespace fc::exercises
