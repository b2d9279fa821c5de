// Exercise 4.7. First frames that play a script and write down what the loop does; then beads on a wire, where the number of
// collisions is known; then the engine's own frames.
#include "ex07_event_loop.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <random>
#include <stdexcept>

#include "ch04_multibody_stepping/world.hpp"

namespace {

using fc::mine::Event;
using fc::mine::Frame;
using Kind = fc::mine::Event::Kind;
using Log = std::vector<std::string>;

constexpr int kMostEvents = 100'000;

[[noreturn]] void endless() {
  throw std::runtime_error(
      fmt::format("{} events, and no end: does the loop leave when earliest() is empty, and is what "
                  "stalls frozen?",
                  kMostEvents));
}

// Plays its events, and writes down what is done about them.
class Script : public Frame {
 public:
  std::deque<Event> events;
  std::vector<int> changed;           // by an instant's impact
  std::vector<int> stopped = {1, 2};  // by freezing
  bool stalls = false;                // what a query finds; nothing is known before
  std::deque<Event> found;            // by queries, one each
  Log log;

  std::optional<Event> earliest() override {
    if (++taken_ > kMostEvents) endless();
    if (events.empty()) return std::nullopt;
    const Event event = events.front();
    events.pop_front();
    return event;
  }
  void query(int a, int b, double now) override {
    log.push_back(fmt::format("query {} {} at {}", a, b, now));
    answer();
  }
  void report(int a, int b, double now) override {
    log.push_back(fmt::format("report {} {} at {}", a, b, now));
  }
  std::span<const int> solve(int a, int b, double now) override {
    log.push_back(fmt::format("solve {} {} at {}", a, b, now));
    stalled_ = false;
    return changed;
  }
  void renew(std::span<const int> bodies, double now) override {
    if (bodies.empty()) return;
    log.push_back(fmt::format("renew {} at {}", fmt::join(bodies, " "), now));
    answer();
  }
  bool is_stalled(int, int) const override { return stalled_; }
  std::span<const int> freeze(double now) override {
    log.push_back(fmt::format("freeze at {}", now));
    stalls = false;
    return stopped;
  }

