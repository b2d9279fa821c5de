// Exercise 4.4. Equal beads exchange their velocities, so that their world lines are straight lines which
// change hands: that tells every place and the number of collisions.
#include "ex04_beads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using fc::exercises::Bead;
using fc::exercises::BeadsResult;
using fc::exercises::fly;

std::vector<Bead> random_beads(std::mt19937_64& random, int count, bool equal) {
  std::uniform_real_distribution<double> any(0, 1);
  std::vector<Bead> beads;
  double place = 0;
  for (int i = 0; i < count; ++i) {
    place += 0.1 + any(random);
    beads.push_back({place, 4 * any(random) - 2, equal ? 1 : 0.2 + 3 * any(random)});
  }
  return beads;
}
double energy(const std::vector<Bead>& beads) {
  double sum = 0;
  for (const Bead& b : beads) sum += 0.5 * b.mass * b.velocity * b.velocity;
  return sum;
}
double momentum(const std::vector<Bead>& beads) {
  double sum = 0;
  for (const Bead& b : beads) sum += b.mass * b.velocity;
  return sum;
}

// After every collision all beads are queried again, and all are moved.
BeadsResult slowly(std::vector<Bead>& beads, double duration) {
  BeadsResult result;
  for (double now = 0;;) {
    double next = duration;
    std::size_t who = beads.size();
    for (std::size_t i = 0; i + 1 < beads.size(); ++i) {
      const double closing = beads[i].velocity - beads[i + 1].velocity;
      if (closing <= 0) continue;
      const double time = now + std::max(0.0, beads[i + 1].place - beads[i].place) / closing;
      if (time < next) {
        next = time;
        who = i;
      }
    }
    for (Bead& b : beads) b.place += (next - now) * b.velocity;
    now = next;
    if (who == beads.size()) return result;
    Bead &a = beads[who], &b = beads[who + 1];
    const double closing = a.velocity - b.velocity, sum = a.mass + b.mass;
    a.velocity -= 2 * b.mass / sum * closing;
    b.velocity += 2 * a.mass / sum * closing;
    ++result.collisions;
  }
}

TEST(Ex04Beads, TwoOfThem) {
  std::vector<Bead> beads{{0, 3, 2}, {6, 0, 1}};
  const BeadsResult result = fly(beads, 5);
  EXPECT_EQ(result.collisions, 1) << "collisions: they meet once, and part";
  EXPECT_NEAR(beads[0].velocity, 1, 1e-14) << "m/s: (m1 - m2) / (m1 + m2) of 3 m/s";
  EXPECT_NEAR(beads[1].velocity, 4, 1e-14) << "m/s: 2 m1 / (m1 + m2) of 3 m/s";
  EXPECT_NEAR(beads[0].place, 6 + 3 * 1, 1e-13) << "m: they met at 6 m after 2 s";
  EXPECT_NEAR(beads[1].place, 6 + 3 * 4, 1e-13) << "m: from 6 m on it flies with 4 m/s for 3 s";
}

TEST(Ex04Beads, NobodyMeets) {
  std::vector<Bead> beads{{0, -1, 1}, {1, 0, 1}, {2, 0.5, 1}};
  const BeadsResult result = fly(beads, 3);
  EXPECT_EQ(result.collisions, 0) << "collisions: each is slower than the next one, so they part";
  EXPECT_NEAR(beads[0].place, -3, 1e-14) << "m: 3 s at -1 m/s, from 0";
  EXPECT_NEAR(beads[2].place, 3.5, 1e-14) << "m: also who never collides arrives at the end's time";
}

// A blow goes through a row at rest from hand to hand.
TEST(Ex04Beads, ABlowGoesThroughTheRow) {
  std::vector<Bead> beads{{0, 2, 1}};
  for (int i = 1; i <= 20; ++i) beads.push_back({static_cast<double>(i), 0, 1});
  const BeadsResult result = fly(beads, 10.5);
  EXPECT_EQ(result.collisions, 20) << "collisions: one for each bead that waits";
  EXPECT_NEAR(beads.back().velocity, 2, 1e-14) << "m/s: the last one has it all";
  EXPECT_NEAR(beads.back().place, 21, 1e-12)
      << "m: it was hit at 20 m, after 10 s, and flew on for half a second";
  EXPECT_NEAR(beads.front().place, 1, 1e-12) << "m: it stays where the second was";
}

TEST(Ex04Beads, EqualBeadsExchangeTheirLines) {
  std::mt19937_64 random(1);
  for (const int count : {3, 10, 60}) {
    std::vector<Bead> beads = random_beads(random, count, true);
    std::vector<double> ends;
    std::int64_t crossings = 0;
    const double duration = 4;
    for (std::size_t i = 0; i < beads.size(); ++i) {
      ends.push_back(beads[i].place + duration * beads[i].velocity);
      for (std::size_t j = 0; j < i; ++j) crossings += ends[j] > ends[i];
    }
    std::sort(ends.begin(), ends.end());
    const BeadsResult result = fly(beads, duration);
    EXPECT_EQ(result.collisions, crossings)
        << "collisions: as many as the straight lines of " << count << " equal beads have crossings";
    for (std::size_t i = 0; i < beads.size(); ++i)
      EXPECT_NEAR(beads[i].place, ends[i], 1e-12 * count)
          << "m, bead " << i << " of " << count << ": equal beads exchange their straight lines";
  }
}

TEST(Ex04Beads, AnyMassesAsTheSlowWayDoes) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<Bead> beads = random_beads(random, 12, false), reference = beads;
    const double before = energy(beads), push = momentum(beads);
    const BeadsResult result = fly(beads, 3), slow = slowly(reference, 3);
    ASSERT_EQ(result.collisions, slow.collisions)
        << "collisions in trial " << trial << ": one was missed, or counted twice";
    EXPECT_NEAR(energy(beads), before, 1e-12 * before) << "J: elastic collisions keep the energy";
    EXPECT_NEAR(momentum(beads), push, 1e-12 * 12) << "kg m/s: nobody pushes from outside";
    for (std::size_t i = 0; i < beads.size(); ++i) {
      EXPECT_NEAR(beads[i].place, reference[i].place, 1e-8)
          << "m, bead " << i << " in trial " << trial
          << ", beside the search that asks everybody anew each time";
      if (i == 0) continue;
      EXPECT_GE(beads[i].place, beads[i - 1].place - 1e-12) << "m: beads passed through each other";
    }
  }
}

TEST(Ex04Beads, CostsThreeEventsACollision) {
  std::mt19937_64 random(3);
  std::vector<Bead> beads = random_beads(random, 400, true);
  const BeadsResult result = fly(beads, 4);
  EXPECT_GT(result.collisions, 1500) << "collisions: 400 beads meet often";
  EXPECT_GT(result.events, result.collisions) << "events: each collision was one, and more were made void";
  EXPECT_LE(result.events, 399 + 3 * result.collisions)
      << "events: only neighbours of the two need to be asked again";
}

}  // namespace
