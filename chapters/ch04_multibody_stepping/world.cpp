#include "ch04_multibody_stepping/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "ch01_convex_advancement/penetration.hpp"
#include "ch02_hull_hierarchy/inside.hpp"
#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/solver.hpp"
#include "ch04_multibody_stepping/sensors.hpp"

namespace fc::world {
namespace {

constexpr double kEverywhere = 1e12;  // m, of a box that contains everything

// The relative error of sums of a few coordinates, with ample room.
constexpr double kBoundsRounding = 1e-14;

// With a tolerance below this (m), the rounding of poses would not let a pair stop at half of it: this many of chapter
// 1's rounding terms, for two bodies of the largest shape side by side. The gap rule lets a pair be off by 64 of them.
double least_tolerance(const World& world) {
  constexpr double kTerms = 256;
  double least = 0;
  for (std::size_t i = 0; i < world.models.size(); ++i) {
    RigidBody beside;
    beside.position = Vec3(2 * world.shapes[i].reach, 0, 0);
    const ca::PairPose pose(ca::Motion(RigidBody{}), ca::Motion(beside), 0);
    const ca::Convex whole = world.models[i].whole();
    least = std::max(least, kTerms * ca::rounding_term(whole, whole, pose));
  }
  return least;
}

// "by 0.001 m along (0, 0, 1), more than"; for a mesh no number: its depth would be a guess.
std::string depth_text(const World& world, const ca::PairPose& pose, int a, int b) {
  if (!world.convex(a) || !world.convex(b)) return "their surfaces cross by more than";
  const Shape& shape_a = world.shapes[world.bodies[a].shape];
  const Shape& shape_b = world.shapes[world.bodies[b].shape];
  const ca::ConvexCore core_a(shape_a.core.vertices, shape_a.disks);
  const ca::ConvexCore core_b(shape_b.core.vertices, shape_b.disks);
  const ca::Penetration deep =
      ca::penetration(core_a.convex(shape_a.radius), core_b.convex(shape_b.radius), pose);
  const auto digits = [](double x) { return std::abs(x) < 5e-4 ? 0.0 : x; };  // no -0, no 1e-17
  const Vec3& n = deep.direction;
  return fmt::format("by {:.4g} m along ({:.3g}, {:.3g}, {:.3g}), more than", deep.depth, digits(n.x()),
                     digits(n.y()), digits(n.z()));
}

void refuse_overlap(const World& world, const Scene& scene, int a, int b) {
  const hulls::Model& model_a = world.model_of(a);
  const hulls::Model& model_b = world.model_of(b);
  const ca::PairPose pose(world.motion(a, 0), world.motion(b, 0), 0);
  const double gap = hulls::model_distance(model_a, model_b, pose, world.tolerance, world.tolerance).lower;
  const bool inside =
      gap >= -world.tolerance && hulls::one_inside_other(model_a, model_b, pose, world.tolerance);
  if (gap >= -world.tolerance && !inside) return;
  const std::string how = inside ? "one lies inside the other by more than" : depth_text(world, pose, a, b);
  throw InputError(scene.bodies[b].where,
                   fmt::format("bodies {} and {} overlap at the start: {} the tolerance of {:.3g} m; "
                               "move them apart",
                               scene.body_text(a), scene.body_text(b), how, world.tolerance));
}

void refuse_overlaps(const World& world, const Scene& scene) {
  const int count = static_cast<int>(world.bodies.size());
  std::vector<Bounds> boxes;
  for (int body = 0; body < count; ++body) boxes.push_back(world.swept_bounds(body, 0, 0));
  BoundsTree tree;
  tree.build(boxes);
  for (int a = 0; a < count; ++a) {
    std::vector<int> others;
    tree.overlapping(boxes[a], [&](int b) {
      if (b > a && (world.is_dynamic(a) || world.is_dynamic(b)) && !is_sensor_pair(world, a, b))
        others.push_back(b);
    });
    std::sort(others.begin(), others.end());
    for (const int b : others) refuse_overlap(world, scene, a, b);
  }
}

bool is_centred_ball(const Shape& shape) {
  return shape.kind == Shape::Kind::sphere && shape.core.vertices[0].isZero(0);
}

// How far the shape reaches along its own axes, m: half the size of its box about its centre of mass.
Vec3 half_extent(const Shape& shape) {
  const Eigen::AlignedBox3d bounds = bounds_of(shape);
  return bounds.max().cwiseMax(-bounds.min());
}

// Where on its free rotation a body is after `elapsed` more seconds, and how fast it then passes through it.
void turn_on(double spin_drag, double elapsed, double& start, double& rate) {
  start += rate * ca::decayed_time(spin_drag, elapsed);
  if (spin_drag > 0) rate *= std::exp(-spin_drag * elapsed);
}

}  // namespace

RigidBody as_it_moves(const Body& body, RigidBody state) {
  if (body.plan.number >= 0) {
    state.velocity = body.plan.linear;
    state.spin = body.plan.angular;
  } else if (body.frozen) {
    state.velocity = body.group_velocity;
    state.spin = Vec3::Zero();
  }
  return state;
}

ca::Motion World::motion(int body, double time) const {
  const Body& b = bodies[body];
  const RigidBody state = state_at(body, time);
  ca::Motion motion(as_it_moves(b, state));
  if ((b.frozen && b.group < 0) || b.asleep || state.is_static() || b.plan.number >= 0) return motion;
  if (b.frozen) {  // as the group moves
    motion.velocity = centre_motion(body, time).velocity;
    add_forces(b, motion);
    return motion;
  }
  add_effects(body, motion);
  if (b.free) turn_on(motion.spin_drag, time - b.time, motion.free_start, motion.free_rate);
  return motion;
}

// ANCHOR: motion
void World::add_forces(const Body& body, ca::Motion& motion) const {
  if (effects.gravity) motion.acceleration = gravity_on(body.state);
  if (!effects.drag) return;
  motion.drag = effects.drag->linear;
  motion.spin_drag = effects.drag->angular;
}

// Adds the scene's effects to a body's motion, which begins at the time of its state.
void World::add_effects(int body, ca::Motion& motion) const {
  const Body& b = bodies[body];
  add_forces(b, motion);
  if (b.free) {
    motion.free = b.free;
    motion.free_start = b.free_start;
    motion.free_rate = b.free_rate;
  }
}
// ANCHOR_END: motion

RigidBody World::state_at(int body, double time) const {
  RigidBody state = bodies[body].state;
  const double elapsed = time - bodies[body].time;
  const Body& b = bodies[body];
  if (elapsed == 0 || (b.plan.number < 0 && is_stationary(body))) return state;
  ca::Motion motion(as_it_moves(b, state));
  const bool planned = b.plan.number >= 0;
  if (is_dynamic(body) && !b.frozen && !b.asleep && !planned) add_effects(body, motion);
  if (b.frozen && b.group >= 0) {  // forces change the velocities that it keeps
    add_forces(b, motion);
    ca::Motion kept(state);
    add_forces(b, kept);
    state.velocity = kept.velocity_at(elapsed);
  }
  state.position = motion.position_at(elapsed);
  if (planned) {
    state.velocity += elapsed * b.plan.push;
    state.spin += elapsed * b.plan.turn;
  } else if (!b.frozen) {
    state.velocity = motion.velocity_at(elapsed);
    state.spin = motion.spin_at(elapsed);
  }
  if (motion.free) {
    state.orientation = Quat(motion.rotation_at(elapsed)).normalized();
  } else if (motion.spin_rate > 0) {
    const double angle = motion.spin_rate * ca::decayed_time(motion.spin_drag, elapsed);
    state.orientation = (Quat(Eigen::AngleAxisd(angle, motion.spin_axis)) * state.orientation).normalized();
  }
  return state;
}

void World::set_motion(int body, const RigidBody& state, double time) {
  Body& b = bodies[body];
  b.state = state;
  b.time = time;
  b.frozen = b.asleep = false;
  b.plan = {};
  b.group = -1;
  b.group_velocity = Vec3::Zero();
  if (!effects.gyroscopic || !is_dynamic(body) || state.free_turns != Vec3::Ones()) return;
  ca::Motion motion(state);
  turn_freely(motion, principal[b.shape]);
  b.free = motion.free;
  b.free_start = 0;
  b.free_rate = 1;
}

void World::advance_to(int body, double time, double relabel) {
  Body& b = bodies[body];
  const double elapsed = time - b.time;
  const Vec3 group_velocity = b.group >= 0 ? centre_motion(body, time).velocity : Vec3(Vec3::Zero());
  b.clock += (b.frozen ? b.time : time) - relabel;  // a frozen body is late from then on
  b.state = state_at(body, time);
  b.group_velocity = group_velocity;
  if (b.free && b.plan.number >= 0) {  // from here on it turns freely again
    ca::Motion motion(b.state);
    turn_freely(motion, principal[b.shape]);
    b.free = motion.free;
    b.free_start = 0;
    b.free_rate = 1;
  } else if (b.free && !b.frozen) {
    turn_on(effects.drag ? effects.drag->angular : 0, elapsed, b.free_start, b.free_rate);
  }
  b.time = relabel;
}

ca::Motion World::centre_motion(int body, double time) const {
  const Body& b = bodies[body];
  ca::Motion path;
  path.position = b.state.position;
  if (is_stationary(body)) return path;
  path.velocity = as_it_moves(b, b.state).velocity;
  if (is_dynamic(body) && (!b.frozen || b.group >= 0) && !b.asleep && b.plan.number < 0) add_forces(b, path);
  const double elapsed = time - b.time;
  const Vec3 position = path.position_at(elapsed), velocity = path.velocity_at(elapsed);
  path.position = position;
  path.velocity = velocity;
  return path;
}

Bounds World::swept_bounds(int body, double from, double to) const {
  if (!effects.swept) return {Vec3::Constant(-kEverywhere), Vec3::Constant(kEverywhere)};
  const ca::Motion path = centre_motion(body, from);
  const double end = to - from;
  // The space that the body fills about its centre: a box if it does not turn, a ball if it does.
  const Body& b = bodies[body];
  const bool turns = !is_stationary(body) && as_it_moves(b, b.state).spin != Vec3::Zero();
  const bool ball = turns || ball_radius[b.shape] > 0;
  const Vec3 half = ball ? Vec3(Vec3::Constant(shapes[b.shape].reach))
                         : Vec3(b.state.orientation.toRotationMatrix().cwiseAbs() * half_extents[b.shape]);
  // The centre's path, a straight line or a parabola, along each axis: its ends, and its turning point if that lies
  // between them.
  const Vec3 start = path.position, stop = path.position_at(end);
  Bounds box{start.cwiseMin(stop), start.cwiseMax(stop)};
  for (int axis = 0; axis < 3; ++axis) {
    if (path.acceleration[axis] == 0) continue;
    double turn = -path.velocity[axis] / path.acceleration[axis];  // with drag, this much of decayed_time
    if (path.drag > 0) {
      const double left =
          1 + path.drag * path.velocity[axis] / (path.acceleration[axis] - path.drag * path.velocity[axis]);
      turn = left > 0 ? -std::log(left) / path.drag : -1;
    }
    if (!(turn > 0 && turn < end)) continue;
    const double there = path.position_at(turn)[axis];
    box.low[axis] = std::min(box.low[axis], there);
    box.high[axis] = std::max(box.high[axis], there);
  }
  // Round-off of the positions and of the pose: some epsilons of the coordinates.
  const double size =
      std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()) + half.maxCoeff();
  const Vec3 margin = half + Vec3::Constant(keep() + kBoundsRounding * size);
  return {box.low - margin, box.high + margin};
}

