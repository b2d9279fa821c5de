// See: chapters/ch02_hull_hierarchy/scenes/two_bunnies.yaml
#include "ex05_hull_tree.hpp"

FC_PIECE(fc::mine::hull_tree);
