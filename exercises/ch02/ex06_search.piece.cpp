// See: chapters/ch02_hull_hierarchy/scenes/two_bunnies.yaml
#include "ex06_search.hpp"

FC_PIECE(fc::mine::search);
