// See: chapters/ch05_resting_contact/scenes/knocked.yaml
#include "ex07_resting_step.hpp"
#include "common/pieces.hpp"

FC_PIECE(fc::mine::resting_step);
