// The Delassus matrix against its definition.
#include "ch03_impulse_lcp/delassus.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>
#include <random>
#include <stdexcept>

#include "bodies.hpp"

namespace fc::lcp {
namespace {

// Definition: A_ij is what a unit impulse at contact j changes in the velocity at contact i.
MatX by_definition(const std::vector<RigidBody>& bodies, const std::vector<Contact>& contacts) {
  const auto n = static_cast<Eigen::Index>(contacts.size());
  MatX A(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    std::vector<RigidBody> pushed = bodies;
    const Contact& c = contacts[static_cast<std::size_t>(j)];
    for (const bool on_b : {false, true}) {
      RigidBody& body = pushed[static_cast<std::size_t>(on_b ? c.body_b : c.body_a)];
      const Vec3 push = on_b ? c.normal : Vec3(-c.normal);
      body.velocity += body.inverse_mass * push;
      body.spin += body.inverse_inertia_world() * (c.point - body.position).cross(push);
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      const Contact& at = contacts[static_cast<std::size_t>(i)];
      A(i, j) = contact_velocity(pushed, at) - contact_velocity(bodies, at);
    }
  }
  return A;
}

TEST(Delassus, IsTheResponseToUnitImpulses) {
  std::vector<RigidBody> bodies{wall(), box({0, 0, 0.5}, {1, 2, -3}, 2, {1, 2, 0.5}),
                                ball({0.2, 0.1, 1.5}, {0, 1, -1}, 0.3)};
  bodies[1].orientation = Quat(0.9, 0.1, -0.3, 0.2).normalized();
  bodies[1].spin = {0.3, -2, 1};
  const std::vector<Contact> contacts{{0, 1, {0.4, 0.3, 0}, Vec3(0.1, 0.2, 1).normalized(), 0, 0.5},
                                      {1, 0, {-0.4, 0.3, 0}, -Vec3::UnitZ(), 0, 0.25},
                                      {1, 2, {0.2, 0.1, 1}, Vec3::UnitZ(), 0, 0}};
  const ImpactProblem problem = assemble(bodies, contacts);
  EXPECT_LE((problem.A - by_definition(bodies, contacts)).lpNorm<Eigen::Infinity>(),
            1e-14 * problem.A.maxCoeff());
  EXPECT_EQ(problem.A, problem.A.transpose());  // exactly
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatX>(problem.A).eigenvalues()[0], 0);
  for (int i = 0; i < 3; ++i) {
    const double v = contact_velocity(bodies, contacts[static_cast<std::size_t>(i)]);
    EXPECT_EQ(problem.v_before[i], v);
    EXPECT_EQ(problem.b[i], (1 + contacts[static_cast<std::size_t>(i)].restitution) * v);
  }
}

TEST(DelassusOperator, IsTheMatrixWithoutItsEntries) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Heap heap = random_heap(random, 12, 3, 6, 1, trial % 2 == 0);
    const MatX A = assemble(heap.bodies, heap.contacts).A;
    DelassusOperator product(heap.bodies, heap.contacts);
    ASSERT_EQ(product.size(), A.rows());
    const VecX z = VecX::Random(A.rows());
    VecX v;
    product.apply(z, v);
    EXPECT_LE((v - A * z).lpNorm<Eigen::Infinity>(), 1e-13 * (A.cwiseAbs() * z.cwiseAbs()).maxCoeff());
    product.apply(VecX::Zero(A.rows()), v);  // nothing is left of the previous problem
    EXPECT_EQ(v, VecX(VecX::Zero(A.rows())));
    EXPECT_LE((product.diagonal() - A.diagonal()).lpNorm<Eigen::Infinity>(), 1e-14 * A.maxCoeff());
  }
  const std::vector<RigidBody> bodies{wall(), ball({0, 0, 0.5}, Vec3::Zero())};
  const std::vector<Contact> bad{{0, 2, {0, 0, 0}, Vec3::UnitZ(), 0, 0}};
  EXPECT_THROW(DelassusOperator(bodies, bad), std::invalid_argument);
}

TEST(Delassus, ContactsWithoutACommonMovingBodyDoNotCouple) {
  // Two balls on one static floor: the floor couples nothing.
  const std::vector<RigidBody> bodies{wall(), ball({0, 0, 0.5}, Vec3::Zero()),
                                      ball({3, 0, 0.5}, Vec3::Zero())};
  const std::vector<Contact> contacts{{0, 1, {0, 0, 0}, Vec3::UnitZ(), 0, 0},
                                      {0, 2, {3, 0, 0}, Vec3::UnitZ(), 0, 0}};
  EXPECT_EQ(assemble(bodies, contacts).A, MatX(MatX::Identity(2, 2)));
}

TEST(Delassus, IsSingularForRedundantContacts) {
  const std::vector<RigidBody> bodies{wall(), box({0, 0, 0.5}, Vec3::Zero())};
  std::vector<Contact> contacts;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) contacts.push_back({0, 1, {x, y, 0}, Vec3::UnitZ(), 0, 0});
  }
  const VecX eigenvalues = Eigen::SelfAdjointEigenSolver<MatX>(assemble(bodies, contacts).A).eigenvalues();
  EXPECT_NEAR(eigenvalues[0], 0, 1e-14);
  EXPECT_GT(eigenvalues[1], 0.1);  // rank 3: height and two tilts
}

TEST(Delassus, RefusesCallersMistakes) {
  std::vector<RigidBody> bodies{wall(), ball({0, 0, 0.5}, Vec3::Zero())};
  const Contact good{0, 1, {0, 0, 0}, Vec3::UnitZ(), 0, 0.5};
  const auto refused = [&](Contact contact) {
    EXPECT_THROW(assemble(bodies, std::vector{contact}), std::invalid_argument);
  };
  Contact bad = good;
  bad.body_b = 2, refused(bad);
  bad.body_b = -1, refused(bad);
  bad.body_b = 0, refused(bad);
  bad = good, bad.normal *= 2, refused(bad);
  bad = good, bad.restitution = 1.5, refused(bad);
  bad = good, bad.restitution = std::numeric_limits<double>::quiet_NaN(), refused(bad);
  bad = good, bad.point.x() = std::numeric_limits<double>::infinity(), refused(bad);
  bodies[1].velocity.x() = std::numeric_limits<double>::quiet_NaN();
  refused(good);
}

}  // namespace
}  // namespace fc::lcp
