// Random certificates replayed, and bounds on motions. (Random answers are checked in suite_test.cpp.)
#include <gtest/gtest.h>

#include <cstring>

#include "ch01_convex_advancement/advance.hpp"
#include "ch01_convex_advancement/replay.hpp"
#include "tests/support/random_engine.hpp"
#include "tests/support/random_shapes.hpp"

namespace {

using namespace fc;
using namespace fc::test;
using ca::Status;

struct Query {
  Solid a, b;
  ca::Motion ma, mb;
  ca::AdvanceOptions options;

  ca::AdvanceResult ask() const { return ca::advance(a.convex(), ma, b.convex(), mb, options); }
};

// Two bodies that fly at each other, turn (some by several turns), and fall differently; sizes from 1 mm to
// 1000 km.
Query random_query(Random& random) {
  const double size = magnitude(random, 1e-3, 1e6);
  Query q{random_solid(random, size), random_solid(random, size * magnitude(random, 0.1, 1)), {}, {}, {}};
  const double reach = q.a.reach() + q.b.reach();
  const Vec3 apart = reach * uniform(random, 0.7, 2) * unit_vector(random);
  const Vec3 closing = -apart * uniform(random, 0, 3) + 0.3 * reach * unit_vector(random);
  const auto spin = [&] { return Vec3(magnitude(random, 0.05, 20) * unit_vector(random)); };
  const Vec3 common = 10 * size * unit_vector(random);  // a shared flight changes nothing
  const auto fall = [&] {
    return Vec3(integer(random, 0, 1) * uniform(random, 0, 3) * reach * unit_vector(random));
  };
  q.ma = motion(size * unit_vector(random), rotation(random), common, spin(), fall());
  q.mb = motion(q.ma.position + apart, rotation(random), common + closing, spin(), fall());
  q.options.interval = integer(random, 0, 3) ? 1 : uniform(random, 0.1, 2);
  q.options.tolerance = size * magnitude(random, 1e-9, 1e-4);
  q.options.bound = static_cast<ca::MotionBound>(integer(random, 0, 3));
  q.options.certificate = true;
  return q;
}

// The largest speed at which any two points of the cores close in along n at t.
Long closing_speed(const Query& q, Long t, const Vec<Long>& n) {
  const auto fastest = [&](const Solid& s, const ca::Motion& m, const Vec<Long>& towards) {
    const LongPose pose = long_pose(m, t, m.position_at(static_cast<double>(t)));
    const Vec<Long> v = m.velocity.cast<Long>() + t * m.acceleration.cast<Long>();
    Long most = -std::numeric_limits<Long>::infinity();
    for (const Vec3& x : s.core.vertices) {
      const Vec<Long> r = pose.rotation * x.cast<Long>();
      most = std::max(most, towards.dot(m.spin.cast<Long>().cross(r)));
    }
    return std::pair(most, v);
  };
  const auto [turn_a, v_a] = fastest(q.a, q.ma, n);
  const auto [turn_b, v_b] = fastest(q.b, q.mb, -n);
  return n.dot(v_a - v_b) + turn_a + turn_b;
}

// What the replay says of an answer with these rows, or "".
std::string replay(const Query& q, const ca::AdvanceResult& r, const std::vector<ca::CertificateRow>& rows) {
  const auto shape = [](const Solid& solid) {
    ca::ReplayShape result{{}, {}, {}, {}, solid.radius, ca::reach_of(solid.core.vertices)};
    for (const Vec3& x : solid.core.vertices) result.points.push_back(x.cast<Long>());
    return result;
  };
  const ca::ReplayShape a = shape(q.a), b = shape(q.b);
  const auto wrong = ca::replay({a, b, q.ma, q.mb, q.options.interval},
                                {r.status, r.toc / q.options.interval, r.gap_lower, r.gap_upper}, rows);
  return wrong.empty() ? "" : wrong[0].what;
}

// A row that claims a little more than its neighbours in double precision is detected.
RC_GTEST_PROP(AdvanceRandom, CertificatesReplay, ()) {
  Random random = random_engine();
  for (int round = 0; round < 10; ++round) {
    const Query q = random_query(random);
    const ca::AdvanceResult r = q.ask();
    if (r.status == Status::penetrating_at_start || r.status == Status::touching_at_start) {
      RC_ASSERT(r.certificate.empty());
      continue;
    }
    RC_ASSERT(static_cast<std::int64_t>(r.certificate.size()) == r.iterations);
    RC_ASSERT(replay(q, r, r.certificate) == "");
    const int k = integer(random, 0, static_cast<int>(r.certificate.size()) - 1);
    auto rows = r.certificate;
    rows[k].gap_lower += 1e-3 * r.gap_upper + 0.1 * (q.a.reach() + q.b.reach());
    RC_ASSERT(replay(q, r, rows) != "");
    rows = r.certificate;
    if (k > 0) {
      rows.erase(rows.begin() + k - 1);
      RC_ASSERT(replay(q, r, rows) != "");
    }
    rows = r.certificate;
    if (rows[k].speed_bound * rows[k].advance > 0) {
      rows[k].advance = 1.01 * rows[k].gap_lower / rows[k].speed_bound;
      RC_ASSERT(replay(q, r, rows) != "");
    }
  }
}

// From afar, or after many turns, a pose is known with less precision than the bodies' size suggests: the
// smallest possible tolerance must take that into account, or the contact is late.
RC_GTEST_PROP(AdvanceRandom, LongWaysAndManyTurns, ()) {
  Random random = random_engine();
  for (int round = 0; round < 10; ++round) {
    Query q{random_solid(random, 0.1), random_solid(random, 0.1), {}, {}, {}};
    const Vec3 way = magnitude(random, 1, 1e5) * unit_vector(random);
    const double turns = magnitude(random, 1, 1e4);
    q.ma = motion(Vec3::Zero(), rotation(random), Vec3::Zero(),
                  uniform(random, 0, 1) * turns * unit_vector(random));
    q.mb = motion(way, rotation(random), -way * uniform(random, 1, 1.5), turns * unit_vector(random));
    q.options.tolerance = 0;
    q.options.certificate = true;
    const ca::AdvanceResult r = q.ask();
    RC_ASSERT(r.status != Status::penetrating_at_start);
    RC_ASSERT(replay(q, r, r.certificate) == "");
    if (r.toc > 0) RC_ASSERT(gap_at<Long>(q.a, q.ma, q.b, q.mb, Long(r.toc)) > 0);
    RC_ASSERT(r.gap_lower <= gap_at<Long>(q.a, q.ma, q.b, q.mb, Long(r.toc)));
  }
}

// The bounds against the fastest pair of points at many times, and against their formulas.
RC_GTEST_PROP(AdvanceRandom, MotionBoundsHold, ()) {
  Random random = random_engine();
  for (int round = 0; round < 20; ++round) {
    const Query q = random_query(random);
    const Vec3 n = unit_vector(random);
    const double t = uniform(random, 0, 1), end = t + uniform(random, 0, 1);
    const ca::Convex a = q.a.convex(), b = q.b.convex();
    const double reach_a = a.reach, reach_b = b.reach;
    const auto speed = [&](ca::MotionBound bound) {
      return ca::MovingPair(bound, a, q.ma, b, q.mb).closing_speed_bound(n, t, end);
    };
    const double directional = speed(ca::MotionBound::directional),
                 projected = speed(ca::MotionBound::projected);
    RC_ASSERT(directional <= speed(ca::MotionBound::naive));
    RC_ASSERT(projected <= directional);
    for (int i = 0; i <= 10; ++i)
      RC_ASSERT(closing_speed(q, t + (end - t) * i / 10, n.cast<Long>()) <= Long(projected));
    const double turning = n.cross(q.ma.spin).norm() * reach_a + n.cross(q.mb.spin).norm() * reach_b;
    const double straight = std::max(n.dot(q.ma.velocity_at(t) - q.mb.velocity_at(t)),
                                     n.dot(q.ma.velocity_at(end) - q.mb.velocity_at(end)));
    const double size = q.ma.velocity.norm() + q.mb.velocity.norm() + turning + std::abs(straight);
    RC_ASSERT(std::abs(directional - (straight + turning)) <= 1e-12 * size);
  }
}

// Where GJK starts changes the cost, not the result.
TEST(AdvanceRandom, WarmAndColdAgree) {
  Random random(7);
  std::int64_t warm_iterations = 0, cold_iterations = 0;
  for (int round = 0; round < 300; ++round) {
    Query q = random_query(random);
    const ca::AdvanceResult warm = q.ask();
    q.options.warm_start = false;
    const ca::AdvanceResult cold = q.ask();
    EXPECT_TRUE(warm.status == cold.status || std::min(warm.gap_upper, cold.gap_upper) <= warm.tolerance);
    EXPECT_EQ(replay(q, cold, cold.certificate), "");
    warm_iterations += warm.gjk_iterations;
    cold_iterations += cold.gjk_iterations;
    EXPECT_GE(warm.gjk_iterations, warm.iterations + 1);
  }
  EXPECT_LT(1.5 * static_cast<double>(warm_iterations), static_cast<double>(cold_iterations));
}

RC_GTEST_PROP(AdvanceRandom, TheSameQueryGivesTheSameBytes, ()) {
  Random random = random_engine();
  const Query q = random_query(random);
  const ca::AdvanceResult r = q.ask(), s = q.ask();
  RC_ASSERT(r.status == s.status);
  RC_ASSERT(std::memcmp(&r.toc, &s.toc, sizeof r.toc) == 0);
  RC_ASSERT(std::memcmp(&r.gap_lower, &s.gap_lower, sizeof r.toc) == 0);
  RC_ASSERT(r.certificate.size() == s.certificate.size());
  // Swapped, the same contact within what the tolerance allows; the certificate is another one, and as good.
  const ca::AdvanceResult swapped = ca::advance(q.b.convex(), q.mb, q.a.convex(), q.ma, q.options);
  const bool both = r.status != Status::unresolved && swapped.status != Status::unresolved;
  if (both && r.status != swapped.status) RC_ASSERT(std::min(r.gap_upper, swapped.gap_upper) <= r.tolerance);
}

}  // namespace
