// Advancement of bodies that turn freely, compared with an integrator that does not use the closed form.
#include <gtest/gtest.h>

#include "ch01_convex_advancement/advance.hpp"
#include "tests/support/euler_integrator.hpp"
#include "tests/support/free_bodies.hpp"
#include "tests/support/random_engine.hpp"

namespace {

using namespace fc;
using namespace fc::test;
using ca::Status;

#ifdef __SIZEOF_FLOAT128__  // a needle's spin about itself hardly shows in its momentum: many digits are lost
__extension__ using Real = __float128;
#else
using Real = long double;
#endif

// A solid whose spin wanders: its moments are not those of its shape, which makes the wandering as large as possible.
struct FreeSolid {
  Solid solid;
  Vec3 moments;
  ca::Motion motion;

  void throw_it(const Vec3& position, const Vec3& velocity, const FreeBody& body, double angle) {
    RigidBody state;
    state.position = position;
    state.velocity = velocity;
    state.orientation = Quat(body.rotation);
    state.spin = angle / body.spin.norm() * body.spin;
    motion = ca::Motion(state);
    moments = body.moments;
    world::turn_freely(motion, world::PrincipalInertia(body.inertia()));
  }
};

// Its pose, by integration. Successive times should be near each other.
class Integrated {
 public:
  explicit Integrated(const FreeSolid& s)
      : solid_(s.solid),
        motion_(s.motion),
        turning_(s.moments.cast<Real>(), s.motion.rotation.cast<Real>(), s.motion.spin.cast<Real>()) {}

  // max n.x over the body at t; x from `origin`.
  Long farthest(const Vec<Long>& n, Long t, const Vec3& origin) {
    if (motion_.spin_rate > 0) turning_.run(Real(t) - Real(t_));
    t_ = t;
    const Vec<Long> local = turning_.rotation().cast<Long>().transpose() * n;
    Long most = -std::numeric_limits<Long>::infinity();
    for (const Vec3& x : solid_.core.vertices) most = std::max(most, local.dot(x.cast<Long>()));
    const Vec<Long> middle =
        motion_.position.cast<Long>() - origin.cast<Long>() + t * motion_.velocity.cast<Long>();
    return n.dot(middle) + most + solid_.radius;
  }

 private:
  const Solid& solid_;
  const ca::Motion& motion_;
  EulerIntegrator<Real> turning_;
  Long t_ = 0;
};

struct Query {
  FreeSolid a, b;
  ca::AdvanceOptions options;

  ca::AdvanceResult ask() const {
    return ca::advance(a.solid.convex(), a.motion, b.solid.convex(), b.motion, options);
  }
};

struct IntegratedPair {
  Integrated a, b;
  Vec3 origin;