namespace {

void add_shape(World& world, const Shape& shape) {
  world.shapes.push_back(shape);
  world.models.push_back(hulls::build_model(shape));
  world.half_extents.push_back(half_extent(shape));
  world.ball_radius.push_back(is_centred_ball(shape) ? shape.radius : 0.0);
}

// What the scene says of all bodies and shapes together.
void set_rules(World& world, const Scene& scene) {
  world.pair_rules = PairRules(scene);
  world.effects = effects_of(scene);
  world.solver = scene.solver;
  world.impact.solver = lcp::solver_of(scene.solver);
  world.max_pairs = scene.ccd.max_iterations;
  world.principal.clear();
  if (world.effects.gyroscopic)
    for (const Shape& shape : world.shapes)
      world.principal.emplace_back(shape.mass.mass > 0 ? shape.mass.inertia : Mat3(Mat3::Identity()));
  world.tolerance = std::max(scene.ccd.tolerance, least_tolerance(world));
}

void add_body(World& world, const BodySpec& spec) {
  Body body;
  body.shape = spec.shape;
  body.sensor = spec.is_sensor;
  RigidBody state = make_body(world.shapes[spec.shape], spec);
  if (!spec.path.empty()) {
    body.path = std::make_shared<const Path>(spec.path, world.shapes[spec.shape]);
    state = body.path->at(0, 0);
  }
  world.bodies.push_back(body);
  world.set_motion(static_cast<int>(world.bodies.size()) - 1, state, 0);
}

}  // namespace

