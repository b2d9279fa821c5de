// Which bodies belong to which pile, in a frame.
#pragma once

#include <limits>
#include <span>
#include <vector>

namespace fc::resting {

class PileList {
 public:
  struct Pile {
    std::vector<int> bodies;                                  // in order
    double length = std::numeric_limits<double>::infinity();  // s, of its next plan at most
    bool done = false;                                        // in this instant
    bool jammed = false;  // between what does not move: shorter plans do not help
  };
  // A frame begins, with these piles.
  void begin(std::size_t bodies, std::vector<std::vector<int>> found);
  void begin_instant();
  const std::vector<int>& pile_of() const { return pile_of_; }  // of each body, or -1
  // The body's, or nothing. Valid until bodies are united.
  Pile* of(int body);
  // One pile of these bodies, and of all that are in a pile with one of them.
  void unite(std::span<const int> bodies);
  // Those of the last frame with at least so many bodies.
  std::vector<std::vector<int>> large(std::size_t bodies) const;
  // Whether no path of its bodies was shortened for some frames.
  bool is_calm(const Pile& pile) const;
  void was_shortened(const Pile& pile);

 private:
  std::vector<Pile> piles_;
  std::vector<int> pile_of_;
  std::vector<int> calm_;  // of each body: frames since a path was shortened in its pile
};

}  // namespace fc::resting
