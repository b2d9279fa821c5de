#include "ch04_multibody_stepping/study/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "ch04_multibody_stepping/contact_search.hpp"
#include "ch04_multibody_stepping/study/parts.hpp"
#include "common/table.hpp"

namespace fc::world {
namespace {

constexpr double kFall = 9.81;  // m/s^2

ShapeSpec ball_of(double radius) {
  ShapeSpec shape;
  shape.name = "ball";
  shape.geometry = SphereSpec{radius};
  shape.mass = 1;
  return shape;
}

BodySpec moving(int shape, const Vec3& position, const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
  BodySpec body;
  body.shape = shape;
  body.position = position;
  body.velocity = velocity;
  body.spin = spin;
  return body;
}

// A ball of radius 0.5 m above a floor whose top is at z = 0. Bodies: the ball, the floor.
Scene above_a_floor(double height, double restitution) {
  Scene scene;
  scene.gravity = Vec3(0, 0, -kFall);
  scene.restitution = restitution;
  ShapeSpec floor;
  floor.name = "floor";
  floor.geometry = BoxSpec{Vec3(4, 4, 1)};
  scene.shapes = {ball_of(0.5), floor};
  BodySpec below;
  below.shape = 1;
  below.is_static = true;
  below.position = Vec3(0, 0, -0.5);
  scene.bodies = {moving(0, Vec3(0, 0, 0.5 + height), Vec3::Zero()), below};
  return scene;
}

double height_of(const World& world) {
  return world.bodies[0].state.position.z() - 0.5;
}

// Four balls in a plane: the first hits the second, which hits the third; the fourth comes near, and passes.
Scene four_balls() {
  Scene scene;
  scene.restitution = 0.8;
  scene.shapes = {ball_of(0.5)};
  scene.bodies = {moving(0, Vec3(0, 0, 0), Vec3(6, 0, 0)), moving(0, Vec3(2, 0, 0), Vec3(2, 0, 0)),
                  moving(0, Vec3(4.6, 0, 0), Vec3::Zero()), moving(0, Vec3(0.5, 3, 0), Vec3(5, -2.2, 0))};
  return scene;
}

// Passes each call on to the step's own frame.
class Forward : public clear::Frame {
 public:
  explicit Forward(clear::Frame& frame) : frame_(frame) {}
  std::optional<clear::Event> earliest() override { return frame_.earliest(); }
  void query(int a, int b, double now) override { frame_.query(a, b, now); }
  void report(int a, int b, double now) override { frame_.report(a, b, now); }
  std::span<const int> solve(int a, int b, double now) override { return frame_.solve(a, b, now); }
  void renew(std::span<const int> bodies, double now) override { frame_.renew(bodies, now); }
  bool is_stalled(int a, int b) const override { return frame_.is_stalled(a, b); }
  std::span<const int> freeze(double now) override { return frame_.freeze(now); }

 private:
  clear::Frame& frame_;
};

// Records what a loop does, and the answers that it gets.
class Tracer final : public Forward {
 public:
  Tracer(clear::Frame& frame, const World& world, TableWriter& table)
      : Forward(frame), world_(world), table_(table) {
    answers(0);
  }
  std::optional<clear::Event> earliest() override {
    const std::optional<clear::Event> event = Forward::earliest();
    if (event && event->kind == clear::Event::Kind::contact)
      row("contact", event->time, event->a, event->b, event->time);
    return event;
  }
  void query(int a, int b, double now) override {
    Forward::query(a, b, now);
    answers(now);
  }
  void renew(std::span<const int> bodies, double now) override {
    for (const int body : bodies) row("new", now, body, body, now);
    Forward::renew(bodies, now);
    answers(now);
  }

 private:
  void row(const char* what, double now, int a, int b, double time) {
    table_.row({std::string(what), now, std::int64_t{a}, std::int64_t{b}, time});
  }
  // Records the answers that pairs have got since the last call.
  void answers(double now) {
    for (int number = 0; number < world_.schedule.size(); ++number) {
      const Pair& pair = world_.schedule.pair(number);
      if (!pair.open || !seen_.insert({number, pair.answers}).second) continue;
      row(pair.contact ? "event" : "clear", now, pair.a, pair.b, pair.time);
    }
  }

  const World& world_;
  TableWriter& table_;
  std::set<std::pair<int, int>> seen_;
};

// Keeps the island of the first instant.
class FirstIsland final : public Forward {
 public:
  FirstIsland(clear::Frame& frame, const World& world, Island& island)
      : Forward(frame), world_(world), island_(island) {}
  std::span<const int> solve(int a, int b, double now) override {
    StepReport report;
    if (island_.bodies.empty()) island_ = touching_island(world_, a, b, now, report);
    return Forward::solve(a, b, now);
  }

