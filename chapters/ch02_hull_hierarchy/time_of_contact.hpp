// The fast search for the first time at which two moving models come to a target gap.
#pragma once

#include <cstdint>
#include <limits>
#include <ostream>
#include <vector>

#include "ch01_convex_advancement/query.hpp"
#include "ch02_hull_hierarchy/box_tree.hpp"
#include "ch02_hull_hierarchy/model_distance.hpp"

namespace fc::hulls {

namespace clear {
struct Pieces;
}

// What time_of_contact looks for: the first time at which the gap has come down to about `target`.
struct TocOptions {
  double interval = 1;      // s
  double target = 5e-7;     // m, every advance aims at this gap; may be <= 0 for a pair that starts so
  double slack = 2.5e-7;    // m, a gap of at most target + slack counts as reached
  double tolerance = 1e-6;  // m, the user's: how precisely distances are wanted near contact
  double start = -1;        // m, a gap of at most this at t = 0 counts as reached at once
  std::int64_t max_pairs = 10'000'000;
};

// The answer of time_of_contact.
struct TimeOfContact {
  enum class Status { reached, clear, limit };
  Status status = Status::clear;
  double time = 0;  // s; before it the gap is at least `target`. clear: the interval
  // m, a lower bound of the gap at t = 0, unless reached at once; rough where the gap is large.
  double start_gap = std::numeric_limits<double>::infinity();
  LeafPair pair;                // reached: the leaves, with plane, bounds and witness points at `time`
  std::int64_t node_pairs = 0;  // pairs of boxes that were looked at
  std::int64_t leaf_pairs = 0;  // pairs of leaves whose distance was computed
  std::int64_t advances = 0;    // steps that were proved
};
inline std::ostream& operator<<(std::ostream& out, TimeOfContact::Status status) {
  constexpr const char* kNames[] = {"reached", "clear", "limit"};
  return out << kNames[static_cast<int>(status)];
}

// One pair of nodes in the queue.
struct WaitingPair {
  double time;      // s, until when it is proved clear
  float apart;      // m, about how far apart the two can be at most
  float normal[3];  // from A to B, world: the plane that proved it
  NodeId a, b;      // nodes; leaves are ~leaf
};

// The storage of a search, and further inputs. Kept from query to query, it allocates nothing.
struct SearchMemory {
  std::vector<WaitingPair> queue;
  // Temporal coherence, for queries of the same two models one after the other: the nodes of the leaves that
  // met last.
  bool coherent = false;
  NodeId last_a = -1, last_b = -1;
  // Null: the search in boxes. Else these pieces do the search, in models that have hulls (add_hulls,
  // hull_model.hpp).
  const clear::Pieces* pieces = nullptr;
  ca::AdvanceResult* certificate = nullptr;  // receives a row for every advance; null: none
};

// Pairs of nodes wait in a queue, each with a time until which it is proved to keep the target gap. The
// earliest is taken and its larger node opened: four boxes side by side against the other's one, each with a
// gap, a bound on its closing speed, and so a time of its own (box_steps.hpp), with which it goes back into
// the queue. Advancing and culling are the same thing: a pair that cannot reach the target before the first
// contact is never opened, and the first pair of leaves at the target is the contact. A pair of leaves uses
// GJK's gap (chapter 1), and its points' own velocities (steps.hpp). After Zhang, Lee, Kim (2006), section 5;
// they take one global step, here each pair has its own time.
TimeOfContact time_of_contact(const Model& a, const ca::Motion& motion_a, const Model& b,
                              const ca::Motion& motion_b, const TocOptions& options, SearchMemory& memory);
TimeOfContact time_of_contact(const Model& a, const ca::Motion& motion_a, const Model& b,
                              const ca::Motion& motion_b, const TocOptions& options);

}  // namespace fc::hulls
