// Exercise 1.3. The tests know an ellipsoid by its points, and eigenvalues from Eigen.
#include "ex03_ellipsoid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

namespace {

using fc::Mat3;
using fc::Vec3;
using fc::exercises::ellipsoid_reach;
using fc::exercises::ellipsoid_speed_bound;
using fc::exercises::ellipsoid_support;

struct Any {
  std::mt19937_64 random{3};
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> u{0, 1};

  Vec3 unit() { return Vec3(gauss(random), gauss(random), gauss(random)).normalized(); }
  double magnitude(double low, double high) { return low * std::pow(high / low, u(random)); }
  Vec3 half_axes() { return {magnitude(1e-3, 10), magnitude(1e-3, 10), magnitude(1e-3, 10)}; }
  Vec3 inside(const Vec3& half_axes) { return half_axes.cwiseProduct(unit()); }
};

TEST(Ex03Ellipsoid, SupportIsOnTheSurface) {
  Any any;
  for (int i = 0; i < 200; ++i) {
    const Vec3 d = any.half_axes();
    EXPECT_NEAR(ellipsoid_support(d, any.unit()).cwiseQuotient(d).norm(), 1, 1e-12)
        << "a support point of the ellipsoid is on its surface: (x/a)^2 + (y/b)^2 + (z/c)^2 = 1";
  }
}

TEST(Ex03Ellipsoid, NoPointLiesFarther) {
  Any any;
  for (int i = 0; i < 100; ++i) {
    const Vec3 d = any.half_axes(), direction = any.unit();
    const double farthest = direction.dot(ellipsoid_support(d, direction));
    for (int k = 0; k < 300; ++k) {
      const Vec3 x = any.inside(d);
      ASSERT_LE(direction.dot(x), farthest * (1 + 1e-12))
          << "the point " << x.transpose() << " of the ellipsoid lies farther along the direction";
    }
  }
}

TEST(Ex03Ellipsoid, SupportIsThatOfADirectionOfAnyLength) {
  const Vec3 d(1, 2, 3), direction(0.3, -0.5, 0.2), point = ellipsoid_support(d, direction);
  for (const double length : {1e-12, 1e-3, 7.0, 1e9})
    EXPECT_NEAR((ellipsoid_support(d, length * direction) - point).norm(), 0, 1e-12)
        << "a direction " << length << " times as long is the same direction";
  EXPECT_NEAR((ellipsoid_support(d, Vec3(0, -5, 0)) - Vec3(0, -2, 0)).norm(), 0, 1e-15);
}

TEST(Ex03Ellipsoid, ReachAlongTheAxesIsTheLargerOfTheOtherTwo) {
  const Vec3 d(1, 2, 3);
  EXPECT_NEAR(ellipsoid_reach(d, Vec3::UnitX()), 3, 1e-12) << "m, from the x axis";
  EXPECT_NEAR(ellipsoid_reach(d, Vec3::UnitY()), 3, 1e-12) << "m, from the y axis";
  EXPECT_NEAR(ellipsoid_reach(d, Vec3::UnitZ()), 2, 1e-12)
      << "m, from the z axis: its longest half axis adds nothing";
}

TEST(Ex03Ellipsoid, NoPointIsFartherFromTheAxis) {
  Any any;
  for (int i = 0; i < 100; ++i) {
    const Vec3 d = any.half_axes(), axis = any.unit();
    const double reach = ellipsoid_reach(d, axis);
    for (int k = 0; k < 300; ++k) {
      const Vec3 x = any.inside(d);
      ASSERT_LE(x.cross(axis).norm(), reach * (1 + 1e-12))
          << "the point " << x.transpose() << " is farther from the axis: the bound would not be one";
    }
  }
}

TEST(Ex03Ellipsoid, SomePointIsAsFarFromTheAxis) {
  Any any;
  for (int i = 0; i < 300; ++i) {
    const Vec3 d = any.half_axes(), axis = any.unit();
    const Mat3 across = d.asDiagonal() * (Mat3::Identity() - axis * axis.transpose()) * d.asDiagonal();
    const double truth = std::sqrt(Eigen::SelfAdjointEigenSolver<Mat3>(across).eigenvalues()[2]);
    EXPECT_NEAR(ellipsoid_reach(d, axis), truth, 1e-9 * truth)
        << "m: larger is safe, but costs advances; smaller is wrong";
  }
}

TEST(Ex03Ellipsoid, TheSpeedIsNeverExceeded) {
  Any any;
  for (int i = 0; i < 100; ++i) {
    const Vec3 d = any.half_axes(), n = any.unit(), spin = any.magnitude(0.1, 30) * any.unit();
    const double bound = ellipsoid_speed_bound(d, n, spin);
    for (int k = 0; k < 300; ++k) {
      // A point of the body after some turn: the body's axes turn, n does not.
      const Vec3 x = Eigen::AngleAxisd(6.3 * any.u(any.random), spin.normalized()) * any.inside(d);
      ASSERT_LE(n.dot(spin.cross(x)), bound * (1 + 1e-12)) << "m/s, at some time of the turn";
    }
  }
}

TEST(Ex03Ellipsoid, TheSpeedIsReached) {
  // Spin about z, normal along x: the point at (0, -2, 0) moves with 2 m times 5 rad/s.
  EXPECT_NEAR(ellipsoid_speed_bound({1, 2, 9}, Vec3::UnitX(), Vec3(0, 0, 5)), 10, 1e-12) << "m/s";
  EXPECT_NEAR(ellipsoid_speed_bound({1, 2, 9}, Vec3(3, 0, 4) / 5, Vec3(0, 0, 5)), 6, 1e-12)
      << "m/s: only the part of n across the spin counts, 3/5";
}

TEST(Ex03Ellipsoid, NothingMovesAlongTheSpinOrWithoutOne) {
  EXPECT_NEAR(ellipsoid_speed_bound({1, 2, 3}, Vec3::UnitZ(), Vec3(0, 0, 7)), 0, 1e-12)
      << "m/s: a body that spins about n brings nothing nearer";
  EXPECT_EQ(ellipsoid_speed_bound({1, 2, 3}, Vec3::UnitX(), Vec3(0, 0, 0)), 0) << "m/s: it does not spin";
}

TEST(Ex03Ellipsoid, ABallAndANeedle) {
  Any any;
  for (int i = 0; i < 50; ++i) {
    const Vec3 axis = any.unit();
    EXPECT_NEAR(ellipsoid_reach({2, 2, 2}, axis), 2, 1e-7) << "m: a ball is as wide from every axis";
    const double sine = axis.cross(Vec3::UnitZ()).norm();
    EXPECT_NEAR(ellipsoid_reach({1e-9, 1e-9, 5}, axis), 5 * sine, 1e-7) << "m: a needle along z";
  }
}

}  // namespace
