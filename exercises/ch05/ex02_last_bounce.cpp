#include "ex02_last_bounce.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

Ending ending(const Drop& drop, double width, double dt) {
  FC_TODO("5.2");
}

double widest_envelope(double restitution, double gravity, double dt) {
  FC_TODO("5.2");
}

double narrowest_envelope(const Drop& drop, double dt, std::int64_t bounces) {
  FC_TODO("5.2");
}

double shortest_frame(double restitution, double gravity, double least) {
  FC_TODO("5.2");
}

}  // namespace fc::exercises
