#include "ch06_friction/rubbing.hpp"

#include <fmt/format.h>

#include "ch06_friction/show_cones.hpp"

namespace fc::friction {

Scene with_envelope(const Scene& scene) {
  Scene result = scene;
  if (!result.envelope) result.envelope = 0;
  return result;
}

void refuse_idle_keys(const Scene& scene) {
  for (const char* key : {"solver.method", "solver.limit", "solver.tolerance"})
    if (const auto mark = scene.mark(key))
      throw InputError(*mark,
                       fmt::format("'{}' has no effect on contacts with friction, which have their own "
                                   "solvers; remove it, or the friction",
                                   key));
}

std::vector<Effect> explain(const Scene& scene, const world::World& world) {
  if (!scene.envelope) return world::explain(scene);
  std::vector<Effect> list = resting::explain(scene, world);
  if (!asks_for_friction(scene)) return list;
  std::erase_if(list, [](const Effect& effect) { return effect.name == "no rotation"; });
  std::vector<char> moves(
      world.shapes.size(),
      0);  // whether a body of the shape can be moved: between two that cannot, there is no friction
  for (const world::Body& body : world.bodies)
    moves[static_cast<std::size_t>(body.shape)] |= !body.state.is_static();
  for (std::size_t a = 0; a < world.shapes.size(); ++a)
    for (std::size_t b = a; b < world.shapes.size(); ++b) {
      if (!moves[a] && !moves[b]) continue;
      const double mu = world.pair_rules.friction(world.shapes, static_cast<int>(a), static_cast<int>(b));
      list.push_back(
          {"friction", fmt::format("pair of '{}' and '{}'", world.shapes[a].name, world.shapes[b].name),
           mu > 0 ? fmt::format("µ = {:.6g}: three rows a contact", mu) : "µ = 0: one row a contact",
           mu > 0 ? 3 : 1});
    }
  return list;
}

std::vector<Effect> explain(const Scene& scene) {
  if (!scene.envelope && !asks_for_friction(scene)) return world::explain(scene);
  return explain(asks_for_friction(scene) ? with_envelope(scene) : scene, world::build_world(scene));
}

world::LiveChapter live_chapter() {
  world::LiveChapter chapter;
  chapter.number = 6;
  chapter.name = "ch06_friction";
  chapter.complete = [](const Scene& scene) {
    return asks_for_friction(scene) ? with_envelope(scene) : scene;
  };
  chapter.prepare = [](const Scene& scene, world::World& world, const world::LiveBefore& before) {
    if (!scene.envelope) return world::live_step(scene);
    if (!asks_for_friction(scene)) return resting::live_step(scene, world, before);
    refuse_idle_keys(scene);
    return resting::live_step(scene, world, before, std::make_unique<CoulombLaw>(world), "friction");
  };
  chapter.explain = [](const Scene& scene, const world::World& world) { return explain(scene, world); };
  chapter.algorithm = [](const Scene& scene, world::World& copy, std::int64_t frame, double t0) {
    return algorithm::json(friction::show_frame(scene, copy, frame, t0));
  };
  chapter.keeps = [](const Scene& scene, const std::string& effect) -> std::string {
    return effect == "envelope" && asks_for_friction(scene) ? "friction needs contacts that last" : "";
  };
  return chapter;
}

}  // namespace fc::friction
