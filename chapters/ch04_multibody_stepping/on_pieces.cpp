#include "ch04_multibody_stepping/on_pieces.hpp"

#include <fmt/format.h>

#include <utility>

#include "ch02_hull_hierarchy/hull_model.hpp"
#include "ch03_impulse_lcp/clear/solver.hpp"
#include "common/errors.hpp"

namespace fc::world {

void put_on_pieces(World& world, const Scene& scene, const clear::Pieces& pieces) {
  for (const auto& [key, is_on] :
       {std::pair{"gyroscopic", world.effects.gyroscopic}, std::pair{"drag", world.effects.drag.has_value()}})
    if (is_on)
      throw InputError(
          scene.mark(key).value_or(SourceMark{scene.file.string()}),
          fmt::format("'{}' makes the spin or the acceleration change, and the clear search allows only "
                      "constant ones; remove it, or run without --clear and --mine",
                      key));
  for (std::size_t i = 0; i < world.shapes.size(); ++i) {
    hulls::Model& model = world.models[i];
    if (model.curved() || !model.parts.empty())
      throw InputError(
          "shape " + world.shapes[i].name +
          ": the clear search allows only balls, capsules, hulls of points and meshes; run without --clear "
          "and --mine");
    hulls::add_hulls(model, pieces.hulls);
  }
  world.memory.pieces = &pieces.hulls;
  world.impact.solver = lcp::clear::solver_of(scene.solver, pieces.lcp);
  world.gap_rule = pieces.gap_rule;
  world.event_loop = pieces.event_loop;
}

}  // namespace fc::world
