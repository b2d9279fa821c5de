#include "ex01_one_contact.hpp"

#include "common/todo.hpp"

namespace fc::mine {

Answer solve_contact(const Mat3& A, const Vec3& q, double mu) {
  FC_TODO("6.1");
}

}  // namespace fc::mine
