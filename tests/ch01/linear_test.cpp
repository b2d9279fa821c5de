// Vertices and triangles, and edges, whose corners fly straight: closed forms, known traps, brute force.
#include "ch01_convex_advancement/linear.hpp"

#include <gtest/gtest.h>

#include "ch01_convex_advancement/replay.hpp"
#include "tests/support/brute_distance.hpp"
#include "tests/support/random_engine.hpp"
#include "tests/support/random_shapes.hpp"
#include "tests/support/run_files.hpp"

namespace {

using namespace fc;
using namespace fc::test;
using ca::AdvanceResult;
using ca::FeatureKind;
using ca::LinearQuery;
using ca::Status;
using Kind = LinearQuery::Kind;
using Corners = std::array<Vec3, 4>;

AdvanceResult ask(const LinearQuery& q, double tolerance = 1e-9) {
  ca::AdvanceOptions options;
  options.tolerance = tolerance;
  options.certificate = true;
  const AdvanceResult r = ca::advance(q, options);
  const auto wrong =
      ca::replay(q, options.interval, {r.status, r.toc, r.gap_lower, r.gap_upper}, r.certificate);
  EXPECT_TRUE(wrong.empty()) << wrong[0].what;
  return r;
}

LinearQuery vertex_face(const Corners& start, const Corners& end) {
  return {Kind::vertex_face, start, end};
}
LinearQuery edge_edge(const Corners& start, const Corners& end) {
  return {Kind::edge_edge, start, end};
}

// A vertex that falls by 2 m from z = 1 onto a triangle that stands still.
LinearQuery falling_on_triangle(double x, double y) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  return vertex_face({Vec3(x, y, 1), a, b, c}, {Vec3(x, y, -1), a, b, c});
}

void expect_contact(const AdvanceResult& r, double toc, double speed) {
  ASSERT_EQ(r.status, Status::contact);
  EXPECT_LE(r.toc, toc);
  EXPECT_GE(r.toc, toc - r.tolerance / speed * (1 + 1e-6));
  EXPECT_LE(r.gap_upper, r.tolerance);
  EXPECT_GT(r.gap_lower, 0);
}

TEST(Linear, VertexOnAFaceItsEdgesAndItsCorners) {
  const auto kind = [](double x, double y) {
    const AdvanceResult r = ask(falling_on_triangle(x, y));
    expect_contact(r, 0.5, 2);
    EXPECT_EQ(r.features.at(0).kind_a, FeatureKind::vertex);
    EXPECT_NEAR(r.features.at(0).point_b.x(), x, 1e-15);
    EXPECT_NEAR(r.features.at(0).normal.z(), -1, 1e-9);
    return r.features.at(0).kind_b;
  };
  EXPECT_EQ(kind(0.25, 0.25), FeatureKind::face);
  EXPECT_EQ(kind(0.5, 0), FeatureKind::edge);
  EXPECT_EQ(kind(0, 0), FeatureKind::vertex);
  EXPECT_EQ(kind(1, 0), FeatureKind::vertex);
  // Beside the edges by less and by more than the tolerance.
  for (const double eps : {1e-16, 1e-10, -1e-16, -1e-10}) {
    EXPECT_EQ(ask(falling_on_triangle(0.3, -eps)).status, Status::contact) << eps;
    EXPECT_EQ(ask(falling_on_triangle(0.5 + eps, 0.5 + eps)).status, Status::contact) << eps;
  }
  for (const double eps : {2e-9, 1e-6, 1e-3}) {
    EXPECT_EQ(ask(falling_on_triangle(0.3, -eps)).status, Status::separated) << eps;
    EXPECT_EQ(ask(falling_on_triangle(-eps, 0.3)).status, Status::separated) << eps;
    EXPECT_EQ(ask(falling_on_triangle(0.5 + eps, 0.5 + eps)).status, Status::separated) << eps;
  }
}

TEST(Linear, ContactAtTheStartAtTheEndAndJustAfterIt) {
  const Vec3 a(-1, -1, 0), b(2, -1, 0), c(-1, 2, 0);
  const auto from_to = [&](double from, double to) {
    return ask(vertex_face({Vec3(0, 0, from), a, b, c}, {Vec3(0, 0, to), a, b, c}));
  };
  EXPECT_EQ(from_to(0, 1).status, Status::touching_at_start);
  EXPECT_EQ(from_to(1, 0).status, Status::contact);
  EXPECT_EQ(from_to(1, -1e-15).status, Status::contact);
  EXPECT_EQ(from_to(1, 2e-9).status, Status::separated);
  for (int k = 1; k <= 15; ++k) {  // t = 1e-1 ... 1e-15: not at the start, and not after it
    const double height = std::pow(10, -k);
    const AdvanceResult r = from_to(height, height - 1);
    if (height > 1e-9)
      expect_contact(r, height, 1);
    else
      EXPECT_EQ(r.status, Status::touching_at_start);
  }
}

