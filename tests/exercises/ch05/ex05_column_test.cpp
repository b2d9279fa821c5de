// Exercise 5.5. Closed forms; then random columns, against Dantzig's method, and against the conditions that
// only the least motion fulfils.
#include "ex05_column.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ch03_impulse_lcp/dantzig.hpp"

namespace {

using namespace fc::exercises;
using Boxes = std::vector<Box>;

constexpr double kWidth = 1, kGravity = 10;  // m, m/s^2: an envelope in which one can count

void expect_displaced(const Boxes& boxes, bool floor, double share, const std::vector<double>& expected,
                      double energy, const char* meaning) {
  const Correction got = correct(boxes, floor, kWidth, share, kGravity);
  ASSERT_EQ(got.displaced.size(), expected.size()) << "displacements: one for each box";
  ASSERT_EQ(got.pushes.size(), expected.size()) << "pushes: one for each gap";
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(got.displaced[i], expected[i], 1e-14) << "m, box " << i << ": " << meaning;
  EXPECT_NEAR(got.energy, energy, 1e-13) << "J: " << meaning;
}

double row(const Box& box, double share) {  // m
  const double lacks = 0.5 * kWidth - box.gap;
  return lacks > 0 ? share * lacks : lacks;
}

Boxes random_boxes(std::mt19937_64& random, int count, double decades) {
  std::uniform_real_distribution<double> any(0, 1);
  Boxes boxes;
  for (int i = 0; i < count; ++i)
    boxes.push_back(
        {std::pow(10, decades * (any(random) - 0.5)), (any(random) < 0.8 ? 0.9 : 4.0) * any(random)});
  return boxes;
}

// The conditions in the header; with them the answer is the only one.
void expect_solution(const Boxes& boxes, bool floor, double share) {
  const Correction got = correct(boxes, floor, kWidth, share, kGravity);
  ASSERT_EQ(got.displaced.size(), boxes.size()) << "displacements: one for each box";
  ASSERT_EQ(got.pushes.size(), boxes.size()) << "pushes: one for each gap";
  double size = 0, weight = 0, sum = 0;  // m, kg, kg m
  for (const Box& box : boxes) {
    size += std::abs(row(box, share));
    weight += box.mass;
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double above = i + 1 < boxes.size() ? got.pushes[i + 1] : 0;
    ASSERT_NEAR(boxes[i].mass * got.displaced[i], got.pushes[i] - above, 1e-12 * weight * size)
        << "kg m, box " << i << ": what pushes it from below, less what it pushes above";
    ASSERT_GE(got.pushes[i], 0) << "kg m, gap " << i << ": nothing pulls";
    sum += boxes[i].mass * got.displaced[i];
    if (i == 0 && !floor) {
      ASSERT_EQ(got.pushes[0], 0) << "kg m: in the air there is no floor that could push";
      continue;
    }
    const double slack = got.displaced[i] - (i > 0 ? got.displaced[i - 1] : 0) - row(boxes[i], share);
    ASSERT_GE(slack, -1e-12 * size) << "m, gap " << i << ": it is still too small";
    if (got.pushes[i] > 0) {
      ASSERT_NEAR(slack, 0, 1e-12 * size) << "m, gap " << i << ": it pushes, though nothing is needed";
    }
  }
  ASSERT_NEAR(got.energy, kGravity * sum, 1e-11 * weight * size) << "J: g times the sum of m d";
  ASSERT_GE(got.energy, 0) << "J: to put gaps right never takes energy away";
}

TEST(Ex05Column, OneBox) {
  expect_displaced({{2, 0.3}}, true, 1, {0.2}, 4, "up to h / 2");
  expect_displaced({{2, 0.3}}, true, 0.2, {0.04}, 0.8, "a fifth of what lacks");
  expect_displaced({{2, 0.5}}, true, 1, {0}, 0, "it is at h / 2");
  expect_displaced({{2, 0.9}}, true, 1, {0}, 0,
                   "it may come down, but nothing makes it: least is not to move");
  expect_displaced({}, true, 1, {}, 0, "nobody");
}

TEST(Ex05Column, AColumnThatTouches) {
  constexpr int kCount = 10;
  const Correction got = correct(Boxes(kCount, {2, 0}), true, kWidth, 0.2, kGravity);
  for (int i = 0; i < kCount; ++i) {
    EXPECT_NEAR(got.displaced[static_cast<std::size_t>(i)], 0.1 * (i + 1), 1e-14)
        << "m, box " << i << ": each gap grows by a fifth of 1/2, and lifts all that is above";
    EXPECT_NEAR(got.pushes[static_cast<std::size_t>(i)], 0.1 * (kCount * (kCount + 1) - i * (i + 1)), 1e-13)
        << "kg m, gap " << i << ": the sum of m d of all above";
  }
  EXPECT_NEAR(got.energy, 2 * kGravity * 0.1 * kCount * (kCount + 1) / 2, 1e-12)
      << "J: box i is lifted by i times 0.1 m; the sum grows as n^2";
}

TEST(Ex05Column, AWideGapTakesItIn) {
  expect_displaced({{1, 0}, {1, 1}, {1, 0.5}}, true, 1, {0.5, 0, 0}, 5,
                   "the second gap has just so much to give");
  expect_displaced({{1, 0}, {1, 0.75}, {1, 0.5}}, true, 1, {0.5, 0.25, 0.25}, 10,
                   "it has half of it to give");
  expect_displaced({{1, 0}, {1, 0.54}, {1, 0.5}}, true, 0.2, {0.1, 0.06, 0.06}, 2.2,
                   "a gap grows by a share of what it lacks; what it has to give, it gives all of it");
}

TEST(Ex05Column, BoxesMayComeDown) {
  expect_displaced({{1, 2}, {1, 0}}, true, 1, {-0.25, 0.25}, 0,
                   "high above the floor two equal boxes part, each by half; that costs no energy");
  expect_displaced({{1, 2}, {3, 0}}, true, 1, {-0.375, 0.125}, 0, "the light one gives way");
  const Correction got = correct(Boxes{{1, 2}, {3, 0}}, true, kWidth, 1, kGravity);
  EXPECT_EQ(got.pushes[0], 0) << "kg m: the floor has no part in it";
  EXPECT_NEAR(got.pushes[1], 0.375, 1e-14) << "kg m: upwards on one, downwards on the other";
}

TEST(Ex05Column, OnlyAsFarDownAsTheMiddle) {
  expect_displaced({{1, 0.6}, {1, 0}}, true, 1, {-0.1, 0.4}, 3,
                   "a tenth is all that the lower gap has; the floor pushes the rest");
  expect_displaced({{1, 0.5}, {1, 0}}, true, 1, {0, 0.5}, 5, "it has nothing");
}

TEST(Ex05Column, InTheAir) {
  expect_displaced({{1, 0}, {1, 0}}, false, 1, {-0.25, 0.25}, 0,
                   "there is no floor, and its gap means nothing");
  expect_displaced({{1, 0}, {4, 0.1}}, false, 1, {-0.32, 0.08}, 0, "the centre of mass stays");
  expect_displaced({{1, 7}, {1, 0}, {1, 0}}, false, 0.2, {-0.1, 0, 0.1}, 0, "all from the one in the middle");
  expect_displaced({{3, 0}}, false, 1, {0}, 0, "alone");
}

// The stack of the chapter's picture: ten boxes of 1 kg that touch, half a millimetre of envelope.
TEST(Ex05Column, FramesOpenAColumn) {
  constexpr int kCount = 10;
  constexpr double kEnvelope = 0.0005;
  Boxes boxes(kCount, {1, 0});
  double energy = 0;
  for (int frame = 1; frame <= 200; ++frame) {
    const Correction got = correct(boxes, true, kEnvelope, 0.2, 9.81);
    energy += got.energy;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      boxes[i].gap += got.displaced[i] - (i > 0 ? got.displaced[i - 1] : 0);
      ASSERT_NEAR(boxes[i].gap, 0.5 * kEnvelope * (1 - std::pow(0.8, frame)), 1e-15)
          << "m, gap " << i << " after " << frame << " frames: four fifths of what lacked are left by each";
    }
  }
  EXPECT_NEAR(energy, 9.81 * 0.5 * kEnvelope * kCount * (kCount + 1) / 2, 1e-12)
      << "J: 0.135, as the chapter says";
}

