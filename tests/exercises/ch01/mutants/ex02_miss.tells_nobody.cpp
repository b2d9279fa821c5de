// Caught by: Ex02Miss.TellsWhereItLooked
// Right, but nobody can see where it looked.
#include "ex02_miss.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {

Answer first_contact(const Rod& rod, double interval, double tolerance, int most) {
  Answer answer;
  double t = 0;
  const double speed = -rod.climb + std::abs(rod.spin) * rod.half_length;
  for (int k = 0;; ++k) {
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
