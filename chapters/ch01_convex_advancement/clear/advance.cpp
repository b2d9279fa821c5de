// 1.9, in its clear form: conservative advancement.
#include <algorithm>
#include <stdexcept>

#include "ch01_convex_advancement/clear/answer.hpp"
#include "ch01_convex_advancement/clear/pieces.hpp"
#include "ch01_convex_advancement/gjk.hpp"

namespace fc::ca::clear {

// ANCHOR: advance
AdvanceResult advance(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                      const AdvanceOptions& options, const Pieces& pieces) {
  check_clear_query(motion_a, motion_b, options);
  AdvanceResult result;
  double t = 0;
  while (true) {
    const PairPose pose(motion_a, motion_b, t);
    const double tolerance = std::max(options.tolerance, 8 * rounding_term(a, b, pose));
    const double target = tolerance / 2;  // never aim at contact: at distance 0 there is no plane
    const Gap g = pieces.gap(a, b, pose, tolerance / 8, pieces.closest_point);
    report(result, t, g, tolerance);

    // Is it over?
    if (g.upper <= tolerance) {
      result.status = t > 0 ? Status::contact : status_at_start(a, b, pose, g, tolerance, result);
      if (result.status != Status::penetrating_at_start)
        result.features.push_back(witness(g, motion_a.position_at(t)));
      return result;
    }
    if (t >= options.interval) {
      result.status = Status::separated;
      return result;
    }
    if (result.iterations >= options.max_iterations || g.lower <= target)
      return result;  // unresolved: clear until t, and nothing is known after it

    // How long does the gap last, above the target?
    const double remaining = options.interval - t;
    const double speed =
        pieces.speed_bound(g.normal, mover(a, motion_a, t), mover(b, motion_b, t), remaining);
    const double room = g.lower - target;
    const bool clear = speed * remaining <= room;  // to the end; so it is for speed <= 0
    const double step = clear ? remaining : room / speed;
    const double next = clear ? options.interval : t + step;
    if (!(next > t)) return result;  // unresolved: the step is below the rounding of t
    if (options.certificate) result.certificate.push_back({t, g.normal, g.lower, room / step, step});
    ++result.iterations;
    t = next;
  }
}
// ANCHOR_END: advance

}  // namespace fc::ca::clear
