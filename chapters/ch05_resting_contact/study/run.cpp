// The scenes of the study, and how they are run.
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "ch04_multibody_stepping/record.hpp"
#include "ch05_resting_contact/study/moreau_jean.hpp"
#include "ch05_resting_contact/study/parts.hpp"

namespace fc::resting {
namespace {

constexpr double kTolerance = 1e-8;  // m
constexpr double kFar = 0.05;        // m: gaps above this are not reported

int add_shape(Scene& scene, const char* name, const auto& geometry, double mass) {
  ShapeSpec shape;
  shape.name = name;
  shape.geometry = geometry;
  if (mass > 0) shape.mass = mass;
  scene.shapes.push_back(shape);
  return static_cast<int>(scene.shapes.size()) - 1;
}

BodySpec& add_body(Scene& scene, int shape, const Vec3& position, bool is_static = false) {
  BodySpec body;
  body.shape = shape;
  body.position = position;
  body.is_static = is_static;
  scene.bodies.push_back(body);
  return scene.bodies.back();
}

Scene floor_alone(double size) {
  Scene scene;
  scene.gravity = Vec3(0, 0, -kGravity);
  scene.envelope = kEnvelope;
  scene.ccd.tolerance = kTolerance;
  const int floor = add_shape(scene, "floor", BoxSpec{Vec3(size, size, 1)}, 0);
  add_body(scene, floor, Vec3(0, 0, -0.5), true);
  return scene;
}

}  // namespace

Scene ball_scene() {
  Scene scene = floor_alone(6);
  scene.restitution = kRestitution;
  const int ball = add_shape(scene, "ball", SphereSpec{0.5}, 1);
  add_body(scene, ball, Vec3(0, 0, 0.5 + kDrop));
  return scene;
}

Scene stack_scene(double apart) {
  Scene scene = floor_alone(6);
  const int box = add_shape(scene, "box", BoxSpec{Vec3::Ones()}, 1);
  for (int k = 0; k < kBoxes; ++k) add_body(scene, box, Vec3(0, 0, 0.5 + k + (k + 1) * apart));
  return scene;
}

Scene slope_scene() {
  Scene scene = floor_alone(80);
  scene.gravity = kGravity * Vec3(std::sin(kSlope), 0, -std::cos(kSlope));
  const int box = add_shape(scene, "box", BoxSpec{Vec3::Ones()}, 1);
  add_body(scene, box, Vec3(0, 0, 0.5));
  return scene;
}

Scene heap_scene(int side, int layers) {
  constexpr double kSide = 0.5, kSpacing = 0.95;  // m: a box may turn in it as it likes
  const double width = side * kSpacing + 0.3, height = layers * kSpacing + 4;
  Scene scene = floor_alone(width + 2);
  scene.ccd.tolerance = 1e-7;
  const int east = add_shape(scene, "east", BoxSpec{Vec3(1, width + 2, height)}, 0);
  const int north = add_shape(scene, "north", BoxSpec{Vec3(width, 1, height)}, 0);
  const int box = add_shape(scene, "box", BoxSpec{Vec3::Constant(kSide)}, 1);
  for (const double sign : {-1.0, 1.0}) {
    add_body(scene, east, Vec3(sign * 0.5 * (width + 1), 0, 0.5 * height), true);
    add_body(scene, north, Vec3(0, sign * 0.5 * (width + 1), 0.5 * height), true);
  }
  std::mt19937_64 engine(1);
  const auto any = [&] {  // uniform in [-1, 1): the same on every machine, unlike std's distributions
    return std::ldexp(static_cast<double>(engine() >> 11), -52) - 1;
  };
  for (int i = 0; i < side * side * layers; ++i) {
    const Vec3 cell(i % side - 0.5 * (side - 1), i / side % side - 0.5 * (side - 1), i / (side * side));
    Eigen::Vector4d q;
    do q = {any(), any(), any(), any()};
    while (q.squaredNorm() > 1 || q.squaredNorm() < 0.01);
    q.normalize();
    const Vec3 aside = 0.02 * Vec3(any(), any(), 0);
    add_body(scene, box, Vec3(0, 0, 0.6) + kSpacing * cell + aside).orientation =
        Quat(q[0], q[1], q[2], q[3]);
  }
  return scene;
}

double ball_height(double t) {
  const double fall = std::sqrt(2 * kDrop / kGravity);
  if (t < fall) return kDrop - 0.5 * kGravity * t * t;
  if (t >= zeno_time()) return 0;
  t -= fall;
  double speed = kGravity * fall * kRestitution;
  for (; t > 2 * speed / kGravity; speed *= kRestitution) t -= 2 * speed / kGravity;
  return t * (speed - 0.5 * kGravity * t);
}

double zeno_time() {
  return std::sqrt(2 * kDrop / kGravity) * (1 + kRestitution) / (1 - kRestitution);
}

const char* name(Method method) {
  return method == Method::events ? "events" : method == Method::envelope ? "envelope" : "moreau";
}

double Run::second_ns(double seconds) const {
  return *std::min_element(ns.begin(), ns.end()) / seconds;
}

namespace {

// Any of the three methods, for one frame: adds to the run, and returns the time it took.
using FrameStep = std::function<double(world::World&, Run&, Frame&, const world::Listeners&)>;

FrameStep events(const Setting& setting) {
  return [dt = setting.dt](world::World& world, Run& run, Frame& frame, const world::Listeners& listeners) {
    const world::StepReport r = world::step(world, dt, listeners);
    run.rows += r.lcp_rows;
    run.solves += r.solves;
    run.queries += r.queries;
    frame.lost = r.lost_time;
    frame.residual = r.lcp_residual;
    return static_cast<double>(r.step_ns);
  };
}

FrameStep envelope(const Setting& setting, world::World& start) {
  auto resting = std::make_shared<Resting>(setting.scene, start, setting.dt, setting.rest);
  return [resting](world::World& world, Run& run, Frame& frame, const world::Listeners& listeners) {
    const RestReport r = resting->step(world, listeners);
    run.rows += r.step.lcp_rows;
    run.solves += r.step.solves;
    run.queries += r.searched + r.checked + r.step.queries;
    run.sweeps += r.sweeps;
    run.corrected += r.correction_energy;
    run.shortened += r.shortened;
    run.lost_impulse += r.lost_impulse;
    frame.lost = r.step.lost_time;
    frame.residual = r.step.lcp_residual;
    return static_cast<double>(r.step.step_ns);
  };
}

FrameStep moreau(const Setting& setting, const world::World& start) {
  auto stepper = std::make_shared<MoreauJean>(start, setting.dt);
  return [stepper](world::World& world, Run& run, Frame& frame, const world::Listeners& listeners) {
    const MoreauJean::Report r = stepper->step(world, listeners.impact);
    run.rows += r.rows;
    run.solves += r.rows > 0 ? 1 : 0;
    run.queries += r.searches;
    frame.residual = r.residual;
    return static_cast<double>(r.ns);
  };
}

}  // namespace

Run run(const Setting& setting, int repeats, const Look& look) {
  Run run;
  run.gap = std::numeric_limits<double>::infinity();
  const int frames = static_cast<int>(std::lround(setting.seconds / setting.dt));
  for (int repeat = 0; repeat < repeats; ++repeat) {
    Scene scene = setting.scene;
    if (setting.method != Method::envelope) scene.envelope.reset();
    world::World world = world::build_world(scene);
    const FrameStep step = setting.method == Method::events     ? events(setting)
                           : setting.method == Method::envelope ? envelope(setting, world)
                                                                : moreau(setting, world);
    Facing judge(world);
    Run once;
    double ns = 0, residuals = 0;
    for (int k = 0; k < frames; ++k) {
      Frame frame;
      frame.t = (k + 1) * setting.dt;
      frame.push.assign(world.bodies.size(), 0);
      ns += step(world, once, frame, {.impact = [&](const world::ImpactRecord& r) {
                   frame.push[static_cast<std::size_t>(r.contact.body_a)] += r.impulse.impulse;
                 }});
      once.lost += frame.lost;
      once.worst_residual = std::max(once.worst_residual, frame.residual);
      residuals += frame.residual;
      if (repeat > 0 || !look) continue;
      frame.gap = smallest_gap(judge, world, kFar);
      run.gap = std::min(run.gap, frame.gap);
      look(world, frame);
    }
    once.mean_residual = residuals / frames;
    once.gap = run.gap;
    once.ns = run.ns;
    once.ns.push_back(ns);
    run = once;
  }
  return run;
}

double energy_of(const world::World& world) {
  const world::Totals totals = world::totals_of(world);
  return totals.kinetic + totals.potential;
}

double force_error(const Frame& frame, int boxes, double dt) {
  double worst = 0;
  for (int level = 0; level < boxes; ++level) {
    const double weight = kGravity * (boxes - level);
    worst = std::max(worst, std::abs(frame.push[static_cast<std::size_t>(level)] / dt / weight - 1));
  }
  return worst;
}

}  // namespace fc::resting
