// Exercise 4.7: the loop of a step.
#pragma once

#include "ch04_multibody_stepping/clear/pieces.hpp"

namespace fc::mine {

using world::clear::Event;
using world::clear::Frame;

// Takes one event after the other from the frame, the earliest first, until none is left.
//   Event::Kind::clear    The search has proved only that nothing happens before: the pair is queried again from now on.
//   Event::Kind::sensed   It is reported. Nothing else happens: the pair is not solved, and not queried.
//   Event::Kind::contact  The contacts of the instant are solved together, and the bodies with a new motion are renewed (which
//                         queries their pairs again, each once). If neither body of this event is among them, the pair has
//                         no event in the queue now: it must be queried from now on, or it is lost.
//                         If the event was stalled, and the pair is stalled again after that, the bodies of the instant are
//                         frozen, and those whose motion this changes are renewed, too.
// clear/pieces.hpp says what each function of Frame does; to renew no bodies does nothing. The results of solve() and
// freeze() are valid until the next call of either.
void event_loop(Frame& frame);

}  // namespace fc::mine
