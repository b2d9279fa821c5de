// The broad phase and the queue, against all pairs and a sorted list.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "ch04_multibody_stepping/broad_phase.hpp"
#include "ch04_multibody_stepping/schedule.hpp"

namespace {

using fc::Vec3;
using fc::world::Bounds;
using fc::world::BoundsTree;
using fc::world::Schedule;

using Pairs = std::set<std::pair<int, int>>;

struct Random {
  std::mt19937_64 engine{1};
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  // Small boxes, some long, some huge, some that are points; and places that are equal.
  Bounds box() {
    const double size = std::pow(10.0, (*this)(-2, 0.7)), grid = (*this)(0, 1) < 0.3 ? 1 : 0;
    Vec3 low((*this)(-5, 5), (*this)(-5, 5), (*this)(-5, 5));
    if (grid > 0) low = low.array().round();
    return {low, low + size * Vec3((*this)(0, 1), (*this)(0, 1), (*this)(0, 1))};
  }
  std::vector<Bounds> boxes(int n) {
    std::vector<Bounds> all;
    for (int i = 0; i < n; ++i) all.push_back(box());
    return all;
  }
};

Pairs all_pairs(const std::vector<Bounds>& boxes) {
  Pairs pairs;
  for (int a = 0; a < static_cast<int>(boxes.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(boxes.size()); ++b)
      if (boxes[a].overlaps(boxes[b])) pairs.emplace(a, b);
  return pairs;
}

void expect_right(const BoundsTree& tree, const std::vector<Bounds>& boxes) {
  Pairs found;
  tree.overlapping_pairs([&](int a, int b) {
    const bool first = found.emplace(std::min(a, b), std::max(a, b)).second;
    EXPECT_TRUE(first) << "the pair " << a << ", " << b << " twice";
  });
  // A box that has grown above its leaf's may be reported only if its own overlaps.
  EXPECT_EQ(found, all_pairs(boxes));
  for (int a = 0; a < static_cast<int>(boxes.size()); a += 3) {
    std::set<int> others, expected;
    tree.overlapping(boxes[a], [&](int b) { EXPECT_TRUE(others.insert(b).second) << b << " twice"; });
    for (int b = 0; b < static_cast<int>(boxes.size()); ++b)
      if (boxes[a].overlaps(boxes[b])) expected.insert(b);
    EXPECT_EQ(others, expected) << a;
  }
}

TEST(BoundsTree, FindsThePairsThatEveryPairFinds) {
  Random random;
  for (const int n : {0, 1, 2, 3, 7, 64, 300}) {
    const std::vector<Bounds> boxes = random.boxes(n);
    BoundsTree tree;
    tree.build(boxes);
    expect_right(tree, boxes);
  }
}

TEST(BoundsTree, StaysRightWhenBoxesMove) {
  Random random;
  std::vector<Bounds> boxes = random.boxes(200);
  BoundsTree tree;
  tree.build(boxes);
  for (int round = 0; round < 20; ++round) {
    for (int k = 0; k < 10; ++k) {
      const int body = static_cast<int>(random(0, 200 - 1e-9));
      boxes[body] = random.box();
      tree.replace(body, boxes[body]);
    }
    expect_right(tree, boxes);
    if (round % 5 != 4) continue;
    boxes = random.boxes(200);
    tree.refit(boxes);
    expect_right(tree, boxes);
  }
}

TEST(BoundsTree, HoldsBoxesThatAreAllTheSame) {
  const std::vector<Bounds> boxes(100, Bounds{Vec3::Zero(), Vec3::Ones()});
  BoundsTree tree;
  tree.build(boxes);
  expect_right(tree, boxes);
}

TEST(Schedule, GivesTheEarliestEventThatIsStillTrue) {
  Schedule schedule;
  schedule.begin(std::vector<Bounds>(6));
  const auto query = [&](int number, double time) {
    schedule.pair(number).time = time;
    schedule.answered(number, 1.0);
  };
  const int late = schedule.open(1, 2), soon = schedule.open(4, 3), never = schedule.open(0, 5);
  query(late, 0.5);
  query(soon, 0.25);
  query(never, 1.0);  // not in this frame
  EXPECT_EQ(schedule.find(3, 4), soon);
  EXPECT_EQ(schedule.find(4, 3), soon);
  EXPECT_EQ(schedule.find(1, 4), -1);
  query(late, 0.125);  // it was queried again: the first answer is void
  EXPECT_EQ(schedule.next(), late);
  schedule.replace(3, Bounds{});  // its pair with 4 is no more
  EXPECT_EQ(schedule.find(3, 4), -1);
  EXPECT_TRUE(schedule.pairs_of(4).empty());
  const int other =
      schedule.open(0, 1);  // takes that pair's number: its old event must not come up as this one's
  EXPECT_EQ(other, soon);
  EXPECT_EQ(schedule.next(), -1);
}

TEST(Schedule, OrdersEventsOfOneInstantByBodies) {
  Schedule schedule;
  schedule.begin(std::vector<Bounds>(4));
  const int later = schedule.open(1, 3), first = schedule.open(2, 0), second = schedule.open(3, 0);
  for (const int number : {later, second, first}) {
    schedule.pair(number).time = 0.5;
    schedule.answered(number, 1.0);
  }
  EXPECT_EQ(schedule.next(), first);
  EXPECT_EQ(schedule.next(), second);
  EXPECT_EQ(schedule.next(), later);
}

}  // namespace
