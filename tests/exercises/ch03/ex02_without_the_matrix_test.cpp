// Exercise 3.2. The chapter's matrix, eigenvalues from a library and closed forms are the oracles.
#include "ex02_without_the_matrix.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/solver.hpp"

namespace {

using fc::MatX;
using fc::RigidBody;
using fc::Vec3;
using fc::VecX;
using fc::exercises::delassus_times;
using fc::exercises::largest_eigenvalue;
using fc::exercises::Masses;
using fc::lcp::Contact;

struct Scene {
  std::vector<RigidBody> bodies;
  std::vector<Contact> contacts;
};

struct Any {
  std::mt19937_64 random{7};
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Vec3 vector() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }
  VecX numbers(std::size_t n) {
    VecX z(static_cast<Eigen::Index>(n));
    for (double& x : z) x = number(-1, 1);
    return z;
  }
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
VecX times(const Scene& scene, const VecX& z) {
  Masses masses(scene.bodies);
  return delassus_times(masses, scene.contacts, z);
}
double largest(const Scene& scene, int products = 400) {
  Masses masses(scene.bodies);
  return largest_eigenvalue(masses, scene.contacts, products);
}

TEST(Ex02WithoutTheMatrix, ABallOnTheFloor) {
  const Scene scene{{{}, ball({0, 0, 0.5}, 4)}, {{0, 1, Vec3::Zero(), Vec3::UnitZ(), 0, 0}}};
  EXPECT_DOUBLE_EQ(times(scene, VecX{{2}})[0], 0.5)
      << "m/s: 2 N s on a ball of 4 kg, through its centre; the floor does not move";
}

TEST(Ex02WithoutTheMatrix, ThreeBallsInARow) {
  const VecX w = times(row_of_balls(3), VecX{{1, 0}});
  EXPECT_NEAR(w[0], 2, 1e-15) << "m/s: 1 N s pushes two balls of 1 kg apart, each at 1 m/s";
  EXPECT_NEAR(w[1], -1, 1e-15) << "m/s: and the middle one is driven against the third";
}

TEST(Ex02WithoutTheMatrix, ACornerTurnsTheCube) {
  const VecX w = times(cube_on_floor(), VecX{{1, 0, 0, 0}});
  // r x n = (1/2, -1/2, 0), inertia 1/6: 1/m + (r x n).(s x n)/I is 1 + 6/2, 1, 1 - 6/2, 1.
  const VecX expected{{4, 1, -2, 1}};
  EXPECT_LE((w - expected).norm(), 1e-14)
      << "m/s at the corners: expected " << expected.transpose() << ", got " << w.transpose()
      << "; 1 N s at one corner lifts the cube and turns it, and the far corner goes down";
}

TEST(Ex02WithoutTheMatrix, OppositePushesAroundTheCornersDoNothing) {
  const Scene scene = cube_on_floor();
  EXPECT_LE(times(scene, VecX{{1, -1, 1, -1}}).norm(), 1e-15)
      << "m/s: four corners, three ways to move; these impulses change no velocity, which is why A is "
         "singular";
  EXPECT_NEAR(times(scene, VecX{{1, 1, 1, 1}}).sum(), 16, 1e-13)
      << "m/s, the sum over the corners: 4 N s on 1 kg make 4 m/s at each of four corners";
}

TEST(Ex02WithoutTheMatrix, IsTheChaptersMatrix) {
  Any any;
  for (int trial = 0; trial < 100; ++trial) {
    const Scene scene = jumble(any, 2 + trial % 7, 1 + trial % 23);
    const MatX A = matrix(scene);
    const VecX z = any.numbers(scene.contacts.size()), expected = A * z, got = times(scene, z);
    const double size = (A.cwiseAbs() * z.cwiseAbs()).maxCoeff();
    ASSERT_EQ(got.size(), expected.size());
    ASSERT_LE((got - expected).lpNorm<Eigen::Infinity>(), 1e-12 * size)
        << "m/s: expected A z = " << expected.transpose() << ", got " << got.transpose()
        << " (boxes that are turned, contacts off their centres, some bodies static)";
  }
}

TEST(Ex02WithoutTheMatrix, WhichBodyIsCalledADoesNotMatter) {
  Any any;
  Scene scene = jumble(any, 6, 12);
  const VecX z = any.numbers(12), w = times(scene, z);
  for (Contact& contact : scene.contacts) {
    std::swap(contact.body_a, contact.body_b);
    contact.normal = -contact.normal;
  }
  EXPECT_LE((times(scene, z) - w).norm(), 1e-13 * w.norm())
      << "m/s: the same contacts told the other way round; they push bodies apart as before";
}

TEST(Ex02WithoutTheMatrix, PushesNeverTakeEnergy) {
  Any any;
  for (int trial = 0; trial < 50; ++trial) {
    const Scene scene = jumble(any, 5, 15);
    const VecX z = any.numbers(15), y = any.numbers(15), Az = times(scene, z), Ay = times(scene, y);
    ASSERT_GE(z.dot(Az), -1e-12 * z.norm() * Az.norm())
        << "J: z'Az is twice the kinetic energy that the impulses give to bodies at rest";
    ASSERT_NEAR(y.dot(Az), z.dot(Ay), 1e-12 * y.norm() * Az.norm())
        << "J: a push here is felt there as much as a push there is felt here";
  }
}

TEST(Ex02WithoutTheMatrix, APlateUnderFiveThousandBalls) {
  // The plate has 100 kg and is free; the balls stand on it symmetrically. A is full: 25 million entries.
  constexpr int n = 5000;
  Scene scene;
  scene.bodies.push_back({});
  scene.bodies[0].set_mass(fc::box_mass({100, 100, 0.01}, 1));
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    const Vec3 place(40 * std::cos(angle), 40 * std::sin(angle), 0.005);
    scene.bodies.push_back(ball(place + Vec3(0, 0, 0.1), 0.5));
    scene.contacts.push_back({0, i + 1, place, Vec3::UnitZ(), 0, 0});
  }
  Masses masses(scene.bodies);
  const VecX w = delassus_times(masses, scene.contacts, VecX::Ones(n));
  EXPECT_LE(masses.kicks(), n + 1)
      << "kicks: there are 5001 bodies, and each answers once to all its contacts "
         "together; a kick per contact or per pair of contacts is too many";
  EXPECT_NEAR(w.maxCoeff(), 52, 1e-9) << "m/s: 1 N s per ball, 1 / 0.5 kg each, and 5000 N s on 100 kg";
  EXPECT_NEAR(w.minCoeff(), 52, 1e-9) << "m/s: the pushes lie symmetrically, and the plate does not turn";
}