 private:
  void answer() {
    stalled_ = stalls;
    if (found.empty()) return;
    events.push_back(found.front());
    found.pop_front();
  }
  int taken_ = 0;
  bool stalled_ = false;
};

TEST(Ex07EventLoop, AFrameWithoutEventsIsOver) {
  Script frame;
  fc::mine::event_loop(frame);
  EXPECT_EQ(frame.log, Log{});
}

TEST(Ex07EventLoop, WhatIsClearOnlyUntilNowIsQueriedAgain) {
  Script frame;
  frame.events = {{Kind::clear, 0.25, 3, 7}};
  frame.found = {{Kind::clear, 0.5, 3, 7}, {Kind::contact, 0.75, 3, 7}};
  frame.changed = {3, 7};
  fc::mine::event_loop(frame);
  EXPECT_EQ(frame.log,
            (Log{"query 3 7 at 0.25", "query 3 7 at 0.5", "solve 3 7 at 0.75", "renew 3 7 at 0.75"}))
      << "the search had come to 0.25 s, then to 0.5 s, and found the contact at 0.75 s";
}

TEST(Ex07EventLoop, BodiesWithAnotherMotionAreRenewed) {
  Script frame;
  frame.events = {{Kind::contact, 0.5, 1, 2}};
  frame.changed = {1, 2, 5};
  fc::mine::event_loop(frame);
  EXPECT_EQ(frame.log, (Log{"solve 1 2 at 0.5", "renew 1 2 5 at 0.5"}))
      << "the impact has changed bodies 1, 2 and 5: what the queue knows of their pairs belongs to motions that are over. "
      << "Renewing them queries the pair 1 2, too: once is enough";
}

TEST(Ex07EventLoop, OneOfTheTwoIsEnough) {  // the other one is a wall
  Script frame;
  frame.events = {{Kind::contact, 0.5, 0, 4}};
  frame.changed = {4};
  fc::mine::event_loop(frame);
  EXPECT_EQ(frame.log, (Log{"solve 0 4 at 0.5", "renew 4 at 0.5"}))
      << "renewing body 4 has queried the pair 0 4 already: once is enough";
}

TEST(Ex07EventLoop, APairThatOnlyTouchesIsNotLost) {
  Script frame;
  frame.events = {{Kind::contact, 0.5, 1, 2}};
  frame.found = {{Kind::contact, 0.75, 1, 2}};
  fc::mine::event_loop(frame);
  EXPECT_EQ(frame.log,
            (Log{"solve 1 2 at 0.5", "query 1 2 at 0.5", "solve 1 2 at 0.75", "query 1 2 at 0.75"}))
      << "nothing closed in, no motion has changed, and the event is off the queue: without a query nobody ever looks at "
      << "this pair again in the frame";
}

TEST(Ex07EventLoop, AnImpactBesideThePairLeavesItToYou) {
  Script frame;
  frame.events = {{Kind::contact, 0.5, 1, 2}};
  frame.changed = {5, 6};
  fc::mine::event_loop(frame);
  EXPECT_EQ(std::ranges::count(frame.log, "renew 5 6 at 0.5"), 1)
      << fmt::format("your calls: {}", fmt::join(frame.log, ", "));
  EXPECT_EQ(std::ranges::count(frame.log, "query 1 2 at 0.5"), 1)
      << fmt::format("your calls: {}\n", fmt::join(frame.log, ", "))
      << "elsewhere in the island bodies 5 and 6 have a new motion, but neither 1 nor 2 has: renewing 5 and 6 does not query the "
      << "pair 1 2, whose event is off the queue";
}

TEST(Ex07EventLoop, SensorsAreReportedAndNotSolved) {
  Script frame;
  frame.events = {{Kind::sensed, 0.125, 2, 9}, {Kind::clear, 0.5, 1, 2}};
  fc::mine::event_loop(frame);
  EXPECT_EQ(frame.log, (Log{"report 2 9 at 0.125", "query 1 2 at 0.5"}))
      << "what a sensor sees is reported, and that is all: no impulse, and no query until one of the two has a new motion";
}

TEST(Ex07EventLoop, ImpactsThatPileUpAreFrozen) {
  Script frame;
  frame.events = {{Kind::contact, 0.5, 1, 2, true}};
  frame.changed = {2};
  frame.stopped = {2, 3};
  frame.stalls = true;
  fc::mine::event_loop(frame);
  EXPECT_EQ(frame.log, (Log{"solve 1 2 at 0.5", "renew 2 at 0.5", "freeze at 0.5", "renew 2 3 at 0.5"}))
      << "the pair had no gap left to spend, and after the impact it closes in again: time must stop for it";
}

TEST(Ex07EventLoop, APileIsSeenOnlyInTheNewAnswer) {
  Script frame;
  frame.events = {{Kind::contact, 0.5, 1, 2, true}};
  frame.stalls = true;
  fc::mine::event_loop(frame);
  EXPECT_EQ(frame.log, (Log{"solve 1 2 at 0.5", "query 1 2 at 0.5", "freeze at 0.5", "renew 1 2 at 0.5"}))
      << "is_stalled() tells of the last answer: ask after the query, not before";
}

TEST(Ex07EventLoop, WhatPartsIsNotFrozen) {
  Script frame;
  frame.events = {{Kind::contact, 0.5, 1, 2, true}};
  frame.changed = {1, 2};
  fc::mine::event_loop(frame);
  EXPECT_EQ(frame.log, (Log{"solve 1 2 at 0.5", "renew 1 2 at 0.5"}))
      << "a pair without a gap to spend has been thrown apart: it goes on";
}

TEST(Ex07EventLoop, TheFirstStallIsGivenAnImpactBeforeItIsFrozen) {
  Script frame;
  frame.events = {{Kind::contact, 0.5, 1, 2, false}};
  frame.changed = {1, 2};
  frame.stalls = true;
  fc::mine::event_loop(frame);
  EXPECT_EQ(frame.log, (Log{"solve 1 2 at 0.5", "renew 1 2 at 0.5"}))
      << "the event itself was not stalled: its next one will be, and may still part the two";
}

// Points on a wire between immovable ones, elastic; a search proves at most kSight seconds at once.
class Wire : public Frame {
 public:
  struct Bead {
    double place, velocity, mass;  // m, m/s, kg
    double time = 0;               // s, at which its place stands
  };
  static constexpr double kSight = 0.4;
  std::vector<Bead> beads;
  int collisions = 0;

