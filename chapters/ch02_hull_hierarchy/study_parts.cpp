#include "ch02_hull_hierarchy/study_parts.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "ch02_hull_hierarchy/pieces.hpp"
#include "ch02_hull_hierarchy/study_mesh.hpp"
#include "common/program.hpp"
#include "common/table.hpp"

namespace fc::hulls {
namespace {

constexpr int kFewPoints = 64;  // of an inner hull: more cost more than they gain (leaves.csv)
constexpr int kAllPoints = 1'000'000;
constexpr std::int64_t kMostPairs = 3'000'000;  // of a query: then it counts as given up

// What a search was asked, query by query.
struct Tally {
  std::vector<double> nodes, leaves, rounds, ns;
  std::vector<Reach> answers;
  std::int64_t given_up = 0;

  template <class Ask>
  void ask(const Ask& search) {
    const auto start = std::chrono::steady_clock::now();
    const auto reach = search();
    ns.push_back(
        static_cast<double>((std::chrono::steady_clock::now() - start) / std::chrono::nanoseconds(1)));
    nodes.push_back(static_cast<double>(reach.node_pairs));
    leaves.push_back(static_cast<double>(reach.leaf_pairs));
    if constexpr (requires { reach.rounds; }) rounds.push_back(static_cast<double>(reach.rounds));
    given_up += reach.status == Reach::Status::limit;
    answers.push_back(reach);
  }
};

std::int64_t whole(double x) {
  return static_cast<std::int64_t>(x);
}

std::vector<Column> with(std::vector<Column> first, const std::vector<Column>& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}
std::vector<Cell> with(std::vector<Cell> first, const std::vector<Cell>& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

const std::vector<Column> kTallyColumns = {{"queries", ""},    {"node_pairs", ""},     {"node_pairs_p95", ""},
                                           {"leaf_pairs", ""}, {"leaf_pairs_p95", ""}, {"given_up", ""},
                                           {"median_ns", ""},  {"p95_ns", ""}};

// Medians, and what 95 % of the queries stay within.
std::vector<Cell> cells(const Tally& t) {
  return {static_cast<std::int64_t>(t.nodes.size()),
          whole(quantile(t.nodes, 0.5)),
          whole(quantile(t.nodes, 0.95)),
          whole(quantile(t.leaves, 0.5)),
          whole(quantile(t.leaves, 0.95)),
          t.given_up,
          whole(quantile(t.ns, 0.5)),
          whole(quantile(t.ns, 0.95))};
}

// The search in four lanes that the chapters use.
Tally by_lanes(const Model& model, const std::vector<MotionPair>& motions, const ReachOptions& reach) {
  Tally tally;
  SearchMemory memory;
  for (const MotionPair& m : motions)
    tally.ask([&] { return first_reach(model, m.a, model, m.b, reach, memory); });
  return tally;
}

Tally by_study(const HullModel& model, const std::vector<MotionPair>& motions, const ReachOptions& reach,
               Order order, Bound bound) {
  Tally tally;
  for (const MotionPair& m : motions)
    tally.ask([&] { return study_reach(model, m.a, model, m.b, reach, {order, bound}); });
  return tally;
}

// Whether a search says what another one says; where not, that neither promised it.
void check_agree(const Tally& tally, const Tally& truth, double slack, const std::string& what) {
  for (std::size_t i = 0; i < truth.answers.size(); ++i) {
    const Reach &x = tally.answers[i], &y = truth.answers[i];
    if (x.status == Reach::Status::limit) continue;
    if (x.status != y.status || std::abs(x.time - y.time) > slack)
      throw NumericalFailure(what + ": query " + std::to_string(i) + " ends at " + std::to_string(x.time) +
                             " s, not at " + std::to_string(y.time) + " s");
  }
}

}  // namespace

ReachOptions reach_options(double tolerance) {
  ReachOptions options;
  options.tolerance = options.start = tolerance;
  options.target = 0.5 * tolerance;
  options.slack = 0.25 * tolerance;
  return options;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

StudyCase study_case(const Shape& shape, const StudyOptions& options, bool with_pieces) {
  StudyCase c;
  c.shape = shape;
  c.model = build_model(shape);
  c.size = size_of(shape);
  if (with_pieces) c.pieces = convex_pieces(c.model.mesh);
  StudyMotions far(c.model, c.size, 1), close(c.model, c.size, 2);
  c.families = {{"far", {}}, {"close", {}}};
  for (int i = 0; i < options.far; ++i) c.families[0].motions.push_back(far.far());
  for (int i = 0; i < options.close; ++i) c.families[1].motions.push_back(close.close());
  return c;
}

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
      // The ancestors, and ours with one idea taken back.
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
  ReachOptions reach = reach_options(kStudyTolerance * c.size);
  reach.max_pairs = kMostPairs;
  Progress progress("ideas", static_cast<std::int64_t>(rows.size() * c.families.size()), options.quiet);
  std::int64_t done = 0;
  std::map<std::tuple<Volume, Leaves, int>, HullModel> trees;  // each is made once
  for (const StudyCase::Family& family : c.families) {
    const Tally lanes = by_lanes(c.model, family.motions, reach);
    for (const Row& row : rows) {
      const std::tuple kind{row.volume, row.leaves, row.most_points};
      if (!trees.contains(kind))
        trees.emplace(kind, build_study_model(c.model, c.pieces, {row.volume, row.leaves, row.most_points}));
      const Tally tally = by_study(trees.at(kind), family.motions, reach, row.order, row.bound);
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
  ReachOptions reach = reach_options(kStudyTolerance * c.size);
  reach.max_pairs = kMostPairs;
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
        const Tally tally = by_study(hulls, family.motions, reach, Order::best_first, Bound::points);
        table.row(with({family.name, name_of(row.volume), name_of(leaves),
                        row.most < kAllPoints ? Cell(std::int64_t{row.most}) : Cell(std::string("all")),
                        static_cast<std::int64_t>(hulls.pieces.start.size() - 1),
                        static_cast<std::int64_t>(hulls.tree.points.size())},
                       cells(tally)));
      }
      progress.update(++done);
    }
  table.close();
}

void study_tightness(const StudyCase& c, const StudyOptions& options) {
  constexpr int kNodes = 64, kDirections = 200;  // of a level; of a node
  struct Row {
    const char* name;
    Volume volume;
    int most;
  };
  const std::vector<Row> rows = {{"sphere", Volume::sphere, 0},    {"swept sphere", Volume::swept_sphere, 0},
                                 {"box", Volume::box, 0},          {"hull of 8", Volume::hull, 8},
                                 {"hull of 16", Volume::hull, 16}, {"hull of 32", Volume::hull, 32},
                                 {"hull of 64", Volume::hull, 64}};
  TableWriter table(options.out / "tightness.csv", {{"volume", ""},
                                                    {"level", ""},
                                                    {"nodes", ""},
                                                    {"radius", "m"},
                                                    {"overhang", "1"},
                                                    {"overhang_p95", "1"},
                                                    {"across", "1"}});
  const HullModel hulls = build_study_model(c.model, c.pieces, {Volume::hull, Leaves::triangles});
  std::vector<std::vector<int>> levels{{0}};
  while (!levels.back().empty()) {
    std::vector<int> next;
    for (const int n : levels.back()) {
      const HullNode& node = hulls.tree.nodes[n];
      if (!node.leaf()) next.insert(next.end(), {node.left, node.right});
    }
    std::erase_if(next, [&](int n) { return hulls.tree.nodes[n].leaf(); });
    levels.push_back(next);
  }
  const std::vector<Vec3> directions = even_directions(kDirections);
  for (const Row& row : rows) {
    const HullModel volumes =
        build_study_model(c.model, c.pieces, {row.volume, Leaves::triangles, std::max(4, row.most)});
    for (std::size_t level = 0; level + 1 < levels.size(); ++level) {
      const std::vector<int>& nodes = levels[level];
      const int count = std::min(kNodes, static_cast<int>(nodes.size()));
      std::vector<double> all;
      double radius = 0, sum = 0, across = 0;
      for (int k = 0; k < count; ++k) {
        const int n = nodes[k * nodes.size() / count];
        const double r = hulls.tree.nodes[n].radius;
        radius += r / count;
        const Vec3 thin = thin_direction(hulls.tree.hull(hulls.tree.nodes[n]));
        across += 0.5 / count * (overhang(volumes, hulls, n, thin) + overhang(volumes, hulls, n, -thin)) / r;
        for (const Vec3& d : directions) all.push_back(overhang(volumes, hulls, n, d) / r);
      }
      for (const double x : all) sum += x / static_cast<double>(all.size());
      table.row({row.name, static_cast<std::int64_t>(level), static_cast<std::int64_t>(nodes.size()), radius,
                 sum, quantile(all, 0.95), across});
    }
  }
  table.close();
}

void study_tolerance(const StudyCase& c, const StudyOptions& options) {
  TableWriter table(
      options.out / "tolerance.csv",
      with({{"tolerance", "1"}, {"early", "s"}, {"early_p95", "s"}, {"early_max", "s"}}, kTallyColumns));
  const std::vector<MotionPair>& motions = c.families[0].motions;
  const Tally truth = by_lanes(c.model, motions, reach_options(1e-12 * c.size));
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11}) {
    const Tally tally = by_lanes(c.model, motions, reach_options(tolerance * c.size));
    std::vector<double> early;
    for (std::size_t i = 0; i < motions.size(); ++i)
      if (truth.answers[i].status == Reach::Status::reached)
        early.push_back(truth.answers[i].time - tally.answers[i].time);
    table.row(
        with({tolerance, quantile(early, 0.5), quantile(early, 0.95), quantile(early, 1)}, cells(tally)));
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
    ReachOptions reach = reach_options(kStudyTolerance * c.size);
    reach.max_pairs = kMostPairs;
    const auto start = std::chrono::steady_clock::now();
    build_model(s);
    const std::int64_t boxes_ns = (std::chrono::steady_clock::now() - start) / std::chrono::nanoseconds(1);
    const auto start_hulls = std::chrono::steady_clock::now();
    const HullModel hulls = build_study_model(c.model, c.pieces, {Volume::hull, Leaves::pieces, kFewPoints});
    const std::int64_t hulls_ns =
        (std::chrono::steady_clock::now() - start_hulls) / std::chrono::nanoseconds(1);
    const auto write = [&](const std::string& family, const char* search, std::int64_t ns,
                           const Tally& tally) {
      table.row(with({family, search, static_cast<std::int64_t>(s.core.triangles.size()),
                      static_cast<std::int64_t>(c.pieces.start.size() - 1), ns},
                     cells(tally)));
    };
    for (const StudyCase::Family& family : c.families) {
      write(family.name, "boxes in lanes", boxes_ns, by_lanes(c.model, family.motions, reach));
      write(family.name, "hulls", hulls_ns,
            by_study(hulls, family.motions, reach, Order::best_first, Bound::points));
      write(family.name, "FAST's", hulls_ns,
            by_study(hulls, family.motions, reach, Order::global, Bound::directional));
    }
    progress.update(++done);
  }
  table.close();
}

