// Coulomb's cones with the impulses inside, and how the solver comes to them, drawn.
#pragma once

#include <ostream>

#include "ch05_resting_contact/show_rest.hpp"
#include "ch06_friction/cone_problem.hpp"

namespace fc::friction {

// What a contact does after the impulses.
enum class Grip { open, sticks, slips };
inline std::ostream& operator<<(std::ostream& out, Grip grip) {
  constexpr const char* kNames[] = {"open", "sticks", "slips"};
  return out << kNames[static_cast<int>(grip)];
}
Grip grip_of(const Vec3& impulse, const Vec3& normal, double mu);

// The cone of a contact as it is drawn: its top at the point, around the normal, `height` (m) high. Its sides touch the true cone
// from outside, so that it holds all of it.
algorithm::Mark cone_mesh(const Vec3& point, const Vec3& normal, double mu, double height,
                          algorithm::Role role);

// The residual of an island after this many sweeps over its contacts.
struct ResidualAfter {
  int sweeps = 0;
  double residual = 0;
};
std::vector<ResidualAfter> residuals_of(const world::World& world, const resting::SeenPush& push);

// The parts of this chapter: for the first islands with friction.
std::vector<algorithm::Part> show_cones(const world::World& world, const resting::RestWatch& watch,
                                        double t0);

// The account of a frame: with friction by Coulomb's law, else as in chapter 5 or 4.
algorithm::Document show_frame(const Scene& scene, world::World& world, std::int64_t before, double t0);

}  // namespace fc::friction
