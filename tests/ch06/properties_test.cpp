// Properties of every answer, whatever the problem: random contacts and heaps of boxes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

#include "ch06_friction/friction_solver.hpp"
#include "cones.hpp"
#include "tests/support/random_engine.hpp"

namespace fc::friction {
namespace {

// ΔE = -½ r'Ar - Σ µ r_N |u_T| <= -½ r'Ar (R24 of the notes), in J; the errors allowed are those of velocities times
// impulses.
void keeps_the_energy_account(const ConeProblem& p, const ConeResult& result) {
  const double half = 0.5 * result.r.dot(p.A * result.r), change = energy_change(p, result.r);
  double heat = 0;
  for (Eigen::Index i = 0; i < p.contacts(); ++i)
    heat += p.mu[i] * result.r[3 * i] * result.u.segment<2>(3 * i + 1).norm();
  const double error = 1e-8 * size_of(p, result.r) * result.r.lpNorm<1>();
  RC_ASSERT(change <= -half + error);
  RC_ASSERT(std::abs(change + half + heat) <= error);
}

// Two to six boxes, one of them fixed or none, up to four points a pair, each once or several times; µ differs from
// contact to contact.
OwnProblem random_heap_problem(std::mt19937_64& random, double decades, double most_mu) {
  const int bodies = *rc::gen::inRange(2, 7), points = *rc::gen::inRange(1, 5),
            copies = *rc::gen::inRange(1, 4);
  const bool floor = *rc::gen::arbitrary<bool>();
  OwnProblem p = heap_problem(lcp::random_heap(random, bodies, points, decades, copies, floor), 0);
  for (double& mu : p.mu) mu = std::max(0.0, uniform(random, -0.2 * most_mu, most_mu));
  return p;
}

RC_GTEST_PROP(FrictionProperties, HeapsAreSolvedAndLoseEnergy, ()) {
  std::mt19937_64 random = test::random_engine();
  const OwnProblem p = random_heap_problem(random, 0, *rc::gen::element(0.3, 1.0, 3.0));
  const ConeResult result = solve(p);
  RC_ASSERT(result.status == Status::solved);
  RC_ASSERT(result.residual <= 1e-10);
  RC_ASSERT(broken_law(p, result.r, result.u) <= 1e-9 * size_of(p, result.r));
  keeps_the_energy_account(p, result);
}

RC_GTEST_PROP(FrictionProperties, MassesOverEightDecadesAreNoOtherLaw, ()) {
  std::mt19937_64 random = test::random_engine();
  const OwnProblem p = random_heap_problem(random, 8, 1.0);
  const ConeResult result = solve(p);
  RC_ASSERT(result.status == Status::solved);
  RC_ASSERT(broken_law(p, result.r, result.u) <= 1e-9 * size_of(p, result.r));
  keeps_the_energy_account(p, result);
}

// Rank far below the number of rows.
RC_GTEST_PROP(FrictionProperties, RedundantContactsAreSolved, ()) {
  std::mt19937_64 random = test::random_engine();
  const Eigen::Index n = *rc::gen::inRange(1, 13), freedom = *rc::gen::inRange(1, 7);
  OwnProblem p = random_problem(random, n, freedom, 0);
  for (double& mu : p.mu) mu = uniform(random, 0, 1);
  const ConeResult result = solve(p);
  RC_ASSERT(result.status == Status::solved);
  keeps_the_energy_account(p, result);
}

// Units of mass and of time.
RC_GTEST_PROP(FrictionProperties, DoNotDependOnUnits, ()) {
  std::mt19937_64 random = test::random_engine();
  const int bodies = *rc::gen::inRange(2, 6), points = *rc::gen::inRange(1, 4);
  const OwnProblem p = heap_problem(lcp::random_heap(random, bodies, points, 0, 1, true), 0.2);
  const double mass = std::exp2(*rc::gen::inRange(-20, 21)), speed = std::exp2(*rc::gen::inRange(-20, 21));
  const MatX A = p.A / mass;
  const VecX b = p.b * speed;
  for (const Method method : kMethods) {
    const ConeResult here = solve(p, method), there = solve({A, b, p.mu}, method);
    if (method == Method::combined)
      RC_ASSERT(here.status == Status::solved && there.status == Status::solved);
    if (here.status != Status::solved || there.status != Status::solved) continue;
    RC_ASSERT((there.u / speed - here.u).norm() <= 1e-7 * size_of(p, here.r));
  }
}

// Friction of at most 0.3, well inside the bodies: where answers are unique, other tangents, the mirrored world, and
// another order of the contacts lead to the same velocities: u there is T u here.
// Bodies touch at one point a pair.
void has_the_same_velocities(const OwnProblem& here, const MatX& T, const VecX& mu_there) {
  const MatX A = T * here.A * T.transpose();
  const VecX b = T * here.b;
  const ConeResult first = solve(here), second = solve({A, b, mu_there});
  RC_ASSERT(first.status == Status::solved && second.status == Status::solved);
  RC_ASSERT((second.u - T * first.u).lpNorm<Eigen::Infinity>() <= 1e-7 * size_of(here, first.r));
}

RC_GTEST_PROP(FrictionProperties, TurnedAndMirroredTangentsChangeNoMotion, ()) {
  std::mt19937_64 random = test::random_engine();
  const int bodies = *rc::gen::inRange(2, 6);
  const OwnProblem p = heap_problem(lcp::random_heap(random, bodies, 1, 0, 1, true), 0.2);
  MatX T = MatX::Zero(p.b.size(), p.b.size());
  for (Eigen::Index i = 0; i < p.mu.size(); ++i) {
    const double angle = uniform(random, 0, 6), c = std::cos(angle), s = std::sin(angle);
    const double sign = uniform(random, -1, 1) < 0 ? -1 : 1;
    T.block<3, 3>(3 * i, 3 * i) << 1, 0, 0, 0, c, -s * sign, 0, s, c * sign;
  }
  has_the_same_velocities(p, T, p.mu);
}

RC_GTEST_PROP(FrictionProperties, TheOrderOfContactsChangesNoMotion, ()) {
  std::mt19937_64 random = test::random_engine();
  const int bodies = *rc::gen::inRange(2, 6);
  OwnProblem p = heap_problem(lcp::random_heap(random, bodies, 1, 0, 1, true), 0);
  for (double& mu : p.mu) mu = uniform(random, 0, 0.3);
  const Eigen::Index n = p.mu.size();
  MatX T = MatX::Zero(3 * n, 3 * n);
  for (Eigen::Index i = 0; i < n; ++i) T.block<3, 3>(3 * i, 3 * (n - 1 - i)).setIdentity();
  has_the_same_velocities(p, T, p.mu.reverse());
}

// Painlevé's rod beside an unconnected body: always an answer, and the preferred one.
RC_GTEST_PROP(FrictionProperties, PainleveHasAnAnswerInAnyCompany, ()) {
  std::mt19937_64 random = test::random_engine();
  const OwnProblem other = random_problem(random, 2, 6, 0.5);
  MatX A = MatX::Zero(9, 9);
  A.topLeftCorner(3, 3) = painleve_block();
  A.bottomRightCorner(6, 6) = other.A;
  VecX b(9), mu{{1.5, 0.5, 0.5}};
  b << -std::exp(uniform(random, -20, 0)), -1, 0, other.b;
  const ConeResult result = solve({A, b, mu});
  RC_ASSERT(result.status == Status::solved);
  RC_ASSERT(result.u.head<3>().norm() <= 1e-9);  // it stops dead
  RC_ASSERT(result.r[0] >= 0.3 - 1e-9);
}

}  // namespace
}  // namespace fc::friction
