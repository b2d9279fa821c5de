// The seeded share of the random suite that every test run asks.
#include "suite.hpp"

#include <gtest/gtest.h>

namespace {

using fc::ca::Status;

#ifdef __SANITIZE_ADDRESS__
constexpr std::uint64_t kRounds = 2;
#else
constexpr std::uint64_t kRounds = 15;
#endif
constexpr std::uint64_t kPairs = suite::kKinds.size() * suite::kKinds.size();

class Suite : public testing::TestWithParam<suite::Story> {};

TEST_P(Suite, HoldsForEveryPairOfKinds) {
  const auto story = static_cast<std::uint64_t>(GetParam());
  int undecided = 0, unresolved = 0, uncertified = 0, contacts = 0, separated = 0, starts = 0;
  for (std::uint64_t i = 0; i < kRounds * kPairs; ++i) {
    const std::uint64_t number = story + i * suite::kStories.size();
    const suite::Verdict v = suite::check(suite::query_of(20080101, number), number);
    EXPECT_EQ(v.wrong, "") << "query " << number << ": ch01_suite --seed 20080101 --queries 1 --first "
                           << number;
    unresolved += v.status == Status::unresolved;
    undecided += v.undecided;
    uncertified += v.uncertified;
    contacts += v.status == Status::contact;
    separated += v.status == Status::separated;
    starts += v.status == Status::touching_at_start || v.status == Status::penetrating_at_start;
  }
  const int all = static_cast<int>(kRounds * kPairs);
  EXPECT_LE(100 * undecided, all) << "the reference should be able to tell in 99 % of the queries";
  // A start that overlaps by less than the tolerance may be too near to touching to tell.
  EXPECT_LE(100 * unresolved, GetParam() == suite::Story::start ? all : 0);
  EXPECT_LE(1000 * uncertified, all);
  // The queries are worth running: none of the answers is rare.
  if (GetParam() == suite::Story::start)
    EXPECT_GE(4 * starts, all);
  else
    EXPECT_GE(20 * std::min(contacts, separated), all);
}

// Regression cases from long runs, of the engine and of the replay.
TEST(Suite, QueriesThatOnceFailed) {
  for (const auto& [seed, number] : {std::pair{2026, 295634}, std::pair{2026, 847799}})
    EXPECT_EQ(suite::check(suite::query_of(seed, number), number).wrong, "") << seed << ", " << number;
}

INSTANTIATE_TEST_SUITE_P(Stories, Suite, testing::ValuesIn(suite::kStories),
                         [](const auto& story) { return name_of(story.param); });

}  // namespace
