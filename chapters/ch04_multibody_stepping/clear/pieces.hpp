// Chapter 4's pieces, each of which is an exercise: the gap rule, and the loop of a step. The engine's step itself calls them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ch02_hull_hierarchy/clear/pieces.hpp"
#include "ch03_impulse_lcp/clear/pieces.hpp"
#include "common/pieces.hpp"

namespace fc::world::clear {

// What gaps are measured against in a scene, all in m.
struct GapScale {
  double far = 1e-6;  // a gap beyond it is far; the tolerance, or more
  double little =
      1e-8;  // a gap of at most this is too little to be halved again: a hundredth of the tolerance
  double rounding = 0;  // a certified gap may be off by this: 64 rounding terms; > 0, but for balls
};

struct NextGap {
  double target = 0;   // m, at which the search for the pair's next contact stops
  bool spent = false;  // nothing is left to spend: if the pair still closes in, impacts pile up
};

// 4.6: at which gap the next contact of a pair is looked for, from the certified gap now (m; infinite: it is far). The target
// is below the gap, and above 0 wherever the gap is more than rounding.
using GapRuleFunction = NextGap(double gap, const GapScale& scale);
GapRuleFunction gap_rule;

// What happens next in a frame, to two bodies.
struct Event {
  enum class Kind {
    clear,    // nothing yet: the pair is proved clear only until now
    contact,  // the pair has come to its gap
    sensed    // the same, but one of the two is a sensor
  };
  Kind kind = Kind::clear;
  double time = 0;       // s in the frame
  int a = 0, b = 0;      // bodies
  bool stalled = false;  // a contact with no gap left to spend
};

// A frame, as its loop sees it: the pairs of bodies that come near each other, a queue of their events, and what can be done
// about them. At its start all pairs have been queried. Times in s, within the frame.
class Frame {
 public:
  virtual ~Frame() = default;
  // The earliest event, which is taken off the queue; events of pairs that have got a later answer are passed over. Empty: no
  // event is left in the frame.
  virtual std::optional<Event> earliest() = 0;
  // Looks for the next event of two bodies from `now` on, which then waits in the queue.
  virtual void query(int a, int b, double now) = 0;
  // Reports what a sensor sees. The pair is left alone until one of the two moves otherwise.
  virtual void report(int a, int b, double now) = 0;
  // Solves all contacts of now that are connected with these two bodies, as one problem. Returns the bodies whose motion it has
  // changed (until the next call); none if nothing closes in.
  virtual std::span<const int> solve(int a, int b, double now) = 0;
  // These bodies move otherwise from now on: whatever was known of their pairs is void, and all of them are queried anew.
  virtual void renew(std::span<const int> bodies, double now) = 0;
  // Whether the last answer about two bodies is that they close in at once, with no gap left to spend.
  virtual bool is_stalled(int a, int b) const = 0;
  // Stops all bodies of the instant that was solved last, until the frame's end. Returns those whose motion it has changed.
  virtual std::span<const int> freeze(double now) = 0;
};

// 4.7: one frame, from contact to contact, until no event is left in it.
using EventLoopFunction = void(Frame& frame);
EventLoopFunction event_loop;

struct Pieces {
  hulls::clear::Pieces hulls;  // chapter 2's, with chapter 1's
  lcp::clear::Pieces lcp;      // chapter 3's
  GapRuleFunction* gap_rule = clear::gap_rule;
  EventLoopFunction* event_loop = clear::event_loop;
};
// In the order of the exercises, the earlier chapters' first: those on which a scene of many bodies runs.
std::vector<PieceSlot> slots(Pieces& pieces);

}  // namespace fc::world::clear
