#include "ch04_multibody_stepping/show_events.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fc::world {
namespace {

using algorithm::Role;
using algorithm::Step;

constexpr std::size_t kQueue = 12;   // events of the queue that are shown,
constexpr std::size_t kClocks = 14;  // clocks,
constexpr std::size_t kPoses = 120;  // and bodies that are drawn elsewhere

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

// The bodies of an island with their states, and its contacts by their places; static bodies at the end, as they come.
SeenInstant seen(const World& world, const Island& island, double now) {
  SeenInstant seen{island.bodies, {}, island.contacts};
  const auto place_of = [&](int body) {
    auto found = std::find(seen.numbers.begin(), seen.numbers.end(), body);
    if (found == seen.numbers.end()) found = seen.numbers.insert(found, body);
    return static_cast<int>(found - seen.numbers.begin());
  };
  for (lcp::Contact& contact : seen.contacts) {
    contact.body_a = place_of(contact.body_a);
    contact.body_b = place_of(contact.body_b);
  }
  for (const int body : seen.numbers) seen.states.push_back(world.state_at(body, now));
  return seen;
}

// The loop's view of the frame, with a watch beside it.
class WatchedFrame final : public clear::Frame {
 public:
  WatchedFrame(clear::Frame& frame, const World& world, FrameWatch& watch, double end)
      : frame_(frame), world_(world), watch_(watch), end_(end) {}

  std::optional<clear::Event> earliest() override {
    using Kind = clear::Event::Kind;
    watch_.after(world_, changed_);
    changed_.clear();
    const std::optional<clear::Event> event = frame_.earliest();
    if (!event) return event;
    watch_.before(world_, *event,
                  event->kind == Kind::contact  ? SeenEvent::Kind::contact
                  : event->kind == Kind::sensed ? SeenEvent::Kind::sensed
                                                : SeenEvent::Kind::clear,
                  end_);
    return event;
  }
  void query(int a, int b, double now) override { frame_.query(a, b, now); }
  void report(int a, int b, double now) override { frame_.report(a, b, now); }
  std::span<const int> solve(int a, int b, double now) override {
    watch_.instant(world_, a, b, now);
    return frame_.solve(a, b, now);
  }
  void renew(std::span<const int> bodies, double now) override {
    changed_.insert(changed_.end(), bodies.begin(), bodies.end());
    frame_.renew(bodies, now);
  }
  bool is_stalled(int a, int b) const override { return frame_.is_stalled(a, b); }
  std::span<const int> freeze(double now) override {
    watch_.frozen();
    return frame_.freeze(now);
  }