TEST(Linear, CrossingEdges) {
  const LinearQuery q = edge_edge({Vec3(-1, 0, 1), Vec3(1, 0, 1), Vec3(0, -1, 0), Vec3(0, 1, 0)},
                                  {Vec3(-1, 0, -2), Vec3(1, 0, -2), Vec3(0, -1, 0), Vec3(0, 1, 0)});
  const AdvanceResult r = ask(q);
  expect_contact(r, 1.0 / 3, 3);
  EXPECT_EQ(r.features.at(0).kind_a, FeatureKind::edge);
  EXPECT_EQ(r.features.at(0).kind_b, FeatureKind::edge);
  EXPECT_EQ(r.iterations, 1);
}

TEST(Linear, ParallelAntiparallelAndCollinearEdges) {
  for (const double sign : {1.0, -1.0}) {
    const Vec3 c(-sign, 0, 0), d(sign, 0, 0), down(0, 0, -2);
    const Vec3 a(-0.5, 0, 1), b(1.5, 0, 1);
    expect_contact(ask(edge_edge({a, b, c, d}, {a + down, b + down, c, d})), 0.5, 2);
    // Along its own line towards the other's end: 2 m away, 4 m/s.
    const Vec3 far(3, 0, 0), way(-4, 0, 0);
    expect_contact(
        ask(edge_edge({far, far + Vec3(1, 0, 0), c, d}, {far + way, far + Vec3(1, 0, 0) + way, c, d})), 0.5,
        4);
    // Side by side, sliding along each other for ever: the gap never changes.
    const Vec3 beside(0, 1e-6, 0), slide(5, 0, 0);
    const AdvanceResult r =
        ask(edge_edge({c + beside, d + beside, c, d}, {c + beside + slide, d + beside + slide, c, d}));
    EXPECT_EQ(r.status, Status::separated);
    EXPECT_LE(r.iterations, 2);
  }
}

// f(t) = det(...) = 0 at all times: the test that cubic solvers cannot answer.
TEST(Linear, InOnePlane) {
  const Vec3 a(0, 1, 0), b(1, 2, 0), c(-1, 0, 0), d(2, 0, 0), down(0, -2, 0);
  expect_contact(ask(edge_edge({a, b, c, d}, {a + down, b + down, c, d})), 0.5, 2);
  expect_contact(ask(vertex_face({a, c, d, Vec3(0, -3, 0)}, {a + down, c, d, Vec3(0, -3, 0)})), 0.5, 2);
}

// Touching without passing through: the determinant, whose sign other methods use, has a double root.
TEST(Linear, DoubleRoots) {
  const Vec3 c(0, -1, 0), d(0, 1, 0);
  // An edge turns about its middle, which lies on the other edge all the time.
  EXPECT_EQ(
      ask(edge_edge({Vec3(-1, 0, 1), Vec3(1, 0, -1), c, d}, {Vec3(-1, 0, -1), Vec3(1, 0, 1), c, d})).status,
      Status::touching_at_start);
  // The lower end of an edge slides over the other edge: they touch at t0 only.
  for (const double t0 : {0.5, 0.8, 0.88, 0.9, 1.0}) {
    const Vec3 far(0, 0, 5);
    expect_contact(ask(edge_edge({Vec3(-t0, 0, 0), far, c, d}, {Vec3(1 - t0, 0, 0), far, c, d}), 1e-6), t0,
                   1);
  }
}

// Perpendicular edges that close by d0 while one stretches by 1e-3: a scalar bound believes that the
// stretching closes the gap.
TEST(Linear, StretchingAlongTheEdgeCostsNothing) {
  for (const double d0 : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const LinearQuery q =
        edge_edge({Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, -1, d0), Vec3(0, 1, d0)},
                  {Vec3(-1 - 1e-3, 0, 0), Vec3(1 + 1e-3, 0, 0), Vec3(0, -1, -d0), Vec3(0, 1, -d0)});
    const AdvanceResult r = ask(q, 1e-6 * d0);
    expect_contact(r, 0.5, 2 * d0);
    EXPECT_LE(r.iterations, 2);
  }
}