World build_world(const Scene& scene) {
  World world;
  for (const Shape& shape : build_shapes(scene, true)) add_shape(world, shape);
  set_rules(world, scene);
  for (const BodySpec& spec : scene.bodies) add_body(world, spec);
  refuse_overlaps(world, scene);
  return world;
}

World rebuild_world(const Scene& scene, const World& from) {
  World world = from;
  world.schedule = {};
  world.memory = {};
  world.rest_gap = 0;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const ShapeSpec& spec = scene.shapes[i];
    if (i == world.shapes.size()) add_shape(world, build_shape(spec, scene.restitution.value_or(0)));
    world.shapes[i].restitution = spec.restitution.value_or(scene.restitution.value_or(0));
    world.shapes[i].friction = spec.friction.value_or(scene.friction.value_or(0));
  }
  set_rules(world, scene);
  for (int i = 0; i < static_cast<int>(world.bodies.size()); ++i) {
    Body& body = world.bodies[static_cast<std::size_t>(i)];
    body.asleep = false;
    body.still = 0;
    if (!world.effects.gyroscopic) body.free.reset();
    if (world.effects.gyroscopic && !body.free) world.set_motion(i, body.state, body.time);
  }
  for (std::size_t i = world.bodies.size(); i < scene.bodies.size(); ++i) add_body(world, scene.bodies[i]);
  refuse_overlaps(world, scene);
  return world;
}

}  // namespace fc::world
