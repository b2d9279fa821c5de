// Exercise 4.7: the loop of a step.
#pragma once

#include "ch04_multibody_stepping/clear/pieces.hpp"

namespace fc::mine {

using world::clear::Event;
using world::clear::Frame;

// Takes one event after the other from the frame, the earliest first, until none is left in it.
//   Event::Kind::clear    The search has proved no more than that nothing happens before: the pair is queried again from now.
//   Event::Kind::sensed   It is reported. Nothing else happens: the pair is not solved, and not queried.
//   Event::Kind::contact  The contacts of the instant are solved together, and the bodies that have got another motion are
//                         renewed (their pairs are queried anew by that, each once). If neither body of this event is among
//                         them, the pair has no event in the queue now, and must be queried from now on, or it is lost.
//                         If after that a pair that had stalled is stalled again, the bodies of the instant are frozen, and
//                         those whose motion that changes are renewed, too.
// clear/pieces.hpp says what each function of Frame does. What solve() and freeze() return lives until the next call of
// either.
void event_loop(Frame& frame);

}  // namespace fc::mine
