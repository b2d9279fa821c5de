// Exercise 3.2. The chapter's matrix, eigenvalues from a library and closed forms are the oracles.
#include "ex02_momentum.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "ch03_impulse_lcp/delassus.hpp"

namespace {

using fc::MatX;
using fc::RigidBody;
using fc::Vec3;
using fc::VecX;
using fc::exercises::largest_eigenvalue;
using fc::exercises::momentum_gradients;
using fc::exercises::Products;
using fc::lcp::Contact;

struct Scene {
  std::vector<RigidBody> bodies;
  std::vector<Contact> contacts;
};

struct Any {
  std::mt19937_64 random{7};
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Vec3 vector() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }
};

RigidBody ball(const Vec3& position, double mass) {
  RigidBody body;
  body.position = position;
  body.set_mass({mass, Vec3::Zero(), 0.1 * mass * fc::Mat3::Identity()});
  return body;
}
// Balls of 1 kg and of diameter 1 in a row.
Scene row_of_balls(int n) {
  Scene scene;
  for (int i = 0; i < n; ++i) scene.bodies.push_back(ball({i + 0.0, 0, 0}, 1));
  for (int i = 0; i + 1 < n; ++i) scene.contacts.push_back({i, i + 1, {i + 0.5, 0, 0}, Vec3::UnitX(), 0, 1});
  return scene;
}
// A cube of 1 kg on a static floor, on its four corners.
Scene cube_on_floor() {
  Scene scene;
  scene.bodies.resize(2);
  scene.bodies[1].position = {0, 0, 0.5};
  scene.bodies[1].set_mass(fc::box_mass({1, 1, 1}, 1));
  for (const Vec3& p : {Vec3(0.5, 0.5, 0), Vec3(-0.5, 0.5, 0), Vec3(-0.5, -0.5, 0), Vec3(0.5, -0.5, 0)})
    scene.contacts.push_back({0, 1, p, Vec3::UnitZ(), 0, 0});
  return scene;
}
// Boxes that are turned at random, a third of them static, with contacts between any two, anywhere.
Scene jumble(Any& any, int bodies, int contacts) {
  Scene scene;
  for (int k = 0; k < bodies; ++k) {
    RigidBody body;
    body.position = 3 * any.vector();
    body.orientation = Eigen::AngleAxisd(any.number(0, 3), any.vector().normalized());
    if (k % 3 != 0)
      body.set_mass(fc::box_mass({any.number(0.1, 1), any.number(0.1, 1), any.number(0.1, 1)}, 2));
    scene.bodies.push_back(body);
  }
  for (int i = 0; i < contacts; ++i) {
    const int a = static_cast<int>(any.number(0, bodies - 1e-9));
    const int b = (a + 1 + static_cast<int>(any.number(0, bodies - 1 - 1e-9))) % bodies;
    scene.contacts.push_back({a, b, 3 * any.vector(), any.vector().normalized(), 0, 0});
  }
  return scene;
}
MatX matrix(const Scene& scene) {
  return fc::lcp::assemble(scene.bodies, scene.contacts).A;
}
double largest(const Scene& scene, int products = 400) {
  Products A(scene.bodies, scene.contacts);
  return largest_eigenvalue(A, products);
}
// The first ball runs into the row at 1 m/s.
Scene struck_row(int n) {
  Scene scene = row_of_balls(n);
  scene.bodies[0].velocity = {1, 0, 0};
  return scene;
}
// How far z is from solving the scene's LCP: max |min(A_ii z_i, w_i)|, m/s.
double fault(const Scene& scene, const VecX& z) {
  const fc::lcp::ImpactProblem problem = fc::lcp::assemble(scene.bodies, scene.contacts);
  const VecX w = problem.A * z + problem.b;
  return problem.A.diagonal().cwiseProduct(z).cwiseMin(w).lpNorm<Eigen::Infinity>();
}
VecX with_momentum(const Scene& scene, int products) {
  const fc::lcp::ImpactProblem problem = fc::lcp::assemble(scene.bodies, scene.contacts);
  const double top = Eigen::SelfAdjointEigenSolver<MatX>(problem.A).eigenvalues().maxCoeff();
  Products A(scene.bodies, scene.contacts);
  const VecX z = momentum_gradients(A, problem.b, 0.985 * top, products);
  EXPECT_LE(A.spent(), products) << "products with A: more than were allowed";
  return z;
}

