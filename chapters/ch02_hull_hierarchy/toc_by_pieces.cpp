#include "ch02_hull_hierarchy/toc_by_pieces.hpp"

#include <stdexcept>

#include "ch02_hull_hierarchy/hull_model.hpp"

namespace fc::hulls {

TimeOfContact toc_by_pieces(const Model& a, const ca::Motion& motion_a, const Model& b,
                            const ca::Motion& motion_b, const TocOptions& options,
                            const clear::Pieces& pieces) {
  if (!a.hulls || !b.hulls) throw std::invalid_argument("toc_by_pieces: a model has no hulls");
  if (!motion_a.steady() || !motion_b.steady())
    throw std::invalid_argument("toc_by_pieces: a motion whose spin or acceleration changes");
  clear::SearchOptions search;
  search.interval = options.interval;
  search.target = options.target;
  search.slack = options.slack;
  search.start = options.start;
  search.most_looks = options.max_pairs;
  const clear::FirstContact found = pieces.search(*a.hulls, motion_a, *b.hulls, motion_b, search, pieces.ca);

  TimeOfContact toc;
  toc.time = found.time;
  toc.node_pairs = found.looks;
  toc.advances = found.advances;
  const HullModel &hulls_a = *a.hulls, &hulls_b = *b.hulls;
  const ca::clear::Gap roots =
      pieces.ca.gap(hulls_a.convex(hulls_a.tree.nodes[0]), hulls_b.convex(hulls_b.tree.nodes[0]),
                    ca::PairPose(motion_a, motion_b, 0), options.tolerance, pieces.ca.closest_point);
  toc.start_gap = std::max(0.0, roots.lower);
  switch (found.status) {
    case clear::FirstContact::Status::contact:
      // From here on the engine needs triangles, not pieces.
      toc.status = TimeOfContact::Status::reached;
      toc.pair =
          model_distance(a, b, ca::PairPose(motion_a, motion_b, found.time), options.tolerance).nearest;
      break;
    case clear::FirstContact::Status::clear:
      toc.status = TimeOfContact::Status::clear;
      break;
    case clear::FirstContact::Status::limit:
      toc.status = TimeOfContact::Status::limit;
      break;
  }
  return toc;
}

}  // namespace fc::hulls
