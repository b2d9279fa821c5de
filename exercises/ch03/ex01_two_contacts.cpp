#include "ex01_two_contacts.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

std::vector<Answer> solve_two(const Mat2& A, const Vec2& b) {
  FC_TODO("3.1");
}

}  // namespace fc::exercises
