// Caught by: Ex02Miss.SeesTheEndThatIsRisingNow
// The speed of the lower end now, instead of a bound for the rest.
#include <algorithm>
#include <cmath>

#include "ex02_miss.hpp"

namespace fc::exercises {

Answer first_contact(const Rod& rod, double interval, double tolerance, int most) {
  Answer answer;
  double t = 0;
  for (int k = 0;; ++k) {
    answer.visited.push_back(t);
    answer.toc = t;
    const double gap =
        rod.height + rod.climb * t - rod.half_length * std::abs(std::sin(rod.tilt + rod.spin * t));
    if (gap <= tolerance) {
      answer.status = ca::Status::contact;
      return answer;
    }
    const double angle = rod.tilt + rod.spin * t, lower_end = std::sin(angle) > 0 ? -1 : 1;
    const double speed = -(rod.climb + lower_end * rod.half_length * rod.spin * std::cos(angle));
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
