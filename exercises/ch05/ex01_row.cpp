#include "ex01_row.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

bool is_impact(const Envelope& envelope, const Ball& ball, bool lasts) {
  FC_TODO("5.1");
}

double approach_limit(const Envelope& envelope, double gap) {
  FC_TODO("5.1");
}

double displacement(const Envelope& envelope, double gap) {
  FC_TODO("5.1");
}

Frame rest(const Envelope& envelope, double gravity, Ball& ball) {
  FC_TODO("5.1");
}

}  // namespace fc::exercises
