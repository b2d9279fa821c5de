// The impact law of two stages: closed forms, chapter 3's law, and energy.
#include "ch06_friction/two_stage_impact.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

#include "ch03_impulse_lcp/impact.hpp"
#include "cones.hpp"
#include "tests/support/random_engine.hpp"

namespace fc::friction {
namespace {

FrictionImpactResult impact(const MatX& A, const VecX& u, double mu, double restitution) {
  const VecX mus = VecX::Constant(u.size() / 3, mu), restitutions = VecX::Constant(u.size() / 3, restitution);
  return two_stage_impact({A, u, mus, restitutions});
}

// A rod of 1 kg and half-length 1 m that hits the floor with its lower end at 45°; J, the energy of the contact.
const MatX kRod{{2.5, -1.5, 0}, {-1.5, 2.5, 0}, {0, 0, 1}};
double contact_energy(const VecX& u) {
  return 0.5 * u.dot(Mat3(kRod).inverse() * u);
}

// Newton's law with Coulomb's friction, r = (65/64, 23/64), makes 64/41 of the rod's energy. This one: 0.619.
TEST(TwoStageImpact, TheRodThatGainsByNewtonsLawLoses) {
  const VecX u{{-1, 0.625, 0}}, newton{{65.0 / 64, 23.0 / 64, 0}};
  ASSERT_NEAR((kRod * newton + u - VecX{{1, 0, 0}}).norm(), 0, 1e-15);
  ASSERT_NEAR(contact_energy(kRod * newton + u) / contact_energy(u), 64.0 / 41, 1e-14);
  const FrictionImpactResult result = impact(kRod, u, 0.5, 1);
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_NEAR(result.u[0], 0.684, 5e-4);
  EXPECT_NEAR(result.u[1], -0.098, 5e-4);
  EXPECT_NEAR(contact_energy(result.u) / contact_energy(u), 0.619, 5e-4);
  EXPECT_NEAR(contact_energy(result.u) - contact_energy(u), result.energy_change, 1e-14);
}

// R22 of the notes: a ball, k² = 2/5. It slides through both stages, or its point stops.
TEST(TwoStageImpact, ABallBouncesWithSlip) {
  const MatX A = Vec3(1, 3.5, 3.5).asDiagonal();
  const double mu = 0.2;
  for (const double e : {0.0, 0.5, 1.0}) {
    for (const double slip : {0.3, 0.8, 1.0, 2.0, 5.0}) {
      const VecX u{{-1, 0.6 * slip, 0.8 * slip}};
      const FrictionImpactResult result = impact(A, u, mu, e);
      ASSERT_EQ(result.status, Status::solved);
      const double after = std::max(0.0, slip - 3.5 * mu * (1 + e));
      EXPECT_NEAR((result.u - VecX{{e, 0.6 * after, 0.8 * after}}).norm(), 0, 1e-9);
      ASSERT_EQ(result.passes.size(), 1u);
      EXPECT_EQ(result.passes[0].cap, 1);
    }
  }
}

// The heap of chapter 3's tests, as chapter 3 solves it, and as this one does: the same speeds.
TEST(TwoStageImpact, WithoutFrictionAndWithOneRestitutionIsChapterThrees) {
  std::mt19937_64 random(20080101);
  for (int draw = 0; draw < 60; ++draw) {
    SCOPED_TRACE(draw);
    const double e = 0.25 * (draw % 5);
    lcp::Heap heap = lcp::random_heap(random, 2 + draw % 5, 1 + draw % 4, 0, 1, draw % 2 == 0);
    for (lcp::Contact& contact : heap.contacts) contact.restitution = e;
    const OwnProblem p = heap_problem(heap, 0);
    const FrictionImpactResult ours = impact(p.A, p.b, 0, e);
    ASSERT_EQ(ours.status, Status::solved);
    const lcp::ImpactResult known = lcp::resolve_impact(heap.bodies, heap.contacts);
    ASSERT_EQ(known.status, lcp::Status::solved);
    ASSERT_EQ(static_cast<int>(ours.passes.size()), known.solves);
    for (std::size_t i = 0; i < heap.contacts.size(); ++i) {
      const double speed = lcp::contact_velocity(heap.bodies, heap.contacts[i]);
      EXPECT_NEAR(ours.u[3 * static_cast<Eigen::Index>(i)], speed, 1e-13 * size_of(p, ours.r));
    }
    EXPECT_NEAR(ours.energy_change, known.energy_change, 1e-12 * (1 + std::abs(known.energy_change)));
    for (const ImpactPass& pass : ours.passes) EXPECT_NEAR(pass.cap, 1, 1e-14);
  }
}

// A row of three balls between which restitutions differ: chapter 3's law gains energy here, and says so.
TEST(TwoStageImpact, MixedRestitutionsGainNothing) {
  std::mt19937_64 random(20080102);
  int capped = 0, gained_by_newton = 0;
  for (int draw = 0; draw < 400; ++draw) {
    SCOPED_TRACE(draw);
    lcp::Heap heap = lcp::random_heap(random, 3, 1 + draw % 3, 2, 1, true);
    VecX e(static_cast<Eigen::Index>(heap.contacts.size()));
    for (Eigen::Index i = 0; i < e.size(); ++i) {
      e[i] = uniform(random, 0, 1) < 0.5 ? 0 : 1;
      heap.contacts[static_cast<std::size_t>(i)].restitution = e[i];
    }
    const OwnProblem p = heap_problem(heap, 0);
    const FrictionImpactResult result = two_stage_impact({p.A, p.b, p.mu, e});
    ASSERT_EQ(result.status, Status::solved);
    EXPECT_LE(result.energy_change, 1e-12 * std::abs(result.r.dot(p.b)));
    for (const ImpactPass& pass : result.passes) capped += pass.cap < 1 - 1e-9;
    const lcp::ImpactResult newton = lcp::resolve_impact(heap.bodies, heap.contacts);
    gained_by_newton += newton.status == lcp::Status::solved && newton.energy_change > 1e-9;
  }
  EXPECT_GT(gained_by_newton, 0);
  EXPECT_GT(capped, 5);
}

TEST(TwoStageImpact, LeavesAloneWhatDoesNotApproach) {
  const MatX A = MatX::Identity(3, 3);
  const VecX u{{0, 5, 0}};
  const FrictionImpactResult result = impact(A, u, 1, 1);
  EXPECT_EQ(result.status, Status::solved);
  EXPECT_TRUE(result.passes.empty());
  EXPECT_EQ(result.u, u);
}

TEST(TwoStageImpact, RefusesCallersMistakes) {
  const MatX A = MatX::Identity(3, 3);
  const VecX u{{-1, 0, 0}}, one{{1.0}}, more{{1.5}};
  EXPECT_THROW(two_stage_impact({A, u, one, more}), std::invalid_argument);
  EXPECT_THROW(two_stage_impact({A, u, one, u}), std::invalid_argument);
  EXPECT_THROW(two_stage_impact({A, u, one, one}, {.max_passes = 1}), std::invalid_argument);
}

TEST(TwoStageImpact, ChangesNothingIfASolveFails) {
  const MatX fixed = Vec3(0, 1, 1).asDiagonal();
  const VecX u{{-1, 1, 0}}, one{{1.0}};
  const FrictionImpactResult result = two_stage_impact({fixed, u, one, one});
  EXPECT_EQ(result.status, Status::no_solution);
  EXPECT_EQ(result.r, VecX::Zero(3));
  EXPECT_EQ(result.u, u);
}

// Tresca's friction: forces known, the energy taken out the most.
TEST(Discs, TakeOutMoreEnergyThanAnyOtherFriction) {
  std::mt19937_64 random(20080103);
  for (int draw = 0; draw < 50; ++draw) {
    SCOPED_TRACE(draw);
    const OwnProblem p = random_problem(random, 3, 6, 0);
    const VecX radius = random_matrix(random, 3, 1).cwiseAbs();
    const ConeResult result = solve_discs(p.A, p.b, radius, Method::combined, {});
    ASSERT_EQ(result.status, Status::solved);
    const auto energy = [&](VecX r) {
      for (Eigen::Index i = 0; i < 9; i += 3) r[i] = 0;
      return energy_change(p, r);
    };
    const double ours = energy(result.r);
    for (Eigen::Index i = 0; i < 3; ++i) EXPECT_NEAR(result.r[3 * i], radius[i], 1e-9);
    for (int other = 0; other < 100; ++other) {
      VecX r = random_matrix(random, 9, 1);
      for (Eigen::Index i = 0; i < 3; ++i) r.segment<2>(3 * i + 1) *= radius[i] / std::sqrt(2.0);
      EXPECT_GE(energy(r), ours - 1e-9);
    }
  }
}

// The law's own bounds, stage by stage: any µ up to 3, any restitutions, any heap, masses over four decades.
RC_GTEST_PROP(TwoStageImpactProperties, NoImpactGainsEnergy, ()) {
  std::mt19937_64 random = test::random_engine();
  const int bodies = *rc::gen::inRange(2, 6), points = *rc::gen::inRange(1, 5),
            decades = *rc::gen::inRange(0, 5);
  OwnProblem p = heap_problem(lcp::random_heap(random, bodies, points, decades, 1, bodies % 2 == 0), 0);
  for (double& mu : p.mu) mu = std::max(0.0, uniform(random, -0.5, 3));
  VecX e(p.mu.size());
  for (double& restitution : e) restitution = uniform(random, 0, 1);
  const FrictionImpactResult result = two_stage_impact({p.A, p.b, p.mu, e});
  RC_ASSERT(result.status == Status::solved);
  const double error = 1e-8 * size_of(p, result.r) * result.r.lpNorm<1>();
  RC_ASSERT(result.energy_change <= error);
  RC_ASSERT(result.fastest_approach <= 1e-8 * size_of(p, result.r));
  double sum = 0;
  for (const ImpactPass& pass : result.passes) {
    const double stored = 0.5 * pass.compression.dot(p.A * pass.compression);
    RC_ASSERT(pass.cap >= 0 && pass.cap <= 1);
    RC_ASSERT(pass.compressed <= -stored + error);
    RC_ASSERT(pass.expanded <= stored + error);
    sum += pass.compressed + pass.expanded;
    for (Eigen::Index i = 0; i < p.mu.size(); ++i) {
      const Vec3 r = pass.compression.segment<3>(3 * i) + pass.expansion.segment<3>(3 * i);
      RC_ASSERT(r.tail<2>().norm() <= p.mu[i] * r[0] * (1 + 1e-8) + 1e-12);
    }
  }
  RC_ASSERT(std::abs(sum - result.energy_change) <= error);
}

// A single rod at any angle, µ to 3: the law of the notes' 1,500 rods.
RC_GTEST_PROP(TwoStageImpactProperties, NoRodGainsEnergy, ()) {
  std::mt19937_64 random = test::random_engine();
  const double angle = uniform(random, 0, 1.57), c = std::cos(angle), s = std::sin(angle);
  const MatX A{{1 + 3 * c * c, -3 * s * c, 0}, {-3 * s * c, 1 + 3 * s * s, 0}, {0, 0, 4}};
  const VecX u{{-1, uniform(random, -3, 3), uniform(random, -1, 1)}};
  const FrictionImpactResult result = impact(A, u, uniform(random, 0, 3), uniform(random, 0, 1));
  RC_ASSERT(result.status == Status::solved);
  RC_ASSERT(result.energy_change <= 1e-12);
  RC_ASSERT(result.u[0] >= -1e-9);
}

}  // namespace
}  // namespace fc::friction
