// Exercise 2.1: a capsule as the volume of a node.
#pragma once

#include <algorithm>

#include "common/types.hpp"

namespace fc::exercises {

// A node's volume, fixed to a body that flies straight and turns evenly: all points within `radius` of the
// segment from p to q (a swept sphere; libraries call it LSS, or with p = q PSS).
struct Capsule {
  Vec3 middle = Vec3::Zero();    // m, world: the body's centre of mass now
  Vec3 velocity = Vec3::Zero();  // m/s, of the centre of mass
  Vec3 spin = Vec3::Zero();      // rad/s, world; the body turns about its centre of mass
  Vec3 p = Vec3::Zero();         // m, world axes, from the centre of mass, now
  Vec3 q = Vec3::Zero();
  double radius = 0;  // m
};

// The gap in m along n (unit, world, from A to B), h seconds from now: what a plane across n can tell. Given.
inline double gap(const Capsule& a, const Capsule& b, const Vec3& n, double h) {
  const auto farthest = [h](const Capsule& c, const Vec3& d) {
    const double rate = c.spin.norm();
    const Mat3 turn =
        rate > 0 ? Eigen::AngleAxisd(rate * h, c.spin / rate).toRotationMatrix() : Mat3(Mat3::Identity());
    return d.dot(c.middle + h * c.velocity) + std::max(d.dot(turn * c.p), d.dot(turn * c.q)) + c.radius;
  };
  return -farthest(b, -n) - farthest(a, n);
}

// The smallest number of m/s, of those that do not depend on how the bodies are turned about their spins just
// now, that the gap along a fixed n never shrinks faster than, at any later time. Negative if the two part
// for ever. (It counts on both bodies being fastest at the same time: one day they may be.) Rounding is
// included: it is never below the truth, and above it by no more than 1e-12 of the speeds involved.
double closing_speed(const Capsule& a, const Capsule& b, const Vec3& n);

// For how many seconds from now the gap along n certainly shrinks by no more than `room` (m, > 0): at all
// times until then, not only at the end, and with rounding included. May be infinite. Where the world's
// origin is does not matter. At least as long, up to 1e-12 of it, as both
//   room / closing_speed (for ever, if that is not positive),
//   the time in which no pair of an end of A and an end of B uses up its room. A pair's room is `room` and by
//   how much the two are farther apart along n than the gap says; it begins with its own closing speed, of
//   now, and bends by at most its own largest acceleration along n.
double safe_step(const Capsule& a, const Capsule& b, const Vec3& n, double room);

}  // namespace fc::exercises
