// Exercise 1.3. The tests know an ellipsoid by its points, and eigenvalues from Eigen in long double.
#include "ex03_ellipsoid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

namespace {

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

using Long = long double;
using Long3 = Eigen::Matrix<Long, 3, 1>;
using Long33 = Eigen::Matrix<Long, 3, 3>;

// The largest distance from the line along `axis`, m, with three digits more than a double has.
Long true_reach(const Vec3& half_axes, const Long3& axis) {
  const Long33 D = half_axes.cast<Long>().asDiagonal();
  const Long33 across = D * (Long33::Identity() - axis * axis.transpose() / axis.squaredNorm()) * D;
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Long33>(across).eigenvalues()[2]);
}
void expect_reach(const Vec3& half_axes, const Vec3& axis) {
  const Long truth = true_reach(half_axes, axis.cast<Long>()), got = ellipsoid_reach(half_axes, axis);
  EXPECT_GE(got / truth - 1, 0) << "of the reach of " << truth
                                << " m: so much it is too small, for half axes of " << half_axes.transpose()
                                << " m. A bound may not be too small, not even by rounding";
  EXPECT_LE(got / truth - 1, 1e-12L) << "of the reach of " << truth
                                     << " m: so much it is too large, for half axes of "
                                     << half_axes.transpose() << " m: safe, but costs advances";
}

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
  for (const double length : {1e-320, 1e-200, 1e-12, 1e-3, 7.0, 1e9, 1e200, 1e308})
    EXPECT_NEAR((ellipsoid_support(d, length * direction) - point).norm(), 0, length < 1e-300 ? 1e-3 : 1e-12)
        << "m: a direction " << length << " times as long is the same direction; its square may be no double";
  EXPECT_NEAR((ellipsoid_support(d, Vec3(0, -5, 0)) - Vec3(0, -2, 0)).norm(), 0, 1e-15)
      << "m, from the point (0, -2, 0), which lies farthest along -y";
}

TEST(Ex03Ellipsoid, ReachAlongTheAxesIsTheLargerOfTheOtherTwo) {
  const Vec3 d(1, 2, 3);
  EXPECT_NEAR(ellipsoid_reach(d, Vec3::UnitX()), 3, 1e-12) << "m, from the x axis: c is longer than b";
  EXPECT_NEAR(ellipsoid_reach(d, Vec3::UnitY()), 3, 1e-12) << "m, from the y axis: c is longer than a";
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
    const auto truth = static_cast<double>(true_reach(d, axis.cast<Long>()));
    EXPECT_NEAR(ellipsoid_reach(d, axis), truth, 1e-12 * truth)
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
  EXPECT_NEAR(ellipsoid_speed_bound({1, 2, 9}, Vec3::UnitX(), Vec3(0, 0, 5)), 10, 1e-12)
      << "m/s: 5 rad/s, 2 m from the axis; the 9 m along it add nothing";
  EXPECT_NEAR(ellipsoid_speed_bound({1, 2, 9}, Vec3(3, 0, 4) / 5, Vec3(0, 0, 5)), 6, 1e-12)
      << "m/s: only the part of n across the spin counts, 3/5";
}

TEST(Ex03Ellipsoid, NothingMovesAlongTheSpinOrWithoutOne) {
  EXPECT_NEAR(ellipsoid_speed_bound({1, 2, 3}, Vec3::UnitZ(), Vec3(0, 0, 7)), 0, 1e-12)
      << "m/s: a body that spins about n brings nothing nearer";
  EXPECT_EQ(ellipsoid_speed_bound({1, 2, 3}, Vec3::UnitX(), Vec3(0, 0, 0)), 0)
      << "m/s: what does not spin brings nothing nearer (0/0 is no bound)";
}

TEST(Ex03Ellipsoid, ABallAndANeedle) {
  Any any;
  for (int i = 0; i < 50; ++i) {
    const Vec3 axis = any.unit();
    EXPECT_NEAR(ellipsoid_reach({2, 2, 2}, axis), 2, 1e-12)
        << "m: a ball is as wide from every axis; what is under your root may have come out below 0";
    const double sine = axis.cross(Vec3::UnitZ()).norm();
    EXPECT_NEAR(ellipsoid_reach({1e-9, 1e-9, 5}, axis), 5 * sine, 1e-12)
        << "m: a needle along z, whose ends go round the axis";
  }
}

// Differences of nearly equal numbers have no digits left: 1e-16 under a root becomes 1e-8.
TEST(Ex03Ellipsoid, NearlyRoundIsNoLessExact) {
  Any any;
  for (int i = 0; i < 2000; ++i) {
    const double size = any.magnitude(1e-3, 1e3), part = any.magnitude(1e-16, 1e-2);
    const Vec3 d = size * (Vec3::Ones() + part * any.unit()), axis = any.unit();
    const auto truth = static_cast<double>(true_reach(d, axis.cast<Long>()));
    ASSERT_NEAR(ellipsoid_reach(d, axis) / truth, 1, 1e-12)
        << "of the true reach; the half axes differ by " << part << " of themselves only";
  }
}

TEST(Ex03Ellipsoid, ABoundHoldsToTheLastDigit) {
  Any any;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 d = i % 3 == 0 ? Vec3::Constant(any.magnitude(1e-3, 10)) : any.half_axes();
    const Vec3 axis = i % 5 == 0 ? Vec3((Vec3::UnitZ() + 1e-9 * any.unit()).normalized()) : any.unit();
    expect_reach(d, axis);
    const double size = any.magnitude(1e-3, 30);
    const Vec3 n = i % 7 == 0 ? axis : any.unit(), spin = size * axis;
    const Long truth = n.cast<Long>().cross(spin.cast<Long>()).norm() * true_reach(d, spin.cast<Long>());
    const Long excess = ellipsoid_speed_bound(d, n, spin) - truth;
    EXPECT_GE(excess, 0) << "m/s: so much a point is faster than the bound, at " << truth << " m/s";
    EXPECT_LE(excess, 1e-12L * size * d.maxCoeff())
        << "m/s: so much the bound is too large, at " << truth << " m/s";
    if (HasFailure()) return;
  }
}

}  // namespace
