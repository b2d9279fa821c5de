// Exercise 5.6. Each test is an account of one law, in a scene that can be worked out on paper. The last one keeps all accounts
// of random piles. Each of the five mistakes has a test that sees no other one.
#include "ex06_hopping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace fc::exercises;

constexpr double kWidth = 1. / 1024, kFrame = 1. / 64;  // m, s: exact numbers
constexpr double kFast = kWidth / kFrame;               // m/s: what comes in faster is an impact
constexpr double kGravity = 9.81;                       // m/s^2; what falls so in a frame falls 1.2 h

double energy(const Pile& pile) {  // J
  double sum = 0;
  for (const Box& box : pile.boxes)
    sum += box.mass * (0.5 * box.velocity * box.velocity + pile.gravity * box.bottom);
  return sum;
}

// The part of a box's change of momentum that neither its weight nor its impulses explain, N s.
double unexplained(const Pile& before, const Pile& after, const Report& report, int box, double dt) {
  double sum =
      before.boxes[box].mass * (after.boxes[box].velocity - before.boxes[box].velocity + before.gravity * dt);
  for (const Impulse& impulse : report.impulses) {
    if (impulse.box == box) sum -= impulse.amount;
    if (impulse.box == box + 1) sum += impulse.amount;
  }
  return sum;
}

// The sum of the impulses of the contact below a box, N s.
double given(const Report& report, int box) {
  double sum = 0;
  for (const Impulse& impulse : report.impulses) sum += impulse.box == box ? impulse.amount : 0;
  return sum;
}

// Two boxes far above the others. They meet after 0.8 of the frame: their gap of 1.21 h is h/4 then. At the frame's end they
// would still be apart, so that a plan which looks for overlaps there does not take them in.
void add_a_clash_above(Pile& pile) {
  pile.boxes.push_back({1, 0.1, 5, 0, 0.5});
  pile.boxes.push_back({1, 0.1, 5.1 + 1.21 * kWidth, -1.2 * kFast, 0.5});
}
void expect_the_clash(const Report& report, int upper) {
  const bool met = std::any_of(report.impulses.begin(), report.impulses.end(), [&](const Impulse& i) {
    return i.box == upper && std::abs(i.time - 0.8 * kFrame) < 1e-12;
  });
  ASSERT_TRUE(met && report.cut == 1) << "two boxes far above meet after 0.8 of the frame, and cut the plan; "
                                      << report.cut << " plans were cut";
}

TEST(Ex06Hopping, WhatRestsDoesNotHop) {
  // The upper box arrives exactly at the frame's end; or in the middle of the frame.
  for (const double gap : {2.4 * kWidth + 0.5 * kGravity * kFrame * kFrame, 2 * kWidth}) {
    const double s = 1.9 * kFast, way = gap - 0.25 * kWidth;
    Pile pile{
        {{2, 0.1, 0.5 * kWidth, 0, 0.5}, {1, 0.1, 0.5 * kWidth + 0.1 + gap, -s, 0.5}}, kGravity, kWidth};
    const double meeting = std::min(kFrame, 2 * way / (s + std::sqrt(s * s + 2 * kGravity * way)));
    const Report report = step(pile, kFrame);
    ASSERT_GT(given(report, 1), 0) << "N s: the upper box hits the lower one";
    EXPECT_NEAR(pile.boxes[0].velocity, 0, 1e-13)
        << "m/s, of a box that rests, when another one hits it after " << meeting / kFrame
        << " frames: with one restitution for both contacts the floor gives back just what the upper box gives. More than that is "
        << "the second half of the box's own weight, given back as if it had been a blow";
    EXPECT_NEAR(pile.boxes[0].bottom, 0.5 * kWidth, 1e-15) << "m: it rests at h/2";
    EXPECT_NEAR(pile.boxes[1].velocity, 0.5 * (s + kGravity * meeting) - kGravity * (kFrame - meeting), 1e-12)
        << "m/s: the upper box leaves with half of the speed with which it came in";
    for (int frame = 1; frame <= 200; ++frame) {
      step(pile, kFrame);
      ASSERT_NEAR(pile.boxes[0].velocity, 0, 1e-13) << "m/s, after frame " << frame << ": it rests";
      ASSERT_NEAR(pile.boxes[0].bottom, 0.5 * kWidth, 1e-13) << "m, after frame " << frame << ": it rests";
    }
    EXPECT_NEAR(pile.boxes[1].velocity, 0, 1e-13) << "m/s: in the end both rest";
  }
}

