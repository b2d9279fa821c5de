// Exercise 6.5. Each test is one law, in a scene that can be worked out on paper. The last one keeps all laws in random scenes.
// Each of the six mistakes has a test that sees no other one.
#include "ex05_creeping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

namespace {

using namespace fc::exercises;
using fc::Mat3;
using fc::Vec3;

constexpr double kFrame = 1. / 64, kMargin = 1. / 1024, kGravity = 9.81;  // s, m, m/s^2

double energy(const Scene& scene) {  // J
  const Body& body = scene.body;
  return 0.5 * body.mass * body.velocity.squaredNorm() + 0.5 * body.inertia * body.spin.squaredNorm() -
         body.mass * scene.gravity.dot(body.centre);
}

// A cube of 1 kg, 0.2 m wide, on four feet with gaps of h/2.
Scene cube(double friction) {
  Scene scene;
  scene.margin = kMargin;
  scene.floor.friction = friction;
  scene.body.inertia = 0.04 / 6;
  for (const double x : {-0.1, 0.1})
    for (const double y : {-0.1, 0.1}) scene.body.feet.push_back({{x, y, -0.1}});
  scene.body.centre = {0, 0, 0.1 + 0.5 * kMargin};
  return scene;
}

// A body on one foot below its centre.
Scene pencil(double friction) {
  Scene scene;
  scene.margin = kMargin;
  scene.floor.friction = friction;
  scene.body.mass = 2;
  scene.body.inertia = 0.3;
  scene.body.feet.push_back({{0, 0, -0.5}});
  scene.body.centre = {0, 0, 0.5 + 0.5 * kMargin};
  return scene;
}

// Everything turned about the y axis: tan of the angle is sine/cosine. Gravity stays, if it is asked to.
void turn_all(Scene& scene, const Mat3& by, bool gravity) {
  Body& body = scene.body;
  body.centre = by * body.centre;
  body.turn = by * body.turn;
  body.velocity = by * body.velocity;
  body.spin = by * body.spin;
  scene.floor.normal = by * scene.floor.normal;
  if (gravity) scene.gravity = by * scene.gravity;
}
Mat3 tilt(double sine, double cosine) {
  Mat3 turn;
  turn << cosine, 0, sine, 0, 1, 0, -sine, 0, cosine;
  return turn;
}

Vec3 sum_of(const Report& report) {  // N s
  Vec3 sum = Vec3::Zero();
  for (const Push& push : report.pushes) sum += push.impulse;
  return sum;
}

std::string text(const Vec3& v) {
  return "(" + std::to_string(v[0]) + ", " + std::to_string(v[1]) + ", " + std::to_string(v[2]) + ")";
}

TEST(Ex06Creeping, FrictionIsStraightAgainstTheSlip) {
  for (int direction = 0; direction < 16; ++direction) {
    const double angle = direction * std::numbers::pi / 8;
    Scene scene = pencil(0.1);
    scene.body.inertia = 0.05;
    scene.body.feet[0].place = {0.3, 0.1, -0.5};  // not below the centre: its tangents are not equally stiff
    scene.body.velocity = 3 * Vec3(std::cos(angle), std::sin(angle), 0);
    const Vec3 arm = scene.body.feet[0].place;
    const Report report = step(scene, kFrame);
    ASSERT_EQ(report.pushes.size(), 1U) << "pushes: one foot, one plan";
    const Vec3 push = report.pushes[0].impulse, slip = scene.body.velocity + scene.body.spin.cross(arm);
    ASSERT_GT(push[2], 0) << "N s: the floor carries it";
    const double cross = push[0] * slip[1] - push[1] * slip[0], dot = push.head<2>().dot(slip.head<2>());
    EXPECT_NEAR(std::atan2(cross, -dot) * 180 / std::numbers::pi, 0, 1e-6)
        << "degrees, thrown at " << angle * 180 / std::numbers::pi << " degrees: friction " << text(push)
        << " N s (without the third number) and the slip " << text(slip)
        << " m/s after it are not straight against each other. At this foot one tangent is stiffer than the other";
  }
}

TEST(Ex06Creeping, ASlopePressesLess) {
  // tan = 3/4, friction 1/2: it slides, with g (0.6 - 0.5 * 0.8).
  Scene scene = cube(0.5);
  scene.body.velocity = {1, 0, 0};
  turn_all(scene, tilt(0.6, 0.8), false);
  const Vec3 down(0.8, 0, -0.6);
  for (int frame = 1; frame <= 20; ++frame) {
    const Report report = step(scene, kFrame);
    ASSERT_NEAR(scene.body.velocity.dot(down), 1 + frame * kFrame * kGravity * 0.2, 1e-9)
        << "m/s, down the slope, after frame " << frame
        << ": a = g (sin - mu cos). The floor pushes with m g cos, and that is what limits friction; not the body's weight";
    ASSERT_NEAR(sum_of(report).dot(down), -0.5 * kGravity * 0.8 * kFrame, 1e-9)
        << "N s: friction, mu m g cos dt";
  }
}

TEST(Ex06Creeping, TheAxesTurnWithTheFloor) {
  for (const double degrees : {5.0, 40.0, 110.0}) {
    Scene scene = pencil(0.25);
    step(scene, kFrame);  // it stands
    const Mat3 by =
        Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3(1, 2, 0.5).normalized()).toRotationMatrix();
    scene.body.velocity = {3, 4, 0};
    turn_all(scene, by, true);
    const Report report = step(scene, kFrame);
    ASSERT_EQ(report.pushes.size(), 1U) << "pushes: one foot, one plan";
    const Vec3 push = by.transpose() * report.pushes[0].impulse,
               truth = 2 * kGravity * kFrame * Vec3(-0.15, -0.2, 1);
    EXPECT_LE((push - truth).norm(), 1e-9)
        << "N s: after one frame all is turned by " << degrees
        << " degrees, gravity, too. Turned back, the floor's push is " << text(push) << ", and should be "
        << text(truth)
        << ": m g dt along the normal, a quarter of it against the slip. What was a tangent is none any more";
  }
}

