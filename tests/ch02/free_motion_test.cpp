// The search on bodies whose spin changes (torque-free) and that feel drag, against dense sampling: what was
// called clear was clear, and what was reached was near.
#include <gtest/gtest.h>

#include "ch02_hull_hierarchy/advance.hpp"
#include "tests/support/free_bodies.hpp"
#include "tests/support/test_models.hpp"

namespace {

using namespace fc;
using namespace fc::test;

constexpr int kSamples = 150;

struct Case {
  ca::Motion a, b;
};

// Two bodies about two metres apart that tumble towards each other, or past each other.
Case random_case(Random& random, double drag, double spin_drag, bool only_a) {
  const auto vector = [&](double size) {
    return Vec3(uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size));
  };
  const auto motion = [&](const Vec3& position, const Vec3& velocity) {
    const FreeBody body = random_free_body(random);
    ca::Motion m;
    m.position = position;
    m.rotation = body.rotation;
    m.velocity = velocity;
    m.spin = uniform(random, 1, 8) * body.spin.normalized();
    m.spin_rate = m.spin.norm();
    m.spin_axis = m.spin.normalized();
    world::turn_freely(m, world::PrincipalInertia(body.inertia()));
    return m;
  };
  Case c{motion(Vec3::Zero(), vector(0.5)), motion(Vec3(3, 0, 0) + vector(0.5), Vec3(-3, 0, 0) + vector(1))};
  for (ca::Motion* m : {&c.a, &c.b}) {
    if (only_a && m == &c.b) continue;
    m->drag = drag;
    m->spin_drag = spin_drag;
  }
  if (drag > 0) c.a.acceleration = vector(5);
  if (drag > 0 && !only_a) c.b.acceleration = c.a.acceleration;
  return c;
}

hulls::TocOptions wide() {  // a target so wide that a bound which is slightly too small shows
  hulls::TocOptions options;
  options.target = 0.02;
  options.slack = 0.01;
  options.tolerance = 0.04;
  return options;
}

void search_against_samples(double drag, double spin_drag, bool only_a) {
  Random random(17);
  const std::vector<hulls::Model> models = {model_of(star(5, 0.3)), model_of(ring(0.7, 0.15, 12, 6)),
                                            model_of(l_prism()), model_of(bumpy_ball(random, 6))};
  int reached = 0, clear = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const hulls::Model &a = models[trial % models.size()], &b = models[trial / models.size() % models.size()];
    const Case c = random_case(random, drag, spin_drag, only_a);
    const hulls::TocOptions options = wide();
    const hulls::TimeOfContact toc = hulls::time_of_contact(a, c.a, b, c.b, options);
    ASSERT_NE(toc.status, hulls::TimeOfContact::Status::limit) << trial;
    const auto distance = [&](double t) {
      return hulls::model_distance(a, b, ca::PairPose(c.a, c.b, t), 1e-6);
    };
    if (distance(0).lower < options.target) continue;
    const bool hit = toc.status == hulls::TimeOfContact::Status::reached;
    EXPECT_LE(toc.start_gap, distance(0).upper) << "m, trial " << trial;
    (hit ? reached : clear) += 1;
    for (int k = 0; k <= kSamples; ++k) {
      const double t = toc.time * k / kSamples;
      ASSERT_GE(distance(t).upper, options.target * (1 - 1e-9))
          << "m: nearer than the target at " << t << " s, before " << toc.time << " s, trial " << trial;
    }
    if (hit) {
      EXPECT_LE(distance(toc.time).lower, options.target + options.slack) << "m, trial " << trial;
    }
  }
  EXPECT_GE(reached, 20);
  EXPECT_GE(clear, 5);
}

TEST(FreeMotion, OfTumblingBodiesIsSearchedWithoutMisses) {
  search_against_samples(0, 0, false);
}
TEST(FreeMotion, WithDragIsSearchedWithoutMisses) {
  search_against_samples(0.8, 1.5, false);
}
TEST(FreeMotion, WithDragOfOneBodyIsSearchedWithoutMisses) {
  search_against_samples(0.8, 1.5, true);
}

}  // namespace