TEST(Ex02WithoutTheMatrix, TheLargestEigenvalueOfARow) {
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

TEST(Ex02WithoutTheMatrix, TheLargestEigenvalueOfAJumble) {
  Any any;
  for (int trial = 0; trial < 40; ++trial) {
    const Scene scene = jumble(any, 4 + trial % 9, 2 + trial);
    const double truth = Eigen::SelfAdjointEigenSolver<MatX>(matrix(scene)).eigenvalues().maxCoeff();
    const double got = largest(scene);
    ASSERT_GE(got, 0.98 * truth) << "1/kg: expected " << truth << " (" << scene.contacts.size()
                                 << " contacts)";
    ASSERT_LE(got, truth * (1 + 1e-12)) << "1/kg: more than there is";
  }
}

TEST(Ex02WithoutTheMatrix, TheLargestEigenvalueOfNothing) {
  EXPECT_EQ(largest({}), 0) << "1/kg: no contacts";
  const Scene walls{{{}, {}}, {{0, 1, Vec3::Zero(), Vec3::UnitX(), 0, 0}}};
  EXPECT_EQ(largest(walls), 0) << "1/kg: two walls; no impulse moves them (0/0 is no answer)";
}

TEST(Ex02WithoutTheMatrix, SpendsNoMoreProductsThanItMay) {
  const Scene scene = row_of_balls(10);
  for (const int products : {1, 7, 50}) {
    Masses masses(scene.bodies);
    const double got = largest_eigenvalue(masses, scene.contacts, products);
    EXPECT_LE(masses.kicks(), 10 * products) << "kicks: " << products << " products with 10 bodies";
    EXPECT_GT(got, 0) << "1/kg, after " << products << " products: a lower bound that says nothing";
  }
}

TEST(Ex02WithoutTheMatrix, GradientsSolveTheChaptersProblem) {
  Scene scene = row_of_balls(6);
  scene.bodies[0].velocity = {1, 0, 0};
  const fc::lcp::ImpactProblem problem = fc::lcp::assemble(scene.bodies, scene.contacts);
  const VecX expected = fc::lcp::solve({problem.A, problem.b}).z;
  Masses masses(scene.bodies);
  const double top = largest_eigenvalue(masses, scene.contacts, 400);
  const VecX got = fc::exercises::projected_gradients(masses, scene.contacts, problem.b, top, 500);
  EXPECT_LE((got - expected).norm(), 1e-9) << "N s: expected " << expected.transpose() << ", got "
                                           << got.transpose() << " from 500 products and no matrix";
}

}  // namespace