TEST(Ex05Column, AsDantzigHasIt) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const int count = 1 + trial % 25;
    const Boxes boxes = random_boxes(random, count, 2);
    // A = J D^-1 J' of a chain, b = -r.
    fc::MatX J = fc::MatX::Zero(count, count), inverse = J;
    fc::VecX b(count);
    for (int i = 0; i < count; ++i) {
      J(i, i) = 1;
      if (i > 0) J(i, i - 1) = -1;
      inverse(i, i) = 1 / boxes[static_cast<std::size_t>(i)].mass;
      b[i] = -row(boxes[static_cast<std::size_t>(i)], 0.7);
    }
    const fc::MatX A = J * inverse * J.transpose();
    const fc::lcp::LcpResult exact = fc::lcp::solve_dantzig({A, b});
    ASSERT_EQ(exact.status, fc::lcp::Status::solved) << "trial " << trial << ", of the test itself";
    const fc::VecX d = inverse * J.transpose() * exact.z;
    const Correction got = correct(boxes, true, kWidth, 0.7, kGravity);
    for (int i = 0; i < count; ++i)
      ASSERT_NEAR(got.displaced[static_cast<std::size_t>(i)], d[i], 1e-9)
          << "m, box " << i << " of " << count << ", trial " << trial
          << ": the least motion is the only answer, and Dantzig has it";
  }
}

