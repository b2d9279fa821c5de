// What the study counts over many queries, and how that becomes rows of a table.
#pragma once

#include "ch02_hull_hierarchy/study/parts.hpp"
#include "common/stopwatch.hpp"
#include "common/table.hpp"

namespace fc::hulls {

constexpr int kFewPoints = 64;  // of an inner hull: further ones cost more than they gain (leaves.csv)
constexpr int kAllPoints = 1'000'000;
constexpr std::int64_t kMostPairs = 3'000'000;  // of a query: then it counts as given up

// What a search answered, query by query, and what it cost.
struct Tally {
  std::vector<double> nodes, leaves, rounds, ns;
  std::vector<TimeOfContact> answers;
  std::int64_t given_up = 0;

  template <class Ask>
  void ask(const Ask& search) {
    const Stopwatch watch;
    const auto toc = search();
    ns.push_back(static_cast<double>(watch.ns()));
    nodes.push_back(static_cast<double>(toc.node_pairs));
    leaves.push_back(static_cast<double>(toc.leaf_pairs));
    if constexpr (requires { toc.rounds; }) rounds.push_back(static_cast<double>(toc.rounds));
    given_up += toc.status == TimeOfContact::Status::limit;
    answers.push_back(toc);
  }
};

// A median of counts, as a whole number.
inline std::int64_t whole(double x) {
  return static_cast<std::int64_t>(x);
}

std::vector<Column> with(std::vector<Column> first, const std::vector<Column>& more);
std::vector<Cell> with(std::vector<Cell> first, const std::vector<Cell>& more);

// Medians, and what 95 % of the queries stay within: the columns and the cells of a row.
extern const std::vector<Column> kTallyColumns;
std::vector<Cell> cells(const Tally& tally);

// Runs every motion: by the search in four lanes that the chapters use, or by one of the study's.
Tally by_lanes(const Model& model, const std::vector<MotionPair>& motions, const TocOptions& options);
Tally by_study(const HullModel& model, const std::vector<MotionPair>& motions, const TocOptions& options,
               Order order, Bound bound);

// Throws NumericalFailure if a search, where it did not give up, disagrees with another one.
void check_agree(const Tally& tally, const Tally& truth, double slack, const std::string& what);

}  // namespace fc::hulls
