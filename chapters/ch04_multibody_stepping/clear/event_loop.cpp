#include <algorithm>

#include "ch04_multibody_stepping/clear/pieces.hpp"

namespace fc::world::clear {

// ANCHOR: event_loop
void event_loop(Frame& frame) {
  while (const std::optional<Event> event = frame.earliest()) {
    const auto [kind, now, a, b, stalled] = *event;
    if (kind == Event::Kind::clear) {  // the search got only this far
      frame.query(a, b, now);
      continue;
    }
    if (kind == Event::Kind::sensed) {
      frame.report(a, b, now);
      continue;
    }
    // Solve all contacts of this instant together. What was known of bodies with a new motion is void.
    const std::span<const int> changed = frame.solve(a, b, now);
    const bool touched = std::ranges::count(changed, a) + std::ranges::count(changed, b) > 0;
    frame.renew(changed, now);
    // If neither of the two has a new motion, their pair has no event in the queue now: look for the next one.
    if (!touched) frame.query(a, b, now);
    // No gap left to spend, and still closing in: impacts would pile up without end.
    if (stalled && frame.is_stalled(a, b)) frame.renew(frame.freeze(now), now);
  }
}
// ANCHOR_END: event_loop

}  // namespace fc::world::clear
