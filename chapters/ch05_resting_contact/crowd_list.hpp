// Which bodies belong to which crowd, in a frame.
#pragma once

#include <limits>
#include <span>
#include <vector>

namespace fc::resting {

class CrowdList {
 public:
  struct Crowd {
    std::vector<int> bodies;                                  // in order
    double length = std::numeric_limits<double>::infinity();  // s, of its next plan at most
    bool done = false;                                        // in this instant
    bool jammed = false;  // between what does not move: shorter plans do not help
  };
  // A frame begins, with these crowds.
  void begin(std::size_t bodies, std::vector<std::vector<int>> found);
  void begin_instant();
  const std::vector<int>& crowd_of() const { return crowd_of_; }  // of each body, or -1
  // The body's, or nothing. Valid until bodies are united.
  Crowd* of(int body);
  // One crowd of these bodies, and of all that are in a crowd with one of them.
  void unite(std::span<const int> bodies);

 private:
  std::vector<Crowd> crowds_;
  std::vector<int> crowd_of_;
};

}  // namespace fc::resting
