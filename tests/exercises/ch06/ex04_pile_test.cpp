// Exercise 6.4: one contact and one sweep on paper; then what balls do.
#include "ex04_pile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace fc::exercises;
using fc::Vec3;

constexpr double kStep = 1. / 128, kGravity = 9.81;  // s, m/s^2
const Vec3 kUp(0, 0, 1);

void expect_near(const Vec3& got, const Vec3& expected, double tolerance, const char* meaning) {
  EXPECT_LE((got - expected).norm(), tolerance)
      << "(" << got.transpose() << "), expected (" << expected.transpose() << "): " << meaning;
}

// A ball of 2 kg and 0.1 m on a slope with this sine and cosine, down along x. Its plane is level, and gravity leans.
Pile on_slope(double sine, double cosine, double mu) {
  Pile pile;
  pile.balls = {{2, 0.1, {0, 0, 0.1}, Vec3::Zero(), Vec3::Zero()}};
  pile.planes = {{}};
  pile.gravity = kGravity * Vec3(sine, 0, -cosine);
  pile.mu = mu;
  return pile;
}

// Balls of 1 kg and 0.1 m in a triangle, `rows` of them on the floor.
Pile triangle(int rows, double mu) {
  Pile pile;
  pile.planes = {{}};
  pile.mu = mu;
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < rows - row; ++k)
      pile.balls.push_back(
          {1, 0.1, {0.2 * k + 0.1 * row, 0, 0.1 + row * 0.1 * std::sqrt(3.0)}, Vec3::Zero(), Vec3::Zero()});
  return pile;
}

// Three balls on the floor, and one above.
Pile tetrahedron(double mu) {
  Pile pile;
  pile.planes = {{}};
  pile.mu = mu;
  const double h = std::sqrt(3.0);
  for (const Vec3& centre : {Vec3(0, 0, 0.1), Vec3(0.2, 0, 0.1), Vec3(0.1, 0.1 * h, 0.1),
                             Vec3(0.1, 0.1 / h, 0.1 + 0.2 * std::sqrt(2. / 3))})
    pile.balls.push_back({1, 0.1, centre, Vec3::Zero(), Vec3::Zero()});
  return pile;
}

// m: how far any ball has moved in this many steps.
double drift(Pile pile, int steps) {
  const std::vector<Ball> start = pile.balls;
  for (int k = 0; k < steps; ++k) step(pile, kStep);
  double most = 0;
  for (std::size_t i = 0; i < start.size(); ++i)
    most = std::max(most, (pile.balls[i].centre - start[i].centre).norm());
  return most;
}

TEST(Ex06Pile, OneContact) {
  expect_near(solve_contact(0.5, 1.75, {3, 0, 1}, kUp, 0, 0.5), Vec3::Zero(), 0, "N s: it parts");
  expect_near(solve_contact(0.5, 1.75, {3, 0, -1}, kUp, 1.5, 0.5), Vec3::Zero(), 0,
              "N s: it may close in with 1.5 m/s");
  expect_near(solve_contact(0.5, 1.75, {0.3, -0.4, -2}, kUp, 1, 0.5), {-0.3 / 1.75, 0.4 / 1.75, 2}, 1e-15,
              "N s: 1 of 2 m/s is stopped, and the slip with it");
  expect_near(solve_contact(0.5, 1.75, {3, -4, -2}, kUp, 0, 0.5), {-1.2, 1.6, 4}, 1e-14,
              "N s: it slips, with 0.5 of 4 N s against it");
  expect_near(solve_contact(0.5, 1.75, {3, -4, -2}, kUp, 0, 0), {0, 0, 4}, 1e-14, "N s: no friction");
  const Vec3 n = Vec3(1, 2, 2) / 3, t = Vec3(2, 1, -2) / 3;
  expect_near(solve_contact(2, 7, -4 * n + 100 * t, n, 0, 0.25), 2 * n - 0.5 * t, 1e-13,
              "N s: along any normal");
}

