// What accuracy costs, against the tolerance and against the margin by which bodies meet or miss.
#include <algorithm>
#include <optional>

#include "ch02_hull_hierarchy/study/tally.hpp"
#include "common/errors.hpp"
#include "common/program.hpp"

namespace fc::hulls {

void study_tolerance(const StudyCase& c, const StudyOptions& options) {
  TableWriter table(
      options.out / "tolerance.csv",
      with({{"tolerance", "1"}, {"early", "s"}, {"early_p95", "s"}, {"early_max", "s"}}, kTallyColumns));
  const std::vector<MotionPair>& motions = c.families[0].motions;
  const Tally truth = by_lanes(c.model, motions, toc_options(1e-12 * c.size));
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11}) {
    const Tally tally = by_lanes(c.model, motions, toc_options(tolerance * c.size));
    std::vector<double> early;
    for (std::size_t i = 0; i < motions.size(); ++i)
      if (truth.answers[i].status == TimeOfContact::Status::reached)
        early.push_back(truth.answers[i].time - tally.answers[i].time);
    table.row(
        with({tolerance, quantile(early, 0.5), quantile(early, 0.95), quantile(early, 1)}, cells(tally)));
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
// other points come nearer by no more than that, so that the two never overlap. The smallest gap of a motion
// is found by bisection: one search answers whether the pair comes to a given gap.
std::optional<Grazing> grazing(const StudyCase& c, MotionPair m) {
  SearchMemory memory;
  TimeOfContact toc;
  const auto comes_to = [&](double gap) {
    TocOptions asked = toc_options(1e-11 * c.size);
    asked.target = asked.start = gap;
    const TimeOfContact r = time_of_contact(c.model, m.a, c.model, m.b, asked, memory);
    if (r.status == TimeOfContact::Status::reached) toc = r;
    return r.status == TimeOfContact::Status::reached;
  };
  double high = 0.5 * c.size;
  if (comes_to(1e-3 * c.size) || !comes_to(high)) return std::nullopt;
  for (int turn = 0; turn < 100; ++turn) {
    double low = 0;
    while (high - low > std::max(1e-10 * c.size, 1e-3 * low)) {
      const double middle = 0.5 * (low + high);
      (comes_to(middle) ? high : low) = middle;
    }
    // Passing by: not in contact from the start on, nor only at the end.
    if (toc.time < 0.1 || toc.time > 0.9) return std::nullopt;
    if (high <= 1e-9 * c.size) return Grazing{m, toc.pair.gjk.normal};
    m.b.position -= low * toc.pair.gjk.normal;
    high = std::max(high - low, 1e-9 * c.size) +
           1e-3 * c.size;  // another pair may now be as near as the first was
    if (!comes_to(high)) high = 0.5 * c.size;
  }
  return std::nullopt;
}

}  // namespace

void study_approach(const StudyCase& c, const StudyOptions& options) {
  TableWriter table(options.out / "approach.csv",
                    with({{"search", ""}, {"answer", ""}, {"margin", "1"}}, kTallyColumns));
  TocOptions asked = toc_options(1e-8 * c.size);  // finer than any margin
  asked.max_pairs = kMostPairs;
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
        lanes.ask([&] { return time_of_contact(c.model, m.a, c.model, m.b, asked, memory); });
        best.ask([&] { return study_time_of_contact(hulls, m.a, hulls, m.b, asked, {}); });
        fast.ask([&] {
          return study_time_of_contact(hulls, m.a, hulls, m.b, asked, {Order::global, Bound::directional});
        });
      }
      check_agree(best, lanes, 1e-2, "approach");
      table.row(with({"boxes in lanes", hit ? "hit" : "miss", margin}, cells(lanes)));
      table.row(with({"hulls", hit ? "hit" : "miss", margin}, cells(best)));
      table.row(with({"FAST's", hit ? "hit" : "miss", margin}, cells(fast)));
    }
  table.close();
}

}  // namespace fc::hulls