TEST(Linear, NothingMovesAndNothingIsThere) {
  const Vec3 a(0, 0, 1), b(1, 0, 0), c(0, 1, 0), o = Vec3::Zero();
  const AdvanceResult r = ask(vertex_face({a, o, b, c}, {a, o, b, c}));
  EXPECT_EQ(r.status, Status::separated);
  EXPECT_EQ(r.iterations, 1);
  EXPECT_NEAR(r.gap_upper, 1, 1e-15);
  // A needle, a segment and a point for a triangle; a point for an edge.
  for (const Vec3& corner : {Vec3(0.5, 1e-12, 0), Vec3(0.5, 0, 0), o, b}) {
    const Vec3 above(0.25, 0, 1), below(0.25, 0, -1);
    expect_contact(ask(vertex_face({above, o, b, corner}, {below, o, b, corner})), 0.5, 2);
  }
  expect_contact(ask(vertex_face({a, o, o, o}, {-a, o, o, o})), 0.5, 2);
  expect_contact(ask(edge_edge({a, a, -b, b}, {-a, -a, -b, b})), 0.5, 2);
  EXPECT_EQ(ask(vertex_face({o, o, o, o}, {o, o, o, o})).status, Status::touching_at_start);
}

// A tolerance below rounding is raised, and the one that was used is reported.
TEST(Linear, TinyAndHuge) {
  for (const double size : {1e-18, 1e-9, 1e-3, 1e6}) {
    LinearQuery q = falling_on_triangle(0.25, 0.25);
    for (int i = 0; i < 4; ++i) q.start[i] *= size, q.end[i] *= size;
    expect_contact(ask(q, 1e-9 * size), 0.5, 2 * size);
    const AdvanceResult finest = ask(q, 0);
    expect_contact(finest, 0.5, 2 * size);
    EXPECT_LE(finest.tolerance, 1e-12 * size);
  }
}

TEST(Linear, ALimitIsNotAMiss) {
  // A triangle that turns its plane while it comes: several advances.
  const LinearQuery q = vertex_face({Vec3(0.2, 0.2, 0), Vec3(0, 0, 1), Vec3(1, 0, 2), Vec3(0, 1, 1)},
                                    {Vec3(0.2, 0.2, 0), Vec3(0, 0, -1), Vec3(1, 0, -1), Vec3(0, 1, -3)});
  ca::AdvanceOptions options;
  const AdvanceResult all = ca::advance(q, options);
  ASSERT_EQ(all.status, Status::contact);
  ASSERT_GE(all.iterations, 2);
  options.max_iterations = 1;
  const AdvanceResult one = ca::advance(q, options);
  EXPECT_EQ(one.status, Status::unresolved);
  EXPECT_GT(one.toc, 0);
  EXPECT_LT(one.toc, all.toc);
}

TEST(Linear, TheIntervalScalesTimes) {
  ca::AdvanceOptions options;
  options.interval = 8;
  const AdvanceResult r = ca::advance(falling_on_triangle(0.2, 0.2), options);
  EXPECT_LE(r.toc, 4);
  EXPECT_GE(r.toc, 4 - 4e-6);
  options.interval = 0;
  EXPECT_EQ(ca::advance(falling_on_triangle(0.2, 0.2), options).status, Status::separated);
  options.interval = -1;
  EXPECT_THROW(ca::advance(falling_on_triangle(0.2, 0.2), options), std::invalid_argument);
}

Long distance_at(const LinearQuery& q, Long t) {
  std::array<Vec<Long>, 4> p;
  for (int i = 0; i < 4; ++i) p[i] = (1 - t) * q.start[i].cast<Long>() + t * q.end[i].cast<Long>();
  if (q.kind == Kind::edge_edge) return segment_segment(p[0], p[1], p[2], p[3]);
  return std::min({point_triangle_inside<Long>(p[0], {p[1], p[2], p[3]}), point_segment(p[0], p[1], p[2]),
                   point_segment(p[0], p[2], p[3]), point_segment(p[0], p[3], p[1])});
}

LinearQuery random_query(Random& random) {
  LinearQuery q;
  q.kind = integer(random, 0, 1) ? Kind::edge_edge : Kind::vertex_face;
  const double size = magnitude(random, 1e-3, 1e3);
  const Vec3 shift = integer(random, 0, 3) ? Vec3(Vec3::Zero()) : Vec3(1e3 * size * unit_vector(random));
  const auto corner = [&] { return Vec3(size * uniform(random, 0, 1) * unit_vector(random)); };
  const Vec3 way = size * uniform(random, 0, 4) * unit_vector(random);
  const double bend = integer(random, 0, 2) ? 1 : magnitude(random, 1e-9, 1e-1);
  for (int i = 0; i < 4; ++i) {
    q.start[i] = corner();
    q.end[i] = q.start[i] + bend * corner();
    if (i < (q.kind == Kind::edge_edge ? 2 : 1)) q.start[i] -= way, q.end[i] += way;
    if (integer(random, 0, 7) == 0) q.start[i].z() = q.end[i].z() = 0;  // much in one plane
    q.start[i] += shift, q.end[i] += shift;
  }
  return q;
}

