// Certificates of hierarchies: what the search proves is true and complete, and what was tampered with is
// refused.
#include "ch02_hull_hierarchy/replay.hpp"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <map>

#include "ch02_hull_hierarchy/advance.hpp"
#include "ch04_multibody_stepping/torque_free.hpp"
#include "tests/support/test_models.hpp"

namespace {

using namespace fc;
using namespace fc::hulls;
using namespace fc::test;

struct Asked {
  Model a, b;
  ca::Motion ma, mb;
  ca::AdvanceResult result;
  double interval = 1;

  ca::ReplayAnswer answer() const {
    return {result.status, result.status == ca::Status::separated ? 1 : result.toc / interval,
            result.gap_lower, result.gap_upper};
  }
  std::vector<ca::Refusal> replayed() const {
    return replay({a, b, ma, mb, interval}, answer(), result.certificate, result.certificate_leaves);
  }
};

Asked ask(Random& random, int kind) {
  const auto mesh = [&](int k) {
    switch (k) {
      case 0:
        return model_of(bumpy_ball(random, 7));
      case 1:
        return model_of(ring(1, 0.3, 10, 6));
      case 2:
        return model_of(triangle_soup(random, 40), false);
      case 3:
        return model_of(capsule(0.3, 1));
      default:
        return model_of(box({1, 0.4, 0.7}));
    }
  };
  Asked q{mesh(kind % 3), mesh(kind % 5), {}, {}, {}, kind % 2 ? 1 : 0.3};
  const Vec3 from = uniform(random, 2.2, 4) * unit_vector(random),
             aim = uniform(random, 0, 2) * unit_vector(random);
  const auto some = [&](double most) -> Vec3 { return uniform(random, 0, most) * unit_vector(random); };
  q.ma = motion(some(2), rotation(random), some(1), some(4), kind % 4 == 1 ? some(3) : Vec3(Vec3::Zero()));
  q.mb = motion(q.ma.position + from, rotation(random), q.ma.velocity + (aim - from) / q.interval, some(4));
  ca::AdvanceOptions options;
  options.interval = q.interval;
  options.certificate = true;
  if (kind % 7 == 6) options.max_iterations = 200;
  q.result = advance(q.a, q.ma, q.b, q.mb, options);
  return q;
}

TEST(HierarchyReplay, WhatIsProvedIsTrueAndComplete) {
  Random random(3);
  std::map<ca::Status, int> seen;
  for (int kind = 0; kind < 140; ++kind) {
    const Asked q = ask(random, kind);
    EXPECT_EQ(check_tree(q.a), "");
    EXPECT_EQ(check_tree(q.b), "");
    ++seen[q.result.status];
    for (const ca::Refusal& refusal : q.replayed())
      ADD_FAILURE() << "query " << kind << ", row " << refusal.row << ": " << refusal.what;
  }
  EXPECT_GT(seen[ca::Status::contact], 20);
  EXPECT_GT(seen[ca::Status::separated], 20);
  EXPECT_GT(seen[ca::Status::unresolved], 3);
}

TEST(HierarchyReplay, RefusesWhatWasTamperedWith) {
  Random random(4);
  int tried = 0;
  for (int kind = 0; tried < 12; ++kind) {
    const Asked honest = ask(random, kind);
    if (honest.result.certificate.size() < 5 || honest.result.status != ca::Status::contact) continue;
    ++tried;
    const std::size_t last = honest.result.certificate.size() - 1, some = last / 2;
    const auto refused = [&](const char* how, const std::function<void(Asked&)>& tamper) {
      Asked q = honest;
      tamper(q);
      EXPECT_FALSE(q.replayed().empty()) << "query " << kind << ": " << how;
    };
    refused("a row dropped", [&](Asked& q) {
      q.result.certificate.erase(q.result.certificate.begin() + last);
      q.result.certificate_leaves.erase(q.result.certificate_leaves.begin() + last);
    });
    refused("a gap too large", [&](Asked& q) { q.result.certificate[some].gap_lower += 1; });
    refused("a step too long", [&](Asked& q) { q.result.certificate[last].advance *= 1000; });
    refused("closing more slowly", [&](Asked& q) { q.result.certificate[last].speed_bound *= 0.5; });
    refused("a normal turned round", [&](Asked& q) { q.result.certificate[some].normal *= -1; });
    refused("another time", [&](Asked& q) { q.result.certificate[last].t += 1e-3 * q.interval; });
    refused("more leaves than there are", [&](Asked& q) { ++q.result.certificate_leaves[some].count_a; });
    refused("leaves left out", [&](Asked& q) { q.result.certificate_leaves.pop_back(); });
    refused("a later time of contact", [&](Asked& q) { q.result.toc += 1e-3 * q.interval; });
    refused("separated after all", [&](Asked& q) { q.result.status = ca::Status::separated; });
  }
}

// The tampered rows whose line is refused, and nothing else of the query.
std::vector<int> refused_rows(const Asked& q) {
  std::vector<int> rows;
  for (const ca::Refusal& refusal : q.replayed()) rows.push_back(refusal.row);
  return rows;
}

// Two leaves' gap is GJK's, or that of their points along a plane: nothing is left in it but rounding.
TEST(HierarchyReplay, RefusesAGapThatIsTooLargeByRounding) {
  Random random(5);
  int tight = 0;
  for (int kind = 0; kind < 40; ++kind) {
    const Asked honest = ask(random, kind);
    const auto& leaves = honest.result.certificate_leaves;
    for (int k = 0; k < static_cast<int>(leaves.size()); ++k) {
      if (leaves[k].count_a != 1 || leaves[k].count_b != 1) continue;
      Asked q = honest;
      q.result.certificate[k].gap_lower += 1e-12 * (honest.a.reach + honest.b.reach);
      if (refused_rows(q) == std::vector{k}) ++tight;
      q.result.certificate[k].gap_lower += 1e-3 * (honest.a.reach + honest.b.reach);
      EXPECT_EQ(refused_rows(q), std::vector{k}) << "query " << kind << ", row " << k;
      break;
    }
  }
  EXPECT_GT(tight, 10);
}

// All rows of one node of A, and of those below it, are taken away: every other row stays true.
TEST(HierarchyReplay, RefusesASubtreeWithoutRows) {
  Random random(6);
  int tried = 0;
  for (int kind = 0; tried < 10; ++kind) {
    const Asked honest = ask(random, kind);
    if (honest.a.boxes.leaves() < 8 || honest.result.certificate.size() < 20 || honest.result.toc == 0)
      continue;
    const BoxQuad& top = honest.a.boxes.quads[honest.a.boxes.child(0)];
    for (int lane = 0; lane < 4 && top.child[lane] != 0; ++lane) {
      const int first = top.first_leaf[lane], end = first + top.leaf_count[lane];
      Asked q = honest;
      q.result.certificate.clear();
      q.result.certificate_leaves.clear();
      for (std::size_t k = 0; k < honest.result.certificate.size(); ++k) {
        const ca::LeafBlock& block = honest.result.certificate_leaves[k];
        if (block.first_a >= first && block.first_a + block.count_a <= end) continue;
        q.result.certificate.push_back(honest.result.certificate[k]);
        q.result.certificate_leaves.push_back(block);
      }
      if (q.result.certificate.size() == honest.result.certificate.size()) continue;  // it needed none
      const std::vector<ca::Refusal> refusals = q.replayed();
      ASSERT_FALSE(refusals.empty()) << "query " << kind << ", lane " << lane;
      EXPECT_NE(refusals[0].what.find("are proved clear until"), std::string::npos) << refusals[0].what;
      ++tried;
    }
  }
}

Asked cubes(const Vec3& offset, const Vec3& velocity, const ca::AdvanceOptions& options, double edge = 1) {
  const TriangleMesh cube = box_core(Vec3::Constant(edge / 2));
  Asked q{model_of(cube), model_of(cube), {}, {}, {}};
  q.interval = options.interval;
  q.mb = motion(offset, Quat::Identity(), velocity);
  q.result = advance(q.a, q.ma, q.b, q.mb, options);
  return q;
}

// Other pairs of nodes have been advanced before the one that touches was found.
TEST(HierarchyReplay, StartsThatTouchOrOverlap) {
  ca::AdvanceOptions options;
  options.certificate = true;
  for (const double x : {0.9, 1.0}) {
    Asked q = cubes({x, 0.3, 0.2}, {1, 0, 0}, options);
    EXPECT_EQ(q.result.status, x < 1 ? ca::Status::penetrating_at_start : ca::Status::touching_at_start);
    EXPECT_FALSE(q.result.certificate.empty());
    EXPECT_TRUE(q.replayed().empty()) << q.replayed()[0].what;
    q.result.certificate[0].gap_lower += 10;
    EXPECT_EQ(refused_rows(q), std::vector{0});
  }
}

// A row that is true of all leaves of two cubes that overlap and part: from -0.1 m on their gap grows.
TEST(HierarchyReplay, ANegativeGapProvesNothing) {
  ca::AdvanceOptions options;
  Asked q = cubes({0.9, 0.3, 0.2}, {1, 0, 0}, options);
  q.result.status = ca::Status::separated;
  q.result.toc = 1;
  q.result.gap_lower = 0;
  q.result.gap_upper = 1;
  q.result.certificate = {{0, Vec3::UnitX(), -0.11, -1, 1}};
  q.result.certificate_leaves = {{0, 12, 0, 12}};
  ASSERT_EQ(refused_rows(q), std::vector{0});
  EXPECT_EQ(q.replayed()[0].what.find("gap_lower is negative"), 0U);
  q.mb.position.x() = 1.2;  // and of two that do not
  q.result.certificate = {{0, Vec3::UnitX(), 0.19, -1, 1}};
  EXPECT_TRUE(q.replayed().empty());
}

TEST(HierarchyReplay, RefusesABodyThatTurnsFreely) {
  ca::AdvanceOptions options;
  options.certificate = true;
  Asked q = cubes({3, 0.3, 0.2}, {-4, 0, 0}, options);
  EXPECT_TRUE(q.replayed().empty());
  q.mb.spin = {1, 2, 3};
  world::turn_freely(q.mb, world::PrincipalInertia(Vec3(2, 3, 4).asDiagonal()));
  ASSERT_TRUE(q.mb.free);
  EXPECT_EQ(refused_rows(q), std::vector{-1});
}

// Between half the tolerance and the tolerance a gap at the start is neither advanced nor far: such a pair must not
// wait at t = 0 for ever.
TEST(HierarchyReplay, ToleranceOfTheBodiesSize) {
  ca::AdvanceOptions options;
  options.certificate = true;
  options.tolerance = 0.1;
  const Asked q = cubes({0.19, 0, 0}, {-1, 0, 0}, options, 0.1);
  EXPECT_EQ(q.result.status, ca::Status::touching_at_start);
  EXPECT_TRUE(q.replayed().empty());
}

}  // namespace