 private:
  clear::Frame& frame_;
  const World& world_;
  FrameWatch& watch_;
  double end_;
  std::vector<int> changed_;
};

// The world takes its loop as a plain function, which cannot carry a watch: it finds it here.
struct Watching {
  const World* world = nullptr;
  FrameWatch* watch = nullptr;
  clear::EventLoopFunction* loop = nullptr;
  double dt = 0;
};
thread_local Watching watching;

void watched_loop(clear::Frame& frame) {
  WatchedFrame watched(frame, *watching.world, *watching.watch, watching.dt - watching.world->part_start);
  watching.loop(watched);
}

std::string queue_text(const SeenEvent& event) {
  if (event.waiting == 0) return "No event waits in the queue.";
  return fmt::format("{} in the queue; the earliest is that of bodies {} and {}.",
                     event.waiting == 1 ? "One event waits" : fmt::format("{} events wait", event.waiting),
                     event.queue.front().a, event.queue.front().b);
}

algorithm::Bars queue_bars(const SeenEvent& event, double t0) {
  algorithm::Bars bars{"the queue: when each pair meets next", "s", {}};
  for (const WaitingEvent& waiting : event.queue)
    bars.rows.push_back({fmt::format("bodies {} and {}", waiting.a, waiting.b), t0 + waiting.time,
                         bars.rows.empty() ? Role::now : Role::past, bars.rows.empty() ? "next" : ""});
  return bars;
}

// Clocks of the bodies of this event first, then of others that move.
algorithm::Bars clock_bars(const World& world, const SeenEvent& event) {
  algorithm::Bars bars{"each body's own clock: when its state was last set", "s in the frame", {}};
  std::vector<int> bodies = event.changed;
  for (int body = 0; body < static_cast<int>(event.clocks.size()); ++body) bodies.push_back(body);
  std::vector<char> done(event.clocks.size(), 0);
  for (std::size_t i = 0; i < bodies.size() && bars.rows.size() < kClocks; ++i) {
    const int body = bodies[i];
    if (std::exchange(done[at(body)], 1) != 0 || world.bodies[at(body)].state.is_static()) continue;
    const bool changed = i < event.changed.size();
    bars.rows.push_back({fmt::format("body {}", body), event.clocks[at(body)],
                         changed ? Role::now : Role::past, changed ? "new motion" : ""});
  }
  return bars;
}

// Events so far as a staircase, and those that wait.
algorithm::Chart event_chart(const FrameWatch& watch, std::size_t k, double dt, double t0) {
  algorithm::Curve done{"dealt with", Role::past, {}, true}, waiting{"in the queue", Role::now, {}, true};
  for (std::size_t i = 0; i <= k; ++i)
    done.points.push_back({t0 + watch.events[i].time, static_cast<double>(i)});
  double count = static_cast<double>(k);
  waiting.points.push_back({t0 + watch.events[k].time, count});
  if (k + 1 < watch.events.size())
    for (const WaitingEvent& event : watch.events[k + 1].queue)
      waiting.points.push_back({t0 + event.time, ++count});
  waiting.points.push_back({t0 + dt, count});
  return {"time [s]", "events", false, {done, waiting}, {}};
}

std::string bodies_text(const std::vector<int>& bodies) {
  constexpr std::size_t kNamed = 6;
  if (bodies.size() == 1) return fmt::format("body {}", bodies[0]);
  const std::size_t named = std::min(kNamed, bodies.size());
  const std::vector<int> first(bodies.begin(), bodies.begin() + static_cast<std::ptrdiff_t>(named));
  return fmt::format("bodies {}{}", fmt::join(first, ", "), bodies.size() > named ? ", …" : "");
}

std::string event_text(const SeenEvent& event, std::size_t number, double t0) {
  std::string text = fmt::format("Event {}, at {:.6g} s. ", number, t0 + event.time);
  switch (event.kind) {
    case SeenEvent::Kind::clear:
      return text +
             fmt::format("The search for bodies {} and {} has proved them clear until here, and goes on.",
                         event.a, event.b);
    case SeenEvent::Kind::sensed:
      return text + fmt::format("Body {} or {} is a sensor, and sees the other.", event.a, event.b);
    case SeenEvent::Kind::plans_end:
      text += "Plans end here. ";
      break;
    case SeenEvent::Kind::contact:
      text += fmt::format("Bodies {} and {} meet. ", event.a, event.b);
      break;
    case SeenEvent::Kind::begin:
      text += "The frame begins. ";
      break;
  }
  if (!event.instant.contacts.empty())
    text += event.instant.contacts.size() == 1
                ? "Their one contact is solved. "
                : fmt::format("{} contacts are solved together. ", event.instant.contacts.size());
  text += event.changed.empty()
              ? "No body gets a new motion."
              : fmt::format("Only {} {} new motions from here on; all other clocks stay.",
                            bodies_text(event.changed), event.changed.size() == 1 ? "gets" : "get");
  if (event.frozen) text += " No gap is left to spend: these bodies are frozen until the frame's end.";
  return text;
}

}  // namespace