  Wire(std::vector<Bead> start, double end) : beads(std::move(start)), end_(end), answers_(beads.size(), 0) {
    for (std::size_t left = 0; left + 1 < beads.size(); ++left) query(left, left + 1, 0);
  }
  double place(int bead, double now) const {
    return beads[bead].place + (now - beads[bead].time) * beads[bead].velocity;
  }
  std::optional<Event> earliest() override {
    if (++taken_ > kMostEvents) endless();
    while (true) {
      std::size_t first = queue_.size();
      for (std::size_t i = 0; i < queue_.size(); ++i)
        if (queue_[i].answer == answers_[queue_[i].event.a] &&
            (first == queue_.size() || queue_[i].event.time < queue_[first].event.time))
          first = i;
      if (first == queue_.size()) return std::nullopt;
      const Event event = queue_[first].event;
      queue_.erase(queue_.begin() + static_cast<std::ptrdiff_t>(first));
      return event;
    }
  }
  void query(int a, int b, double now) override {
    const int answer = ++answers_[a];
    const double gap = place(b, now) - place(a, now), closing = beads[a].velocity - beads[b].velocity;
    double time = closing > 0 ? now + std::max(gap, 0.0) / closing : std::numeric_limits<double>::infinity();
    Kind kind = Kind::contact;
    if (time > now + kSight) {
      time = now + kSight;
      kind = Kind::clear;
    }
    if (time < end_) queue_.push_back({{kind, time, a, b}, answer});
  }
  void report(int, int, double) override { FAIL() << "no sensors here"; }
  std::span<const int> solve(int a, int b, double now) override {
    changed_.clear();
    Bead &left = beads[a], &right = beads[b];
    EXPECT_NEAR(place(a, now), place(b, now), 1e-9) << "m: beads that do not touch now were solved";
    const double closing = left.velocity - right.velocity;
    if (closing <= 0) return changed_;
    ++collisions;
    const double inverse = 1 / left.mass + 1 / right.mass, impulse = 2 * closing / inverse;
    for (const int bead : {a, b}) {
      if (std::isinf(beads[bead].mass)) continue;
      beads[bead].place = place(bead, now);
      beads[bead].time = now;
      beads[bead].velocity += (bead == a ? -impulse : impulse) / beads[bead].mass;
      changed_.push_back(bead);
    }
    return changed_;
  }
  void renew(std::span<const int> bodies, double now) override {
    std::vector<char> left(beads.size(), 0);
    for (const int body : bodies) {
      if (body > 0) left[body - 1] = 1;
      if (body + 1 < static_cast<int>(beads.size())) left[body] = 1;
    }
    for (int a = 0; a < static_cast<int>(beads.size()); ++a)
      if (left[a]) query(a, a + 1, now);
  }
  bool is_stalled(int, int) const override { return false; }
  std::span<const int> freeze(double) override {
    ADD_FAILURE() << "nothing piles up on this wire";
    return {};
  }

