// Exercise 5.3. Scenes whose islands one sees; then random ones, against a search that goes from body to
// body.
#include "ex03_islands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace {

using namespace fc::exercises;
using Numbers = std::vector<int>;

// From body to body, over contacts, until no new body is found.
std::vector<Island> slowly(const std::vector<char>& fixed, const std::vector<Touch>& contacts) {
  std::vector<Island> islands;
  Numbers island_of(fixed.size(), -1);
  for (const Touch& first : contacts) {
    const int start = fixed[first.a] ? first.b : first.a;
    if (fixed[start] || island_of[start] >= 0) continue;
    const int number = static_cast<int>(islands.size());
    islands.emplace_back();
    island_of[start] = number;
    for (bool found = true; found;) {
      found = false;
      for (const Touch& c : contacts)
        for (const auto& [from, to] : {std::pair(c.a, c.b), std::pair(c.b, c.a)}) {
          if (fixed[to] || fixed[from] || island_of[from] != number || island_of[to] == number) continue;
          island_of[to] = number;
          found = true;
        }
    }
    for (int body = 0; body < static_cast<int>(fixed.size()); ++body)
      if (island_of[body] == number) islands.back().bodies.push_back(body);
    for (int i = 0; i < static_cast<int>(contacts.size()); ++i) {
      const auto& [a, b] = contacts[i];
      if (island_of[a] != number && island_of[b] != number) continue;
      islands.back().contacts.push_back(i);
      islands.back().grounded |= fixed[a] || fixed[b];
    }
  }
  return islands;
}

void expect_islands(const std::vector<Island>& got, const std::vector<Island>& expected,
                    const char* meaning) {
  ASSERT_EQ(got.size(), expected.size()) << "islands: " << meaning;
  for (std::size_t k = 0; k < got.size(); ++k) {
    ASSERT_EQ(got[k].bodies, expected[k].bodies) << "bodies of island " << k << ": " << meaning;
    ASSERT_EQ(got[k].contacts, expected[k].contacts) << "contacts of island " << k << ": " << meaning;
    ASSERT_EQ(got[k].grounded, expected[k].grounded) << "whether island " << k << " stands: " << meaning;
  }
}

TEST(Ex03Islands, SetsGrowTogether) {
  Sets sets = single_sets(6);
  EXPECT_EQ(size(sets, 3), 1) << "members: at first each number is a set by itself";
  EXPECT_TRUE(join(sets, 0, 1)) << "0 and 1 were two sets, and become one";
  EXPECT_TRUE(join(sets, 2, 3)) << "2 and 3 were two sets, and become one";
  EXPECT_TRUE(join(sets, 1, 3)) << "sets become one over members that are no roots, too";
  EXPECT_FALSE(join(sets, 0, 2)) << "0 and 2 are of one set already, over 1 and 3";
  EXPECT_EQ(size(sets, 0), 4) << "members: 0, 1, 2 and 3";
  EXPECT_EQ(size(sets, 4), 1) << "members: nobody joined 4";
  for (const int i : {1, 2, 3})
    EXPECT_EQ(find(sets, i), find(sets, 0))
        << "roots: " << i << " is of one set with 0, so both have the same";
  EXPECT_NE(find(sets, 4), find(sets, 0)) << "roots: 4 is of another set than 0";
  EXPECT_NE(find(sets, 4), find(sets, 5)) << "roots: 4 and 5 are each by themselves";
  EXPECT_EQ(find(sets, find(sets, 2)), find(sets, 2)) << "roots: a root is its own root";
}

TEST(Ex03Islands, TwoStacksOnOneFloor) {
  // The floor is body 0; 1 and 2 stand on each other, and so do 3 and 4.
  const std::vector<char> fixed{1, 0, 0, 0, 0};
  const std::vector<Touch> contacts{{0, 1}, {0, 3}, {1, 2}, {3, 4}};
  expect_islands(islands_of(fixed, contacts), {{{1, 2}, {0, 2}, true}, {{3, 4}, {1, 3}, true}},
                 "who pushes one stack moves nothing of the other: the floor does not pass it on");
}

TEST(Ex03Islands, ABridge) {
  const std::vector<char> fixed{1, 0, 0, 0, 0, 0};
  std::vector<Touch> contacts{{0, 1}, {0, 3}, {1, 2}, {3, 4}, {2, 5}, {4, 5}};
  expect_islands(islands_of(fixed, contacts), {{{1, 2, 3, 4, 5}, {0, 1, 2, 3, 4, 5}, true}},
                 "a beam over both stacks makes one island of them, though that is seen last");
}

