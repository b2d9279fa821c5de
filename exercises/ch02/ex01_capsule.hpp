// Exercise 2.1: a capsule as the volume of a node.
#pragma once

#include <algorithm>

#include "common/types.hpp"

namespace fc::exercises {

// A node's volume, fixed to a body with constant velocity and spin: all points within `radius` of the segment
// from p to q (a swept sphere; libraries call it LSS, or with p = q PSS).
struct Capsule {
  Vec3 middle = Vec3::Zero();    // m, world: the body's centre of mass now
  Vec3 velocity = Vec3::Zero();  // m/s, of the centre of mass
  Vec3 spin = Vec3::Zero();      // rad/s, world; the body turns about its centre of mass
  Vec3 p = Vec3::Zero();         // m, world axes, from the centre of mass, now
  Vec3 q = Vec3::Zero();
  double radius = 0;  // m
};

// The gap in m along n (unit, world, from A to B), h seconds from now, as a plane across n shows it. Given.
inline double gap(const Capsule& a, const Capsule& b, const Vec3& n, double h) {
  const auto farthest = [h](const Capsule& c, const Vec3& d) {
    const double rate = c.spin.norm();
    const Mat3 turn =
        rate > 0 ? Eigen::AngleAxisd(rate * h, c.spin / rate).toRotationMatrix() : Mat3(Mat3::Identity());
    return d.dot(c.middle + h * c.velocity) + std::max(d.dot(turn * c.p), d.dot(turn * c.q)) + c.radius;
  };
  return -farthest(b, -n) - farthest(a, n);
}

// The smallest bound, in m/s, of the speed at which the gap along a fixed n shrinks at any later time, among
// those that do not depend on the bodies' present turn about their spins. Negative if the two part for ever.
// (It assumes that both bodies are fastest at the same time, which may happen.) Rounding is included: never
// below the truth, and above it by no more than 1e-12 of the speeds involved.
double closing_speed(const Capsule& a, const Capsule& b, const Vec3& n);

// For how many seconds from now the gap along n certainly shrinks by no more than `room` (m, > 0): at all
// times until then, not only at the end, and with rounding included. May be infinite. The world's origin does
// not matter. At least as long, up to 1e-12 of it, as both
//   room / closing_speed (for ever, if that is not positive),
//   the time in which no pair of an end of A and an end of B uses up its room. A pair's room is `room` plus
//   the excess of its distance along n over the gap; it begins with its own present closing speed, and bends
//   by at most its own largest acceleration along n.
double safe_step(const Capsule& a, const Capsule& b, const Vec3& n, double room);

}  // namespace fc::exercises