 private:
  struct Waiting {
    Event event;
    int answer;
  };
  double end_;
  std::vector<int> answers_;  // of the pair of each bead with the next
  std::vector<Waiting> queue_;
  std::vector<int> changed_;
  int taken_ = 0;
};

constexpr double kWall = std::numeric_limits<double>::infinity();  // kg

TEST(Ex07EventLoop, GalperinsBlocksCountTheDigitsOfPi) {
  const int digits[] = {3, 31, 314, 3141};
  double ratio = 1;
  for (const int expected : digits) {
    Wire wire({{0, 0, kWall}, {1, 0, 1}, {2, -1, ratio}}, 20);
    fc::mine::event_loop(wire);
    EXPECT_EQ(wire.collisions, expected)
        << "collisions of a block of " << ratio << " kg that pushes one of 1 kg against a wall";
    ratio *= 100;
  }
}

TEST(Ex07EventLoop, EqualBeadsHandOnTheirVelocities) {
  std::mt19937_64 random(47);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Wire::Bead> beads;
  double energy = 0;
  for (int i = 0; i < 12; ++i) beads.push_back({static_cast<double>(i), any(random), 1});
  for (const Wire::Bead& bead : beads) energy += bead.velocity * bead.velocity;
  std::vector<double> ends;  // of straight lines, which the beads exchange
  int crossings = 0;
  for (std::size_t i = 0; i < beads.size(); ++i) {
    ends.push_back(beads[i].place + 9 * beads[i].velocity);
    for (std::size_t k = 0; k < i; ++k) crossings += ends[k] > ends[i];
  }
  std::sort(ends.begin(), ends.end());
  Wire wire(beads, 9);
  fc::mine::event_loop(wire);
  EXPECT_EQ(wire.collisions, crossings) << "every crossing of two lines is a collision";
  for (std::size_t i = 0; i < beads.size(); ++i) {
    EXPECT_NEAR(wire.place(static_cast<int>(i), 9), ends[i], 1e-9) << "m, bead " << i << " after 9 s";
    energy -= wire.beads[i].velocity * wire.beads[i].velocity;
  }
  EXPECT_NEAR(energy, 0, 1e-12);
}

// Boxes and balls above a floor, thrown together.
fc::Scene thrown_together(std::uint64_t seed, double restitution, bool falls) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  fc::Scene scene;
  scene.restitution = restitution;
  if (falls) scene.gravity = fc::Vec3(0, 0, -9.81);
  fc::ShapeSpec ball, box, floor;
  ball.name = "ball";
  ball.geometry = fc::SphereSpec{0.4};
  box.name = "box";
  box.geometry = fc::BoxSpec{fc::Vec3(0.8, 0.6, 0.5)};
  floor.name = "floor";
  floor.geometry = fc::BoxSpec{fc::Vec3(40, 40, 1)};
  ball.mass = box.mass = 1;
  scene.shapes = {ball, box, floor};
  fc::BodySpec below;
  below.shape = 2;
  below.is_static = true;
  below.position = fc::Vec3(0, 0, -0.5);
  scene.bodies = {below};
  for (int i = 0; i < 12; ++i) {
    fc::BodySpec body;
    body.shape = i % 2;
    body.position = fc::Vec3(1.3 * (i % 3 - 1), 1.3 * (i / 3 % 2), 0.7 + 1.2 * (i / 6));
    body.velocity = fc::Vec3(2 * any(random), 2 * any(random), 2 * any(random));
    if (i % 2 == 1) body.spin = fc::Vec3(2 * any(random), 2 * any(random), 2 * any(random));
    scene.bodies.push_back(body);
  }
  return scene;
}

TEST(Ex07EventLoop, MovesTheEnginesBodiesAsTheBooksLoopDoes) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const fc::Scene scene = thrown_together(seed, seed % 2 == 0 ? 0.9 : 0.2, seed > 2);
    fc::world::World yours = fc::world::build_world(scene), books = fc::world::build_world(scene);
    yours.event_loop = fc::mine::event_loop;
    for (int frame = 0; frame < 30; ++frame) {
      const fc::world::StepReport mine = fc::world::step(yours, 1.0 / 30),
                                  expected = fc::world::step(books, 1.0 / 30);
      ASSERT_EQ(mine.impacts, expected.impacts) << "impacts in frame " << frame << " of scene " << seed;
      ASSERT_EQ(mine.lost_time, expected.lost_time) << "s in frame " << frame << " of scene " << seed;
    }
    for (std::size_t i = 0; i < books.bodies.size(); ++i)
      EXPECT_EQ(yours.bodies[i].state.position, books.bodies[i].state.position)
          << "body " << i << " of scene " << seed << " is "
          << (yours.bodies[i].state.position - books.bodies[i].state.position).norm()
          << " m from where it should be";
  }
}

}  // namespace
