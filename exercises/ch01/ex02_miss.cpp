#include "ex02_miss.hpp"

#include <algorithm>
#include <cmath>

#include "common/todo.hpp"

namespace fc::exercises {

// Conservative advancement with four mistakes, each of which has been shipped in a real library. It misses
// contacts, and reports some too late.
Answer first_contact(const Rod& rod, double interval, double tolerance, int most) {
  FC_TODO("1.2");  // delete this line, and begin

  Answer answer;
  double t = 0;
  for (int k = 0; k < most; ++k) {
    answer.visited.push_back(t);
    const double angle = rod.tilt + rod.spin * t;
    const double gap = rod.height + rod.climb * t - rod.half_length * std::abs(std::sin(angle));
    if (gap < 0) break;  // under the floor: it was not hit
    if (gap <= tolerance && k > 0 && gap > 0) {
      answer.status = ca::Status::contact;
      answer.toc = t;
      return answer;
    }
    // The lower end's speed towards the floor.
    const double lower_end = std::sin(angle) > 0 ? -1 : 1;
    const double speed = -(rod.climb + lower_end * rod.half_length * rod.spin * std::cos(angle));
    if (speed <= 0) break;             // it moves away
    t += std::max(gap / speed, 1e-4);  // some progress in any case
    if (t >= interval) break;
  }
  answer.status = ca::Status::separated;
  answer.toc = interval;
  return answer;
}

}  // namespace fc::exercises
