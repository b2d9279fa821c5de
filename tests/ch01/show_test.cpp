// The steps that a student sees of a query say what the query proved.
#include "ch01_convex_advancement/show_advance.hpp"

#include <gtest/gtest.h>

#include "ch01_convex_advancement/gjk.hpp"
#include "tests/support/random_shapes.hpp"

namespace {

using namespace fc;
using namespace fc::test;
using algorithm::Mark;
using algorithm::Role;

struct Shown {
  Solid a, b;
  ca::ShownPair pair;
  ca::AdvanceResult result;
  std::vector<algorithm::Step> steps;
};

constexpr double kFrame = 2;  // s, the frame's start

Shown shown(Random& random) {
  Shown s{random_solid(random, 1), random_solid(random, 0.7), {}, {}, {}};
  const double reach = s.a.reach() + s.b.reach();
  const Vec3 apart = uniform(random, 1.1, 2) * reach * unit_vector(random);
  const auto spin = [&] { return Vec3(uniform(random, 0, 4) * unit_vector(random)); };
  s.pair.number_a = 3;
  s.pair.number_b = 7;
  s.pair.motion_a = motion(unit_vector(random), rotation(random), Vec3::Zero(), spin(), Vec3::Zero());
  s.pair.motion_b = motion(s.pair.motion_a.position + apart, rotation(random),
                           -uniform(random, 0.5, 2) * apart + 0.3 * reach * unit_vector(random), spin(),
                           uniform(random, 0, 3) * unit_vector(random));
  s.pair.from = 0.25;
  s.pair.to = 1.25;
  s.pair.tolerance = 1e-5;
  return s;
}

// The shapes do not move after this.
void ask(Shown& s) {
  s.pair.a = s.a.convex();
  s.pair.b = s.b.convex();
  s.result = ca::certified_advance(s.pair);
  s.steps = ca::show_advance(s.pair, s.result, kFrame);
}

double gap_at(const Shown& s, double t) {
  return ca::distance(s.pair.a, s.pair.b, ca::PairPose(s.pair.motion_a, s.pair.motion_b, t), {}).upper;
}

// m: how far the point is from the body, or inside of it.
double off_surface(const ca::Convex& shape, const ca::Motion& motion, double t, const Vec3& point) {
  const std::vector<Vec3> there{Vec3::Zero()};
  ca::Motion rests;
  rests.position = point;
  ca::Convex grown = shape;
  grown.radius = 0;
  const double d =
      ca::distance(grown, {there, 0, 0}, ca::PairPose(motion.pose_at(t), rests.pose_at(0)), {}).upper;
  return std::abs(d - shape.radius);
}

double time_of(const Shown& s, const algorithm::Step& step) {  // s, of an advance: where its segment begins
  for (const algorithm::Curve& curve : step.chart->curves)
    if (curve.name == "this advance") return curve.points.front()[0] - kFrame - s.pair.from;
  throw std::logic_error("no advance");
}

TEST(ShownAdvance, WhatIsProvedLiesBelowTheTrueGapAndEndsAtTheAnswersTime) {
  Random random(1);
  int contacts = 0;
  for (int i = 0; i < 60; ++i) {
    Shown s = shown(random);
    ask(s);
    if (s.result.certificate.empty()) continue;
    contacts += s.result.status == ca::Status::contact;
    const algorithm::Chart& chart = *s.steps.back().chart;
    double end = 0;
    for (const algorithm::Curve& curve : chart.curves) {
      if (curve.name == "gap") continue;
      for (std::size_t k = 0; k < curve.points.size(); ++k) {
        const auto& [time, proved] = curve.points[k];
        end = std::max(end, time);
        EXPECT_LE(proved, gap_at(s, time - kFrame - s.pair.from) + 1e-9);
        if (k == 0) continue;
        // Also in the middle of a segment that goes on in time.
        const auto& [before, from] = curve.points[k - 1];
        ASSERT_GE(time, before - 1e-12);
        EXPECT_LE(0.5 * (from + proved),
                  std::max(from, gap_at(s, 0.5 * (before + time) - kFrame - s.pair.from)) + 1e-9);
      }
    }
    EXPECT_NEAR(end, kFrame + s.pair.from + s.result.toc, 1e-12);
  }
  EXPECT_GT(contacts, 20);
}

TEST(ShownAdvance, WitnessPointsLieOnTheBodiesAndTheSlabHoldsNeither) {
  Random random(2);
  int slabs = 0;
  for (int i = 0; i < 40; ++i) {
    Shown s = shown(random);
    ask(s);
    for (const algorithm::Step& step : s.steps) {
      const bool is_advance = step.text.starts_with("Advance ");
      const double t = is_advance ? time_of(s, step) : &step == &s.steps.front() ? 0 : s.result.toc;
      std::vector<const Mark*> planes;
      for (const Mark& mark : step.draw) {
        if (mark.kind == Mark::Kind::plane) planes.push_back(&mark);
        if (mark.kind != Mark::Kind::point) continue;
        const bool of_a = mark.role == Role::a;
        EXPECT_LT(off_surface(of_a ? s.pair.a : s.pair.b, of_a ? s.pair.motion_a : s.pair.motion_b, t,
                              mark.points[0]),
                  1e-6);
      }
      ASSERT_EQ(planes.size(), is_advance ? 2u : 0u);
      if (!is_advance) continue;
      ++slabs;
      const Vec3& n = planes[0]->points[1];
      EXPECT_GE(n.dot(planes[1]->points[0] - planes[0]->points[0]), -1e-9);
      for (const Vec3& p : s.pair.a.points)
        EXPECT_LE(n.dot(s.pair.motion_a.pose_at(t) * p - planes[0]->points[0]) + s.pair.a.radius, 1e-9);
      for (const Vec3& p : s.pair.b.points)
        EXPECT_GE(n.dot(s.pair.motion_b.pose_at(t) * p - planes[1]->points[0]) - s.pair.b.radius, -1e-9);
      ASSERT_EQ(step.poses.size(), 2u);
      EXPECT_EQ(step.poses[0].body, 3);
      EXPECT_LT((step.poses[1].position - s.pair.motion_b.position_at(t)).norm(), 1e-12);
    }
  }
  EXPECT_GT(slabs, 100);
}

TEST(Account, IsShortenedToWhatAPageTakesAndSaysSo) {
  algorithm::Document document{1, 0, 1, {{4, "long", {}}, {3, "short", {{"one step"}}}}};
  algorithm::Step step{"many points"};
  for (int i = 0; i < 1000; ++i) step.draw.push_back(algorithm::point(Vec3(i, 1.0 / 3, 0), Role::now));
  for (int i = 0; i < 30; ++i) document.parts[0].steps.push_back(step);
  const std::string text = algorithm::json(document);
  EXPECT_LE(text.size(), algorithm::kMostBytes);
  EXPECT_GT(text.size(), algorithm::kMostBytes / 2);
  EXPECT_NE(text.find("steps of this part are left out"), std::string::npos);
  EXPECT_NE(text.find("one step"), std::string::npos);
}

TEST(Account, RefusesNumbersThatAreNotFinite) {
  algorithm::Document document{1, 0, 1, {{4, "one", {{"a step"}}}}};
  document.parts[0].steps[0].draw.push_back(algorithm::point(Vec3(0, std::nan(""), 0), Role::a));
  EXPECT_THROW(algorithm::json(document), std::invalid_argument);
}

}  // namespace