TEST(Ex06Creeping, AGapPutRightDoesNotWalk) {
  Scene scene = cube(0.8);
  // Feet with gaps of h/10 and h/2: the cube leans a little.
  const double angle = 0.4 * kMargin / 0.2;
  scene.body.turn = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
  double lowest = 1;
  for (int i = 0; i < 4; ++i) lowest = std::min(lowest, gap_of(scene, i));
  scene.body.centre[2] += 0.1 * kMargin - lowest;
  const Scene start = scene;
  for (int frame = 1; frame <= 40; ++frame) step(scene, kFrame);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(gap_of(scene, i), 0.5 * kMargin, 1e-3 * kMargin)
        << "m, foot " << i << ": all gaps have come to h/2";
    const Vec3 moved = place_of(scene.body, i) - place_of(start.body, i);
    EXPECT_LE(moved.head<2>().norm(), 0.01 * 0.1 * angle)
        << "m, along the floor, foot " << i << ": the cube turns by " << angle
        << " while its gaps come to h/2. It stands; feet that move by " << 0.1 * angle
        << " m, as if the floor were ice, do so each time: it walks";
  }
}

TEST(Ex06Creeping, AnImpactMakesNoEnergy) {
  // A rod of 1 kg and 2 m, of which the lower end hits the floor at 45 degrees.
  const double half = std::sqrt(0.5), along = 5. / 8;
  for (const double e : {1.0, 0.9}) {
    Scene scene;
    scene.gravity.setZero();
    scene.margin = kMargin;
    scene.floor.friction = 0.5;
    scene.floor.restitution = e;
    scene.body.inertia = 1. / 3;
    scene.body.feet.push_back({{-half, 0, -half}});
    scene.body.centre = {0, 0, half + 0.5 * kMargin};
    scene.body.velocity = {along, 0, -1};
    const double before = energy(scene);
    const Report report = step(scene, kFrame);
    EXPECT_LE(energy(scene), before)
        << "J: the end comes in with 1 m/s, 0.625 m/s along the floor, and leaves with "
        << scene.body.velocity[2]
        << " m/s of the centre. With each foot's speed given back by e, and friction for that, energy comes from nowhere";
    if (e < 1) continue;
    // The first stage stops the end, with (25, -1)/64 N s. The second gives 25/64 N s, and friction of half of that.
    const Vec3 arm(-half, 0, -half), u = scene.body.velocity + scene.body.spin.cross(arm);
    EXPECT_NEAR(u[2], 175. / 256, 1e-9) << "m/s: the end leaves with";
    EXPECT_NEAR(u[0], -25. / 256, 1e-9) << "m/s: and along the floor";
    EXPECT_TRUE(!report.pushes.empty() && report.pushes[0].impact) << "it is told as an impact";
  }
}

TEST(Ex06Creeping, WhatSticksStandsStill) {
  // tan = 3/4, friction 0.9: it stands.
  Scene scene = cube(0.9);
  turn_all(scene, tilt(0.6, 0.8), false);
  const Scene start = scene;
  for (int frame = 1; frame <= 200; ++frame) {
    const Report report = step(scene, kFrame);
    ASSERT_LE(scene.body.velocity.norm(), 1e-10)
        << "m/s, frame " << frame << ", on a slope that is not too steep: not slowly either. "
        << kGravity * 0.6 * kFrame << " m/s are what gravity gives along the slope in a frame";
    ASSERT_LE((sum_of(report) + kFrame * scene.gravity).norm(), 1e-10)
        << "N s: the floor carries the weight, all of it";
  }
  for (int i = 0; i < 4; ++i)
    EXPECT_LE((place_of(scene.body, i) - place_of(start.body, i)).norm(), 1e-9)
        << "m, foot " << i << ": after 200 frames";
}