 private:
  const World& world_;
  Island& island_;
};

// A loop is a plain function, which has no place of its own for what it records.
std::function<void(clear::Frame&)> watched;
void watched_loop(clear::Frame& frame) {
  watched(frame);
}

}  // namespace

void picture_clocks(const std::filesystem::path& out) {
  TableWriter table(out / "clocks.csv", {{"what", ""}, {"now", "s"}, {"a", ""}, {"b", ""}, {"time", "s"}});
  World world = build_world(four_balls());
  watched = [&](clear::Frame& frame) {
    Tracer tracer(frame, world, table);
    clear::event_loop(tracer);
  };
  world.event_loop = watched_loop;
  step(world, 1);
  table.close();
}

void picture_bounce(const std::filesystem::path& out) {
  constexpr double kHeight = 2, kRestitution = 0.8, kEnd = 2.8, kStep = 0.14;  // m, 1, s, s
  constexpr int kSamples = 560;
  TableWriter table(out / "bounce.csv", {{"what", ""}, {"t", "s"}, {"height", "m"}});
  World world = build_world(above_a_floor(kHeight, kRestitution));
  const auto height_row = [&](const char* what, double t, double height) {
    table.row({std::string(what), t, height});
  };
  height_row("path", 0, kHeight);
  for (int sample = 0; sample < kSamples; ++sample) {
    const double dt = kEnd / kSamples;
    step(world, dt, {.impact = [&](const ImpactRecord& hit) {
           height_row("contact", sample * dt + hit.time, hit.contact.gap);
         }});
    height_row("path", (sample + 1) * dt, height_of(world));
  }
  double height = kHeight, speed = 0;
  height_row("steps", 0, height);
  for (int k = 1; k * kStep <= kEnd + 1e-9; ++k) {
    moreau_step(kStep, kFall, kRestitution, height, speed);
    height_row("steps", k * kStep, height);
  }
  table.close();
}

void picture_gaps(const std::filesystem::path& out) {
  TableWriter table(out / "gaps.csv", {{"restitution", ""}, {"t", "s"}, {"gap", "m"}});
  constexpr double kDt = 1.0 / 60;
  for (const double restitution : {0.8, 0.0}) {
    World world = build_world(above_a_floor(0.1, restitution));
    for (int frame = 0; frame < 56; ++frame)
      step(world, kDt, {.impact = [&](const ImpactRecord& hit) {
             table.row({restitution, frame * kDt + hit.time, hit.contact.gap});
           }});
  }
  table.close();
}

void picture_boxes(const std::filesystem::path& out) {
  Scene scene;
  scene.restitution = 1;
  ShapeSpec rod = ball_of(0.5);
  rod.name = "rod";
  rod.geometry = BoxSpec{Vec3(1.2, 0.2, 0.2)};
  scene.shapes = {ball_of(0.4), rod};
  scene.bodies = {moving(0, Vec3(0, 0, 0), Vec3(3, 1, 0)), moving(0, Vec3(1.9, 0.9, 0), Vec3(0, -0.3, 0)),
                  moving(0, Vec3(3.6, -0.65, 0), Vec3(-0.5, 0.1, 0)),
                  moving(1, Vec3(0.6, 2.9, 0), Vec3(1.6, 0.2, 0), Vec3(0, 0, 3)),
                  moving(0, Vec3(4.2, 1.9, 0), Vec3(0.4, 0.5, 0))};
  constexpr double kWholeFrame = 1;
  World world = build_world(scene);
  TableWriter boxes(out / "boxes.csv", {{"moment", ""},
                                        {"now", "s"},
                                        {"body", ""},
                                        {"x", "m"},
                                        {"y", "m"},
                                        {"x_end", "m"},
                                        {"y_end", "m"},
                                        {"x_low", "m"},
                                        {"y_low", "m"},
                                        {"x_high", "m"},
                                        {"y_high", "m"}});
  TableWriter pairs(out / "pairs.csv", {{"moment", ""}, {"a", ""}, {"b", ""}});
  // A body keeps its box until it gets another motion; then the box is of the rest of the frame.
  std::vector<Bounds> swept(scene.bodies.size());
  std::int64_t moment = 0;
  const auto look = [&](const World& at, double now) {
    const int count = static_cast<int>(at.bodies.size());
    for (int body = 0; body < count; ++body) {
      if (moment == 0 || at.bodies[body].time == now) swept[body] = at.swept_bounds(body, now, kWholeFrame);
      const Vec3 here = at.state_at(body, now).position, there = at.state_at(body, kWholeFrame).position;
      const Bounds& box = swept[body];
      boxes.row({moment, now, std::int64_t{body}, here.x(), here.y(), there.x(), there.y(), box.low.x(),
                 box.low.y(), box.high.x(), box.high.y()});
    }
    for (int a = 0; a < count; ++a)
      for (int b = a + 1; b < count; ++b)
        if ((swept[a].low.array() <= swept[b].high.array()).all() &&
            (swept[b].low.array() <= swept[a].high.array()).all())
          pairs.row({moment, std::int64_t{a}, std::int64_t{b}});
    ++moment;
  };
  look(world, 0);
  step(world, kWholeFrame, {.instant = [&](const World& at, double now) { look(at, now); }});
  boxes.close();
  pairs.close();
}

void picture_island(const std::filesystem::path& out) {
  Scene scene;
  scene.restitution = 0.9;
  scene.shapes = {ball_of(0.5)};
  constexpr double kApart = 1 + 5e-7;  // m, between the centres of balls that touch
  for (int row = 0; row < 3; ++row)
    for (int k = 0; k <= row; ++k)
      scene.bodies.push_back(moving(0, kApart * Vec3(row * std::sqrt(0.75), k - 0.5 * row, 0), Vec3::Zero()));
  scene.bodies.push_back(moving(0, Vec3(3.4, 0.9, 0), Vec3(-0.5, 0, 0)));
  scene.bodies.push_back(moving(0, Vec3(0.2, -1.9, 0), Vec3(1, -0.2, 0)));
  const int cue = static_cast<int>(scene.bodies.size());
  scene.bodies.push_back(moving(0, Vec3(-1.8, 0.12, 0), Vec3(5, 0, 0)));
  World world = build_world(scene);
  TableWriter bodies(out / "island.csv",
                     {{"body", ""}, {"x", "m"}, {"y", "m"}, {"member", ""}, {"vx", "m/s"}, {"vy", "m/s"}});
  TableWriter contacts(out / "island_contacts.csv",
                       {{"a", ""}, {"b", ""}, {"x", "m"}, {"y", "m"}, {"impulse", "N s"}});
  Island island;
  watched = [&](clear::Frame& frame) {
    FirstIsland look(frame, world, island);
    clear::event_loop(look);
  };
  world.event_loop = watched_loop;
  std::vector<ImpactRecord> hits;
  bool first = true;
  step(world, 0.5,
       {.impact = [&](const ImpactRecord& hit) { hits.push_back(hit); },
        .instant =
            [&](const World& at, double now) {
              if (!std::exchange(first, false)) return;
              for (int body = 0; body <= cue; ++body) {
                const RigidBody state = at.state_at(body, now);
                bodies.row({std::int64_t{body}, state.position.x(), state.position.y(),
                            std::int64_t{std::ranges::count(island.bodies, body)}, state.velocity.x(),
                            state.velocity.y()});
              }
              for (const lcp::Contact& contact : island.contacts) {
                double impulse = 0;
                for (const ImpactRecord& hit : hits)
                  if (hit.contact.body_a == contact.body_a && hit.contact.body_b == contact.body_b)
                    impulse += hit.impulse.impulse;
                contacts.row({std::int64_t{contact.body_a}, std::int64_t{contact.body_b}, contact.point.x(),
                              contact.point.y(), impulse});
              }
            }});
  bodies.close();
  contacts.close();
}

void picture_frozen(const std::filesystem::path& out) {
  constexpr double kDt = 1.0 / 30;
  constexpr int kFrames = 45;
  World world = build_world(above_a_floor(0.3, 0.7));
  TableWriter frames(out / "frozen.csv", {{"t", "s"}, {"height", "m"}, {"lost_time", "s"}});
  TableWriter impacts(out / "frozen_impacts.csv", {{"t", "s"}, {"gap", "m"}, {"v_after", "m/s"}});
  for (int frame = 0; frame < kFrames; ++frame) {
    const StepReport report =
        step(world, kDt, {.impact = [&](const ImpactRecord& hit) {
               impacts.row({frame * kDt + hit.time, hit.contact.gap, hit.impulse.v_after});
             }});
    frames.row({(frame + 1) * kDt, height_of(world), report.lost_time});
  }
  frames.close();
  impacts.close();
}

}  // namespace fc::world