TEST(Ex06Hopping, AHitGoesThroughWhatRests) {
  const double s = 1.9 * kFast, v = s + kGravity * kFrame;
  Pile pile{{{1, 0.1, 0.5 * kWidth, 0, 0.5},
             {1, 0.1, 0.1 + kWidth + s * kFrame + 0.5 * kGravity * kFrame * kFrame, -s, 0}},
            kGravity,
            kWidth};
  step(pile, kFrame);
  for (const Box& box : pile.boxes)
    EXPECT_NEAR(box.velocity, 0.25 * v, 1e-12)
        << "m/s: the blow goes through the lower box to the floor, and the floor gives half of it back, 0.5 m v, to two boxes that "
        << "do not bounce off each other. A contact that lasts has restitution like any other";
}

TEST(Ex06Hopping, WhatIsFarFallsFreely) {
  const double gap = 5.12 * kWidth, s = 1, way = gap - 0.25 * kWidth;
  Pile pile{{{2, 0.1, gap, -s, 0.5}}, kGravity, kWidth};
  const Report report = step(pile, kFrame);
  const double meeting = 2 * way / (s + std::sqrt(s * s + 2 * kGravity * way));
  const double hits = s + kGravity * meeting, rest = kFrame - meeting;
  EXPECT_NEAR(pile.boxes[0].velocity, 0.5 * hits - kGravity * rest, 1e-12)
      << "m/s: it falls freely for " << meeting / kFrame
      << " frames, bounces with half of its speed, and flies up. What arrives only then acts from then on: a box that is slowed "
      << "down from the frame's start has lost the fall that it has not made yet";
  EXPECT_NEAR(pile.boxes[0].bottom, 0.25 * kWidth + 0.5 * hits * rest - 0.5 * kGravity * rest * rest, 1e-14)
      << "m: fall, bounce at h/4, rise";
  ASSERT_EQ(report.impulses.size(), 1U) << "impulses: one blow, and nothing else acts";
  EXPECT_NEAR(report.impulses[0].amount, 2 * 1.5 * hits, 1e-12) << "N s: m (1 + e) times the speed";
  EXPECT_NEAR(report.impulses[0].time, meeting, 1e-14) << "s: when the gap is h/4";
  EXPECT_LE(report.impulses[0].gap, kWidth) << "m: no impulse acts across a gap above h";

  // In the air, where both fall.
  Pile air{{{1, 0.1, 3, 0.6, 0}, {3, 0.1, 3.1 + 6.25 * kWidth, -0.4, 1}}, kGravity, kWidth};
  const Report there = step(air, kFrame);
  ASSERT_EQ(there.impulses.size(), 1U) << "impulses: one blow";
  EXPECT_NEAR(there.impulses[0].time, 6 * kWidth, 1e-12) << "s: 6 h at 1 m/s; gravity does not part them";
  EXPECT_NEAR(air.boxes[0].velocity, -0.9 - kGravity * kFrame, 1e-12) << "m/s: 0.6 - 2 (3/4) 1, and gravity";
  EXPECT_NEAR(air.boxes[1].velocity, 0.1 - kGravity * kFrame, 1e-12) << "m/s: -0.4 + 2 (1/4) 1, and gravity";
}

