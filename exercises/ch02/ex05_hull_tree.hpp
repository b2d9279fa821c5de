// Exercise 2.5: a tree of convex hulls. A piece of the engine: chapters 2 and 4 run on it with --mine.
#pragma once

#include <vector>

#include "ch02_hull_hierarchy/clear/pieces.hpp"

namespace fc::mine {

using hulls::HullNode;
using hulls::HullTree;

// A binary tree over convex pieces. Each piece is given by its points (m, body axes): at least one piece, with at least one
// point each. HullNode says what each field of a node means.
//
//   - Node 0 is the root. Every other node is the child of one node, and each piece is in one leaf.
//   - A leaf has `piece` and that piece's points; `left` and `right` stay -1.
//   - An inner node has `left` and `right`, and points whose convex hull holds the points of both children. They are
//     points of the pieces below, so that the hull is no larger than that of the pieces. Whether points inside the hull are
//     kept is up to you; fc::hull_vertices (common/convex_hull.hpp) finds those that must be. It may leave out a point that
//     lies up to kHullRounding times the size of the points outside: `slack` (m) says how much, 0 if all points are kept.
//   - `center` is the middle of the box of the node's points, `radius` the largest distance of one of them from it.
//   - The pieces of an inner node are split at the median: sorted by the middle of each piece's box along the axis in which
//     these middles spread most, the first half goes left (half of n, rounded down), the rest right.
HullTree hull_tree(const std::vector<std::vector<Vec3>>& pieces);

}  // namespace fc::mine
