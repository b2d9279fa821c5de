#include "ch05_resting_contact/steering.hpp"

#include <algorithm>
#include <cmath>

namespace fc::resting {
namespace {

// Of what a gap lacks to half the envelope, so much is made up in a frame; and no body is moved by more than
// this part of the envelope, so that bodies outside each other's shells stay apart.
constexpr double kSteerShare = 0.2, kMostSteered = 0.2;

constexpr double kNearMiddle = 1 - 1e-3;  // of the middle: a gap above it is let be
constexpr double kSteerResidual = 1e-4;   // positions need no more: the next frame goes on
constexpr double kMostLost = 0.1;         // of a gap, by what the rough answer missed
constexpr int kMostHalvings = 6;

// Whether every pair in contact keeps half of its gap, or half of the envelope's middle, from the island's
// bodies to the moved ones.
bool keeps_gaps(const world::World& world, const Island& island, const std::vector<RigidBody>& moved,
                double middle) {
  for (std::size_t i = 0; i < island.contacts.size();) {
    const lcp::Contact& c = island.contacts[i];
    double gap = c.gap;
    for (; i < island.contacts.size() && island.contacts[i].body_a == c.body_a &&
           island.contacts[i].body_b == c.body_b;
         ++i)  // contacts of a pair stand together
      gap = std::min(gap, island.contacts[i].gap);
    const ca::PairPose pose(ca::Motion{moved[c.body_a]}, ca::Motion{moved[c.body_b]}, 0);
    const double after =
        hulls::model_distance(world.model_of(island.numbers[c.body_a]),
                              world.model_of(island.numbers[c.body_b]), pose, world.tolerance, 0.5 * middle)
            .lower;
    if (after < 0.5 * std::min(gap, middle) && after < gap) return false;
  }
  return true;
}

// The bodies after they have gone on for so long with their velocities; the velocities stay.
std::vector<RigidBody> displaced(const std::vector<RigidBody>& bodies, const std::vector<RigidBody>& by,
                                 double share) {
  std::vector<RigidBody> moved = bodies;
  for (std::size_t k = 0; k < moved.size(); ++k) {
    if (moved[k].is_static()) continue;
    moved[k].position += share * by[k].velocity;
    const double angle = share * by[k].spin.norm();
    if (angle > 0)
      moved[k].orientation =
          (Quat(Eigen::AngleAxisd(angle, by[k].spin.normalized())) * moved[k].orientation).normalized();
  }
  return moved;
}

void steer_island(world::World& world, const Island& island, double envelope, IslandSolver& solver,
                  Steering& steering) {
  const double middle = 0.5 * envelope;
  // Displacements are velocities for one unit of time, from rest. A gap may shrink by what it has above the
  // middle; one below it must grow.
  std::vector<RigidBody> by = island.bodies;
  for (RigidBody& body : by) body.velocity = body.spin = Vec3::Zero();
  std::vector<double> impulses(island.contacts.size(), 0), allowed;
  for (const lcp::Contact& contact : island.contacts)
    allowed.push_back(contact.gap < middle ? -kSteerShare * (middle - contact.gap) : contact.gap - middle);
  IslandOptions rough;
  rough.residual = rough.accepted = kSteerResidual;
  if (!solver.solve(by, island.contacts, allowed, impulses, rough).solved) return;

  double most = 0;
  for (std::size_t k = 0; k < by.size(); ++k)
    most = std::max(most, by[k].velocity.norm() + island.reaches[k] * by[k].spin.norm());
  double share = most > kMostSteered * envelope ? kMostSteered * envelope / most : 1;
  for (const lcp::Contact& contact : island.contacts) {
    const double lost = -lcp::contact_velocity(by, contact) - std::max(0.0, contact.gap - middle);
    if (lost > 0) share = std::min(share, std::max(0.0, kMostLost * contact.gap / lost));
  }
  // The rows are straight, the bodies turn: look at every pair, and go half as far until no gap has lost more
  // than half.
  for (int halvings = 0; halvings < kMostHalvings && share > 0; ++halvings, share *= 0.5) {
    const std::vector<RigidBody> moved = displaced(island.bodies, by, share);
    if (!keeps_gaps(world, island, moved, middle)) continue;
    steering.way = std::max(steering.way, share * most);
    for (std::size_t k = 0; k < by.size(); ++k) {
      if (by[k].velocity.isZero(0) && by[k].spin.isZero(0)) continue;
      if (world.effects.gravity)
        steering.energy -= share * by[k].mass * world.effects.gravity->dot(by[k].velocity);
      world.set_course(island.numbers[k], moved[k], 0);
    }
    return;
  }
}

}  // namespace

Steering steer(world::World& world, Shell& shell, IslandSolver& solver) {
  Steering steering;
  const double low = kNearMiddle * 0.5 * shell.envelope();
  const auto is_low = [&](int i) { return shell.contacts()[i].contact.gap < low; };
  shell.find(world);
  const std::vector<char> all(shell.contacts().size(), 1);
  std::vector<int> place(world.bodies.size(), -1);
  for (const std::vector<int>& members : islands_of(world, shell.contacts(), all))
    if (std::any_of(members.begin(), members.end(), is_low))
      steer_island(world, Island(world, shell.contacts(), members, place), shell.envelope(), solver,
                   steering);
  return steering;
}

}  // namespace fc::resting