TEST(Ex06Hopping, AGapPutRightLeavesNoVelocity) {
  for (const int boxes : {1, 3}) {
    Pile pile{{}, 0, kWidth};
    for (int i = 0; i < boxes; ++i)
      pile.boxes.push_back({1, 0.125, i * 0.125 + (i + 1) * 0.125 * kWidth, 0, 0.5});
    for (int frame = 1; frame <= 50; ++frame) {
      step(pile, kFrame);
      const double gap = kWidth * (0.5 - 0.25 * std::pow(0.8, frame - 1));
      for (int i = 0; i < boxes; ++i) {
        ASSERT_NEAR(pile.boxes[i].velocity, 0, 1e-15)
            << "m/s, box " << i << " of " << boxes << " without gravity, after frame " << frame
            << ": a narrow gap is an error of places. A velocity that mends it is energy from nowhere, and the box keeps it";
        ASSERT_NEAR(gap_below(pile, i), gap, 1e-14)
            << "m: at once to h/4, then a fifth of what lacks to h/2 in each frame";
      }
    }
  }
}

TEST(Ex06Hopping, ATouchOpensToTheRestGap) {
  Pile pile{{{3, 0.1, 0, 0, 0.5}}, kGravity, kWidth};
  double lifted = 0;  // J
  for (int frame = 1; frame <= 60; ++frame) {
    lifted += step(pile, kFrame).lifted;
    ASSERT_NEAR(pile.boxes[0].bottom, kWidth * (0.5 - 0.25 * std::pow(0.8, frame - 1)), 1e-15)
        << "m, after frame " << frame << ": at once to h/4, then a fifth of what lacks to h/2 in each frame";
    ASSERT_NEAR(lifted, 3 * kGravity * pile.boxes[0].bottom, 1e-14)
        << "J: what corrections have lifted, m g h";
  }
}

TEST(Ex06Hopping, WhatPartsFliesItsParabola) {
  for (const double part : {0.0, 0.1, 0.3, 0.5, 0.9}) {
    Pile pile{{{2, 0.1, part * kWidth, 1, 0.5}}, kGravity, kWidth};
    const Report report = step(pile, kFrame);
    EXPECT_NEAR(pile.boxes[0].bottom, part * kWidth + kFrame - 0.5 * kGravity * kFrame * kFrame, 1e-15)
        << "m, from a gap of " << part
        << " h: a straight path with half of gravity ends where the parabola ends; and what opens by "
        << "itself needs no correction, for what counts is the gap at the plan's end";
    EXPECT_NEAR(pile.boxes[0].velocity, 1 - kGravity * kFrame, 1e-15) << "m/s: only gravity acts on it";
    EXPECT_TRUE(report.impulses.empty()) << "impulses: floors do not pull";
    EXPECT_EQ(report.lifted, 0) << "J: nothing was corrected";
  }
}

TEST(Ex06Hopping, ACutPlanHasItsShareOfGravity) {
  // Thrown so that it stays in contact, and nothing has to push.
  const double v = 0.5 * kGravity * kFrame + 0.4 * kFast;
  Pile pile{{{2, 0.1, 0.5 * kWidth, v, 0}}, kGravity, kWidth};
  add_a_clash_above(pile);
  const Pile before = pile;
  const Report report = step(pile, kFrame);
  expect_the_clash(report, 2);
  EXPECT_NEAR(unexplained(before, pile, report, 0, kFrame), 0, 1e-14)
      << "N s, of the lowest box (its weight gives " << 2 * kGravity * kFrame
      << " in the frame): m dv + m g dt is not the sum of its impulses. Its plan was cut after 0.8 of the frame; until then it "
      << "was falling for 0.8 frames, and not for half as long";
}

