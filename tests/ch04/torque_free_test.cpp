// Free rotation against an integrator of 33 digits, closed forms, and its own laws.
#include "ch04_multibody_stepping/torque_free.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "ch04_multibody_stepping/elliptic.hpp"
#include "tests/support/euler_integrator.hpp"
#include "tests/support/free_bodies.hpp"
#include "tests/support/random_engine.hpp"

namespace {

using namespace fc;
using namespace fc::test;
using world::TorqueFree;

#ifdef __SIZEOF_FLOAT128__
__extension__ using Real = __float128;
#else
using Real = long double;
#endif
using Integrator = EulerIntegrator<Real>;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double long_eps = static_cast<double>(std::numeric_limits<long double>::epsilon());

Integrator integrator(const FreeBody& body, const Vec3& nudge = Vec3::Zero()) {
  const Integrator::Vec spin = body.spin.cast<Real>() + nudge.cast<Real>();
  return Integrator(body.moments.cast<Real>(), body.rotation.cast<Real>(), spin);
}

double apart(const Integrator& a, const Integrator& b) {
  return Mat3((a.rotation() - b.rotation()).cast<double>()).norm();
}

// What the header promises: within 16 eps (1 + angle) of the motion from a start within 8 eps of long double.
void agrees(const FreeBody& body, std::initializer_list<double> angles, const Vec3& direction) {
  const TorqueFree free = body.free();
  Integrator truth = integrator(body);
  Integrator nudged = integrator(body, 8 * long_eps * body.spin.norm() * direction);
  double t = 0;
  for (const double angle : angles) {
    const double next = angle / free.spin_bound();
    truth.run(Real(next) - Real(t));
    nudged.run(Real(next) - Real(t));
    t = next;
    const double allowed = 16 * eps * (1 + std::abs(angle)) + 16 * apart(truth, nudged);
    const Mat3 rotation = (free.rotation_at(t).cast<Real>() - truth.rotation()).cast<double>();
    const Vec3 spin = (free.spin_at(t).cast<Real>() - truth.spin_world()).cast<double>();
    RC_ASSERT(rotation.norm() <= allowed);
    RC_ASSERT(spin.norm() <= allowed * free.spin_bound());
  }
}

RC_GTEST_PROP(TorqueFree, AgreesWithTheIntegrator, ()) {
  Random random = random_engine();
  const FreeBody body = random_free_body(random);
  agrees(body, {0, uniform(random, 0, 2), uniform(random, 2, 20)}, unit_vector(random));
  agrees(body, {uniform(random, -8, 0)}, unit_vector(random));
}

// A racket thrown about its middle axis turns over, and over again.
TEST(TorqueFree, TheRacketTurnsOver) {
  for (const double lean : {1e-1, 1e-3, 1e-6, 1e-9}) {
    FreeBody body{{1, 2, 2.5}, Mat3::Identity(), {lean, 1, 0.3 * lean}};
    agrees(body, {1, 5, 20, 60, 90}, Vec3::UnitX());
    const TorqueFree free = body.free();
    double lowest = 1, highest = -1;  // of the middle axis along L
    for (int i = 0; i < 4000; ++i) {
      const double along = free.rotation_at(0.1 * i).col(1).dot(free.momentum_axis());
      lowest = std::min(lowest, along);
      highest = std::max(highest, along);
    }
    EXPECT_LT(lowest, -0.99);
    EXPECT_GT(highest, 0.99);
  }
}

// The border between the two kinds of motion, where nothing is periodic: L_2 = |L| tanh(rate t).
TEST(TorqueFree, TheSeparatrix) {
  const Vec3 moments(12, 15, 20), spin(10, 0, 6);  // 2E = L^2/I2
  const TorqueFree free(moments.asDiagonal(), Mat3::Identity(), spin);
  const double momentum = moments.cwiseProduct(spin).norm();
  const double rate = momentum * std::sqrt((1.0 / 12 - 1.0 / 15) * (1.0 / 15 - 1.0 / 20));
  for (double x = -4; x <= 4; x += 0.25) {
    const double t = x / rate, tolerance = 16 * eps * (1 + free.spin_bound() * std::abs(t));
    const Vec3 body = free.rotation_at(t).transpose() * free.spin_at(t);
    EXPECT_NEAR(std::abs(15 * body.y()) / momentum, std::tanh(std::abs(x)), tolerance);
    EXPECT_NEAR(body.x(), 10 / std::cosh(x), tolerance * free.spin_bound());
  }
}

using LongRotation = Eigen::AngleAxis<Long>;

// With two equal moments the axis of the third turns steadily about L, and the body about that axis.
RC_GTEST_PROP(TorqueFree, SymmetricTops, ()) {
  Random random = random_engine();
  FreeBody body = random_free_body(random);
  const int axis = integer(random, 0, 1) ? 0 : 2;
  const double twice = body.moments[1];
  body.moments = axis == 0 ? Vec3(twice * magnitude(random, 1e-6, 1), twice, twice)
                           : Vec3(twice, twice, twice * uniform(random, 1, 2));
  const TorqueFree free = body.free();
  const auto start = body.rotation.cast<Long>().eval();
  const auto moments = body.moments.cast<Long>().eval();
  const auto momentum = (start * moments.asDiagonal() * start.transpose() * body.spin.cast<Long>()).eval();
  const Long about_axis = start.col(axis).dot(body.spin.cast<Long>()) * (1 - moments[axis] / moments[1]);
  for (const double angle : {0.0, 3.0, -50.0, 1e4}) {
    const double t = angle / free.spin_bound(), tolerance = 16 * eps * (1 + std::abs(angle));
    const Eigen::Matrix<Long, 3, 3> precession =
        LongRotation(momentum.norm() / moments[1] * t, momentum.normalized()).toRotationMatrix();
    const Eigen::Matrix<Long, 3, 3> turn =
        LongRotation(about_axis * t, Eigen::Matrix<Long, 3, 1>::Unit(axis)).toRotationMatrix();
    const auto truth = (precession * start * turn).eval();
    RC_ASSERT((free.rotation_at(t).cast<Long>() - truth).norm() <= tolerance);
    RC_ASSERT((free.spin_at(t).cast<Long>() - precession * body.spin.cast<Long>()).norm() <=
              tolerance * free.spin_bound());
  }
}

// About each principal axis (the middle one too, at any orientation), for a sphere, and at rest: w stays.
RC_GTEST_PROP(TorqueFree, ConstantSpin, ()) {
  Random random = random_engine();
  FreeBody body = random_free_body(random);
  const int kind = integer(random, 0, 4);
  if (kind == 0)
    body.moments[0] = std::max(body.moments[0], 0.75 * body.moments[1]);  // of a needle L would lean
  if (kind < 3) body.spin = body.spin.norm() * body.rotation.col(kind);
  if (kind == 3) body.moments.setConstant(body.moments[1]);
  if (kind == 4) body.spin.setZero();
  const TorqueFree free = body.free();
  RC_ASSERT(free.constant_spin());
  RC_ASSERT(free.spin_change_bound() == 0);
  const double rate = body.spin.norm();
  RC_ASSERT(free.spin_bound() >= rate);
  RC_ASSERT(free.spin_bound() <= rate * (1 + 64 * eps));
  const Vec3 n = unit_vector(random);
  RC_ASSERT(std::abs(free.turning_bound(n) - n.cross(body.spin).norm()) <= 64 * eps * rate);
  for (const double angle : {0.0, -2.0, 1e3}) {
    const double t = rate > 0 ? angle / rate : angle;
    Mat3 truth = body.rotation;
    if (rate > 0) truth = Eigen::AngleAxisd(rate * t, body.spin / rate).toRotationMatrix() * truth;
    RC_ASSERT((free.rotation_at(t) - truth).norm() <= 16 * eps * (1 + std::abs(angle)));
    RC_ASSERT((free.spin_at(t) - body.spin).norm() <= 8 * eps * rate);
  }
  if (kind == 4) RC_ASSERT(free.rotation_at(7) == body.rotation);
}

// Energy and angular momentum do not drift: as exact after a million radians as at the start.
RC_GTEST_PROP(TorqueFree, ConservesEnergyAndMomentum, ()) {
  Random random = random_engine();
  FreeBody body = random_free_body(random);
  const Mat3 axes = rotation(random).toRotationMatrix();  // a full tensor this time
  const Mat3 inertia = axes * body.inertia() * axes.transpose();
  const Mat3 tensor = (inertia + inertia.transpose()) / 2;
  RC_PRE(world::PrincipalInertia(tensor).moments[0] > 1e-6 * body.moments[2]);
  const TorqueFree free(tensor, body.rotation, body.spin);
  const auto momentum = [&](double t) {
    const Mat3 r = free.rotation_at(t);
    return Vec3(r * tensor * r.transpose() * free.spin_at(t));
  };
  const Vec3 start = momentum(0);
  const double energy = start.dot(free.spin_at(0));
  RC_ASSERT((start - body.rotation * tensor * body.rotation.transpose() * body.spin).norm() <=
            64 * eps * body.moments[2] * free.spin_bound());
  for (const double angle : {1.0, 30.0, -1e3, 1e6}) {
    const double t = angle / free.spin_bound();
    const Mat3 r = free.rotation_at(t);
    RC_ASSERT((r.transpose() * r - Mat3::Identity()).norm() <= 32 * eps);
    RC_ASSERT((momentum(t) - start).norm() <= 64 * eps * body.moments[2] * free.spin_bound());
    RC_ASSERT(std::abs(momentum(t).dot(free.spin_at(t)) - energy) <=
              64 * eps * body.moments[2] * free.spin_bound() * free.spin_bound());
  }
}

// The axes in which the tensor is written do not matter, in any order.
RC_GTEST_PROP(TorqueFree, AnyBodyAxes, ()) {
  Random random = random_engine();
  const Vec3 moments =
      moments_of({uniform(random, 0.1, 0.3), uniform(random, 0.4, 0.6), uniform(random, 0.7, 1)});
  const FreeBody body{moments, rotation(random).toRotationMatrix(), unit_vector(random)};
  Mat3 axes = rotation(random).toRotationMatrix();
  if (integer(random, 0, 1)) axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const Mat3 inertia = axes * body.inertia() * axes.transpose();
  const TorqueFree free = body.free(), same(inertia, body.rotation * axes.transpose(), body.spin);
  for (const double t : {0.0, 1.0, -5.0})
    RC_ASSERT((same.rotation_at(t) * axes - free.rotation_at(t)).norm() <= 1e-11);
}

// The state at any time is a start from which the same motion goes on; with the spin reversed, it goes back.
RC_GTEST_PROP(TorqueFree, GoesOnAndGoesBack, ()) {
  Random random = random_engine();
  const FreeBody body = random_free_body(random);
  const TorqueFree free = body.free();
  const double first = uniform(random, -20, 20) / free.spin_bound();
  const double more = uniform(random, -20, 20) / free.spin_bound();
  const FreeBody there{body.moments, free.rotation_at(first), free.spin_at(first)};
  FreeBody back = there, nudged = there;
  back.spin = -there.spin;
  nudged.spin += 16 * eps * free.spin_bound() * unit_vector(random);
  const Mat3 goal = free.rotation_at(first + more);
  const double allowed =
      64 * eps * 40 + 16 * (there.free().rotation_at(more) - nudged.free().rotation_at(more)).norm();
  RC_ASSERT((there.free().rotation_at(more) - goal).norm() <= allowed);
  RC_ASSERT((back.free().rotation_at(-more) - goal).norm() <= allowed);
}

// The change of the spin, from Euler's equation in the world.
Vec3 spin_change(const FreeBody& body, const Mat3& r, const Vec3& spin) {
  const Vec3 w = r.transpose() * spin;
  return r * body.moments.cwiseProduct(w).cross(w).cwiseQuotient(body.moments);
}

RC_GTEST_PROP(TorqueFree, BoundsHold, ()) {
  Random random = random_engine();
  const FreeBody body = random_free_body(random);
  const TorqueFree free = body.free();
  const Vec3 n = unit_vector(random);
  for (int i = 0; i < 500; ++i) {
    const double t = uniform(random, -50, 50) / free.spin_bound();
    const Vec3 spin = free.spin_at(t);
    const Vec3 axis = free.momentum_axis();
    const double change = spin_change(body, free.rotation_at(t), spin).norm();
    RC_ASSERT(spin.norm() <= free.spin_bound());
    RC_ASSERT(n.cross(spin).norm() <= free.turning_bound(n));
    RC_ASSERT(axis.cross(spin).norm() <= free.turning_bound(axis));
    // The check loses digits in the difference of almost equal moments; the bound does not.
    RC_ASSERT(change <= free.spin_change_bound() + 64 * eps * free.spin_bound() * free.spin_bound());
  }
  // By the textbook's formula, and never worse than it.
  const Vec3 w = body.rotation.transpose() * body.spin, l = body.moments.cwiseProduct(w);
  const double i1 = body.moments[0], i3 = body.moments[2], energy = w.dot(l) / 2;
  const double most = (2 * energy * (i1 + i3) - l.squaredNorm()) / (i1 * i3);
  const double along = 2 * energy / l.norm();
  if (!free.constant_spin() && i1 > 1e-3 * i3)
    RC_ASSERT(std::abs(free.spin_bound() * free.spin_bound() - most) <= 1e-11 * most);
  const double loose = along * n.cross(l.norm() > 0 ? free.momentum_axis() : n).norm() +
                       std::sqrt(std::max(0.0, free.spin_bound() * free.spin_bound() - along * along));
  RC_ASSERT(free.turning_bound(n) <= loose * (1 + 1e-12) + 1e-12 * free.spin_bound());
}

// Nothing smaller would do: sampled long enough, the motion comes as close to each bound as one likes.
TEST(TorqueFree, BoundsAreAttained) {
  Random random(7);
  for (int round = 0; round < 12; ++round) {
    const Vec3 moments =
        moments_of({uniform(random, 0.2, 1), uniform(random, 0.2, 1), uniform(random, 0.2, 1)});
    const FreeBody body{moments, Mat3::Identity(), unit_vector(random)};
    const TorqueFree free = body.free();
    const Vec3 n = round % 3 ? unit_vector(random) : free.momentum_axis();
    double spin = 0, turning = 0, change = 0;
    for (int i = 0; i < 200'000; ++i) {
      const Vec3 w = free.spin_at(0.0917 * i);
      spin = std::max(spin, w.norm());
      turning = std::max(turning, n.cross(w).norm());
      if (i < 20'000) change = std::max(change, spin_change(body, free.rotation_at(0.0917 * i), w).norm());
    }
    EXPECT_GT(spin, free.spin_bound() * (1 - 1e-6));
    EXPECT_GT(turning, free.turning_bound(n) * (1 - 1e-3));
    EXPECT_GT(change, free.spin_change_bound() * (1 - 1e-3));
  }
}

std::string refused(const Mat3& inertia, const Mat3& rotation, const Vec3& spin) {
  try {
    TorqueFree(inertia, rotation, spin);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(TorqueFree, RefusesWhatIsNoBody) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Mat3 good = Vec3(1, 2, 2.5).asDiagonal(), one = Mat3::Identity();
  const auto says = [](const std::string& text, const std::string& part, const std::string& value) {
    return text.find(part) != std::string::npos && text.find(value) != std::string::npos;
  };
  EXPECT_EQ(refused(good, one, Vec3::UnitX()), "");
  EXPECT_EQ(refused(Vec3(1, 2, 3).asDiagonal(), one, Vec3::UnitX()), "");  // a plate
  EXPECT_TRUE(says(refused(Vec3(1, 2, 3.001).asDiagonal(), one, Vec3::UnitX()), "those of no mass", "3.001"));
  EXPECT_TRUE(says(refused(Vec3(0, 2, 2).asDiagonal(), one, Vec3::UnitX()), "not all positive", "(0, 2, 2)"));
  EXPECT_TRUE(
      says(refused(Vec3(-1, 2, 2).asDiagonal(), one, Vec3::UnitX()), "not all positive", "(-1, 2, 2)"));
  EXPECT_TRUE(says(refused(Vec3(1, nan, 2).asDiagonal(), one, Vec3::UnitX()), "not finite", "nan"));
  Mat3 skew = good;
  skew(0, 1) = 0.125;
  EXPECT_TRUE(says(refused(skew, one, Vec3::UnitX()), "not symmetric", "0.125"));
  EXPECT_TRUE(says(refused(good, 1.5 * one, Vec3::UnitX()), "not a rotation", "1.5"));
  EXPECT_TRUE(says(refused(good, -one, Vec3::UnitX()), "not a rotation", "-1"));
  EXPECT_TRUE(says(refused(good, nan * one, Vec3::UnitX()), "not a rotation", "nan"));
  EXPECT_TRUE(says(refused(good, one, Vec3(0, nan, 0)), "not finite", "nan"));
}

// Known values (Carlson; K at m = 1/2), and the trapezoidal rule, which is exact for smooth periodic
// functions.
TEST(Elliptic, Integrals) {
  EXPECT_NEAR(static_cast<double>(world::carlson_rf(1, 2, 0)), 1.3110287771460600, 1e-15);
  EXPECT_NEAR(static_cast<double>(world::carlson_rf(2, 3, 4)), 0.58408284167715170, 1e-15);
  EXPECT_NEAR(static_cast<double>(world::complete_integral(std::sqrt(0.5L), 1, 1, 1)), 1.8540746773013719,
              1e-15);
  for (const Long k : {0.1L, 0.5L, 1.0L, 3.0L})
    for (const Long p : {0.05L, 1.0L, 20.0L}) {
      Long sum = 0;
      const int steps = 4000;
      for (int i = 0; i < steps; ++i) {
        const Long angle = std::numbers::pi_v<Long> * i / steps, c = std::cos(angle), s = std::sin(angle);
        sum += (0.7L * c * c + 1.9L * s * s) / ((c * c + p * s * s) * std::sqrt(c * c + k * k * s * s));
      }
      sum *= std::numbers::pi_v<Long> / (2 * steps);
      EXPECT_NEAR(static_cast<double>(world::complete_integral(k, p, 0.7L, 1.9L) / sum), 1, 1e-15);
    }
}

}  // namespace
