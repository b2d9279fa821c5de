// See: chapters/ch01_convex_advancement/scenes/spinning_box.yaml
#include "ex06_closest_point.hpp"

FC_PIECE(fc::mine::closest_point);
