#include "ex02_miss.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {

// 1. A step must hold for all of the time until its end: the speed is a bound for the rest of the interval,
//    not that of the end which is lower just now. An end may swing down that is rising at present.
// 2. The aim is half the tolerance, not contact. A step that lands on the floor finds a gap of 0, or one
//    below it by rounding, and what is at the floor then counts as under it.
// 3. No step is ever made longer than it was proved.
// 4. Having used up the advances is no proof of a miss: the answer is "clear until t".
Answer first_contact(const Rod& rod, double interval, double tolerance, int most) {
  Answer answer;
  double t = 0;
  const double speed = -rod.climb + std::abs(rod.spin) * rod.half_length;
  for (int k = 0;; ++k) {
    answer.visited.push_back(t);
    answer.toc = t;
    const double gap =
        rod.height + rod.climb * t - rod.half_length * std::abs(std::sin(rod.tilt + rod.spin * t));
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
    t = std::min(t + (gap - 0.5 * tolerance) / speed, interval);
  }
}

}  // namespace fc::exercises
