#include "ch02_hull_hierarchy/advance.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "ch02_hull_hierarchy/features.hpp"
#include "ch02_hull_hierarchy/inside.hpp"

namespace fc::hulls {

void advance(const Model& a, const ca::Motion& motion_a, const Model& b, const ca::Motion& motion_b,
             const ca::AdvanceOptions& options, SearchMemory& memory, ca::AdvanceResult& result) {
  ca::check_query(motion_a, motion_b, options);
  result.clear();
  const ca::PairPose start(motion_a, motion_b, 0), end(motion_a, motion_b, options.interval);
  result.tolerance = std::max(options.tolerance, 8 * std::max(ca::rounding_term(a.whole(), b.whole(), start),
                                                              ca::rounding_term(a.whole(), b.whole(), end)));
  const double tolerance = result.tolerance;

  TocOptions search;
  search.interval = options.interval;
  search.tolerance = tolerance;
  search.target = 0.5 * tolerance;
  search.slack = 0.25 * tolerance;
  search.start = tolerance;
  search.max_pairs = options.max_iterations;
  memory.certificate = options.certificate ? &result : nullptr;
  const TimeOfContact toc = time_of_contact(a, motion_a, b, motion_b, search, memory);
  memory.certificate = nullptr;
  result.iterations = toc.advances;
  result.node_pairs = toc.node_pairs;
  result.distance_calls = toc.leaf_pairs;
  result.toc = toc.time;
  const bool inside = one_inside_other(a, b, start, tolerance);
  const bool at_start = toc.status == TimeOfContact::Status::reached && toc.time == 0;
  if (inside) result.toc = 0;
  const ca::PairPose pose(motion_a, motion_b, result.toc);
  if (toc.status == TimeOfContact::Status::reached && !at_start && !inside) {
    // Every other pair keeps its target until `toc` or longer.
    result.gap_lower = std::min(toc.pair.gjk.lower, search.target);
    result.gap_upper = toc.pair.gjk.upper;
    result.status = result.gap_upper <= tolerance ? ca::Status::contact : ca::Status::unresolved;
  } else if (toc.status == TimeOfContact::Status::clear && !inside && !options.end_distance) {
    result.gap_lower = search.target;
    result.gap_upper = std::numeric_limits<double>::infinity();
    result.status = ca::Status::separated;
  } else {
    const ModelDistance d = model_distance(a, b, pose, tolerance);
    result.node_pairs += d.node_pairs;
    result.distance_calls += d.leaf_pairs;
    result.gap_lower = inside ? std::min(0.0, d.lower) : d.lower;
    result.gap_upper = inside ? 0 : d.upper;
    result.status = inside || (at_start && d.lower < -tolerance) ? ca::Status::penetrating_at_start
                    : at_start                                   ? ca::Status::touching_at_start
                    : toc.status == TimeOfContact::Status::clear ? ca::Status::separated
                                                                 : ca::Status::unresolved;
  }
  if (!options.features) return;
  if (result.status == ca::Status::contact || result.status == ca::Status::touching_at_start)
    result.features = contact_features(a, b, pose, motion_a.position_at(result.toc), tolerance);
}

ca::AdvanceResult advance(const Model& a, const ca::Motion& motion_a, const Model& b,
                          const ca::Motion& motion_b, const ca::AdvanceOptions& options) {
  SearchMemory memory;
  ca::AdvanceResult result;
  advance(a, motion_a, b, motion_b, options, memory, result);
  return result;
}

}  // namespace fc::hulls