TEST(Ex03Islands, AFixedBodyAsTheFirstOfAContactOrTheSecond) {
  const std::vector<char> fixed{0, 1, 0, 0};
  expect_islands(islands_of(fixed, std::vector<Touch>{{0, 1}, {1, 2}}), {{{0}, {0}, true}, {{2}, {1}, true}},
                 "each of two bodies on a fixed one is an island");
}

TEST(Ex03Islands, WhoIsInNone) {
  const std::vector<char> fixed{1, 1, 0, 0, 0};
  expect_islands(islands_of(fixed, std::vector<Touch>{{0, 1}, {3, 4}}), {{{3, 4}, {1}, false}},
                 "fixed bodies that touch have nothing to solve; body 2 touches nobody; 3 and 4 fly");
  expect_islands(islands_of(fixed, {}), {}, "no contacts");
}

TEST(Ex03Islands, IsGroundedByAnyOfItsContacts) {
  // A row of bodies 1, 2, 3 that leans on the wall 0 at one end; 4 and 5 fly.
  const std::vector<char> fixed{1, 0, 0, 0, 0, 0};
  expect_islands(islands_of(fixed, std::vector<Touch>{{2, 3}, {4, 5}, {1, 2}, {0, 1}, {2, 3}}),
                 {{{1, 2, 3}, {0, 2, 3, 4}, true}, {{4, 5}, {1}, false}},
                 "one contact with the wall is enough, whichever; a pair may have several contacts");
}

TEST(Ex03Islands, AsFromBodyToBody) {
  std::mt19937_64 random(1);
  std::size_t islands = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int count = 2 + static_cast<int>(random() % 30);
    std::vector<char> fixed;
    for (int i = 0; i < count; ++i) fixed.push_back(random() % 5 == 0);
    std::vector<Touch> contacts;
    for (int i = static_cast<int>(random() % 40); i > 0; --i) {
      const int a = static_cast<int>(random() % count), b = static_cast<int>(random() % count);
      if (a != b) contacts.push_back({a, b});
    }
    const std::vector<Island> got = islands_of(fixed, contacts);
    ASSERT_NO_FATAL_FAILURE(expect_islands(got, slowly(fixed, contacts), "as a plain search has it"))
        << "random contacts, trial " << trial;
    islands += got.size();
  }
  EXPECT_GT(islands, 500U) << "islands in all trials, of the test itself";
}

// Joined in this order, two and two, four and four, ..., trees become as high as they can.
TEST(Ex03Islands, NoWayIsLongerThanTheLogarithm) {
  constexpr int kLevels = 12, kCount = 1 << kLevels;
  Sets pairs = single_sets(kCount), row = single_sets(kCount);
  for (int width = 1; width < kCount; width *= 2)
    for (int i = 0; i < kCount; i += 2 * width) join(pairs, i, i + width);
  for (int i = 1; i < kCount; ++i) join(row, i, i - 1);
  for (Sets* sets : {&pairs, &row})
    for (int i = 0; i < kCount; ++i) {
      const std::int64_t before = sets->steps;
      find(*sets, i);
      ASSERT_LE(sets->steps - before, kLevels)
          << "steps from number " << i
          << ": a member of the larger set never gets farther from its root, and "
          << "one of the smaller set goes to one twice as large; that happens 12 times at most";
    }
}

// Each time a number is searched its path is half as long.
TEST(Ex03Islands, WhoWasAskedIsNearer) {
  constexpr int kLevels = 12, kCount = 1 << kLevels;
  Sets sets = single_sets(kCount);
  for (int width = 1; width < kCount; width *= 2)
    for (int i = 0; i < kCount; i += 2 * width) join(sets, i, i + width);
  std::int64_t before = 0;
  for (int time = 1; time <= 5; ++time) {
    before = sets.steps;
    for (int i = 0; i < kCount; ++i) find(sets, i);
  }
  EXPECT_EQ(sets.steps - before, kCount - 1)
      << "steps for all numbers, asked for the fifth time: one each, but none for the root";
}

TEST(Ex03Islands, CostsAFewStepsAContact) {
  constexpr int kCount = 20'000;
  Numbers order(kCount - 1);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937_64 random(2);
  for (int shuffled = 0; shuffled < 2; ++shuffled) {
    Sets sets = single_sets(kCount);
    for (const int i : order) join(sets, i + 1, i);
    for (int i = 0; i < kCount; ++i) find(sets, i);
    EXPECT_EQ(size(sets, 0), kCount) << "a row of bodies is one island";
    EXPECT_LE(sets.steps, 5 * kCount) << "steps, for " << kCount << " bodies in a row";
    EXPECT_GE(sets.steps, kCount - 1) << "steps: all but the root are at least one away from it";
    std::shuffle(order.begin(), order.end(), random);
  }
}

}  // namespace
