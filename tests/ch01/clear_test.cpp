// The clear versions against the fast ones, on random shapes and flights; and the chapter's programs with --clear and --mine.
#include "ch01_convex_advancement/clear/pieces.hpp"

#include <gtest/gtest.h>

#include "ch01_convex_advancement/advance.hpp"
#include "ch01_convex_advancement/replay.hpp"
#include "ch01_convex_advancement/simplex.hpp"
#include "tests/support/changed_tables.hpp"
#include "tests/support/random_engine.hpp"
#include "tests/support/random_shapes.hpp"

namespace {

using namespace fc;
using namespace fc::test;
using ca::Status;
namespace clear = ca::clear;
using std::filesystem::path;

RC_GTEST_PROP(Clear, ClosestPointIsThatOfTheFastOne, ()) {
  Random random = random_engine();
  for (int round = 0; round < 100; ++round) {
    const int count = integer(random, 1, 4), distinct = integer(random, 1, count);
    const double size = magnitude(random, 1e-3, 1e3);
    const Vec3 offset = uniform(random, 0, 1.5) * size * unit_vector(random);
    std::array<Vec3, 4> corners;
    for (int i = 0; i < count; ++i)
      corners[i] = i < distinct ? Vec3(offset + size * unit_vector(random)) : corners[i - distinct];
    const ca::SimplexPoint fast = ca::closest_to_origin(corners, count);
    const clear::ClosestPoint c = clear::closest_point(std::span(corners).first(count));
    RC_ASSERT((c.point - fast.point).norm() <= 1e-9 * size);
    double sum = 0;
    Vec3 said = Vec3::Zero();
    for (int i = 0; i < count; ++i) {
      RC_ASSERT(c.weight[i] >= 0);
      sum += c.weight[i];
      said += c.weight[i] * corners[i];
    }
    RC_ASSERT(std::abs(sum - 1) < 1e-12);
    RC_ASSERT((said - c.point).norm() <= 1e-12 * size);
  }
}

RC_GTEST_PROP(Clear, GapEnclosesTheDistanceAsTheFastOneDoes, ()) {
  Random random = random_engine();
  for (int round = 0; round < 20; ++round) {
    const double size = magnitude(random, 1e-3, 1e3);
    const Solid a = random_solid(random, size), b = random_solid(random, size * magnitude(random, 0.1, 1));
    const ca::Motion ma = motion(size * unit_vector(random), rotation(random));
    const ca::Motion mb =
        motion(ma.position + uniform(random, 0.1, 2) * (a.reach() + b.reach()) * unit_vector(random),
               rotation(random));
    const ca::PairPose pose(ma, mb, 0);
    const ca::GjkResult fast = ca::distance(a.convex(), b.convex(), pose, {1e-13 * size, 1e-13, 128});
    const clear::Gap g = clear::gap(a.convex(), b.convex(), pose, 1e-8 * size, clear::closest_point);
    const double rounding = ca::rounding_term(a.convex(), b.convex(), pose);
    RC_ASSERT(g.lower <= std::max(fast.upper, 0.0));
    RC_ASSERT(g.lower <= ca::support_gap(a.convex(), b.convex(), pose, g.normal) + rounding);
    if (fast.status != ca::GjkResult::Status::separated || fast.lower < 1e-7 * size) continue;
    RC_ASSERT(std::abs(g.upper - fast.upper) <= 2e-8 * size);
    RC_ASSERT(g.upper - g.lower <= 1.001e-8 * size + 2 * rounding);
    RC_ASSERT(std::abs((g.point_b - g.point_a).norm() - g.upper) <= 8 * rounding);
    RC_ASSERT(g.corners >= 1 && g.corners <= 3);
  }
}

RC_GTEST_PROP(Clear, SpeedBoundIsTheDirectionalOne, ()) {
  Random random = random_engine();
  const Solid a = random_solid(random, 1), b = random_solid(random, 2);
  const auto fall = [&] { return Vec3(integer(random, 0, 1) * unit_vector(random)); };
  const ca::Motion ma =
      motion(Vec3::Zero(), rotation(random), 3 * unit_vector(random), 5 * unit_vector(random), fall());
  const ca::Motion mb =
      motion(Vec3::Zero(), rotation(random), 3 * unit_vector(random), 5 * unit_vector(random), fall());
  const ca::Convex shape_a = a.convex(), shape_b = b.convex();
  const double t = uniform(random, 0, 1), end = t + uniform(random, 0, 2);
  const Vec3 n = unit_vector(random);
  const double fast =
      ca::MovingPair(ca::MotionBound::directional, shape_a, ma, shape_b, mb).closing_speed_bound(n, t, end);
  const double slow =
      clear::speed_bound(n, {ma.velocity_at(t), ma.acceleration, ma.spin, shape_a.reach},
                         {mb.velocity_at(t), mb.acceleration, mb.spin, shape_b.reach}, end - t);
  RC_ASSERT(std::abs(fast - slow) < 1e-12);
}

// Two bodies that fly at each other, turn, and fall differently.
RC_GTEST_PROP(Clear, AdvanceAnswersAsTheFastOneDoesAndItsCertificateIsTrue, ()) {
  Random random = random_engine();
  for (int round = 0; round < 6; ++round) {
    const double size = magnitude(random, 1e-2, 1e2);
    const Solid a = random_solid(random, size), b = random_solid(random, size * uniform(random, 0.2, 1));
    const double reach = a.reach() + b.reach();
    const Vec3 apart = reach * uniform(random, 0.9, 2) * unit_vector(random);
    const auto fall = [&] { return Vec3(integer(random, 0, 1) * reach * unit_vector(random)); };
    const ca::Motion ma = motion(Vec3::Zero(), rotation(random), size * unit_vector(random),
                                 uniform(random, 0, 5) * unit_vector(random), fall());
    const ca::Motion mb = motion(apart, rotation(random), ma.velocity - uniform(random, 0, 3) * apart,
                                 uniform(random, 0, 5) * unit_vector(random), fall());
    ca::AdvanceOptions options;
    options.tolerance = size * magnitude(random, 1e-8, 1e-3);
    options.certificate = true;
    const ca::AdvanceResult fast = ca::advance(a.convex(), ma, b.convex(), mb, options);
    const ca::AdvanceResult r = clear::advance(a.convex(), ma, b.convex(), mb, options, clear::Pieces());
    const bool known = r.status != Status::unresolved && fast.status != Status::unresolved;
    RC_ASSERT(r.status == fast.status || !known ||
              std::min(r.gap_upper, fast.gap_upper) <=
                  2 * options.tolerance);  // just within it: both are right
    if (r.status == Status::touching_at_start || r.status == Status::penetrating_at_start) continue;
    const auto shape = [](const Solid& solid) {
      ca::ReplayShape result{{}, {}, {}, {}, solid.radius, ca::reach_of(solid.core.vertices)};
      for (const Vec3& x : solid.core.vertices) result.points.push_back(x.cast<Long>());
      return result;
    };
    const ca::ReplayShape shape_a = shape(a), shape_b = shape(b);
    const auto wrong = ca::replay({shape_a, shape_b, ma, mb, options.interval},
                                  {r.status, r.toc, r.gap_lower, r.gap_upper}, r.certificate);
    if (!wrong.empty()) RC_LOG() << wrong[0].what;
    RC_ASSERT(wrong.empty());
    for (const ca::AdvanceResult& answer : {r, fast})
      RC_ASSERT(clear::check_certificate(answer.certificate, a.convex(), ma, b.convex(), mb, answer.toc) ==
                "");
  }
}

TEST(Clear, MotionsThatItDoesNotKnowAreRefused) {
  const Solid ball = sphere(1);
  ca::Motion slowed = motion({5, 0, 0});
  slowed.drag = 1;
  EXPECT_THROW(clear::advance(ball.convex(), motion({0, 0, 0}), ball.convex(), slowed, {}, clear::Pieces()),
               std::invalid_argument);
}

// --- the programs -----------------------------------------------------------------------------------------

const std::string kBin = FC_BIN_DIR;
const path kScenes = path(FC_SOURCE_DIR) / "chapters/ch01_convex_advancement/scenes";

fc_test::Outcome advanced(const std::string& scene, const path& out, const std::string& options) {
  return fc_test::run(kBin + "/ch01_convex_advancement '" + (kScenes / scene).string() +
                      "' --certificate --out '" + out.string() + "' " + options);
}
fc_test::Outcome replayed(const std::string& scene, const path& out, const std::string& options = "") {
  return fc_test::run(kBin + "/ch01_replay '" + (kScenes / scene).string() + "' '" + out.string() + "' " +
                      options);
}

TEST(Clear, ItsRunsAreProvedByBothCheckers) {
  for (const char* scene : {"spinning_box.yaml", "tumbling_plank.yaml"}) {
    const path out = fc_test::scratch(scene);
    const fc_test::Outcome o = advanced(scene, out, "--clear --quiet");
    EXPECT_EQ(o.exit_code, 0) << o.err;
    for (const char* checker : {"", "--clear"}) {
      const fc_test::Outcome proof = replayed(scene, out, checker);
      EXPECT_EQ(proof.exit_code, 0) << scene << " " << checker << ": " << proof.err;
    }
  }
}

TEST(Clear, TheClearCheckerRefusesWhatIsChanged) {
  const path out = fc_test::scratch("changed");
  ASSERT_EQ(advanced("spinning_box.yaml", out, "--clear --quiet").exit_code, 0);
  fc_test::Lines lines = fc_test::lines_of(out / "certificate.csv");
  lines[2] = fc_test::with(lines[2], 6, fc_test::cell(lines[2], 6) + 1e-9);
  fc_test::write(out / "certificate.csv", lines);
  const fc_test::Outcome o = replayed("spinning_box.yaml", out, "--clear");
  EXPECT_EQ(o.exit_code, 3);
  EXPECT_NE(o.err.find("query 0: row 1: "), std::string::npos) << o.err;
}

TEST(Clear, WhatItDoesNotHaveIsRefusedInALine) {
  for (const char* options : {"--clear --set ccd.bound=naive", "--clear --set ccd.warm_start=false"}) {
    const fc_test::Outcome o = advanced("spinning_box.yaml", fc_test::scratch("refused"), options);
    EXPECT_EQ(o.exit_code, 2) << options;
    EXPECT_NE(o.err.find("run without --clear and --mine"), std::string::npos) << o.err;
  }
  EXPECT_EQ(advanced("corners.yaml", fc_test::scratch("refused"), "--clear").exit_code, 2);
}

// The book's functions, compiled as a learner's are, put where exercises/check.py puts those.
TEST(Clear, MineOnTheBooksPiecesWritesTheSameFiles) {
  const path mine = fc_test::scratch("mine");
  const path source = path(FC_SOURCE_DIR) / "README.md";  // any file that does not change meanwhile
  for (const char* piece : {"ch01_ex06", "ch01_ex07", "ch01_ex08", "ch01_ex09", "ch01_ex10"}) {
    const std::string name(piece);
    std::filesystem::copy_file(path(FC_BOOK_PIECES) / (name + ".so"), mine / (name + ".so"));
    std::ofstream(mine / (name + ".source")) << source.string() << "\n" << fc_test::contents(source);
  }
  setenv("FC_MINE", mine.c_str(), 1);
  const path ours = fc_test::scratch("ours"), theirs = fc_test::scratch("theirs");
  ASSERT_EQ(advanced("spinning_box.yaml", ours, "--clear --quiet").exit_code, 0);
  const fc_test::Outcome o = advanced("spinning_box.yaml", theirs, "--mine");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  EXPECT_NE(o.out.find("yours"), std::string::npos) << o.out;
  EXPECT_EQ(o.out.find("the book's"), std::string::npos) << o.out;
  for (const char* file : {"certificate.csv", "features.csv", "motion.glb"})
    EXPECT_EQ(fc_test::contents(ours / file), fc_test::contents(theirs / file)) << file;
  const fc_test::Outcome proof = replayed("spinning_box.yaml", theirs, "--mine");
  EXPECT_EQ(proof.exit_code, 0) << proof.err;
  EXPECT_NE(proof.out.find("by your checker"), std::string::npos) << proof.out;
  unsetenv("FC_MINE");
}

}  // namespace