namespace {

// Two bodies that pass by each other and touch in passing.
struct Grazing {
  MotionPair motion;
  Vec3 normal;  // from A to B, where they touch
};

// Makes a motion that misses graze: B is brought nearer along the nearest points' normal, again and again;
// other points come nearer by no more than that, so that the two never overlap. The nearest that a pair comes
// is found by halving: whether it comes to a gap is what a search answers.
std::optional<Grazing> grazing(const StudyCase& c, MotionPair m) {
  SearchMemory memory;
  Reach reach;
  const auto comes_to = [&](double gap) {
    ReachOptions asked = reach_options(1e-11 * c.size);
    asked.target = asked.start = gap;
    const Reach r = first_reach(c.model, m.a, c.model, m.b, asked, memory);
    if (r.status == Reach::Status::reached) reach = r;
    return r.status == Reach::Status::reached;
  };
  double high = 0.5 * c.size;
  if (comes_to(1e-3 * c.size) || !comes_to(high)) return std::nullopt;
  for (int turn = 0; turn < 100; ++turn) {
    double low = 0;
    while (high - low > std::max(1e-10 * c.size, 1e-3 * low)) {
      const double middle = 0.5 * (low + high);
      (comes_to(middle) ? high : low) = middle;
    }
    // Past each other: neither from the start on nor at the end only.
    if (reach.time < 0.1 || reach.time > 0.9) return std::nullopt;
    if (high <= 1e-9 * c.size) return Grazing{m, reach.pair.gjk.normal};
    m.b.position -= low * reach.pair.gjk.normal;
    high =
        std::max(high - low, 1e-9 * c.size) + 1e-3 * c.size;  // a new nearest pair may be as near as before
    if (!comes_to(high)) high = 0.5 * c.size;
  }
  return std::nullopt;
}

}  // namespace

