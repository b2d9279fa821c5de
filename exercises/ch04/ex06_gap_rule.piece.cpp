// See: chapters/ch04_multibody_stepping/scenes/bounce.yaml
#include "ex06_gap_rule.hpp"

FC_PIECE(fc::mine::gap_rule);
