// Caught by: Ex02Miss.SeesARodThatFallsFlat
// A step as long as the whole gap lands on the floor, where a gap of 0 or less counts as a miss.
#include <algorithm>
#include <cmath>

#include "ex02_miss.hpp"

namespace fc::exercises {

Answer first_contact(const Rod& rod, double interval, double tolerance, int most) {
  Answer answer;
  double t = 0;
  const double speed = -rod.climb + std::abs(rod.spin) * rod.half_length;
  for (int k = 0;; ++k) {
    answer.visited.push_back(t);
    answer.toc = t;
    const double gap =
        rod.height + rod.climb * t - rod.half_length * std::abs(std::sin(rod.tilt + rod.spin * t));
    if (gap <= 0) {
      answer.status = ca::Status::separated;
      answer.toc = interval;
      return answer;
    }
    if (gap <= tolerance) {
      answer.status = ca::Status::contact;
      return answer;
    }
    if (t >= interval || speed <= 0) {
      answer.status = ca::Status::separated;
      answer.toc = interval;
      return answer;
    }
    if (k == most) return answer;  // unresolved
    t = std::min(t + gap / speed, interval);
  }
}

}  // namespace fc::exercises
