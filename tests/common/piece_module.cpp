// A learner's piece, of NUMBER(NUMBER).
#include "common/pieces.hpp"

namespace {
NUMBER thrice(NUMBER x) {
  return 3 * x;
}
}  // namespace

FC_PIECE(thrice);
