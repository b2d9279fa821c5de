// Exercise 3.5: a body that scrapes: friction at one contact, by bounds.
#pragma once

#include "common/rigid_body.hpp"

namespace fc::exercises {

// A point at which a body hits a fixed wall or floor.
struct Touch {
  Vec3 point = Vec3::Zero();   // m, world
  Vec3 normal = Vec3::Zero();  // unit, world, from the floor into the body
  Vec3 along =
      Vec3::Zero();        // unit, world, at right angles to the normal; the second tangent is normal x along
  double restitution = 0;  // epsilon, in [0, 1]
  double friction = 0;     // mu >= 0
};

// Impulses on the body in N s: `normal` pushes, `along` and `across` are friction along the two tangents.
struct Scrape {
  bool found = false;
  double normal = 0, along = 0, across = 0;
};

// The impulses of the impact, which are also applied to the body: velocity and spin change. With v the
// velocity of the body's point and v+ the one after, to within 1e-9 of the speeds involved,
//   normal >= 0, v+_n + epsilon v_n >= 0, and one of the two is 0;
//   for each of the two tangents t: |impulse_t| <= mu normal; v+_t = 0 if |impulse_t| is smaller, else v+_t
//   is opposite to impulse_t, or 0.
// (So friction is bounded separately along each tangent: a pyramid in place of Coulomb's cone.) If the normal
// impulse changes v_t, and friction changes v_n, the two must be found together. `found` says whether they
// were; they are for mu up to 0.5 and a solid box that is hit anywhere on its surface. If not, the body is
// unchanged.
Scrape scrape(RigidBody& body, const Touch& touch);

}  // namespace fc::exercises