TEST(Ex06Pile, ASweepTakesBackWhatWasTooMuch) {
  // The guess was 3 N s upwards and 1 N s to the side: the ball flies. Nothing should have pushed.
  std::vector<Ball> balls = {
      {2, 0.1, {0, 0, 0.1}, Vec3(0.5, 0, 1.5), Vec3(0, 0.1 * 1 / (0.4 * 2 * 0.01) * -1, 0)}};
  std::vector<Contact> contacts = {{-1, 0, kUp, 0, 0.5, {1, 0, 3}}};
  const double change = sweep(balls, contacts);
  expect_near(contacts[0].impulse, Vec3::Zero(), 1e-14,
              "N s: without the guess it would be at rest; the sum is 0 again");
  expect_near(balls[0].velocity, Vec3::Zero(), 1e-14, "m/s: and all of it has been taken back");
  expect_near(balls[0].spin, Vec3::Zero(), 1e-13, "rad/s: the turn, too");
  EXPECT_NEAR(change, 3.5 * 0.5, 1e-13) << "m/s: the largest change, a |3| = 1.5 and d |1| = 1.75";
}

TEST(Ex06Pile, TwoBallsMeet) {
  std::vector<Ball> balls = {{1, 0.1, {0, 0, 0}, {2, 0, 0}, {0, 0, 5}},
                             {3, 0.2, {0.3, 0, 0}, {-1, 1, 0}, {1, 0, -2}}};
  const auto momentum = [&] { return Vec3(balls[0].velocity + 3 * balls[1].velocity); };
  const auto angular = [&] {
    Vec3 sum = Vec3::Zero();
    for (const Ball& ball : balls)
      sum += ball.mass * ball.centre.cross(ball.velocity) +
             0.4 * ball.mass * ball.radius * ball.radius * ball.spin;
    return sum;
  };
  const Vec3 before = momentum(), turning = angular();
  std::vector<Contact> contacts = {{0, 1, {1, 0, 0}, 0, 0.05, Vec3::Zero()}};
  sweep(balls, contacts);
  expect_near(momentum(), before, 1e-14, "N s: what one gets the other one gives");
  expect_near(angular(), turning, 1e-14, "N m s: and at the same point");
  EXPECT_NEAR(balls[1].velocity[0] - balls[0].velocity[0], 0, 1e-14) << "m/s: nothing closes in any more";
  EXPECT_NEAR(contacts[0].impulse[0], 3 * 3. / 4, 1e-13) << "N s: 3 m/s, and an effective mass of 3/4 kg";
  EXPECT_NEAR(contacts[0].impulse.tail<2>().norm(), 0.05 * 9. / 4, 1e-13) << "N s: friction of mu times that";
  EXPECT_EQ(sweep(balls, contacts) < 1e-13, true) << "one contact is solved by one sweep";
}

TEST(Ex06Pile, ABallRollsDown) {
  // tan = 3/4; it rolls if mu >= 2/7 tan = 0.214.
  Pile pile = on_slope(0.6, 0.8, 0.22);
  for (int k = 1; k <= 100; ++k) {
    step(pile, kStep);
    const double v = 5. / 7 * kGravity * 0.6 * k * kStep;
    ASSERT_NEAR(pile.balls[0].velocity[0], v, 1e-11) << "m/s, step " << k << ": 5/7 g sin t";
    ASSERT_NEAR(pile.balls[0].spin[1], v / 0.1, 1e-9) << "rad/s, step " << k << ": it rolls without slip";
  }
}

TEST(Ex06Pile, ABallSlidesDown) {
  Pile pile = on_slope(0.6, 0.8, 0.1);
  for (int k = 1; k <= 100; ++k) {
    step(pile, kStep);
    ASSERT_NEAR(pile.balls[0].velocity[0], kGravity * (0.6 - 0.1 * 0.8) * k * kStep, 1e-11)
        << "m/s, step " << k << ": g (sin - mu cos) t: too little friction to roll";
    ASSERT_NEAR(pile.balls[0].spin[1], 2.5 * 0.1 * kGravity * 0.8 / 0.1 * k * kStep, 1e-10)
        << "rad/s, step " << k;
  }
}

