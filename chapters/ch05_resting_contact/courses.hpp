// Who goes where in a plan's time, and who comes near whom on the way.
#pragma once

#include <span>
#include <vector>

#include "ch05_resting_contact/island.hpp"
#include "ch05_resting_contact/path.hpp"

namespace fc::resting {

// Two members that may come near each other.
struct Candidate {
  PairContacts* contacts;
  int a, b;                 // places among the members
  bool in_contact = false;  // at the start
  bool clear = false;       // their paths are proved
  double time = 0;          // s, if not: when they have come near
};

// The bodies of a plan, and what cannot be moved and is near them, on straight paths with constant spin.
class Courses {
 public:
  explicit Courses(Contacts& contacts) : contacts_(contacts) {}

  // For `length` seconds from `now` on (s in the frame). Nobody has a path yet.
  void start(const world::World& world, std::span<const Member> members, double now, double length);
  // Adds the pairs that may come near each other, and brings their contacts to the start: at first all whose paths by their
  // mean velocities do, then those of bodies whose paths leave the boxes that were looked at. `far`: contact points are wanted
  // of convex pairs that may get into contact in the plan's time, too.
  void find(const world::World& world, bool far);
  int candidate_of(PairContacts* contacts, int a, int b);
  // The member goes with these velocities.
  void go(int member, const Twist& path);
  // Proves the paths of all pairs of which one goes in another way than at the last prove(); whether all are clear.
  // `floor`: m; gaps stay above that, or half of what they were.
  template <class Floor>
  bool prove(const world::World& world, Floor&& floor, std::int64_t most_pairs) {
    bool all = true;
    for (Candidate& pair : candidates) {
      if (changed_[at(pair.a)] || changed_[at(pair.b)]) {
        const PathVerdict verdict = check(world, pair, tracks[at(pair.a)], tracks[at(pair.b)], floor(pair), most_pairs);
        pair.clear = verdict.clear;
        pair.time = verdict.time;
      }
      all = all && pair.clear;
    }
    std::fill(changed_.begin(), changed_.end(), 0);
    return all;
  }
  // One pair, on these paths.
  PathVerdict check(const world::World& world, const Candidate& pair, const Track& a, const Track& b, double floor,
                    std::int64_t most_pairs);

  double length() const { return length_; }
  int checked() const { return checked_; }

  std::vector<Member> members;
  std::vector<Twist> drift;   // of each: the mean velocities of free flight
  std::vector<Twist> last;    // what the end of free flight has more than that
  std::vector<Track> tracks;  // of each
  std::vector<Candidate> candidates;

 private:
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  void add_member(const world::World& world, const Member& member);
  world::Bounds box_of(const world::World& world, int member) const;
  void add_pair(const world::World& world, int i, int j, bool far);
  double way(const Candidate& pair) const;

  Contacts& contacts_;
  std::int64_t number_ = 0;  // of starts
  double now_ = 0, length_ = 0;
  std::vector<int> place_of_;  // of each body of the world among the members, or -1
  std::vector<char> changed_;  // of each member, since the last prove()
  world::BoundsTree tree_;     // of the boxes of members that can be moved; none of others
  std::vector<world::Bounds> boxes_;
  std::vector<int> others_;
  int checked_ = 0;
};

}  // namespace fc::resting
