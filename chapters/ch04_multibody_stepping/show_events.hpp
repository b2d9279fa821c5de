// One frame, drawn: watches a step while it runs on a copy of a world, and turns its events into steps.
#pragma once

#include <functional>
#include <vector>

#include "ch01_convex_advancement/show_advance.hpp"
#include "ch04_multibody_stepping/contact_search.hpp"
#include "ch04_multibody_stepping/world.hpp"
#include "common/algorithm.hpp"

namespace fc::world {

// A pair of bodies whose next event waits in the queue.
struct WaitingEvent {
  double time = 0;  // s in the frame
  int a = 0, b = 0;
};

// Two bodies that met, and how they moved until then.
struct SeenSearch {
  int a = 0, b = 0;
  double from = 0, to = 0;  // s in the frame: since when their motions have been these, and the frame's end
  ca::Motion motion_a, motion_b;  // their times count from `from`
};

// The bodies of an instant at its time, before it is solved, and all that touches.
struct SeenInstant {
  std::vector<int> numbers;  // of the bodies
  std::vector<RigidBody> states;
  std::vector<lcp::Contact> contacts;  // bodies by their places here
};

struct SeenEvent {
  enum class Kind { begin, clear, contact, sensed, plans_end };
  Kind kind = Kind::clear;
  double time = 0;  // s in the frame
  int a = -1, b = -1;
  bool stalled = false, frozen = false;  // no gap is left; its bodies were frozen
  std::vector<WaitingEvent> queue = {};  // the earliest of those that waited before it
  int waiting = 0;                       // all of them
  std::vector<RigidBody> states = {};    // of all bodies, at its time, before it
  std::vector<double> clocks = {};       // s in the frame, after it: at which time each body's state stands
  std::vector<int> changed = {};         // bodies with a new motion
  SeenSearch search = {};                // of a contact
  SeenInstant instant = {};              // of a contact that is solved as in chapter 3
};

// Collects what happens. A later chapter's planner may call it, too.
class FrameWatch {
 public:
  static constexpr int kMost = 32;  // events that are kept; the others are only counted

  // An event is about to be dealt with, at `now` (s in the part of the frame that is being stepped).
  void before(const World& world, const clear::Event& event, SeenEvent::Kind kind, double part_end);
  // It has been dealt with.
  void after(const World& world, std::span<const int> changed);
  void instant(const World& world, int a, int b, double now);
  void frozen();

  std::vector<SeenEvent> events;
  int contacts = 0, others = 0;  // events, of all

 private:
  bool keeps_ = false;  // the event that is being dealt with
};

// Steps the world by chapter 4's own step, and watches.
StepReport watched_step(World& world, double dt, FrameWatch& watch, const Listeners& listeners = {});

std::vector<algorithm::BodyPose> poses_of(const std::vector<RigidBody>& states, const World& world);

// The part of chapter 4: the queue, and each event with the bodies at its time and their clocks.
algorithm::Part show_events(const World& world, const FrameWatch& watch, double dt, double t0);

}  // namespace fc::world