TEST(Ex06Pile, AMasseShot) {
  Pile pile = on_slope(0, 1, 0.3);
  Ball& ball = pile.balls[0];
  ball.velocity = {1, 0.5, 0};
  ball.spin = {20, 10, 7};
  const Vec3 v = ball.velocity, u = v + ball.spin.cross(Vec3(0, 0, -0.1));
  const double end = 2 * u.norm() / (7 * 0.3 * kGravity);
  for (int k = 1; k <= 100; ++k) {
    step(pile, kStep);
    const double t = k * kStep;
    if (t < end)
      expect_near(ball.velocity, v - 0.3 * kGravity * t * u.normalized(), 1e-11,
                  "m/s: the slip keeps its direction");
  }
  expect_near(ball.velocity, v - 2. / 7 * u, 1e-11, "m/s: and in the end it rolls, with v - 2/7 u");
  EXPECT_NEAR(ball.spin[2], 7, 1e-12) << "rad/s: a point does not brake a spin about the normal";
}

TEST(Ex06Pile, ThreeBallsStandOrFall) {
  // Two balls that carry a third one want to roll apart. They stand if mu >= tan 15 degrees = 0.268.
  EXPECT_LE(drift(triangle(2, 0.272), 200), 1e-9) << "m, with mu = 0.272";
  EXPECT_GT(drift(triangle(2, 0.264), 200), 0.05) << "m, with mu = 0.264: they roll apart";
}

TEST(Ex06Pile, ATetrahedronStandsOrFalls) {
  // sin = 1 / sqrt 3, and mu >= tan of half the angle: 0.318.
  EXPECT_LE(drift(tetrahedron(0.322), 200), 1e-9) << "m, with mu = 0.322";
  EXPECT_GT(drift(tetrahedron(0.314), 200), 0.05) << "m, with mu = 0.314: it comes apart";
}

TEST(Ex06Pile, AWallOfBallsStands) {
  EXPECT_LE(drift(triangle(5, 0.8), 256), 1e-6) << "m: fifteen balls with mu = 0.8, after two seconds";
}

TEST(Ex06Pile, EnergyNeverGrows) {
  std::mt19937_64 random(64);
  std::uniform_real_distribution<double> any(0, 1);
  int full = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Pile pile;
    pile.mu = any(random);
    pile.planes = {{}, {{1, 0, 0}, 0}, {{-1, 0, 0}, -1}, {{0, 1, 0}, 0}, {{0, -1, 0}, -1}};
    for (int i = 0; i < 8; ++i) {
      const Vec3 cell(0.3 + 0.4 * (i & 1), 0.3 + 0.4 * (i >> 1 & 1), 0.2 + 0.4 * (i >> 2 & 1));
      pile.balls.push_back({0.5 + any(random), 0.1 + 0.09 * any(random), cell,
                            Vec3(any(random), any(random), -any(random)),
                            5 * Vec3(any(random), any(random), any(random))});
    }
    pile.margin = 0.02;  // m: more than any ball goes in a step
    for (int k = 0; k < 400; ++k) {
      const double before = energy(pile);
      step(pile, 1. / 500);
      full += pile.sweeps > 1;
      ASSERT_LE(energy(pile), before + 1e-10 * (1 + std::abs(before)))
          << "J, trial " << trial << ", step " << k << ": energy from nowhere";
      for (const Ball& ball : pile.balls)
        ASSERT_GE(ball.centre[2], ball.radius - 1e-6) << "m, trial " << trial << ": through the floor";
    }
  }
  EXPECT_GT(full, 500) << "steps with contacts, of the test itself";
}

}  // namespace
