// See: chapters/ch01_convex_advancement/scenes/spinning_box.yaml
#include "ex09_advance.hpp"

FC_PIECE(fc::mine::advance);
