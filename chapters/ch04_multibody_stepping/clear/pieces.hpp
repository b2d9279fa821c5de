// Chapter 4's pieces, each an exercise: the gap rule, and the loop of a step. The engine's own step calls them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ch02_hull_hierarchy/clear/pieces.hpp"
#include "ch03_impulse_lcp/clear/pieces.hpp"
#include "common/pieces.hpp"

namespace fc::world::clear {

// The lengths against which a scene's gaps are measured, all in m.
struct GapScale {
  double far = 1e-6;  // a larger gap is far; at least the tolerance
  double little =
      1e-8;             // a gap of at most this is too small to be halved again: a hundredth of the tolerance
  double rounding = 0;  // the error that a certified gap may have: 64 rounding terms; > 0, except for balls
};

struct NextGap {
  double target = 0;   // m, the gap at which the search for the pair's next contact stops
  bool spent = false;  // no gap is left to spend: if the pair still closes in, impacts pile up
};

// 4.6: the gap at which the search for a pair's next contact stops, from the certified gap now (m; infinite if the pair
// is far apart). The target is below the gap, and above 0 wherever the gap exceeds the rounding.
using GapRuleFunction = NextGap(double gap, const GapScale& scale);
GapRuleFunction gap_rule;

// What happens next to two bodies in a frame.
struct Event {
  enum class Kind {
    clear,    // nothing yet: the pair is proved clear only until now
    contact,  // the pair has reached its target gap
    sensed    // the same, but one of the two is a sensor
  };
  Kind kind = Kind::clear;
  double time = 0;       // s in the frame
  int a = 0, b = 0;      // bodies
  bool stalled = false;  // a contact with no gap left to spend
};

// A frame as its loop sees it: the pairs of bodies that come near each other, a queue of their events, and what can be
// done about them. At its start all pairs have been queried. Times are in s, within the frame.
class Frame {
 public:
  virtual ~Frame() = default;
  // Takes the earliest event off the queue. Events of pairs with a newer answer are skipped. Empty: no event is left in
  // the frame.
  virtual std::optional<Event> earliest() = 0;
  // Searches for the next event of two bodies from `now` on, and puts it into the queue.
  virtual void query(int a, int b, double now) = 0;
  // Reports what a sensor sees. The pair is not queried again until one of the two gets a new motion.
  virtual void report(int a, int b, double now) = 0;
  // Solves all contacts at `now` that are connected with these two bodies, as one problem. Returns the bodies whose
  // motion changed (valid until the next call); none if no contact closes in.
  virtual std::span<const int> solve(int a, int b, double now) = 0;
  // These bodies have a new motion from `now` on: what was known of their pairs is void, and the pairs are queried
  // again.
  virtual void renew(std::span<const int> bodies, double now) = 0;
  // Whether the last answer about two bodies is that they close in at once, with no gap left to spend.
  virtual bool is_stalled(int a, int b) const = 0;
  // Freezes all bodies of the instant that was solved last, until the frame's end. Returns those whose motion changed.
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
// The pieces that a scene of many bodies needs, in the order of the exercises, the earlier chapters' first.
std::vector<PieceSlot> slots(Pieces& pieces);

}  // namespace fc::world::clear