TEST(Ex06Hopping, ACutPlanTellsItsShareOfImpulses) {
  Pile pile{{{2, 0.1, 0.5 * kWidth, 0, 0}}, kGravity, kWidth};
  add_a_clash_above(pile);
  const Report report = step(pile, kFrame);
  expect_the_clash(report, 2);
  double first = 0;  // N s
  for (const Impulse& impulse : report.impulses)
    if (impulse.box == 0 && impulse.time == 0) first += impulse.amount;
  const double half = 0.5 * 2 * kGravity * kFrame;
  EXPECT_NEAR(first, 0.8 * half, 1e-14)
      << "N s, told of the plan that begins with the frame, for a box that rests: in a whole frame it would have given half of the "
      << "weight, " << half
      << " N s. It was cut after 0.8 of the frame and has given 0.8 of that; if more is told, m dv + m g dt is "
      << "not the sum of all impulses any more";
}

TEST(Ex06Hopping, AStackRestsOnItsWeight) {
  Pile pile{{}, kGravity, kWidth};
  for (int i = 0; i < 5; ++i)
    pile.boxes.push_back({1. + i, 0.125, i * 0.125 + (i + 1) * 0.5 * kWidth, 0, 0.9});
  for (int frame = 1; frame <= 50; ++frame) {
    const Report report = step(pile, kFrame);
    double above = 0;  // kg
    for (int i = 4; i >= 0; --i) {
      above += pile.boxes[i].mass;
      ASSERT_NEAR(given(report, i), above * kGravity * kFrame, 1e-12)
          << "N s, below box " << i << ", frame " << frame << ": the weight above it, times dt";
      ASSERT_NEAR(pile.boxes[i].velocity, 0, 1e-14) << "m/s, box " << i << ", frame " << frame
                                                    << ": a plan's end is no blow, and nothing bounces there";
      ASSERT_NEAR(gap_below(pile, i), 0.5 * kWidth, 1e-13) << "m, box " << i << ", frame " << frame;
    }
  }
}

TEST(Ex06Hopping, ABoxBouncesAndRests) {
  constexpr double e = 0.6;
  Pile pile{{{2, 0.1, 0.5, 0, e}}, kGravity, kWidth};
  const double fall = std::sqrt(2 * (0.5 - 0.25 * kWidth) / kGravity), hits = kGravity * fall;  // s, m/s
  double start = fall, speed = e * hits;
  int bounces = 0;
  for (int frame = 1; frame <= 256; ++frame) {
    const double before = energy(pile);
    const Report report = step(pile, kFrame);
    ASSERT_LE(energy(pile), before + report.lifted + 1e-12) << "J, frame " << frame;
    const double now = frame * kFrame;
    while (now >= start + 2 * speed / kGravity && bounces < 4) {
      start += 2 * speed / kGravity;
      speed *= e;
      ++bounces;
    }
    if (bounces >= 4) continue;
    const double t = now - start;
    const double truth =
        now < fall ? 0.5 - 0.5 * kGravity * now * now : 0.25 * kWidth + speed * t - 0.5 * kGravity * t * t;
    ASSERT_NEAR(pile.boxes[0].bottom, truth, 1e-12)
        << "m, after frame " << frame << " and " << bounces + (now >= fall)
        << " bounces: between two bounces it falls freely, and it leaves with " << e << " of its speed";
  }
  EXPECT_NEAR(pile.boxes[0].bottom, 0.5 * kWidth, 1e-12) << "m: after 4 s it rests, at h/2";
  EXPECT_NEAR(pile.boxes[0].velocity, 0, 1e-14) << "m/s: after 4 s it rests";
}

TEST(Ex06Hopping, DifferentRestitutionsMakeNoEnergy) {
  // The chapter's three balls, the first one from above.
  Pile pile{
      {{1, 0.1, 1, 0, 0}, {1, 0.1, 1.1 + 0.5 * kWidth, 0, 0}, {1, 0.1, 1.2 + kWidth, -3, 1}}, 0, kWidth};
  step(pile, kFrame);
  const double k = std::sqrt(0.75);
  EXPECT_NEAR(pile.boxes[2].velocity, -1 + 2 * k, 1e-12) << "m/s: the cap, and the upper one goes up again";
  for (const int i : {0, 1})
    EXPECT_NEAR(pile.boxes[i].velocity, -1 - k, 1e-12)
        << "m/s: then the middle one runs into the lower one, and both go on together";
}

