#include "ch04_multibody_stepping/live_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ch02_hull_hierarchy/inside.hpp"
#include "ch04_multibody_stepping/sensors.hpp"

namespace fc::world {
namespace {

constexpr double kDensity = 1000;  // kg/m^3: water

}  // namespace

void add_throws(Scene& scene, const std::vector<Throw>& balls) {
  if (balls.empty()) return;
  ShapeSpec ball;
  ball.name = "thrown";
  const auto is_taken = [&](const ShapeSpec& shape) { return shape.name == ball.name; };
  for (int i = 2; std::any_of(scene.shapes.begin(), scene.shapes.end(), is_taken); ++i)
    ball.name = fmt::format("thrown-{}", i);
  ball.geometry = SphereSpec{balls.front().radius};
  ball.density = kDensity;
  ball.where = ball.geometry_where = {"a thrown ball"};
  scene.shapes.push_back(ball);
  for (const Throw& thrown : balls) {
    BodySpec body;
    body.shape = static_cast<int>(scene.shapes.size()) - 1;
    body.position = thrown.position;
    body.velocity = thrown.velocity;
    body.where = ball.where;
    scene.bodies.push_back(body);
  }
}

void refuse_overlap_of_last(const World& world, const Scene& scene) {
  const int ball = static_cast<int>(world.bodies.size()) - 1;
  const Bounds box = world.swept_bounds(ball, 0, 0);
  for (int other = 0; other < ball; ++other) {
    if (is_sensor_pair(world, other, ball) || !box.overlaps(world.swept_bounds(other, 0, 0))) continue;
    const ca::PairPose pose(world.motion(other, 0), world.motion(ball, 0), 0);
    const hulls::Model &model = world.model_of(other), &model_of_ball = world.model_of(ball);
    if (hulls::model_distance(model, model_of_ball, pose, world.tolerance).lower > world.tolerance &&
        !hulls::one_inside_other(model, model_of_ball, pose, world.tolerance))
      continue;
    throw InputError(
        fmt::format("a ball of {:.3g} m would begin inside of body {}, or touch it; throw it from elsewhere",
                    world.shapes.back().radius, scene.body_text(other)));
  }
}

Scene scene_as_it_stands(Scene scene, const World& world) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    BodySpec& spec = scene.bodies[i];
    const Body& body = world.bodies[i];
    if (spec.path_file && body.path && body.clock == 0) continue;  // it has not begun
    if (body.path && std::isfinite(body.path->next_after(body.clock)))
      throw InputError(fmt::format(
          "body {} is on its way along a path, in the middle of which no scene can begin; save before the scene runs, or when the "
          "path has ended",
          scene.body_text(static_cast<int>(i))));
    spec.path.clear();
    spec.path_file.reset();
    spec.position = frame_position(world.shapes[static_cast<std::size_t>(body.shape)], body.state);
    spec.orientation = body.state.orientation;
    if (spec.is_static) continue;
    spec.velocity = body.path ? Vec3(Vec3::Zero()) : body.state.velocity;
    spec.spin = body.path ? Vec3(Vec3::Zero()) : body.state.spin;
  }
  return scene;
}

void keep_marks(const Scene& from, Scene& scene) {
  scene.key_marks = from.key_marks;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    scene.shapes[i].where = from.shapes[i].where;
    scene.shapes[i].geometry_where = from.shapes[i].geometry_where;
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) scene.bodies[i].where = from.bodies[i].where;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) scene.pairs[i].where = from.pairs[i].where;
}

}  // namespace fc::world
