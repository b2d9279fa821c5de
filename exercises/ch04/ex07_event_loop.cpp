#include "ex07_event_loop.hpp"

#include "common/todo.hpp"

namespace fc::mine {

void event_loop(Frame& frame) {
  FC_TODO("4.7");
}

}  // namespace fc::mine
