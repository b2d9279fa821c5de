// Hierarchical conservative advancement: the first contact of two moving models.
#pragma once

#include <cstdint>
#include <vector>

#include "ch01_convex_advancement/query.hpp"
#include "ch02_hull_hierarchy/model_distance.hpp"

namespace fc::hulls {

// What first_reach looks for: the first time at which the gap has come down to about `target`.
struct ReachOptions {
  double interval = 1;      // s
  double target = 5e-7;     // m, every advance aims at this gap; may be <= 0 for a pair that starts so
  double slack = 2.5e-7;    // m, a gap of at most target + slack counts as reached
  double tolerance = 1e-6;  // m, the user's: how precisely distances are wanted near contact
  std::int64_t max_pairs = 10'000'000;
};

struct Reach {
  enum class Status { reached, clear, limit };
  Status status = Status::clear;
  double time = 0;              // s; before it the gap is at least `target`. clear: the interval
  LeafPair pair;                // reached: the pieces, with plane, bounds and witness points at `time`
  std::int64_t node_pairs = 0;  // pairs of nodes that were looked at
  std::int64_t advances = 0;
  std::vector<ca::CertificateRow> certificate;  // if asked for
};

// Pairs of nodes wait in a queue, each with a time until which it is proved to keep the target gap. The
// earliest is taken: its hulls' certified gap and a bound on their closing speed prove it clear for longer,
// and it goes back into the queue, or, where the gap is small against the nodes, its children go. So
// advancing and culling are the same thing: what cannot reach the target before the first contact is never
// opened, and the first pair of leaves at the target is the contact. The bound of a pair of nodes is the
// directional bound about the centre of mass (chapter 1), or the same bound about the nodes' own middles with
// their exact velocity, whichever proves more; a pair of leaves is also held against a plane that moves with
// its witness points, vertex by vertex, which lets pieces leave a contact, or slide in it. Zhang, Lee, Kim
// (2006), section 5 (there one global step; here each pair has its own time).
Reach first_reach(const Model& a, const ca::Motion& motion_a, const Model& b, const ca::Motion& motion_b,
                  const ReachOptions& options, bool certificate = false);

// The query of contract 1.5 for two models; see fc::ca::AdvanceOptions. Features are all pairs within the
// tolerance at toc (features.hpp). Throws std::invalid_argument as ca::check_query.
ca::AdvanceResult advance(const Model& a, const ca::Motion& motion_a, const Model& b,
                          const ca::Motion& motion_b, const ca::AdvanceOptions& options);

}  // namespace fc::hulls