TEST(Ex05Column, TheConditionsOfTheLeastMotion) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const Boxes boxes = random_boxes(random, 1 + trial % 60, trial % 7);
    ASSERT_NO_FATAL_FAILURE(expect_solution(boxes, trial % 3 != 0, trial % 2 == 0 ? 1 : 0.2))
        << "trial " << trial;
  }
}

// A matrix would have 10^10 entries.
TEST(Ex05Column, AHundredThousandBoxes) {
  std::mt19937_64 random(3);
  const Boxes boxes = random_boxes(random, 100'000, 1);
  expect_solution(boxes, true, 0.2);
  expect_solution(boxes, false, 1);
  expect_solution(Boxes(100'000, {1, 0}), true, 0.2);
}

// Rounding of a sum grows with the number of what is added: 0.1, a hundred thousand times, is off by 2e-8.
TEST(Ex05Column, AHundredThousandRoundingsDoNotAdd) {
  constexpr int kCount = 100'000;
  const double gaps[] = {0, 0.3, 0.47}, shares[] = {0.2, 1, 0.7};
  for (const double gap : gaps) {
    for (const double share : shares) {
      const long double each = static_cast<long double>(share) * (0.5L * kWidth - gap), size = kCount * each;
      const Correction got = correct(Boxes(kCount, {1, gap}), true, kWidth, share, kGravity);
      ASSERT_EQ(got.displaced.size(), static_cast<std::size_t>(kCount)) << "displacements: one for each box";
      for (int i = 0; i < kCount; ++i)
        ASSERT_NEAR(static_cast<double>(got.displaced[static_cast<std::size_t>(i)] - (i + 1) * each), 0,
                    static_cast<double>(1e-12L * size))
            << "m, from " << static_cast<double>((i + 1) * each) << " m: box " << i
            << " is lifted by its own row and all below it; in so long a sum a double does not keep 12 digits";
      ASSERT_NEAR(static_cast<double>(got.pushes[0] - 0.5L * kCount * (kCount + 1) * each), 0,
                  static_cast<double>(1e-12L * kCount * size))
          << "kg m: the floor pushes all of them";
    }
  }
}

}  // namespace
