#include "ch02_hull_hierarchy/study/tally.hpp"

#include <algorithm>
#include <cmath>

#include "ch02_hull_hierarchy/convex_pieces.hpp"
#include "ch02_hull_hierarchy/study/mesh.hpp"
#include "common/errors.hpp"

namespace fc::hulls {

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

Tally by_lanes(const Model& model, const std::vector<MotionPair>& motions, const TocOptions& options) {
  Tally tally;
  SearchMemory memory;
  for (const MotionPair& m : motions)
    tally.ask([&] { return time_of_contact(model, m.a, model, m.b, options, memory); });
  return tally;
}

Tally by_study(const HullModel& model, const std::vector<MotionPair>& motions, const TocOptions& options,
               Order order, Bound bound) {
  Tally tally;
  for (const MotionPair& m : motions)
    tally.ask([&] { return study_time_of_contact(model, m.a, model, m.b, options, {order, bound}); });
  return tally;
}

void check_agree(const Tally& tally, const Tally& truth, double slack, const std::string& what) {
  for (std::size_t i = 0; i < truth.answers.size(); ++i) {
    const TimeOfContact &x = tally.answers[i], &y = truth.answers[i];
    if (x.status == TimeOfContact::Status::limit) continue;
    if (x.status != y.status || std::abs(x.time - y.time) > slack)
      throw NumericalFailure(what + ": query " + std::to_string(i) + " ends at " + std::to_string(x.time) +
                             " s, not at " + std::to_string(y.time) + " s");
  }
}

TocOptions toc_options(double tolerance) {
  TocOptions options;
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

}  // namespace fc::hulls
