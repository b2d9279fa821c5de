// Exercise 1.2. The truth is a function of one variable, and can be looked at as closely as one likes.
#include "ex02_miss.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using fc::exercises::Answer;
using fc::exercises::first_contact;
using fc::exercises::Rod;

double gap_at(const Rod& rod, double t) {
  return rod.height + rod.climb * t - rod.half_length * std::abs(std::sin(rod.tilt + rod.spin * t));
}
// The first time at which the gap is 0, or -1: a march that no gap can slip through, then bisection.
double true_contact(const Rod& rod, double interval) {
  const double speed = std::abs(rod.climb) + std::abs(rod.spin) * rod.half_length;
  for (double t = 0; t <= interval; t += std::max(gap_at(rod, t) / speed, 1e-7))
    if (gap_at(rod, t) <= 0) {
      double low = t - 1e-7, high = t;
      for (int k = 0; k < 60; ++k) (gap_at(rod, 0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
      return low;
    }
  return -1;
}
std::string status_of(const Answer& answer) {
  return fc::ca::name_of(answer.status);
}
std::string says(const Answer& answer) {
  return "the answer was `" + status_of(answer) + "` at " + std::to_string(answer.toc) + " s";
}

TEST(Ex02Miss, SeesARodThatFallsFlat) {
  // 1 m at 3 m/s: contact after a third of a second. Without spin the bound is exact, so a step that aims at
  // contact gets there.
  const Answer answer = first_contact({0.5, 1, -3, 0, 0}, 1, 1e-6, 100);
  ASSERT_EQ(status_of(answer), "contact") << says(answer) << ", but the rod hits the floor at 1/3 s";
  EXPECT_LE(answer.toc, 1.0 / 3) << "s: a time of contact is never late";
  EXPECT_GE(answer.toc, (1 - 1e-6) / 3 - 1e-15) << "s: at toc the gap is at most the tolerance";
}

TEST(Ex02Miss, SeesTheEndThatIsRisingNow) {
  const Rod rod{1, 0.8, 0.05, 0.1, -4};  // its middle climbs; its lower end is the one that rises, at first
  const double contact = true_contact(rod, 2);
  ASSERT_GT(contact, 0) << "s: of the test itself, whose rod has to hit the floor";
  const Answer answer = first_contact(rod, 2, 1e-6, 1000);
  ASSERT_EQ(status_of(answer), "contact")
      << says(answer) << ", but at " << contact << " s an end that was rising has swung down to the floor";
  EXPECT_LE(answer.toc, contact) << "s: a time of contact is never late";
}

TEST(Ex02Miss, IsNeverLate) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> u(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    Rod rod{0.2 + u(random), 0, -2 * u(random), 6 * u(random), 12 * u(random) - 6};
    rod.height = rod.half_length * std::abs(std::sin(rod.tilt)) + 0.01 + u(random);
    const double contact = true_contact(rod, 1);
    const Answer answer = first_contact(rod, 1, 1e-6, 100000);
    if (contact >= 0) {
      ASSERT_EQ(status_of(answer), "contact")
          << says(answer) << ", but the rod hits the floor at " << contact << " s";
      ASSERT_LE(answer.toc, contact + 1e-15) << "s: the contact is reported after it happened";
    } else {
      ASSERT_NE(status_of(answer), "unresolved")
          << says(answer)
          << " after 100,000 advances, but no part of the rod is ever near the floor: a few thousand prove that";
    }
    for (const double t : answer.visited)
      ASSERT_TRUE(contact < 0 || t <= contact + 1e-15)
          << "the advancement looked at " << t << " s, after the contact at " << contact << " s";
  }
}

TEST(Ex02Miss, StopsWithinATightTolerance) {
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Rod rod{0.5, 1, -0.7, 0.3, 1.5};
    const Answer answer = first_contact(rod, 3, tolerance, 100000);
    ASSERT_EQ(status_of(answer), "contact")
        << says(answer) << " with a tolerance of " << tolerance << " m, but the rod falls onto the floor";
    EXPECT_GT(gap_at(rod, answer.toc), 0) << "m: the gap at toc, with a tolerance of " << tolerance
                                          << " m: the rod must not be in the floor yet";
    EXPECT_LE(gap_at(rod, answer.toc), tolerance)
        << "m: the gap at toc; `contact` means that no more is left";
  }
}

TEST(Ex02Miss, SaysThatALimitWasReached) {
  const Rod rod{1, 3, -0.5, 0, 20};  // many turns on the way down: plain advancement takes many steps
  const Answer answer = first_contact(rod, 10, 1e-9, 5);
  ASSERT_EQ(status_of(answer), "unresolved")
      << says(answer)
      << ", but five advances prove only that the rod is clear for a while; `separated` would be a lie";
  EXPECT_GT(answer.toc, 0) << "s: until then the rod is clear";
  EXPECT_LE(answer.toc, true_contact(rod, 10)) << "s: nothing is proved beyond the contact";
}

TEST(Ex02Miss, TellsWhereItLooked) {
  for (const Rod& rod : {Rod{0.5, 1, -0.7, 0.3, 1.5}, Rod{1, 3, -0.5, 0, 20}, Rod{1, 2, 0.1, 0.4, 0.1}}) {
    const Answer answer = first_contact(rod, 3, 1e-6, 30);
    const std::vector<double>& visited = answer.visited;
    ASSERT_FALSE(visited.empty())
        << "`visited` names each time at which the advancement looked; the plot is made of them";
    EXPECT_EQ(visited.front(), 0) << "s: it looks at the start first";
    EXPECT_TRUE(std::is_sorted(visited.begin(), visited.end())) << "s: it never goes back";
    EXPECT_LE(visited.size(), 31U) << "looks: one before each of 30 advances, and one after the last";
    if (status_of(answer) == "contact") {
      EXPECT_EQ(visited.back(), answer.toc) << "s: the contact is where it looked last";
    }
    for (const double t : visited)
      EXPECT_LE(t, answer.toc) << "s: it looked beyond the time until which anything is proved; "
                               << says(answer);
  }
}

// At the smallest tolerance that the contract allows; the gap in long double.
TEST(Ex02Miss, IsAsTightAsItMayBeAsked) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> u(0, 1);
  for (int trial = 0; trial < 100; ++trial) {
    const double interval = 3;
    const Rod rod{0.2 + u(random), 1.5 + 10 * u(random), -5 - u(random), 6 * u(random), 12 * u(random) - 6};
    const double size = rod.height +
                        rod.half_length * (1 + std::abs(rod.tilt) + std::abs(rod.spin) * interval) +
                        std::abs(rod.climb) * interval;
    const Answer answer = first_contact(rod, interval, 1e-13 * size, 100000);
    ASSERT_EQ(status_of(answer), "contact")
        << says(answer) << ", with a tolerance of " << 1e-13 * size << " m";
    const long double t = answer.toc;
    const long double gap =
        rod.height + rod.climb * t - rod.half_length * std::abs(std::sin(rod.tilt + rod.spin * t));
    ASSERT_GT(gap, 0) << "m: at toc the rod is in the floor, if only by rounding: aim at half the tolerance";
    ASSERT_LE(gap, 1e-13L * size) << "m: the gap at toc";
  }
}

}  // namespace
