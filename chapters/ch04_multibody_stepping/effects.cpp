#include "ch04_multibody_stepping/effects.hpp"

#include <algorithm>

namespace fc::world {
namespace {

bool all_balls(const Scene& scene) {
  return std::all_of(scene.bodies.begin(), scene.bodies.end(), [&](const BodySpec& body) {
    if (body.is_static || body.is_kinematic) return true;
    const ShapeSpec& shape = scene.shapes[static_cast<std::size_t>(body.shape)];
    return std::holds_alternative<SphereSpec>(shape.geometry) && !shape.center_of_mass;
  });
}

std::string declared(const Scene& scene, const std::string& key) {
  const auto mark = scene.mark(key);
  return mark ? "declared at " + mark->text() : "";
}

// Where the scene declares the first body with this property, and how many bodies have it.
template <class Has>
std::string declared_by_bodies(const Scene& scene, Has has) {
  const auto first = std::find_if(scene.bodies.begin(), scene.bodies.end(), has);
  if (first == scene.bodies.end()) return "";
  const auto count = std::count_if(scene.bodies.begin(), scene.bodies.end(), has);
  return "declared by " + std::to_string(count) + (count == 1 ? " body at " : " bodies, first at ") +
         first->where.text();
}

bool is_guided(const BodySpec& body) {
  return !body.free_moves.isOnes(0) || !body.free_turns.isOnes(0);
}

}  // namespace

// ANCHOR: effects
Effects effects_of(const Scene& scene) {
  Effects effects;
  effects.gravity = scene.gravity;
  effects.drag = scene.drag;
  effects.sleep = scene.sleep;
  effects.gyroscopic = scene.gyroscopic;
  effects.rotation = !all_balls(scene);
  effects.restitution = scene.restitution.has_value() || !scene.pairs.empty();
  for (const ShapeSpec& shape : scene.shapes) effects.restitution |= shape.restitution.has_value();
  for (const BodySpec& body : scene.bodies) {
    effects.kinematic |= body.is_kinematic;
    effects.sensors |= body.is_sensor;
    effects.paths |= !body.path.empty();
    effects.guided |= is_guided(body);
  }
  return effects;
}
// ANCHOR_END: effects

std::vector<Effect> explain(const Scene& scene) {
  const Effects on = effects_of(scene);
  std::vector<Effect> list;
  list.push_back({"collision", "derived: the scene has bodies",
                  "continuous collision detection; one LCP per island and instant", 1});
  list.push_back({"swept detection", "derived: bodies have bounded speeds",
                  "a tree of swept boxes: a pair that cannot close its gap is never queried", 0});
  if (on.rotation)
    list.push_back({"rotation", "derived: a body that moves is not a ball",
                    on.gyroscopic
                        ? "six columns for each such body in a row"
                        : "six columns for each such body in a row; the spin is constant between impacts "
                          "(without the gyroscopic effect the angular momentum is not)",
                    0});
  else
    list.push_back({"no rotation", "derived: all bodies that move are balls, without friction",
                    "rows have no angular part; spins never change", 0});
  if (!on.gravity)
    list.push_back(
        {"rest", "derived: nothing accelerates a body", "pairs of bodies at rest are not queried", 0});
  if (on.gravity)
    list.push_back(
        {"gravity", declared(scene, "gravity"), "free fall in closed form inside every motion", 0});
  if (on.gyroscopic)
    list.push_back({"gyroscopic", declared(scene, "gyroscopic"),
                    "torque-free rotation in closed form (Jacobi) inside every motion", 0});
  if (on.drag)
    list.push_back(
        {"drag", declared(scene, "drag"), "exponential decay in closed form inside every motion", 0});
  if (on.restitution) {
    std::string where = declared(scene, "restitution");
    for (const ShapeSpec& shape : scene.shapes)
      if (shape.restitution && where.empty())
        where = "declared by shape '" + shape.name + "' at " + shape.where.text();
    if (where.empty()) where = declared(scene, "pairs");
    list.push_back({"restitution", where, "the right-hand side of the LCP", 0});
  }
  if (on.kinematic)
    list.push_back({"kinematic", declared_by_bodies(scene, [](const BodySpec& b) { return b.is_kinematic; }),
                    "bodies of infinite mass that move; their work is reported", 0});
  if (on.paths)
    list.push_back({"path", declared_by_bodies(scene, [](const BodySpec& b) { return !b.path.empty(); }),
                    "frames are divided where a kinematic body begins a new motion", 0});
  if (on.guided)
    list.push_back({"fixed degrees of freedom", declared_by_bodies(scene, is_guided),
                    "zeros in the inverse masses; gravity does not act along them", 0});
  if (on.sensors)
    list.push_back({"sensor", declared_by_bodies(scene, [](const BodySpec& b) { return b.is_sensor; }),
                    "sensors.csv; no rows in any LCP", 0});
  if (on.sleep)
    list.push_back({"sleep", declared(scene, "sleep"), "bodies frozen for long enough are not queried", 0});
  return list;
}

}  // namespace fc::world
