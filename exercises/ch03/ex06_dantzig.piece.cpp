// See: chapters/ch03_impulse_lcp/scenes/three_balls.yaml
#include "ex06_dantzig.hpp"
#include "common/pieces.hpp"

FC_PIECE(fc::mine::dantzig);