RC_GTEST_PROP(LinearRandom, NeverLateNeverFalseAndProved, ()) {
  Random random = random_engine();
  for (int round = 0; round < 20; ++round) {
    const LinearQuery q = random_query(random);
    ca::AdvanceOptions options;
    options.certificate = true;
    options.tolerance = magnitude(random, 1e-12, 1e-2);
    const AdvanceResult r = ca::advance(q, options);
    RC_ASSERT(r.status != Status::penetrating_at_start);
    RC_ASSERT(r.status != Status::unresolved);
    const Long there = distance_at(q, r.toc);
    RC_ASSERT(Long(r.gap_lower) <= there);
    RC_ASSERT(std::abs(static_cast<double>(there) - r.gap_upper) <= 0.2 * r.tolerance);
    if (r.status != Status::separated) RC_ASSERT(r.gap_upper <= r.tolerance);
    for (int i = 0; i <= 200 && r.toc > 0; ++i) RC_ASSERT(distance_at(q, Long(r.toc) * i / 200) > 0);
    const ca::ReplayAnswer answer{r.status, r.toc, r.gap_lower, r.gap_upper};
    RC_ASSERT(ca::replay(q, 1, answer, r.certificate).empty());
    if (r.certificate.empty()) continue;
    auto rows = r.certificate;
    const int k = integer(random, 0, static_cast<int>(rows.size()) - 1);
    rows[k].gap_lower += 1e-9 * (1 + rows[k].gap_lower) * (q.start[0] - q.start[3]).norm() + r.tolerance;
    RC_ASSERT(!ca::replay(q, 1, answer, rows).empty());
  }
}

// The program: two queries of each kind, and what it refuses.
class LinearProgram : public testing::Test {
 protected:
  std::filesystem::path folder = fc_test::scratch("linear");
  std::string header = [] {
    std::string text = "kind";
    for (const char* end : {"0", "1"})
      for (const char* point : {"p0_", "p1_", "p2_", "p3_"})
        for (const char* axis : {"x", "y", "z"}) text += std::string(",") + point + axis + end;
    return text;
  }();

  fc_test::Outcome run(const std::string& rows, const std::string& more = "") {
    std::ofstream(folder / "scene.yaml") << "linear: q.csv\n" << more;
    std::ofstream(folder / "q.csv") << header << '\n' << rows;
    return fc_test::run(std::string(FC_BIN_DIR) + "/ch01_convex_advancement '" +
                        (folder / "scene.yaml").string() + "' --certificate --out '" +
                        (folder / "out").string() + "'");
  }
};

TEST_F(LinearProgram, AnswersAndReplays) {
  const std::string hit = "vf,0.2,0.2,1,0,0,0,1,0,0,0,1,0,0.2,0.2,-1,0,0,0,1,0,0,0,1,0\n",
                    miss = "vf,0.8,0.8,1,0,0,0,1,0,0,0,1,0,0.8,0.8,-1,0,0,0,1,0,0,0,1,0\n",
                    cross = "ee,-1,0,1,1,0,1,0,-1,0,0,1,0,-1,0,-3,1,0,-3,0,-1,0,0,1,0\n";
  const fc_test::Outcome o = run(hit + miss + cross);
  EXPECT_EQ(o.exit_code, 0) << o.err;
  const fc_test::Table queries = fc_test::read_table(folder / "out/queries.csv");
  ASSERT_EQ(queries.rows(), 3);
  EXPECT_EQ(queries.cells[0][1], "contact");
  EXPECT_EQ(queries.cells[1][1], "separated");
  EXPECT_NEAR(queries.at(2, "toc"), 0.25, 1e-6);
  const fc_test::Outcome replay =
      fc_test::run(std::string(FC_BIN_DIR) + "/ch01_replay '" + (folder / "scene.yaml").string() + "' '" +
                   (folder / "out").string() + "'");
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
}

TEST_F(LinearProgram, RefusesInOneLine) {
  const std::string row = "vf,0.2,0.2,1,0,0,0,1,0,0,0,1,0,0.2,0.2,-1,0,0,0,1,0,0,0,1,0\n";
  const auto refused = [&](const fc_test::Outcome& o, const std::string& what) {
    EXPECT_EQ(o.exit_code, 2);
    EXPECT_NE(o.err.find(what), std::string::npos) << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  };
  refused(run("fv" + row.substr(2)), "q.csv:2:1");
  refused(run("vf,nan" + row.substr(6)), "q.csv:2:4");
  refused(run("vf,1\n"), "q.csv:2:4: 2 cells");
  refused(run(""), "no queries");
  refused(run(row, "bodies: [{shape: a}, {shape: a}]\nshapes: {a: {sphere: {radius: 1}}}\n"),
          "beside 'linear'");
  header = "kind,x";
  refused(run(row), "q.csv:1:6");
}

}  // namespace
