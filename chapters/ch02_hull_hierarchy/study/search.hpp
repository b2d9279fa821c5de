// Hierarchical advancement, one idea at a time: earlier searches and ours, on the same hierarchy.
#pragma once

#include <ostream>
#include <vector>

#include "ch02_hull_hierarchy/advance.hpp"
#include "ch02_hull_hierarchy/study/tree.hpp"

namespace fc::hulls {

enum class Order {
  global,       // one step for all pairs: the smallest of their safe times, found anew from the roots. FAST
  controlled,   // the same, but early steps are not worked out to the last leaf. C2A
  depth_first,  // each pair has its own time, and is left when that is later than the earliest contact so far
  best_first    // each pair has its own time; the pair with the earliest is next: ours
};
// How long a gap lasts. Each is at least as good as the one before.
enum class Bound {
  naive,         // n.v + |w| r, r: how far the node reaches from the centre of mass
  directional,   // n.v + |n x w| r
  second_order,  // the node's middle exactly, its radius, and the turning of both (ball_step)
  points         // the same, and at the leaves each point's own velocity (points_step): ours
};
const char* name_of(Order order);
inline std::ostream& operator<<(std::ostream& out, Order order) {
  return out << name_of(order);
}
const char* name_of(Bound bound);
inline std::ostream& operator<<(std::ostream& out, Bound bound) {
  return out << name_of(bound);
}

// What became of a pair of nodes when it was looked at.
enum class Fate {
  clear,     // it does not meet within the interval, or not before the earliest contact so far
  advanced,  // proved clear for longer
  opened,    // too near for its size: its children are next (in the searches by rounds: in this round)
  reached    // two leaves in contact
};
const char* name_of(Fate fate);
inline std::ostream& operator<<(std::ostream& out, Fate fate) {
  return out << name_of(fate);
}
struct Visit {
  int a, b;      // the nodes
  double time;   // s, of the pose at which the pair was looked at
  double step;   // s, for which it was then proved clear
  double gap;    // m, certified
  double radii;  // m, of both nodes
  bool leaves;   // both are
  Fate fate;
};

struct StudySearchOptions {
  Order order = Order::best_first;
  Bound bound = Bound::points;
  std::vector<Visit>* visits = nullptr;  // receives each look; null: none
};

struct StudyTimeOfContact : TimeOfContact {
  std::int64_t rounds = 0;  // global, controlled: how often the hierarchy was gone through from the roots
};

// The first time at which two models come to the target gap: the same as time_of_contact and clear::search,
// with the same guarantee: never late, whatever the options. Kept plain: it saves no time by reusing storage,
// or by lanes.
StudyTimeOfContact study_time_of_contact(const HullModel& a, const ca::Motion& motion_a, const HullModel& b,
                                         const ca::Motion& motion_b, const TocOptions& options,
                                         const StudySearchOptions& study);

}  // namespace fc::hulls
