#include "ch04_multibody_stepping/world.hpp"

#include <fmt/format.h>

#include "ch02_hull_hierarchy/inside.hpp"
#include "ch03_impulse_lcp/solver.hpp"

namespace fc::world {
namespace {

bool balls_apart(const World& world, int a, int b) {
  const Vec3 apart = world.bodies[b].state.position - world.bodies[a].state.position;
  return apart.norm() > world.shapes[world.bodies[a].shape].reach +
                            world.shapes[world.bodies[b].shape].reach + world.tolerance;
}

void refuse_overlaps(const World& world, const Scene& scene) {
  for (const Pair& pair : world.pairs) {
    if (balls_apart(world, pair.a, pair.b)) continue;
    const hulls::Model& model_a = world.model_of(pair.a);
    const hulls::Model& model_b = world.model_of(pair.b);
    const ca::PairPose pose(world.motion(pair.a, 0), world.motion(pair.b, 0), 0);
    const double gap = hulls::model_distance(model_a, model_b, pose, world.tolerance, world.tolerance).lower;
    const bool inside =
        gap >= -world.tolerance && hulls::one_inside_other(model_a, model_b, pose, world.tolerance);
    if (gap >= -world.tolerance && !inside) continue;
    const std::string how = inside ? "one lies inside the other" : fmt::format("by about {:.3g} m", -gap);
    throw InputError(
        scene.bodies[pair.b].where,
        fmt::format("bodies {} and {} overlap at the start ({}), more than the tolerance of {:.3g} m; "
                    "move them apart",
                    pair.a, pair.b, how, world.tolerance));
  }
}

}  // namespace

ca::Motion World::motion(int body, double time) const {
  RigidBody state = state_at(body, time);
  if (bodies[body].held) state.velocity = state.spin = Vec3::Zero();
  return ca::Motion(state, bodies[body].held || state.is_static() ? Vec3(Vec3::Zero()) : gravity);
}

RigidBody World::state_at(int body, double time) const {
  RigidBody state = bodies[body].state;
  const double elapsed = time - bodies[body].time;
  if (elapsed == 0 || bodies[body].held || state.is_static()) return state;
  const ca::Motion motion(state, gravity);
  state.position = motion.position_at(elapsed);
  state.velocity = motion.velocity_at(elapsed);
  if (motion.spin_rate > 0) {
    const Quat turn(Eigen::AngleAxisd(motion.spin_rate * elapsed, motion.spin_axis));
    state.orientation = (turn * state.orientation).normalized();
  }
  return state;
}

World build_world(const Scene& scene) {
  World world;
  world.shapes = build_shapes(scene, true);
  for (const Shape& shape : world.shapes) world.models.push_back(hulls::build_model(shape));
  world.gravity = scene.gravity.value_or(Vec3::Zero());
  world.tolerance = scene.ccd.tolerance;
  if (scene.solver.method != SolverSpec().method || scene.solver.limit > 0) {
    const lcp::Method method = lcp::method_named(scene.solver.method);
    const lcp::SolveOptions options{.limit = scene.solver.limit, .tolerance = scene.solver.tolerance};
    world.impact.solver = [method, options](const lcp::Lcp& rows) {
      return lcp::solve(rows, method, options);
    };
  }
  world.max_pairs = scene.ccd.max_iterations;
  for (const BodySpec& spec : scene.bodies)
    world.bodies.push_back({make_body(world.shapes[spec.shape], spec), 0, spec.shape, false});
  const int count = static_cast<int>(world.bodies.size());
  world.pairs_of.resize(count);
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) {
      if (world.bodies[a].state.is_static() && world.bodies[b].state.is_static()) continue;
      for (const int body : {a, b}) world.pairs_of[body].push_back(static_cast<int>(world.pairs.size()));
      world.pairs.push_back({a, b});
    }
  refuse_overlaps(world, scene);
  return world;
}

}  // namespace fc::world
