// Mass properties against closed forms, and what must not change under motions.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <stdexcept>

#include "common/convex_hull.hpp"
#include "common/mass_properties.hpp"
#include "tests/mesh/test_meshes.hpp"

namespace fc {
namespace {

constexpr double kPi = std::numbers::pi;

double relative(const Mat3& a, const Mat3& b) {
  return (a - b).norm() / b.norm();
}

TEST(MassProperties, SphereBoxAndCapsule) {
  const MassProperties ball = sphere_mass(2, 3);
  EXPECT_DOUBLE_EQ(ball.mass, 32 * kPi);
  EXPECT_LT(relative(ball.inertia, 0.4 * 32 * kPi * 4 * Mat3::Identity()), 1e-15);

  const MassProperties box = box_mass({1, 2, 3}, 2);
  EXPECT_DOUBLE_EQ(box.mass, 12);
  EXPECT_LT(relative(box.inertia, Vec3(13, 10, 5).asDiagonal()), 1e-15);

  // A capsule without a length is a sphere; a very long one is a rod.
  EXPECT_LT(relative(capsule_mass(2, 0, 3).inertia, ball.inertia), 1e-15);
  const MassProperties rod = capsule_mass(1e-4, 1, 1);
  EXPECT_NEAR(rod.inertia(0, 0) / rod.mass, 1.0 / 12, 1e-4);
  EXPECT_NEAR(rod.inertia(2, 2) / rod.mass, 0.5e-8, 1e-11);
}

// A capsule's integrals by cutting it into thin discs.
TEST(MassProperties, CapsuleAgreesWithQuadrature) {
  const double r = 0.7, length = 1.3, density = 5;
  double mass = 0, across = 0, along = 0;
  const int n = 200000;
  const double h = (length + 2 * r) / n;
  for (int i = 0; i < n; ++i) {
    const double z = -length / 2 - r + (i + 0.5) * h;
    const double beyond = std::max(0.0, std::abs(z) - length / 2);
    const double r2 = r * r - beyond * beyond;
    const double disc = density * kPi * r2 * h;
    mass += disc;
    along += disc * r2 / 2;
    across += disc * (r2 / 4 + z * z);
  }
  const MassProperties capsule = capsule_mass(r, length, density);
  EXPECT_NEAR(capsule.mass / mass, 1, 1e-9);
  EXPECT_NEAR(capsule.inertia(2, 2) / along, 1, 1e-9);
  EXPECT_NEAR(capsule.inertia(0, 0) / across, 1, 1e-9);
  EXPECT_EQ(capsule.inertia(0, 0), capsule.inertia(1, 1));
}

// The same for a cylinder and a cone, about their centres of mass.
TEST(MassProperties, CylinderAndConeAgreeWithQuadrature) {
  const double r = 0.7, length = 1.3, density = 5;
  for (const bool cone : {false, true}) {
    const MassProperties solid = cone ? cone_mass(r, length, density) : cylinder_mass(r, length, density);
    double mass = 0, first = 0, across = 0, along = 0;
    const int n = 200000;
    const double h = length / n;
    for (int i = 0; i < n; ++i) {
      const double z = -length / 2 + (i + 0.5) * h;
      const double radius = cone ? r * (0.5 - z / length) : r, r2 = radius * radius;
      const double disc = density * kPi * r2 * h, arm = z - solid.center_of_mass.z();
      mass += disc;
      first += disc * z;
      along += disc * r2 / 2;
      across += disc * (r2 / 4 + arm * arm);
    }
    EXPECT_NEAR(solid.mass / mass, 1, 1e-9);
    EXPECT_NEAR(solid.center_of_mass.z(), first / mass, 1e-9);
    EXPECT_NEAR(solid.inertia(2, 2) / along, 1, 1e-9);
    EXPECT_NEAR(solid.inertia(0, 0) / across, 1, 1e-9);
    EXPECT_EQ(solid.inertia(0, 0), solid.inertia(1, 1));
  }
}

TEST(MassProperties, TetrahedronHasItsClosedForm) {
  // The corner of a cube, of edge 1: integrals of x^2 and xy over it are 1/60 and 1/120.
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const MassProperties m = solid_mass(mesh, 6);
  EXPECT_DOUBLE_EQ(m.mass, 1);
  EXPECT_LT((m.center_of_mass - Vec3::Constant(0.25)).norm(), 1e-15);
  // About the centre: 6/60 - 1/16 on the diagonal of the covariance, 6/120 - 1/16 off it.
  const double xx = 0.1 - 0.0625, xy = 0.05 - 0.0625;
  Mat3 inertia = Mat3::Constant(-xy);
  inertia.diagonal().setConstant(2 * xx);
  EXPECT_LT(relative(m.inertia, inertia), 1e-15);
}

TEST(MassProperties, BoxMeshTurnedAndFarAway) {
  const Vec3 size(1, 2, 3);
  const MassProperties box = box_mass(size, 2);
  for (double distance : {0.0, 1.0, 1e3, 1e6}) {
    const Pose pose{Quat(0.3, -1, 2, 0.5).normalized().toRotationMatrix(), distance * Vec3(1, -2, 0.5)};
    const MassProperties m = solid_mass(test::moved(test::box_mesh(-size / 2, size / 2), pose), 2);
    // The vertices themselves are rounded to the distance's last digit; nothing more may be lost.
    const double rounding = 4e-16 * (8 + 4 * distance);
    EXPECT_NEAR(m.mass, box.mass, box.mass * rounding) << distance;
    EXPECT_LT((m.center_of_mass - pose.position).norm(), rounding) << distance;
    EXPECT_LT(relative(m.inertia, pose.rotation * box.inertia * pose.rotation.transpose()), rounding)
        << distance;
  }
}

TEST(MassProperties, SphereMeshConvergesWithTheSquareOfItsEdges) {
  double previous = 0;
  for (int rings : {8, 16, 32, 64}) {
    const MassProperties m = solid_mass(test::sphere_mesh(1, rings), 1);
    const double error = relative(m.inertia, sphere_mass(1, 1).inertia);
    if (previous > 0) {
      EXPECT_NEAR(previous / error, 4, 0.4) << rings;
    }
    previous = error;
  }
  EXPECT_LT(previous, 0.01);
}

TEST(MassProperties, CavityIsEmpty) {
  const TriangleMesh hollow = test::joined(test::box_mesh(Vec3::Zero(), Vec3::Constant(3)),
                                           test::reversed(test::box_mesh(Vec3::Ones(), Vec3::Constant(2))));
  const MassProperties m = solid_mass(hollow, 1);
  EXPECT_DOUBLE_EQ(m.mass, 26);
  EXPECT_LT(relative(m.inertia, box_mass(Vec3::Constant(3), 1).inertia - box_mass(Vec3::Ones(), 1).inertia),
            1e-15);
}

TEST(MassProperties, RefusesAMeshWithoutVolume) {
  EXPECT_THROW(solid_mass(test::reversed(test::unit_cube()), 1), std::invalid_argument);
  EXPECT_THROW(solid_mass({}, 1), std::invalid_argument);
}

TriangleMesh random_hull(std::mt19937_64& random) {
  std::vector<Vec3> points;
  for (int i = 0; i < 30; ++i) points.push_back(test::random_vector(random, 1).cwiseProduct(Vec3(1, 2, 0.3)));
  return *hull_mesh(points);
}

RC_GTEST_PROP(MassProperties, TurnAndMoveWithTheMesh, ()) {
  auto random = test::random_engine();
  const TriangleMesh mesh = random_hull(random);
  const Pose pose{test::random_rotation(random), test::random_vector(random, 100)};
  const MassProperties here = solid_mass(mesh, 3), there = solid_mass(test::moved(mesh, pose), 3);
  RC_ASSERT(std::abs(there.mass / here.mass - 1) < 1e-12);
  RC_ASSERT((there.center_of_mass - pose * here.center_of_mass).norm() < 1e-12);
  RC_ASSERT(relative(there.inertia, pose.rotation * here.inertia * pose.rotation.transpose()) < 1e-12);
}

RC_GTEST_PROP(MassProperties, ScaleWithTheFifthPower, ()) {
  auto random = test::random_engine();
  TriangleMesh mesh = random_hull(random);
  const MassProperties before = solid_mass(mesh, 3);
  for (Vec3& v : mesh.vertices) v *= 2;
  const MassProperties after = solid_mass(mesh, 3);
  RC_ASSERT(after.mass == 8 * before.mass);  // powers of two are exact
  RC_ASSERT(after.inertia == 32 * before.inertia);
  const MassProperties doubled = scaled(before, 2);
  RC_ASSERT(doubled.mass == 2 * before.mass && doubled.inertia == 2 * before.inertia);
  RC_ASSERT(doubled.center_of_mass == before.center_of_mass);
}

// Cut by a plane, the two parts' masses add up, with Steiner's term for the distance of their centres.
RC_GTEST_PROP(MassProperties, PartsAddUpByTheParallelAxisTheorem, ()) {
  auto random = test::random_engine();
  const double cut = *rc::gen::inRange(1, 100) / 100.0;
  const Pose pose{test::random_rotation(random), test::random_vector(random, 10)};
  const auto part = [&](double from, double to) {
    return solid_mass(test::moved(test::box_mesh({from, 0, 0}, {to, 2, 3}), pose), 1);
  };
  const MassProperties whole = part(0, 1), left = part(0, cut), right = part(cut, 1);
  Mat3 sum = Mat3::Zero();
  for (const MassProperties& m : {left, right}) {
    const Vec3 d = m.center_of_mass - whole.center_of_mass;
    sum += m.inertia + m.mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
  }
  RC_ASSERT(std::abs(left.mass + right.mass - whole.mass) < 1e-12);
  RC_ASSERT(relative(sum, whole.inertia) < 1e-12);
}

RC_GTEST_PROP(MassProperties, InertiaIsThatOfABody, ()) {
  auto random = test::random_engine();
  const Mat3 inertia = solid_mass(random_hull(random), 1).inertia;
  RC_ASSERT(inertia == inertia.transpose());
  const Vec3 moments = Eigen::SelfAdjointEigenSolver<Mat3>(inertia).eigenvalues();
  RC_ASSERT(moments[0] > 0 && moments[0] + moments[1] >= moments[2]);
}

// The sum over random points that fall inside a convex mesh, an oracle that knows no integrals.
TEST(MassProperties, AgreeWithMonteCarlo) {
  std::mt19937_64 random(3);
  const TriangleMesh mesh = random_hull(random);
  Eigen::AlignedBox3d box;
  for (const Vec3& v : mesh.vertices) box.extend(v);
  const int n = 100000;
  int inside = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (int s = 0; s < n; ++s) {
    const Vec3 x = box.center() + test::random_vector(random, 0.5).cwiseProduct(box.sizes());
    bool in = true;
    for (const auto& [i, j, k] : mesh.triangles) {
      const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
      in = in && (b - a).cross(c - a).dot(x - a) <= 0;
    }
    if (!in) continue;
    ++inside;
    first += x;
    second += x * x.transpose();
  }
  const MassProperties m = solid_mass(mesh, 1);
  const Vec3 center = first / inside;
  const Mat3 covariance = (second / inside - center * center.transpose()) * m.mass;
  EXPECT_NEAR(m.mass / (box.volume() * inside / n), 1, 0.02);
  EXPECT_LT((m.center_of_mass - center).norm(), 0.02);
  EXPECT_LT(relative(covariance.trace() * Mat3::Identity() - covariance, m.inertia), 0.02);
}

}  // namespace
}  // namespace fc
