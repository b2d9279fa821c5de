// The seeded share of the random suite that every test run asks.
#include "suite.hpp"

#include <gtest/gtest.h>

namespace {

using fc::ca::Status;

#ifdef __SANITIZE_ADDRESS__
constexpr std::uint64_t kShare = 20;  // one in so many
#else
constexpr std::uint64_t kShare = 1;
#endif
constexpr std::uint64_t kSeed = 20080102;

// Each story alone would prepare all shapes again, so stories run together, and mesh kinds one by one.
class Ch02Suite : public testing::TestWithParam<suite::Kind> {};

TEST_P(Ch02Suite, HoldsForEveryStoryAndEveryOtherKind) {
  suite::Queries queries(kSeed);
  int all = 0, undecided = 0, contacts = 0, separated = 0, starts = 0;
  for (std::uint64_t other = 0; other < suite::kKinds.size(); ++other)
    for (std::uint64_t story = 0; story < suite::kStories.size(); ++story) {
      const std::uint64_t pair = other * suite::kMeshKinds.size() + static_cast<std::uint64_t>(GetParam());
      if ((pair + story) % kShare != 0) continue;
      const std::uint64_t number = pair * suite::kStories.size() + story;
      const suite::Query query = queries.at(number);
      const suite::Verdict v = suite::check(query);
      EXPECT_EQ(v.wrong, "") << query.a->what << " against " << query.b->what << ": ch02_suite --seed "
                             << kSeed << " --queries 1 --first " << number;
      ++all;
      undecided += v.undecided;
      contacts += v.status == Status::contact;
      separated += v.status == Status::separated;
      starts += v.status == Status::touching_at_start || v.status == Status::penetrating_at_start;
    }
  EXPECT_LE(100 * undecided, all) << "the reference should be able to tell in 99 % of the queries";
  // The queries are worth running: none of the answers is rare.
  if (kShare == 1) {
    EXPECT_GE(20 * std::min({contacts, separated, starts}), all);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Ch02Suite, testing::ValuesIn(suite::kMeshKinds),
                         [](const auto& kind) { return suite::name_of(kind.param); });

TEST(Ch02SuiteBunny, HoldsFarNearAndGrazing) {
  const std::shared_ptr<const suite::Prepared> bunny = suite::bunny();
  if (!bunny) GTEST_SKIP() << "the bunny is not there";
  for (std::uint64_t number = 0; number < 6; ++number)
    EXPECT_EQ(suite::check(suite::query_of_one_mesh(bunny, kSeed, number)).wrong, "")
        << "ch02_suite --seed " << kSeed << " --bunny 1 --first " << number;
}

// Touching at the start to within rounding: a vertex on the other one's surface winds either way. Disabled
// until the library asks a vertex that is away from the surface.
TEST(Ch02SuiteStart, TouchingIsNotInside) {
  for (const auto& [seed, number] : {std::pair{20080101, 427}}) {
    suite::Queries queries(seed);
    EXPECT_EQ(suite::check(queries.at(number)).wrong, "") << seed << ", " << number;
  }
}

}  // namespace
