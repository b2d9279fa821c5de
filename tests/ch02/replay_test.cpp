// Certificates of hierarchies: what the search proves is true and complete, and what was tampered with is
// refused.
#include "ch02_hull_hierarchy/replay.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "ch02_hull_hierarchy/advance.hpp"
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

}  // namespace