TEST(Ex06Creeping, WhatIsFarFallsFreely) {
  Scene scene = cube(0.5);
  scene.body.centre = {0, 0, 5};
  scene.body.velocity = {1, 2, 3};
  scene.body.spin = {0, 0, 2};
  for (int frame = 1; frame <= 30; ++frame) {
    const Report report = step(scene, kFrame);
    ASSERT_TRUE(report.pushes.empty()) << "the floor is 5 m away";
    ASSERT_LE((scene.body.velocity - Vec3(1, 2, 3 - frame * kFrame * kGravity)).norm(), 1e-12)
        << "m/s, frame " << frame;
    ASSERT_LE((scene.body.spin - Vec3(0, 0, 2)).norm(), 1e-14) << "rad/s, frame " << frame;
  }
  EXPECT_LE((scene.body.turn - Eigen::AngleAxisd(60 * kFrame, Vec3::UnitZ()).toRotationMatrix()).norm(),
            1e-12)
      << "2 rad/s";
}

TEST(Ex06Creeping, ACubeRestsOnItsWeight) {
  Scene scene = cube(0.5);
  for (int frame = 1; frame <= 50; ++frame) {
    const Report report = step(scene, kFrame);
    ASSERT_LE((sum_of(report) - Vec3(0, 0, kGravity * kFrame)).norm(), 1e-11)
        << "N s, frame " << frame << ": m g dt";
    ASSERT_LE(scene.body.velocity.norm() + scene.body.spin.norm(), 1e-10)
        << "m/s, rad/s, frame " << frame << ": it rests";
    for (int i = 0; i < 4; ++i)
      ASSERT_NEAR(gap_of(scene, i), 0.5 * kMargin, 1e-11) << "m, foot " << i << ", frame " << frame;
  }
}

TEST(Ex06Creeping, ASlideStops) {
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, -1, 0)}) {
    Scene scene = cube(0.4);
    scene.body.velocity = 1.5 * direction;
    const Vec3 start = scene.body.centre;
    for (int frame = 1; frame <= 40; ++frame) {
      step(scene, kFrame);
      ASSERT_NEAR(scene.body.velocity.dot(direction), std::max(0.0, 1.5 - 0.4 * kGravity * frame * kFrame),
                  1e-9)
          << "m/s, frame " << frame << ": it loses mu g dt in each frame, until it stands";
    }
    const double way = 1.5 * 1.5 / (2 * 0.4 * kGravity);
    EXPECT_NEAR((scene.body.centre - start).dot(direction), way, 0.8 * kFrame)
        << "m: v^2/(2 mu g), but for a frame's part";
    EXPECT_LE(scene.body.spin.norm(), 1e-9) << "rad/s: it does not turn";
  }
}

TEST(Ex06Creeping, ABallBounces) {
  for (const double e : {0.0, 0.5, 1.0}) {
    Scene scene = pencil(0.3);
    scene.gravity.setZero();
    scene.floor.restitution = e;
    scene.body.velocity = {8, -6, -2};
    const Report report = step(scene, kFrame);
    EXPECT_NEAR(scene.body.velocity[2], 2 * e, 1e-9) << "m/s: it leaves with e times the speed it came with";
    const double friction = 0.3 * (1 + e) * 2;
    EXPECT_LE((scene.body.velocity - Vec3(8 - 0.8 * friction, -6 + 0.6 * friction, 2 * e)).norm(), 1e-9)
        << "m/s: while it slides, friction is mu times the normal impulse of both stages";
    ASSERT_FALSE(report.pushes.empty());
    EXPECT_TRUE(report.pushes[0].impact);
  }
}

TEST(Ex06Creeping, LiftingIsTold) {
  Scene scene = cube(0.5);
  scene.body.mass = 3;
  scene.body.centre[2] -= 0.4 * kMargin;
  double lifted = 0;  // J
  for (int frame = 1; frame <= 40; ++frame) {
    lifted += step(scene, kFrame).lifted;
    const double lacks = 0.4 * kMargin * std::pow(0.8, frame);
    ASSERT_NEAR(gap_of(scene, 0), 0.5 * kMargin - lacks, 1e-9 * kMargin + 1e-14)
        << "m, frame " << frame << ": a fifth of what lacks";
    ASSERT_NEAR(lifted, 3 * kGravity * (0.4 * kMargin - lacks), 1e-11)
        << "J, frame " << frame << ": m g times the lift";
    ASSERT_LE(scene.body.velocity.norm(), 1e-10)
        << "m/s, frame " << frame << ": corrections leave no velocity";
  }
}