TEST(Ex06Hopping, RandomPilesKeepTheLaws) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> any(0, 1);
  int cut = 0, free = 0, pushes = 0, corrected = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Pile pile{{}, trial % 4 == 0 ? 0 : 20 * any(random), std::pow(10, -4 + 2 * any(random))};
    const double h = pile.envelope, dt = 1 / (30 + 200 * any(random));
    const bool one_for_all = trial % 3 == 0;
    const double restitution = any(random);
    double top = 0;
    for (int i = 0; i < 1 + trial % 6; ++i) {
      Box box{std::pow(10, 2 * any(random) - 1), 0.05 + 0.2 * any(random), 0, 0,
              one_for_all ? restitution : any(random)};
      const double kind = any(random);
      box.bottom = top + (kind < 0.1 ? 0 : kind < 0.8 ? 2 * h * any(random) : 0.1 * any(random));
      box.velocity = (any(random) < 0.5 ? 2 * h / dt : 2) * (2 * any(random) - 1);
      top = box.bottom + box.height;
      pile.boxes.push_back(box);
    }
    for (int frame = 1; frame <= 20; ++frame) {
      const Pile before = pile;
      const Report report = step(pile, dt);
      const auto where = [&] {
        return ", trial " + std::to_string(trial) + ", frame " + std::to_string(frame);
      };
      bool is_free = report.impulses.empty() && report.cut == 0;  // and no gap has to be corrected
      double speed = std::max(pile.gravity * dt, h / dt), mass = 0;
      for (int i = 0; i < std::ssize(pile.boxes); ++i) {
        speed = std::max({speed, std::abs(pile.boxes[i].velocity), std::abs(before.boxes[i].velocity)});
        mass += pile.boxes[i].mass;
        is_free = is_free && gap_below(before, i) >= 0.5 * h;
      }
      for (int i = 0; i < std::ssize(pile.boxes); ++i) {
        const Box &box = pile.boxes[i], &was = before.boxes[i];
        ASSERT_NEAR(unexplained(before, pile, report, i, dt), 0, 1e-11 * mass * speed)
            << "N s, box " << i << where() << ": m dv + m g dt is the sum of its impulses (Newton)";
        ASSERT_GE(gap_below(pile, i), std::min(gap_below(before, i), 0.25 * h) - 1e-13)
            << "m, below box " << i << where() << ": narrower than it was, and than h/4";
        if (!is_free) continue;
        ASSERT_NEAR(box.bottom, was.bottom + dt * (was.velocity - 0.5 * pile.gravity * dt), 1e-13)
            << "m, box " << i << where() << ": nothing has pushed or lifted it; free fall";
      }
      for (const Impulse& impulse : report.impulses) {
        ASSERT_GT(impulse.amount, 0) << "N s" << where() << ": contacts push, and never pull";
        ASSERT_LE(impulse.gap, h * (1 + 1e-9)) << "m" << where() << ": no impulse acts across a gap above h";
        ASSERT_TRUE(impulse.time >= 0 && impulse.time <= dt) << "s" << where() << ": a time of the frame";
      }
      ASSERT_LE(energy(pile),
                energy(before) + report.lifted + 1e-11 * (mass * speed * speed + energy(before)))
          << "J" << where() << ": more than corrections lifted";
      cut += report.cut;
      free += is_free;
      pushes += static_cast<int>(report.impulses.size());
      corrected += report.lifted > 0;
    }
  }
  EXPECT_GT(cut, 500) << "plans that were cut, of the test itself";
  EXPECT_GT(free, 100) << "frames in which all fell freely, of the test itself";
  EXPECT_GT(pushes, 5000) << "impulses, of the test itself";
  EXPECT_GT(corrected, 500) << "frames with corrections, of the test itself";
}

}  // namespace
