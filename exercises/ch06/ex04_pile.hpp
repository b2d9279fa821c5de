// Exercise 6.4: a pile of balls, supported by your own solver.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "common/types.hpp"

namespace fc::exercises {

// A solid ball: its inertia is 2/5 m r^2.
struct Ball {
  double mass = 1;    // kg, > 0
  double radius = 1;  // m, > 0
  Vec3 centre = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();  // m/s
  Vec3 spin = Vec3::Zero();      // rad/s
};

// A wall or a floor, which does not move: the balls are where normal·x >= offset.
struct Plane {
  Vec3 normal{0, 0, 1};  // of length 1
  double offset = 0;     // m
};

struct Contact {
  int a = -1, b = 0;            // a ball, or -1: a plane; and a ball
  Vec3 normal = Vec3::Zero();   // of length 1, from a to b
  double room = 0;              // m/s, >= 0: a and b may close in at this speed
  double mu = 0;                // >= 0
  Vec3 impulse = Vec3::Zero();  // N s, in the world's axes: the sum on b so far; a has got the opposite
};

// One contact of balls. An impulse along the normal does not turn a ball, and friction does not change the normal
// velocity: A is diagonal, with `a` (1/kg, > 0) for the normal and `d` (1/kg, > 0) for any tangent.
//   q         m/s: the velocity of b relative to a, at the contact, without any impulse
//   normal    of length 1, from a to b;  room: m/s, >= 0;  mu: >= 0
// Returns r (N s, in the world's axes, on b). With u = q + a r_N (normal) + d r_T:
//   u_N >= -room, r_N >= 0, and one of the two is an equality; |r_T| <= mu r_N; and u_T is 0, or |r_T| = mu r_N
//   with r_T directly against u_T.
// Exact up to rounding.
Vec3 solve_contact(double a, double d, const Vec3& q, const Vec3& normal, double room, double mu);

// One sweep: visits the contacts in the order of the list. Each is solved exactly, as if all other impulses were known.
// The change of its impulse acts on the balls at once, and contact.impulse becomes the new *sum*. On entry the balls'
// velocities contain all impulses already. Returns the largest change of velocity at a contact, m/s: the largest max(a
// |change of r_N|, d |change of r_T|).
double sweep(std::vector<Ball>& balls, std::vector<Contact>& contacts);

// ---- Given: the loop around it. ----

struct Pile {
  std::vector<Ball> balls;
  std::vector<Plane> planes;
  Vec3 gravity{0, 0, -9.81};  // m/s^2
  double mu = 0.5;
  double margin = 1e-3;                      // m: a gap of at most that is a contact
  std::map<std::pair<int, int>, Vec3> last;  // N s: impulses of the last step; planes are -1, -2, ...
  int sweeps = 0;                            // of the last step
};

// Gravity, contacts, the impulses of the last step as a guess, sweeps until nothing changes any more, motion. In a step
// a pair may at most use up its gap: nothing overlaps except by rounding. Energy never grows: see the statement.
inline void step(Pile& pile, double dt) {
  constexpr int kMostSweeps = 1000;
  constexpr double kTolerance = 1e-13;  // m/s
  std::vector<Ball>& balls = pile.balls;
  for (Ball& ball : balls) ball.velocity += dt * pile.gravity;
  std::vector<Contact> contacts;
  std::vector<std::pair<int, int>> names;
  const auto look = [&](int a, int b, const Vec3& normal, double gap) {
    if (gap > pile.margin) return;
    contacts.push_back({std::max(a, -1), b, normal, std::max(0.0, gap) / dt, pile.mu, Vec3::Zero()});
    names.emplace_back(a, b);
  };
  for (int b = 0; b < static_cast<int>(balls.size()); ++b) {
    const Ball& ball = balls[static_cast<std::size_t>(b)];
    for (int p = 0; p < static_cast<int>(pile.planes.size()); ++p) {
      const Plane& plane = pile.planes[static_cast<std::size_t>(p)];
      look(-1 - p, b, plane.normal, plane.normal.dot(ball.centre) - plane.offset - ball.radius);
    }
    for (int a = 0; a < b; ++a) {
      const Ball& other = balls[static_cast<std::size_t>(a)];
      const Vec3 between = ball.centre - other.centre;
      look(a, b, between.normalized(), between.norm() - ball.radius - other.radius);
    }
  }
  // The guess acts on the balls, and is counted.
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    Contact& contact = contacts[k];
    const auto found = pile.last.find(names[k]);
    if (found == pile.last.end()) continue;
    contact.impulse = found->second;
    const auto give = [&](Ball& ball, const Vec3& arm, const Vec3& impulse) {
      ball.velocity += impulse / ball.mass;
      ball.spin += arm.cross(impulse) / (0.4 * ball.mass * ball.radius * ball.radius);
    };
    Ball& b = balls[static_cast<std::size_t>(contact.b)];
    give(b, -b.radius * contact.normal, contact.impulse);
    if (contact.a >= 0) {
      Ball& a = balls[static_cast<std::size_t>(contact.a)];
      give(a, a.radius * contact.normal, -contact.impulse);
    }
  }
  for (pile.sweeps = 1; pile.sweeps < kMostSweeps && sweep(balls, contacts) > kTolerance;) ++pile.sweeps;
  pile.last.clear();
  for (std::size_t k = 0; k < contacts.size(); ++k) pile.last[names[k]] = contacts[k].impulse;
  for (Ball& ball : balls) ball.centre += dt * ball.velocity;
}

// J: kinetic, and potential in the pile's gravity.
inline double energy(const Pile& pile) {
  double sum = 0;
  for (const Ball& ball : pile.balls)
    sum += ball.mass *
           (0.5 * ball.velocity.squaredNorm() + 0.2 * ball.radius * ball.radius * ball.spin.squaredNorm() -
            pile.gravity.dot(ball.centre));
  return sum;
}

}  // namespace fc::exercises