TEST(Ex02Momentum, TheLargestEigenvalueOfARow) {
  // The matrix 2, -1 of a chain of n contacts: 2 + 2 cos(pi / (n + 1)).
  for (const int contacts : {1, 2, 3, 5, 20, 200}) {
    const double truth = 2 + 2 * std::cos(std::numbers::pi / (contacts + 1));
    const double got = largest(row_of_balls(contacts + 1));
    EXPECT_GE(got, 0.98 * truth)
        << "1/kg: expected " << truth << " for " << contacts
        << " contacts; a smaller one makes the gradients' steps too long, and energy grows. "
           "(The fastest answer is to impulses of alternating sign.)";
    EXPECT_LE(got, truth * (1 + 1e-12)) << "1/kg: more than there is, for " << contacts << " contacts";
  }
}

TEST(Ex02Momentum, TheLargestEigenvalueOfAJumble) {
  Any any;
  for (int trial = 0; trial < 40; ++trial) {
    const Scene scene = jumble(any, 4 + trial % 9, 2 + trial);
    const double truth = Eigen::SelfAdjointEigenSolver<MatX>(matrix(scene)).eigenvalues().maxCoeff();
    const double got = largest(scene);
    ASSERT_GE(got, 0.98 * truth) << "1/kg: expected " << truth << " (" << scene.contacts.size()
                                 << " contacts)";
    ASSERT_LE(got, truth * (1 + 1e-12))
        << "1/kg: more than the largest eigenvalue, which no z'Az / z'z can be";
  }
}

TEST(Ex02Momentum, TheLargestEigenvalueOfNothing) {
  EXPECT_EQ(largest({}), 0) << "1/kg: without contacts there is no eigenvalue, and 0 is asked for";
  const Scene walls{{{}, {}}, {{0, 1, Vec3::Zero(), Vec3::UnitX(), 0, 0}}};
  EXPECT_EQ(largest(walls), 0) << "1/kg: two walls; no impulse moves them (0/0 is no answer)";
}

TEST(Ex02Momentum, TheEigenvalueSpendsNoMoreProductsThanItMay) {
  const Scene scene = row_of_balls(10);
  for (const int products : {1, 7, 50}) {
    Products A(scene.bodies, scene.contacts);
    const double got = largest_eigenvalue(A, products);
    EXPECT_LE(A.spent(), products) << "products with A: more than were allowed";
    EXPECT_GT(got, 0) << "1/kg, after " << products << " products: a lower bound that says nothing";
  }
}

TEST(Ex02Momentum, SolvesALongRowInTime) {
  for (const int balls : {3, 10, 40, 100}) {
    const Scene scene = struck_row(balls);
    const VecX z = with_momentum(scene, 1000);
    EXPECT_LE(fault(scene, z), 2e-6) << "m/s: " << balls
                                     << " balls in a row, the first at 1 m/s, after 1000 products; plain "
                                     << "gradients are that far only after tens of thousands for 100 balls";
  }
}

TEST(Ex02Momentum, NeverPulls) {
  for (const int products : {1, 2, 5, 17, 60}) {
    const VecX z = with_momentum(struck_row(20), products);
    EXPECT_GE(z.minCoeff(), 0) << "N s, after " << products
                               << " products: contacts push, they do not pull, at no time";
  }
}

TEST(Ex02Momentum, OneProductIsAPlainStep) {
  const Scene scene = struck_row(5);
  const VecX z = with_momentum(scene, 1);
  EXPECT_NEAR(z[0], 2 / (2 + std::sqrt(3.0)), 0.03)
      << "N s: from rest, 2 m/s of closing over the largest eigenvalue";
  EXPECT_EQ(z.tail(3).norm(), 0) << "N s: the other contacts do not approach yet";
}

TEST(Ex02Momentum, RedundantContactsHaveTheRightVelocities) {
  Scene scene = cube_on_floor();
  scene.bodies[1].velocity = {0, 0, -2};
  scene.bodies[1].spin = {0.3, 0.5, 0};
  EXPECT_LE(fault(scene, with_momentum(scene, 300)), 2e-6)
      << "m/s: a cube on four corners; A is singular, its impulses are not unique, its velocities are";
}

TEST(Ex02Momentum, NothingApproachesNothingPushes) {
  Scene scene = row_of_balls(4);
  scene.bodies[0].velocity = {-1, 0, 0};
  EXPECT_EQ(with_momentum(scene, 20).norm(), 0) << "N s: the balls move apart by themselves";
}

TEST(Ex02Momentum, ManySeparateAndSomePush) {
  Any any;
  for (int trial = 0; trial < 30; ++trial) {
    Scene scene = jumble(any, 6, 8);
    for (RigidBody& body : scene.bodies) {
      if (body.is_static()) continue;
      body.velocity = any.vector();
      body.spin = any.vector();
    }
    const VecX z = with_momentum(scene, 4000);
    const double size = fc::lcp::assemble(scene.bodies, scene.contacts).b.lpNorm<Eigen::Infinity>();
    ASSERT_LE(fault(scene, z), 1e-4 * size) << "m/s: 8 contacts between 6 boxes, after 4000 products";
  }
}

}  // namespace
