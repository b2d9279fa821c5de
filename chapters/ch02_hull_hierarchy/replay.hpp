// Checks certificates of hierarchies: does every row claim what is true of its leaves, and do the rows
// together prove every pair of leaves clear? In long double, without GJK and without the motion bounds, like
// chapter 1's.
#pragma once

#include "ch01_convex_advancement/replay.hpp"
#include "ch02_hull_hierarchy/model.hpp"

namespace fc::hulls {

// What is wrong with a model's tree: leaves that are not each triangle once, children that do not share their
// parent's leaves among them, points outside a box; or "". The proof needs nothing else of it.
std::string check_tree(const Model& model);

// The query.
struct PairQuery {
  const Model& a;
  const Model& b;
  ca::Motion motion_a, motion_b;
  double interval;  // s
};

// Everything that is wrong with an answer and its certificate; row k is about blocks[k] (as many as rows). A
// row is held against its boxes' corners, which have the leaves between them, and, if that does not show it,
// against the leaves' own points. Then the blocks: what a block's rows prove from the time on that its
// parents had reached must last until toc, or be taken up by its parts. Stops at the tenth block that does
// not. Not checked: gap_lower and gap_upper at toc, and whether a start that is said to touch or to overlap
// does (rows that stand beside such an answer must be true all the same).
std::vector<ca::Refusal> replay(const PairQuery& query, const ca::ReplayAnswer& answer,
                                const std::vector<ca::CertificateRow>& rows,
                                const std::vector<ca::LeafBlock>& blocks);

}  // namespace fc::hulls
