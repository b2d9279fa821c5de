// Bodies followed between their impacts, and examined closely: in between, and just before and after each impact.
#pragma once

#include <algorithm>
#include <sstream>

#include "support/independent_overlap.hpp"

namespace independent {

// All bodies from `begin` to `end` (s), with no impact in between; `states` are those at the beginning.
struct Segment {
  double begin = 0, end = 0;
  std::vector<State> states;
};

inline std::vector<State> moved(const std::vector<Solid>& solids, const std::vector<State>& states,
                                double seconds) {
  std::vector<State> next;
  for (std::size_t i = 0; i < states.size(); ++i) next.push_back(moved(solids[i], states[i], seconds));
  return next;
}

// The largest distance, in m, between where a body's points are and where the other state has them.
inline double distance(const Solid& solid, const State& a, const State& b) {
  const Matrix p = rotation(a.orientation), q = rotation(b.orientation);
  double turn = 0;
  for (int i = 0; i < 3; ++i) turn = std::max(turn, norm(p[i] - q[i]));
  return norm(center(solid, a) - center(solid, b)) + turn * solid.reach;
}

// The first overlap of any two bodies that are not both static, in words; empty if there is none.
inline std::string find_overlap(const std::vector<Solid>& solids, const std::vector<State>& states, How how) {
  for (std::size_t a = 0; a < solids.size(); ++a)
    for (std::size_t b = a + 1; b < solids.size(); ++b)
      if (!(solids[a].is_static && solids[b].is_static) &&
          overlap(solids[a], states[a], solids[b], states[b], how))
        return "bodies " + std::to_string(a) + " and " + std::to_string(b) + " overlap";
  return {};
}

struct Watch {
  int looks = 0;
  std::string overlap;  // the first
};

// Looks at both ends of the segment, at 1 ns to 0.1 ms from them, and at `samples` times in between.
inline void watch(const std::vector<Solid>& solids, const Segment& segment, int samples, How how,
                  Watch& result) {
  const double length = segment.end - segment.begin;
  std::vector<double> times{0, length};
  for (const double near : {1e-9, 1e-7, 1e-5, 1e-4})
    if (near < length) times.insert(times.end(), {near, length - near});
  for (int i = 1; i <= samples; ++i) times.push_back(length * i / (samples + 1));
  for (const double t : times) {
    ++result.looks;
    if (!result.overlap.empty()) return;
    const std::string found = find_overlap(solids, moved(solids, segment.states, t), how);
    if (found.empty()) continue;
    std::ostringstream text;
    text.precision(17);
    text << found << " at t = " << segment.begin + t << " s";
    result.overlap = text.str();
  }
}

}  // namespace independent
