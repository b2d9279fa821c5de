#include "ex04_pile.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

Vec3 solve_contact(double a, double d, const Vec3& q, const Vec3& normal, double room, double mu) {
  FC_TODO("6.4");
}

double sweep(std::vector<Ball>& balls, std::vector<Contact>& contacts) {
  FC_TODO("6.4");
}

}  // namespace fc::exercises
