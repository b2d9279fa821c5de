// Sweeps on bodies: the residual that they return is the true one.
#include <gtest/gtest.h>

#include "ch06_friction/contact_sweeps.hpp"

namespace {

using fc::Vec3;

// Two boxes, one on the other on a floor, four corners each, in whose gaps more is wanted below the first corners.
TEST(ContactSweeps, HeldContactsTellWhatIsLeft) {
  std::vector<fc::RigidBody> bodies(3);
  for (int i = 0; i < 2; ++i) {
    fc::MassProperties mass;
    mass.mass = 1;
    mass.inertia = fc::Mat3::Identity() / 6;
    bodies[static_cast<std::size_t>(i)].set_mass(mass);
    bodies[static_cast<std::size_t>(i)].position = Vec3(0, 0, 0.5 + i);
  }
  fc::friction::ContactSweeps sweeps;
  const auto left = [&](int most) {
    sweeps.start(bodies);
    for (int level = 0; level < 2; ++level)
      for (const double x : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5}) {
          const fc::lcp::Contact contact{level == 0 ? 2 : 0, level, Vec3(x, y, level), Vec3::UnitZ()};
          sweeps.add(contact, 0.5, Vec3(0, 0, x < 0 ? -0.2 : -0.1), Vec3::Zero());
        }
    const std::vector<char> holds(8, 1);
    return sweeps.run_held(holds, most, 1e-12);
  };
  EXPECT_GT(left(1), 1e-2) << "one sweep does not put two boxes right";
  EXPECT_LT(left(2000), 1e-9);
}

}  // namespace
