// Invariants of the impact law on random heaps of boxes and balls: nothing approaches, momenta stay, energy
// follows its identity.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bodies.hpp"
#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"

namespace fc::lcp {
namespace {

void check_invariants(const Heap& heap, double restitution, bool floor) {
  std::vector<Contact> contacts = heap.contacts;
  for (Contact& contact : contacts) contact.restitution = restitution;
  std::vector<RigidBody> bodies = heap.bodies;
  const Sums before = sums(bodies);
  const ImpactResult result = resolve_impact(bodies, contacts);
  const Sums after = sums(bodies);

  ASSERT_EQ(result.status, Status::solved);
  EXPECT_LE(result.worst_residual, 1e-11);
  for (const Contact& contact : contacts) EXPECT_GE(contact_velocity(bodies, contact), -1e-9);
  EXPECT_LE(after.energy, before.energy * (1 + 1e-12));
  EXPECT_NEAR(result.energy_change, result.energy_identity, 1e-11 * before.energy);
  if (!floor) {
    EXPECT_LE((after.momentum - before.momentum).norm(), 1e-12 * before.momentum_size);
    EXPECT_LE((after.angular - before.angular).norm(), 1e-12 * before.angular_size);
  }
}

TEST(ImpactRandom, KeepsTheInvariants) {
  std::mt19937_64 random(20080101);
  for (int draw = 0; draw < 150; ++draw) {
    SCOPED_TRACE(draw);
    const bool floor = draw % 2 == 0;
    const Heap heap = random_heap(random, 2 + draw % 7, 1 + draw % 5, 0, 1, floor);
    for (const double restitution : {0.0, 0.5, 1.0}) check_invariants(heap, restitution, floor);
  }
}

TEST(ImpactRandom, KeepsTheInvariantsWithEveryContactEightTimes) {
  std::mt19937_64 random(20080102);
  for (int draw = 0; draw < 40; ++draw) {
    SCOPED_TRACE(draw);
    check_invariants(random_heap(random, 2 + draw % 4, 4, 0, 8, draw % 2 == 0), 0.5, draw % 2 == 0);
  }
}

TEST(ImpactRandom, KeepsTheInvariantsOverEightDecadesOfMass) {
  std::mt19937_64 random(20080103);
  for (int draw = 0; draw < 100; ++draw) {
    SCOPED_TRACE(draw);
    check_invariants(random_heap(random, 2 + draw % 6, 1 + draw % 5, 8, 1, draw % 2 == 0), draw % 3 * 0.5,
                     draw % 2 == 0);
  }
}

// A tower of boxes of which each is 10^decades times as heavy as the one below: the worst case of the impulse
// form.
TEST(ImpactRandom, ATowerThatGrowsHeavierStopsApproaching) {
  for (const double decades : {-4.0, -2.0, 0.0, 2.0, 4.0}) {
    for (const double restitution : {0.0, 0.5, 1.0}) {
      SCOPED_TRACE(testing::Message() << decades << " decades, restitution " << restitution);
      Heap tower{{wall()}, {}};
      for (int i = 0; i < 3; ++i) {
        const Vec3 fall(0, 0, i == 2 ? -1 : 0);
        tower.bodies.push_back(box(Vec3(0, 0, 0.5 + i), fall, std::pow(10.0, decades * i)));
        for (const double x : {-0.5, 0.5}) {
          for (const double y : {-0.5, 0.5}) {
            tower.contacts.push_back({i, i + 1, Vec3(x, y, i), Vec3::UnitZ(), 0, restitution});
          }
        }
      }
      const ImpactResult result = resolve_impact(tower.bodies, tower.contacts);
      ASSERT_EQ(result.status, Status::solved);
      EXPECT_LE(result.worst_residual, 1e-12);
      EXPECT_LE(result.fastest_approach, 1e-11);
    }
  }
}

// One solve, one epsilon: the change of energy is -1/2 (1 - e)/(1 + e) j'Aj.
TEST(ImpactRandom, LosesTheEnergyOfTheIdentity) {
  std::mt19937_64 random(20080104);
  int checked = 0;
  for (int draw = 0; draw < 100; ++draw) {
    SCOPED_TRACE(draw);
    Heap heap = random_heap(random, 4, 3, 0, 1, true);
    const double e = 0.1 * (draw % 11);
    for (Contact& contact : heap.contacts) contact.restitution = e;
    const ImpactProblem problem = assemble(heap.bodies, heap.contacts);
    const double before = sums(heap.bodies).energy;
    const ImpactResult result = resolve_impact(heap.bodies, heap.contacts);
    if (result.solves != 1) continue;
    ++checked;
    VecX j = VecX::Zero(problem.b.size());
    for (const Impulse& p : result.impulses) j[p.contact] = p.impulse;
    const double expected = -0.5 * (1 - e) / (1 + e) * j.dot(problem.A * j);
    EXPECT_NEAR(sums(heap.bodies).energy - before, expected, 1e-12 * before);
  }
  EXPECT_GT(checked, 10);
}

}  // namespace
}  // namespace fc::lcp
