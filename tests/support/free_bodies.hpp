// Random bodies that turn freely, the hard ones included.
#pragma once

#include <algorithm>

#include "ch01_convex_advancement/motion.hpp"
#include "ch04_multibody_stepping/torque_free.hpp"
#include "tests/support/random_shapes.hpp"

namespace fc::test {

struct FreeBody {
  Vec3 moments;  // kg m^2, ascending; the principal axes are the body's own
  Mat3 rotation;
  Vec3 spin;  // rad/s, world

  Mat3 inertia() const { return moments.asDiagonal(); }
  world::TorqueFree free() const { return {inertia(), rotation, spin}; }
};

// Any masses on the three axes give moments that a body can have.
inline Vec3 moments_of(const Vec3& masses) {
  Vec3 m(masses.y() + masses.z(), masses.z() + masses.x(), masses.x() + masses.y());
  std::sort(m.data(), m.data() + 3);
  return m;
}

// Bricks, plates, needles, nearly and exactly symmetric tops; spins in any direction, and close to each of
// the axes (to the middle one: near the separatrix).
inline FreeBody random_free_body(Random& random) {
  const auto mass = [&] { return uniform(random, 0.1, 1); };
  const auto alike = [&] { return 1 + integer(random, 0, 3) / 3 * magnitude(random, 1e-15, 1e-3); };
  Vec3 masses(mass(), mass(), mass());
  switch (integer(random, 0, 5)) {
    case 0:
      masses[2] *= integer(random, 0, 1) * magnitude(random, 1e-12, 1e-2);  // plate
      break;
    case 1:
      masses[1] *= magnitude(random, 1e-8, 1e-2);  // needle
      masses[2] = masses[1] * uniform(random, 0.1, 1);
      break;
    case 2:
      masses[1] = masses[0] * alike();  // top
      break;
    case 3:
      masses[1] = masses[0] * alike();  // ball
      masses[2] = masses[0] * alike();
      break;
    default:
      break;
  }
  FreeBody body;
  body.moments = magnitude(random, 1e-9, 1e9) * moments_of(masses);
  body.rotation = rotation(random).toRotationMatrix();
  Vec3 direction = unit_vector(random);
  const int near = integer(random, 0, 4);
  if (near < 3) direction = (magnitude(random, 1e-4, 1e-1) * direction + Vec3::Unit(near)).normalized();
  body.spin = magnitude(random, 1e-3, 1e3) * (body.rotation * direction);
  return body;
}

// Lets one or both of a pair turn freely, and feel drag, or neither. Drag is the same for both, or one of
// them flies straight on.
inline void add_random_effects(Random& random, ca::Motion& a, ca::Motion& b) {
  const auto mass = [&] { return uniform(random, 0.05, 1); };
  for (ca::Motion* m : {&a, &b}) {
    if (integer(random, 0, 1) == 0 || m->spin_rate == 0) continue;
    world::turn_freely(*m, world::PrincipalInertia(Mat3(moments_of({mass(), mass(), mass()}).asDiagonal())));
  }
  if (integer(random, 0, 1) == 0) return;
  a.drag = magnitude(random, 1e-3, 10);
  a.spin_drag = magnitude(random, 1e-3, 10);
  if (integer(random, 0, 1) == 0) {
    b.acceleration = Vec3::Zero();
    return;
  }
  b.drag = a.drag;
  b.spin_drag = a.spin_drag;
}

}  // namespace fc::test