void FrameWatch::before(const World& world, const clear::Event& event, SeenEvent::Kind kind,
                        double part_end) {
  (kind == SeenEvent::Kind::contact ? contacts : others) += 1;
  keeps_ = events.size() < kMost;
  if (!keeps_) return;
  const double start = world.part_start, now = event.time;
  SeenEvent seen{kind, start + now, event.a, event.b, event.stalled};
  for (int i = 0; i < world.schedule.size(); ++i) {
    const Pair& pair = world.schedule.pair(i);
    if (pair.open && (pair.contact || pair.stalled) && pair.time < part_end)
      seen.queue.push_back({start + pair.time, pair.a, pair.b});
  }
  seen.waiting = static_cast<int>(seen.queue.size());
  std::sort(seen.queue.begin(), seen.queue.end(), [](const WaitingEvent& x, const WaitingEvent& y) {
    return x.time != y.time ? x.time < y.time : x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  if (seen.queue.size() > kQueue) seen.queue.resize(kQueue);
  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body)
    seen.states.push_back(world.state_at(body, now));
  if (kind == SeenEvent::Kind::contact) {
    const double from = std::max(world.bodies[at(event.a)].time, world.bodies[at(event.b)].time);
    seen.search = {event.a,
                   event.b,
                   start + from,
                   start + part_end,
                   world.motion(event.a, from),
                   world.motion(event.b, from)};
  }
  events.push_back(std::move(seen));
}

void FrameWatch::after(const World& world, std::span<const int> changed) {
  if (!keeps_) return;
  SeenEvent& event = events.back();
  event.changed.assign(changed.begin(), changed.end());
  std::sort(event.changed.begin(), event.changed.end());
  event.changed.erase(std::unique(event.changed.begin(), event.changed.end()), event.changed.end());
  for (const Body& body : world.bodies) event.clocks.push_back(world.part_start + body.time);
  keeps_ = false;
}

void FrameWatch::instant(const World& world, int a, int b, double now) {
  if (!keeps_) return;
  StepReport aside;
  events.back().instant = seen(world, touching_island(world, a, b, now, aside), now);
}

void FrameWatch::frozen() {
  if (keeps_) events.back().frozen = true;
}

StepReport watched_step(World& world, double dt, FrameWatch& watch, const Listeners& listeners) {
  struct Restore {
    World& world;
    ~Restore() {
      world.event_loop = watching.loop;
      watching = {};
    }
  };
  watching = {&world, &watch, world.event_loop, dt};
  const Restore restore{world};
  world.event_loop = watched_loop;
  return step(world, dt, listeners);
}

std::vector<algorithm::BodyPose> poses_of(const std::vector<RigidBody>& states, const World& world) {
  std::vector<algorithm::BodyPose> poses;
  for (std::size_t i = 0; i < states.size() && poses.size() < kPoses; ++i)
    if (!world.bodies[i].state.is_static() || !states[i].velocity.isZero(0) || !states[i].spin.isZero(0))
      poses.push_back({static_cast<int>(i), states[i].position, states[i].orientation});
  return poses;
}

algorithm::Part show_events(const World& world, const FrameWatch& watch, double dt, double t0) {
  algorithm::Part part{4, "the queue of events, and each body's own clock", {}};
  const std::size_t count = watch.events.size();
  Step first;
  first.text = "No event lies in this frame: each body goes straight to its end in one step.";
  if (count > 0) {  // pairs are queried after a planner has begun
    const SeenEvent& earliest =
        watch.events[count > 1 && watch.events[0].kind == SeenEvent::Kind::begin ? 1 : 0];
    first.text = queue_text(earliest);
    if (earliest.waiting > 0) first.bars = queue_bars(earliest, t0);
  }
  part.steps.push_back(first);
  for (std::size_t k = 0; k < count; ++k) {
    const SeenEvent& event = watch.events[k];
    Step step;
    step.text = event_text(event, k + 1, t0);
    step.poses = poses_of(event.states, world);
    for (const lcp::Contact& contact : event.instant.contacts) {
      if (step.draw.size() >= 60) break;
      step.draw.push_back(algorithm::point(contact.point, Role::now));
    }
    step.bars = clock_bars(world, event);
    step.chart = event_chart(watch, k, dt, t0);
    part.steps.push_back(step);
  }
  const int left = watch.contacts + watch.others - static_cast<int>(count);
  Step last;
  last.text =
      fmt::format("The frame ends at {:.6g} s: only now do all clocks show the same time again. It had {}{}.",
                  t0 + dt, algorithm::count(watch.contacts + watch.others, "event"),
                  left > 0 ? fmt::format(", of which {} are not shown", left) : "");
  for (std::size_t i = 0; i < world.bodies.size() && last.poses.size() < kPoses; ++i)
    if (!world.bodies[i].state.is_static())
      last.poses.push_back(
          {static_cast<int>(i), world.bodies[i].state.position, world.bodies[i].state.orientation});
  part.steps.push_back(last);
  return part;
}

}  // namespace fc::world