void study_approach(const StudyCase& c, const StudyOptions& options) {
  TableWriter table(options.out / "approach.csv",
                    with({{"search", ""}, {"answer", ""}, {"margin", "1"}}, kTallyColumns));
  ReachOptions reach = reach_options(1e-8 * c.size);  // finer than any margin
  reach.max_pairs = kMostPairs;
  const HullModel hulls = build_study_model(c.model, c.pieces, {Volume::hull, Leaves::pieces, kFewPoints});
  std::vector<Grazing> all;
  Progress progress("motions", static_cast<std::int64_t>(c.families[0].motions.size()), options.quiet);
  std::int64_t done = 0;
  for (const MotionPair& m : c.families[0].motions) {
    if (const auto g = grazing(c, m)) all.push_back(*g);
    progress.update(++done);
  }
  if (all.empty()) throw NumericalFailure("approach: none of these motions passes by; ask for more");
  SearchMemory memory;
  for (const bool hit : {true, false})
    for (const double margin : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {  // of the size
      Tally lanes, best, fast;
      for (const Grazing& g : all) {
        MotionPair m = g.motion;
        m.b.position += (hit ? -1 : 1) * margin * c.size * g.normal;
        lanes.ask([&] { return first_reach(c.model, m.a, c.model, m.b, reach, memory); });
        best.ask([&] { return study_reach(hulls, m.a, hulls, m.b, reach, {}); });
        fast.ask([&] {
          return study_reach(hulls, m.a, hulls, m.b, reach, {Order::global, Bound::directional});
        });
      }
      check_agree(best, lanes, 1e-2, "approach");
      table.row(with({"boxes in lanes", hit ? "hit" : "miss", margin}, cells(lanes)));
      table.row(with({"hulls", hit ? "hit" : "miss", margin}, cells(best)));
      table.row(with({"FAST's", hit ? "hit" : "miss", margin}, cells(fast)));
    }
  table.close();
}

void study_pictures(const StudyCase& c, const StudyOptions& options) {
  const HullModel hulls = build_study_model(c.model, c.pieces, {Volume::hull, Leaves::pieces});
  TableWriter table(options.out / "hulls.csv",
                    {{"level", ""}, {"node", ""}, {"x", "m"}, {"y", "m"}, {"z", "m"}});
  std::vector<int> level{0};
  for (std::int64_t depth = 0; depth <= 8; ++depth) {
    std::vector<int> next;
    for (const int n : level) {
      const HullNode& node = hulls.tree.nodes[n];
      if (depth % 2 == 0)
        for (const Vec3& p : hulls.tree.hull(node)) table.row({depth, std::int64_t{n}, p.x(), p.y(), p.z()});
      if (!node.leaf()) next.insert(next.end(), {node.left, node.right});
    }
    level = std::move(next);
  }
  table.close();

  // The first of the far motions that hits after a while, as three searches see it.
  ReachOptions reach = reach_options(kStudyTolerance * c.size);
  reach.max_pairs = kMostPairs;
  TableWriter visits(options.out / "visits.csv", {{"search", ""},
                                                  {"time", "s"},
                                                  {"step", "s"},
                                                  {"gap", "m"},
                                                  {"radii", "m"},
                                                  {"leaves", ""},
                                                  {"fate", ""}});
  for (const MotionPair& m : c.families[0].motions) {
    const Reach hit = first_reach(c.model, m.a, c.model, m.b, reach);
    if (hit.status != Reach::Status::reached || hit.time < 0.3) continue;
    for (const auto& [name, order, bound] : {std::tuple{"FAST's", Order::global, Bound::directional},
                                             std::tuple{"depth first", Order::depth_first, Bound::points},
                                             std::tuple{"ours", Order::best_first, Bound::points}}) {
      std::vector<Visit> seen;
      study_reach(hulls, m.a, hulls, m.b, reach, {order, bound, &seen});
      for (const Visit& v : seen)
        visits.row({name, v.time, v.step, v.gap, v.radii, std::int64_t{v.leaves}, name_of(v.fate)});
    }
    break;
  }
  visits.close();
}

}  // namespace fc::hulls
