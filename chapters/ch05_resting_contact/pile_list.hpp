// Which bodies belong to which pile, and how much work other islands may take when they go from event to event.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "ch05_resting_contact/island.hpp"

namespace fc::resting {

// Work is counted in visits of a solver to a contact, so it is the same on every machine. An island that exceeds its
// budget becomes a pile for the rest of the frame and for some frames more; each time it does so again, for twice as
// many. An island that stands at the frame's end is exempt: its balance may take much work to find, but then costs
// nothing.
class PileList {
 public:
  struct Pile {
    std::vector<int> bodies;                                  // in order
    double length = std::numeric_limits<double>::infinity();  // s, the most for its next plan
    bool done = false;                                        // in this instant
    bool jammed = false;  // between bodies that do not move: shorter plans do not help
  };
  explicit PileList(std::size_t bodies) : accounts_(bodies) {}
  void next_frame();
  // A frame, or a part of one, begins with these piles.
  void begin(const std::vector<std::vector<int>>& found);
  const std::vector<int>& pile_of() const { return pile_of_; }  // of each body, or -1
  // The body's pile, or null. Valid until bodies are united.
  Pile* of(int body);
  void begin_instant() {
    for (Pile& pile : piles_) pile.done = false;
  }
  // Makes one pile of these bodies, and of all piles that contain one of them.
  void unite(std::span<const int> bodies);
  // The last frame's piles of at least this size.
  std::vector<std::vector<int>> large(std::size_t bodies) const;
  // Whether no path of its bodies has been shortened for some frames.
  bool is_calm(const Pile& pile) const;
  void was_shortened(const Pile& pile);

  // Charges an island with its work; most: the budget of a frame. rest_speed: m/s, a margin in a frame, if the frame is
  // over; else 0.
  void add_work(const Island& island, double work, double most, double rest_speed);
  bool is_spent(const Island& island) const;

 private:
  struct Account {
    double work = 0;  // in this frame, of its island
    int waits = 0;    // frames for which it remains a pile
    int waited = 0;   // frames for which it was a pile the last time
    bool spent = false;
    int calm = 0;  // frames since a path was shortened in its pile
  };
  std::vector<Pile> piles_;
  std::vector<int> pile_of_;
  std::vector<Account> accounts_;  // of each body
};

}  // namespace fc::resting
