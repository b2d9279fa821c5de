#include "ch02_hull_hierarchy/clear/pieces.hpp"

namespace fc::hulls::clear {

std::vector<PieceSlot> slots(Pieces& pieces) {
  std::vector<PieceSlot> all = ca::clear::slots(pieces.ca);
  all.push_back(slot("ch02/ex05_hull_tree", "a tree of convex hulls", pieces.hull_tree));
  all.push_back(slot("ch02/ex06_search", "the search over two trees", pieces.search));
  return all;
}

}  // namespace fc::hulls::clear
