// The search in two hierarchies, drawn: the pairs of boxes that led to the first contact, and the queue beside them.
#pragma once

#include "ch01_convex_advancement/show_advance.hpp"
#include "ch02_hull_hierarchy/time_of_contact.hpp"

namespace fc::hulls {

// Two bodies and their motions, whose times count from `from`.
struct ShownModels {
  int number_a = 0, number_b = 0;  // of the bodies in the scene
  const Model& a;
  const Model& b;
  ca::Motion motion_a, motion_b;
  double from = 0;  // s in the frame
  TocOptions options;
};

// A search with its certificate: one row for each pair of boxes, or of leaves, that got a step.
struct CertifiedSearch {
  TimeOfContact found;
  ca::AdvanceResult rows;
};
CertifiedSearch certified_search(const ShownModels& shown);

// The rows whose boxes hold the two leaves that met, in order: each but the first lies within the one before.
std::vector<std::size_t> rows_to_contact(const CertifiedSearch& search);

// frame_start: s, added to the times in texts and bars.
std::vector<algorithm::Step> show_search(const ShownModels& shown, const CertifiedSearch& search,
                                         double frame_start);

// The corners of the box that holds these leaves of the tree and no others; m, shape axes.
std::vector<Vec3> box_of_leaves(const BoxTree& tree, int first, int count);

}  // namespace fc::hulls
