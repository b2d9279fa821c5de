// The paths of a plan's bodies, and which of them come near each other on these paths.
#pragma once

#include <span>
#include <vector>

#include "ch05_resting_contact/island.hpp"
#include "ch05_resting_contact/path.hpp"

namespace fc::resting {

// Two members that may come near each other.
struct Candidate {
  PairContacts* contacts;
  int a, b;                             // places among the members
  bool in_contact = false;              // at the start
  bool checked = false, clear = false;  // whether their paths were examined, and proved
  double time = 0;                      // s, if not proved: when they have come near
  double slack = 0;                     // m: they are clear as long as the two paths change by less
  double moved = 0;                     // m, by which the paths had changed when they were examined
};

// The bodies of a plan, and the nearby bodies that cannot be moved, on straight paths with constant spin.
class Courses {
 public:
  // keep: pairs are kept from one start to the next, if the bodies are the same. PlanMaker gives pairs in contact anew
  // for each plan, so they cannot be kept there.
  Courses(Contacts& contacts, bool keep) : contacts_(contacts), keep_(keep) {}

  // Begins `length` seconds from `now` on (s in the frame). No member has a path yet.
  void start(const world::World& world, std::span<const Member> members, double now, double length);
  // Adds the pairs that may come near each other, and updates their contacts to the start: at first all pairs that do
  // so at their mean velocities, then those of bodies whose paths leave the boxes that were searched. `far`: contact
  // points are also found for convex pairs that may get into contact during the plan.
  void find(const world::World& world, bool far);
  int candidate_of(PairContacts* contacts, int a, int b);
  // Gives the member a path with these velocities.
  void go(int member, const Twist& twist);
  // Proves the paths of all pairs that have changed so much since their last proof that it no longer holds. Returns
  // whether all are clear. options_of(pair): gaps stay above `required_gap`, or half of what they were.
  template <class OptionsOf>
  bool prove(const world::World& world, OptionsOf&& options_of) {
    bool all = true;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      fetch_ahead(i);
      Candidate& pair = candidates[i];
      const double moved = moved_[at(pair.a)] + moved_[at(pair.b)];
      const double since = moved - pair.moved;
      if (!pair.checked || (pair.clear ? since > pair.slack : since > 0)) {
        const PathVerdict verdict =
            check(world, pair, paths[at(pair.a)], paths[at(pair.b)], options_of(pair));
        pair.checked = true;
        pair.clear = verdict.clear;
        pair.time = verdict.time;
        pair.slack = verdict.slack;
        pair.moved = moved;
      }
      all = all && pair.clear;
    }
    return all;
  }
  // Checks one pair, on these paths.
  PathVerdict check(const world::World& world, const Candidate& pair, const Path& a, const Path& b,
                    PathOptions options);

  // For loops over all candidates, at the i-th: prefetches the data of later ones. A pile's data exceed the caches, and
  // lie scattered in memory.
  void fetch_ahead(std::size_t i) const {
    constexpr std::size_t kPair = 12, kPoints = 6, kLine = 64;
    const auto fetch = [](const void* start, std::size_t bytes) {
      for (std::size_t k = 0; k < bytes; k += kLine) __builtin_prefetch(static_cast<const char*>(start) + k);
    };
    if (i + kPair < candidates.size()) fetch(candidates[i + kPair].contacts, sizeof(PairContacts));
    if (i + kPoints >= candidates.size()) return;
    const std::vector<ContactPoint>& points = candidates[i + kPoints].contacts->points;
    fetch(points.data(), points.size() * sizeof(ContactPoint));
  }
  // The members, with these velocities.
  std::vector<RigidBody> with(const std::vector<Twist>& velocities) const;

  double length() const { return length_; }
  int checked() const { return checked_; }

  std::vector<Member> members;
  std::vector<Twist> drift;  // of each: the mean velocities of free flight
  std::vector<Twist> last;   // by how much the velocity at the end of free flight differs from that
  std::vector<Path> paths;   // of each
  std::vector<Candidate> candidates;

 private:
  bool keeps(const world::World& world, std::span<const Member> all);
  void add_member(const world::World& world, const Member& member);
  void set_member(const world::World& world, std::size_t i, const Member& member);
  void update(const world::World& world, const Candidate& pair, bool far);
  std::vector<int> widen(const world::World& world);
  world::Bounds box_of(const world::World& world, int member) const;
  void add_pair(const world::World& world, int i, int j, bool far);
  double approach(const Candidate& pair) const;

  Contacts& contacts_;
  bool keep_;
  bool fresh_ = true;        // nothing was found since the start
  std::int64_t frame_ = 0;   // of the last start
  int age_ = 0;              // starts with the same pairs so far
  std::size_t first_ = 0;    // members at the start
  std::int64_t number_ = 0;  // of starts
  double now_ = 0, length_ = 0;
  std::vector<int> place_of_;  // of each body of the world among the members, or -1
  std::vector<double> moved_;  // m: of each member, a bound of how much its path has changed, in total
  world::BoundsTree tree_;     // of the boxes of members that can be moved
  std::vector<world::Bounds> boxes_;
  std::vector<int> others_;
  int checked_ = 0;
};

}  // namespace fc::resting
