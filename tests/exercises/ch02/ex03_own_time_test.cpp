// Exercise 2.3. Trees whose leaves are known to meet at given times, and that write down who looked where.
#include "ex03_own_time.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace {

using fc::exercises::first_contact;
using fc::exercises::Found;
using fc::exercises::Look;
using fc::exercises::Pairs;

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kNear = 1e-9;  // s, so near its meeting a pair of leaves counts as having reached it

// A binary tree: pair k has the children 2 k + 1 and 2 k + 2; the last `meets.size()` pairs are leaves.
struct Tree {
  std::vector<double> first;    // s, of each pair: when the first leaves below it meet
  std::vector<double> proved;   // s, until when each pair is proved clear so far
  std::vector<int> looks;       // of each pair
  std::vector<double> visited;  // s, when it was looked, in that order
  double too_early = 0;         // s, the longest time that was proved already and looked through again
  double too_late = 0;          // s, the longest time that was passed over without a proof
  double leaf_share = 0.8;      // of its time to the meeting a leaf proves this much in a look, a node less

  explicit Tree(const std::vector<double>& meets)
      : first(2 * meets.size() - 1), proved(first.size(), 0), looks(first.size(), 0) {
    std::copy(meets.begin(), meets.end(), first.end() - static_cast<std::ptrdiff_t>(meets.size()));
    for (int k = static_cast<int>(meets.size()) - 2; k >= 0; --k)
      first[k] = std::min(first[2 * k + 1], first[2 * k + 2]);
  }
  bool leaf(int k) const { return 2 * k + 1 >= static_cast<int>(first.size()); }
  int total() const { return static_cast<int>(visited.size()); }
  Pairs pairs() {
    return {0, [this](int k, double t) { return look(k, t); }};
  }
  Look look(int k, double t) {
    if (total() >= 100000) throw std::runtime_error("100,000 looks: an endless loop?");
    ++looks.at(k);
    visited.push_back(t);
    too_early = std::max(too_early, proved[k] - t);
    too_late = std::max(too_late, t - proved[k]);
    Look result;
    if (leaf(k)) {
      result.reached = first[k] - t <= kNear;
      result.clear_until = t + leaf_share * (first[k] - t);
    } else {
      result.clear_until = t + (0.3 + 0.1 * (k % 4)) * (first[k] - t);
      result.children = {2 * k + 1, 2 * k + 2};
      for (const int child : result.children) proved[child] = std::max(proved[child], result.clear_until);
    }
    proved[k] = std::max(proved[k], result.clear_until);
    return result;
  }
};

std::vector<double> meetings(int leaves, int seed, double earliest = 0.3, double latest = 3) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(earliest, latest);
  std::vector<double> meets(leaves);
  for (double& t : meets) t = random() % 4 ? u(random) : kNever;  // a quarter never meets
  meets[leaves / 2] = u(random);
  return meets;
}
std::string says(const Found& found) {
  return std::string("the answer was `") + fc::ca::name_of(found.status) + "` at " +
         std::to_string(found.time) + " s";
}

TEST(Ex03OwnTime, FindsTheFirstContact) {
  for (int seed = 0; seed < 100; ++seed) {
    Tree tree(meetings(1 << (seed % 8), seed));
    const double truth = tree.first[0];
    const Found found = first_contact(tree.pairs(), 10, 100000);
    ASSERT_EQ(found.status, fc::ca::Status::contact)
        << says(found) << ", but at " << truth << " s leaves meet";
    ASSERT_NEAR(found.time, truth, 2 * kNear) << "s: others meet later; the first contact is asked for";
    ASSERT_EQ(tree.first.at(found.pair), truth)
        << "pair " << found.pair << " is not the one that meets first";
  }
}

TEST(Ex03OwnTime, LooksAtNothingBeyondTheContact) {
  Tree tree(meetings(256, 1));
  const Found found = first_contact(tree.pairs(), 10, 100000);
  ASSERT_EQ(found.status, fc::ca::Status::contact)
      << says(found) << ", but some leaves do meet within the interval";
  const double last = *std::max_element(tree.visited.begin(), tree.visited.end());
  EXPECT_LE(last, tree.first[0]) << "s: the first contact is at " << tree.first[0]
                                 << " s, but a pair was looked at "
                                 << "that is proved clear until " << last << " s: it cannot be the first";
}

TEST(Ex03OwnTime, SkipsNothingThatIsNotProved) {
  for (int seed = 0; seed < 20; ++seed) {
    Tree tree(meetings(64, seed));
    const Found found = first_contact(tree.pairs(), 10, 100000);
    ASSERT_LE(tree.too_late, 0) << "s were passed over without a proof: " << says(found)
                                << "; there a contact would be missed";
    ASSERT_GT(tree.total(), 1) << "looks: the root alone tells nothing of 64 leaves";
  }
}

