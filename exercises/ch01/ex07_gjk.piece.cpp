// See: chapters/ch01_convex_advancement/scenes/spinning_box.yaml
#include "ex07_gjk.hpp"

FC_PIECE(fc::mine::gap);