TEST(Ex06Creeping, RandomScenesKeepTheLaws) {
  std::mt19937_64 random(65);
  std::uniform_real_distribution<double> any(0, 1);
  const auto vector = [&](double size) {
    return Vec3(size * Vec3(any(random) - 0.5, any(random) - 0.5, any(random) - 0.5));
  };
  int slips = 0, sticks = 0, impacts = 0;
  for (int trial = 0; trial < 30; ++trial) {
    Scene scene;
    scene.margin = kMargin;
    scene.floor.friction = any(random);
    scene.floor.restitution = trial % 2 == 0 ? 0 : any(random);
    scene.gravity = trial % 10 == 9 ? Vec3::Zero() : Vec3(0, 0, -kGravity);
    Body& body = scene.body;
    body.mass = std::pow(10, any(random));
    const double x = 0.1 + 0.1 * any(random), z = 0.1 + 0.1 * any(random);
    body.inertia = body.mass * (0.5 + any(random)) * x * x;
    for (int i = 0; i < 8; ++i) body.feet.push_back({{i & 1 ? x : -x, i & 2 ? x : -x, i & 4 ? z : -z}});
    body.turn =
        Eigen::AngleAxisd(any(random) < 0.5 ? 0 : 3 * any(random), vector(1).normalized()).toRotationMatrix();
    body.velocity = vector(4);
    body.spin = vector(trial % 3 == 0 ? 20 : 2);
    double lowest = 10;
    for (int i = 0; i < 8; ++i) lowest = std::min(lowest, gap_of(scene, i));
    body.centre[2] += kMargin * any(random) - lowest;
    const Mat3 tilting =
        Eigen::AngleAxisd(any(random) < 0.5 ? 0 : 0.01 * any(random), Vec3::UnitY()).toRotationMatrix();
    for (int frame = 1; frame <= 40; ++frame) {
      turn_all(scene, tilting, false);
      const Scene before = scene;
      const Report report = step(scene, kFrame);
      const auto where = [&] {
        return ", trial " + std::to_string(trial) + ", frame " + std::to_string(frame);
      };
      const double speed = before.body.velocity.norm() + 0.3 * before.body.spin.norm() + kGravity * kFrame;
      // N s: sums must agree to the last digits; the results of sweeps, to four digits.
      const double small = 1e-9 * body.mass * speed, found = 1e-4 * body.mass * speed;
      Vec3 momentum = body.mass * (body.velocity - before.body.velocity - kFrame * scene.gravity);
      Vec3 angular = body.inertia * (body.spin - before.body.spin);
      const double mu = scene.floor.friction;
      for (const Push& push : report.pushes) {
        const Vec3 arm = place_of(before.body, push.foot) - before.body.centre, n = scene.floor.normal;
        momentum -= push.impulse;
        angular -= arm.cross(push.impulse);
        const double normal = n.dot(push.impulse);
        const Vec3 friction = push.impulse - normal * n;
        ASSERT_GE(normal, -small) << "N s" << where() << ": the floor does not pull";
        ASSERT_LE(friction.norm(), mu * normal + found)
            << "N s" << where() << ": at most mu times the normal impulse";
        impacts += push.impact;
        if (push.impact) continue;
        const Vec3 u = body.velocity + body.spin.cross(arm), slip = u - n.dot(u) * n;
        ASSERT_LE((friction.norm() * slip + friction * slip.norm()).norm(), found * speed)
            << "N s m/s" << where() << ": friction is straight against the slip";
        ASSERT_LE((mu * normal - friction.norm()) * slip.norm(), found * speed)
            << "N s m/s" << where() << ": what slips is at the limit of friction";
        (slip.norm() > 1e-6 ? slips : sticks) += 1;
      }
      ASSERT_LE(momentum.norm(), small) << "N s" << where() << ": m dv is gravity's and the pushes'";
      ASSERT_LE(angular.norm(), small) << "N m s" << where() << ": I dw is the pushes'";
      ASSERT_LE(energy(scene), energy(before) + report.lifted + found * speed)
          << "J" << where() << ": more than corrections lifted";
    }
  }
  EXPECT_GT(slips, 200) << "of the test itself";
  EXPECT_GT(sticks, 200) << "of the test itself";
  EXPECT_GT(impacts, 100) << "of the test itself";
}

}  // namespace