TEST(Ex03OwnTime, ForgetsNothingThatIsProved) {
  Tree tree(meetings(64, 3));
  const Found found = first_contact(tree.pairs(), 10, 100000);
  ASSERT_EQ(found.status, fc::ca::Status::contact)
      << says(found) << ", but some leaves do meet within the interval";
  EXPECT_LE(tree.too_early, 0)
      << "s that were proved clear were looked through again: a pair inherits the proof "
      << "of the pair it came from, and keeps its own";
}

TEST(Ex03OwnTime, ANodeIsLookedAtOnce) {
  Tree tree(meetings(256, 4));
  const Found found = first_contact(tree.pairs(), 10, 100000);
  ASSERT_EQ(found.status, fc::ca::Status::contact)
      << says(found) << ", but some leaves do meet within the interval";
  for (int k = 0; !tree.leaf(k); ++k)
    ASSERT_LE(tree.looks[k], 1) << "looks at pair " << k << ", which was opened";
}

TEST(Ex03OwnTime, LooksAtFewPairs) {
  Tree tree(meetings(4096, 5));
  tree.first.back() = 0.1;  // the last leaf meets long before all others
  for (int k = static_cast<int>(tree.first.size()) - 1; k > 0; k = (k - 1) / 2)
    tree.first[(k - 1) / 2] = std::min(tree.first[(k - 1) / 2], tree.first[k]);
  const Found found = first_contact(tree.pairs(), 10, 100000);
  ASSERT_EQ(found.status, fc::ca::Status::contact)
      << says(found) << ", but some leaves do meet within the interval";
  EXPECT_LE(tree.total(), 60)
      << "looks, with 8191 pairs: a way down of 12 nodes, the leaf's own looks, and the few "
      << "that might have been earlier";
}

TEST(Ex03OwnTime, ALeafGoesOnFromWhereItIs) {
  Tree tree({2.0});  // one pair of leaves: chapter 1
  const Found found = first_contact(tree.pairs(), 10, 1000);
  ASSERT_EQ(found.status, fc::ca::Status::contact) << says(found) << ", but the only pair meets at 2 s";
  EXPECT_NEAR(found.time, 2, 2 * kNear) << "s: the only pair of leaves meets then";
  EXPECT_EQ(tree.total(), 15) << "looks: each leaves a fifth of the time, until 1e-9 s are left";
}

TEST(Ex03OwnTime, TheFirstLeafOnTopNeedNotBeIt) {
  Tree tree({5.0, 4.0});
  tree.leaf_share = 0.1;  // leaves that learn little in a look
  const Found found = first_contact(tree.pairs(), 10, 100000);
  ASSERT_EQ(found.status, fc::ca::Status::contact)
      << says(found) << ", but some leaves do meet within the interval";
  EXPECT_NEAR(found.time, 4, 2 * kNear)
      << "s: a pair of leaves on top is a contact only if it has reached its target";
}

TEST(Ex03OwnTime, WhatIsBeyondTheIntervalIsGone) {
  Tree tree(meetings(128, 6, 2, 5));
  const Found found = first_contact(tree.pairs(), 1.5, 100000);
  ASSERT_EQ(found.status, fc::ca::Status::separated) << says(found) << ", but nothing meets before 2 s";
  EXPECT_EQ(found.time, 1.5) << "s: clear for the whole interval";
  const double last = *std::max_element(tree.visited.begin(), tree.visited.end());
  EXPECT_LT(last, 1.5) << "s: a pair was looked at that is proved clear until " << last
                       << " s, beyond the interval's end";
}

TEST(Ex03OwnTime, ForEverIsFinite) {
  Tree tree(std::vector<double>(64, kNever));
  const Found found = first_contact(tree.pairs(), kNever, 1000);
  EXPECT_EQ(found.status, fc::ca::Status::separated) << says(found) << ", but no pair ever meets";
  EXPECT_EQ(tree.total(), 1) << "looks: the root is clear for ever, and so is all below it";
}

TEST(Ex03OwnTime, SaysThatALimitWasReached) {
  for (const int most : {1, 5, 20}) {
    Tree tree(meetings(256, 7));
    const Found found = first_contact(tree.pairs(), 10, most);
    ASSERT_EQ(found.status, fc::ca::Status::unresolved)
        << says(found) << ", but " << most << " looks prove only that all is clear for a while";
    EXPECT_EQ(tree.total(), most) << "looks: all that were allowed, and no more";
    EXPECT_GT(found.time, 0) << "s: one look at the root is a proof";
    EXPECT_LE(found.time, tree.first[0]) << "s: nothing was proved beyond the contact";
    EXPECT_GE(found.time, tree.visited.back()) << "s: the queue's top was later than this already";
  }
}

TEST(Ex03OwnTime, AnIntervalOfNothingNeedsNoLook) {
  Tree tree(meetings(8, 9));
  const Found found = first_contact(tree.pairs(), 0, 1000);
  EXPECT_EQ(found.status, fc::ca::Status::separated) << says(found) << ", but nothing meets before 0 s";
  EXPECT_EQ(found.time, 0) << "s: clear for the whole interval, which is none";
  EXPECT_EQ(tree.total(), 0) << "looks: also the root's time lies at the interval's end";
}

}  // namespace
