// The rounding of doubles, and sums of times that are never too large.
#pragma once

#include <cmath>
#include <limits>

namespace fc::ca {

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// The sum of two times >= 0, rounded down.
inline double sum_below(double t, double step) {
  const double sum = t + step;
  const double added = sum - t;
  const double lost = (t - (sum - added)) + (step - added);  // sum + lost = t + step exactly (Knuth)
  return lost < 0 ? std::nextafter(sum, t) : sum;
}

// What is left of the interval at t, rounded up: the last row of a certificate must reach the end.
inline double remaining_above(double t, double interval) {
  const double remaining = interval - t;
  return sum_below(t, remaining) < interval ? std::nextafter(remaining, interval) : remaining;
}

}  // namespace fc::ca
