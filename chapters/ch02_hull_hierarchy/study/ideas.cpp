// What each idea gains, what leaves and hulls of few points cost, and how cost grows with the mesh.
#include <map>
#include <tuple>

#include "ch02_hull_hierarchy/study/mesh.hpp"
#include "ch02_hull_hierarchy/study/tally.hpp"
#include "common/program.hpp"
#include "common/stopwatch.hpp"

namespace fc::hulls {

void study_ideas(const StudyCase& c, const StudyOptions& options) {
  struct Row {
    const char* label;
    Order order;
    Bound bound;
    Volume volume;
    Leaves leaves;
    int most_points = kAllPoints;
  };
  constexpr auto kG = Order::global;
  constexpr auto kC = Order::controlled;
  constexpr auto kD = Order::depth_first;
  constexpr auto kB = Order::best_first;
  constexpr auto kTriangles = Leaves::triangles;
  const std::vector<Row> rows = {
      // One idea after the other.
      {"one step for all", kG, Bound::naive, Volume::box, kTriangles},
      {"directional bound", kG, Bound::directional, Volume::box, kTriangles},
      {"second-order bound", kG, Bound::second_order, Volume::box, kTriangles},
      {"own time per pair", kD, Bound::second_order, Volume::box, kTriangles},
      {"best first", kB, Bound::second_order, Volume::box, kTriangles},
      {"points' own velocities", kB, Bound::points, Volume::box, kTriangles},
      {"hulls", kB, Bound::points, Volume::hull, kTriangles},
      {"pieces", kB, Bound::points, Volume::hull, Leaves::pieces},
      {"hulls of 64 points", kB, Bound::points, Volume::hull, Leaves::pieces, kFewPoints},
      // The earlier searches, and ours with one idea removed.
      {"FAST's", kG, Bound::directional, Volume::hull, Leaves::pieces},
      {"C2A's", kC, Bound::directional, Volume::swept_sphere, kTriangles},
      {"C2A's on boxes", kC, Bound::directional, Volume::box, kTriangles},
      {"ours with the naive bound", kB, Bound::naive, Volume::hull, kTriangles},
      {"ours with the directional bound", kB, Bound::directional, Volume::hull, kTriangles},
      {"spheres", kB, Bound::points, Volume::sphere, kTriangles},
      {"swept spheres", kB, Bound::points, Volume::swept_sphere, kTriangles},
      {"boxes of pieces", kB, Bound::points, Volume::box, Leaves::pieces},
  };
  TableWriter table(options.out / "ideas.csv", with({{"motions", ""},
                                                     {"idea", ""},
                                                     {"order", ""},
                                                     {"bound", ""},
                                                     {"volume", ""},
                                                     {"leaves", ""},
                                                     {"rounds", ""}},
                                                    kTallyColumns));
  TocOptions asked = toc_options(kStudyTolerance * c.size);
  asked.max_pairs = kMostPairs;
  Progress progress("ideas", static_cast<std::int64_t>(rows.size() * c.families.size()), options.quiet);
  std::int64_t done = 0;
  std::map<std::tuple<Volume, Leaves, int>, HullModel> trees;  // each is made once
  for (const StudyCase::Family& family : c.families) {
    const Tally lanes = by_lanes(c.model, family.motions, asked);
    for (const Row& row : rows) {
      const std::tuple kind{row.volume, row.leaves, row.most_points};
      if (!trees.contains(kind))
        trees.emplace(kind, build_study_model(c.model, c.pieces, {row.volume, row.leaves, row.most_points}));
      const Tally tally = by_study(trees.at(kind), family.motions, asked, row.order, row.bound);
      check_agree(tally, lanes, 1e-2, row.label);
      table.row(with({family.name, row.label, name_of(row.order), name_of(row.bound), name_of(row.volume),
                      name_of(row.leaves), whole(quantile(tally.rounds, 0.5))},
                     cells(tally)));
      progress.update(++done);
    }
    table.row(
        with({family.name, "four in lanes", "best first", "points", "box", "triangles", std::int64_t{0}},
             cells(lanes)));
  }
  table.close();
}

void study_leaves(const StudyCase& c, const StudyOptions& options) {
  TableWriter table(options.out / "leaves.csv", with({{"motions", ""},
                                                      {"volume", ""},
                                                      {"leaves", ""},
                                                      {"most_points", ""},
                                                      {"tree_leaves", ""},
                                                      {"tree_points", ""}},
                                                     kTallyColumns));
  TocOptions asked = toc_options(kStudyTolerance * c.size);
  asked.max_pairs = kMostPairs;
  struct Row {
    Volume volume;
    int most;
  };
  const std::vector<Row> rows = {{Volume::hull, 8},  {Volume::hull, 16},  {Volume::hull, 32},
                                 {Volume::hull, 64}, {Volume::hull, 128}, {Volume::hull, kAllPoints},
                                 {Volume::box, 8}};
  Progress progress("leaves", static_cast<std::int64_t>(2 * rows.size()), options.quiet);
  std::int64_t done = 0;
  for (const Leaves leaves : {Leaves::pieces, Leaves::triangles})
    for (const Row& row : rows) {
      const HullModel hulls = build_study_model(c.model, c.pieces, {row.volume, leaves, row.most});
      for (const StudyCase::Family& family : c.families) {
        const Tally tally = by_study(hulls, family.motions, asked, Order::best_first, Bound::points);
        table.row(with({family.name, name_of(row.volume), name_of(leaves),
                        row.most < kAllPoints ? Cell(std::int64_t{row.most}) : Cell(std::string("all")),
                        static_cast<std::int64_t>(hulls.pieces.start.size() - 1), points_in(hulls.tree)},
                       cells(tally)));
      }
      progress.update(++done);
    }
  table.close();
}

void study_triangles(const Shape& shape, const StudyOptions& options) {
  TableWriter table(
      options.out / "triangles.csv",
      with({{"motions", ""}, {"search", ""}, {"triangles", ""}, {"pieces", ""}, {"build_ns", ""}},
           kTallyColumns));
  const std::vector<std::size_t> wanted = {500, 1000, 2000, 5000, 10'000, 20'000, 35'000};
  std::vector<Shape> shapes;
  for (const std::size_t n : wanted)
    if (n < shape.core.triangles.size()) shapes.push_back(coarser(shape, n));
  shapes.push_back(shape);
  Progress progress("meshes", static_cast<std::int64_t>(shapes.size()), options.quiet);
  std::int64_t done = 0;
  for (const Shape& s : shapes) {
    const StudyCase c = study_case(s, options, true);
    TocOptions asked = toc_options(kStudyTolerance * c.size);
    asked.max_pairs = kMostPairs;
    const Stopwatch watch;
    build_model(s);
    const std::int64_t boxes_ns = watch.ns();
    const Stopwatch watch_hulls;
    const HullModel hulls = build_study_model(c.model, c.pieces, {Volume::hull, Leaves::pieces, kFewPoints});
    const std::int64_t hulls_ns = watch_hulls.ns();
    const auto write = [&](const std::string& family, const char* search, std::int64_t ns,
                           const Tally& tally) {
      table.row(with({family, search, static_cast<std::int64_t>(s.core.triangles.size()),
                      static_cast<std::int64_t>(c.pieces.start.size() - 1), ns},
                     cells(tally)));
    };
    for (const StudyCase::Family& family : c.families) {
      write(family.name, "boxes in lanes", boxes_ns, by_lanes(c.model, family.motions, asked));
      write(family.name, "hulls", hulls_ns,
            by_study(hulls, family.motions, asked, Order::best_first, Bound::points));
      write(family.name, "FAST's", hulls_ns,
            by_study(hulls, family.motions, asked, Order::global, Bound::directional));
    }
    progress.update(++done);
  }
  table.close();
}

}  // namespace fc::hulls
