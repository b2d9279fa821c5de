// See: chapters/ch04_multibody_stepping/scenes/two_bunnies.yaml
#include "ex07_event_loop.hpp"

FC_PIECE(fc::mine::event_loop);
