// See: chapters/ch01_convex_advancement/scenes/spinning_box.yaml
#include "ex10_certificate.hpp"

FC_PIECE(fc::mine::check_certificate);