  explicit IntegratedPair(const Query& q) : a(q.a), b(q.b), origin(q.a.motion.position) {}
  Long gap(const Vec3& normal, Long t) {
    const Vec<Long> n = normal.cast<Long>();
    return -b.farthest(-n, t, origin) - a.farthest(n, t, origin);
  }
};

Query random_query(Random& random) {
  const double size = magnitude(random, 1e-3, 1e3);
  Query q;
  q.a.solid = random_solid(random, size);
  q.b.solid = random_solid(random, size * magnitude(random, 0.1, 1));
  const double reach = q.a.solid.reach() + q.b.solid.reach();
  const Vec3 apart = reach * uniform(random, 0.8, 2) * unit_vector(random);
  const auto angle = [&] { return magnitude(random, 0.1, 15); };
  q.a.throw_it(size * unit_vector(random), size * unit_vector(random), random_free_body(random), angle());
  q.b.throw_it(q.a.motion.position + apart,
               q.a.motion.velocity - uniform(random, 0, 2) * apart + 0.3 * reach * unit_vector(random),
               random_free_body(random), angle());
  q.options.tolerance = size * magnitude(random, 1e-9, 1e-4);
  q.options.bound = static_cast<ca::MotionBound>(integer(random, 0, 3));
  q.options.certificate = true;
  return q;
}

// What every row claims, at many times: it must hold for the motion that the equations of motion give.
RC_GTEST_PROP(FreeFlight, CertificatesHoldForTheIntegratedMotion, ()) {
  Random random = random_engine();
  const Query q = random_query(random);
  const ca::AdvanceResult r = q.ask();
  IntegratedPair truth(q);
  Long reached = 0;
  const std::size_t every = 1 + r.certificate.size() / 32;  // the integrator is slow
  for (std::size_t k = 0; k < r.certificate.size(); ++k) {
    const ca::CertificateRow& row = r.certificate[k];
    RC_ASSERT(row.t <= static_cast<double>(reached) * (1 + 1e-15));
    for (int i = 0; i <= 4 && k % every == 0; ++i) {
      const Long h = Long(row.advance) * i / 4;
      RC_ASSERT(truth.gap(row.normal, Long(row.t) + h) >= Long(row.gap_lower) - h * Long(row.speed_bound));
    }
    reached = Long(row.t) + Long(row.advance);
  }
  if (r.status == Status::contact) {
    RC_ASSERT(r.gap_upper <= r.tolerance);
    RC_ASSERT(r.features.size() == 1u);
    // The support gap along any plane is at most the distance: here the two meet.
    const Long gap = truth.gap(r.features.at(0).normal, Long(r.toc));
    RC_ASSERT(std::abs(static_cast<double>(gap) - r.gap_upper) <= r.tolerance);
  }
  if (r.status == Status::separated) RC_ASSERT(reached >= Long(q.options.interval));
}

// The speed of any corner along n never exceeds the bound of any kind, at any time from t on.
RC_GTEST_PROP(FreeFlight, MotionBoundsHold, ()) {
  Random random = random_engine();
  const Query q = random_query(random);
  const Vec3 n = unit_vector(random);
  const double t = uniform(random, 0, 1), end = t + uniform(random, 0, 3);
  const ca::Convex a = q.a.solid.convex(), b = q.b.solid.convex();
  const auto speed = [&](ca::MotionBound bound) {
    return ca::MovingPair(bound, a, q.a.motion, b, q.b.motion).closing_speed_bound(n, t, end);
  };
  const double directional = speed(ca::MotionBound::directional);
  RC_ASSERT(directional <= speed(ca::MotionBound::naive));
  const auto turning = [&](const FreeSolid& s, const Vec3& towards, double time) {
    const Mat3 axes = s.motion.rotation_at(time);
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3& x : s.solid.core.vertices)
      most = std::max(most, towards.dot(s.motion.spin_at(time).cross(axes * x)));
    return most;
  };
  const double straight = n.dot(q.a.motion.velocity - q.b.motion.velocity);
  for (int i = 0; i <= 20; ++i) {
    const double now = t + (end - t) * i / 20;
    RC_ASSERT(straight + turning(q.a, n, now) + turning(q.b, -n, now) <= directional);
  }
}

// A ball feels no difference, and neither does a brick that spins about one of its axes.
TEST(FreeFlight, ConstantSpinStaysConstant) {
  for (const Vec3& spin : {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, -2, 0)}) {
    ca::Motion m = motion({1, 2, 3}, Quat::Identity(), {1, 0, 0}, spin);
    world::turn_freely(m, world::PrincipalInertia(Vec3(1, 2, 2.5).asDiagonal()));
    EXPECT_FALSE(m.free);
  }
  ca::Motion ball = motion({1, 2, 3}, Quat::Identity(), {1, 0, 0}, {1, 2, 3});
  world::turn_freely(ball, world::PrincipalInertia(Mat3(2 * Mat3::Identity())));
  EXPECT_FALSE(ball.free);
}

// A racket that is thrown about its middle axis turns over and hits a wall behind which a racket with
// constant spin would have stayed.
TEST(FreeFlight, TheRacketTurnsOverAndHits) {
  FreeSolid racket{box({0.02, 1, 0.02}), Vec3::Zero(), {}};  // a rod along y
  // It spins about y, which only the moments make its middle axis; after half a turn over, its ends have
  // swung.
  racket.throw_it(Vec3::Zero(), Vec3::Zero(), {{1, 2, 2.5}, Mat3::Identity(), {0.01, 1, 0}}, 6);
  const Solid wall = box({1, 1, 1});
  const ca::Motion still = motion({0.75, 0, 0});  // its face at x = 0.25
  ca::AdvanceOptions options;
  options.interval = 4;
  options.tolerance = 1e-9;
  for (const auto bound : {ca::MotionBound::naive, ca::MotionBound::directional, ca::MotionBound::projected,
                           ca::MotionBound::second_order}) {
    options.bound = bound;
    const ca::AdvanceResult r =
        ca::advance(racket.solid.convex(), racket.motion, wall.convex(), still, options);
    ASSERT_EQ(r.status, Status::contact);
    const Long ahead = Integrated(racket).farthest({1, 0, 0}, Long(r.toc), Vec3::Zero());
    EXPECT_LE(ahead, 0.25L);
    EXPECT_GE(ahead, 0.25L - 1e-9L);
    ca::Motion constant = racket.motion;
    constant.free.reset();
    EXPECT_EQ(ca::advance(racket.solid.convex(), constant, wall.convex(), still, options).status,
              Status::separated);
  }
}

}  // namespace
