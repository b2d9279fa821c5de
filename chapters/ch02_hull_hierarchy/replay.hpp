// Checks certificates of hierarchies: is every row's claim true of its leaves, and do the rows together prove
// every pair of leaves clear? In long double, without GJK and without the motion bounds, like chapter 1's.
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
// row is checked against its boxes' corners, whose hull contains the leaves, and, if these do not prove it,
// against the leaves' own points. Then the blocks: from the time that its parents had reached, a block's rows
// must prove it clear until toc, or its parts must take over. Stops at the tenth block that fails. Not
// checked: gap_lower and gap_upper at toc, and whether bodies reported as touching or overlapping at the
// start do so (the rows of such an answer must be true all the same).
std::vector<ca::Refusal> replay(const PairQuery& query, const ca::ReplayAnswer& answer,
                                const std::vector<ca::CertificateRow>& rows,
                                const std::vector<ca::LeafBlock>& blocks);

}  // namespace fc::hulls
