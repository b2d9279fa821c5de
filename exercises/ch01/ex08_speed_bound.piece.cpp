// See: chapters/ch01_convex_advancement/scenes/spinning_box.yaml
#include "ex08_speed_bound.hpp"

FC_PIECE(fc::mine::speed_bound);
