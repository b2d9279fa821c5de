// See: chapters/ch06_friction/scenes/billiards.yaml
#include "ex01_one_contact.hpp"
#include "common/pieces.hpp"

FC_PIECE(fc::mine::solve_contact);
