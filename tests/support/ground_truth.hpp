// The first contact of two moving convex bodies, slowly and reliably: the reference for chapter 1.
//
// Nothing of the library is used here. Shapes are points with disks and a rounding ball, poses are
// quaternions, all in long double. Two arguments carry everything:
//
//   a distance   the support gap along any direction is a lower bound, the distance of any two points of the
//                bodies an upper one. The search that makes them meet need not be trusted.
//   a time       the gap along a fixed plane changes at most as fast as the bodies' fastest points move along
//                its normal. So a gap in the middle of an interval proves the whole interval clear, if it is
//                short enough; if it is not, it is halved.
//
// Where neither can be shown the answer is `undecided`.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <vector>

namespace truth {

using Real = long double;
using V = Eigen::Matrix<Real, 3, 1>;
constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

// The convex hull of points, each with a disk about it across the body's z axis, rounded by a ball.
struct Shape {
  std::vector<V> points;    // m, about the centre of mass, body axes
  std::vector<Real> disks;  // m, radii; empty: none
  Real radius = 0;          // m, of the ball
  Real reach() const;       // m, the largest distance of the core from the centre of mass
};

// What a query is given: the state at t = 0, of constant acceleration and spin.
struct Flight {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m, the centre of mass
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      // m/s
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();          // rad/s, world axes
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // m/s^2
};

struct Body {
  Shape shape;
  Flight flight;
};

// The distance lies in [lower, upper]; balls that overlap make it negative, cores that overlap leave it <= 0.
struct Gap {
  Real lower = -kInfinity, upper = kInfinity;  // m
  V normal = V::UnitX();                       // unit, from A to B: along it the gap is `lower`
};

// At time t (s). Stops as soon as `lower` exceeds `enough`.
Gap gap(const Body& a, const Body& b, Real t, Real enough = kInfinity);

// The first time in [0, end] at which the distance is at most `level` (m).
struct FirstTime {
  enum class Verdict {
    never,     // larger during all of the interval
    at,        // in [lower, upper], which is at most `width` long
    undecided  // not before `lower`
  };
  Verdict verdict = Verdict::undecided;
  Real lower = 0, upper = kInfinity;  // s
  int looks = 0;                      // distances computed
};
FirstTime first_time(const Body& a, const Body& b, Real end, Real level, Real width,
                     int most_looks = 100'000);

// The smallest distance during [0, end] lies in [lower, upper] (m), at most `width` apart unless the limit of samples
// was reached.
struct Closest {
  Real lower = -kInfinity, upper = kInfinity;
};
Closest closest(const Body& a, const Body& b, Real end, Real width, int most_looks = 100'000);

}  // namespace truth
