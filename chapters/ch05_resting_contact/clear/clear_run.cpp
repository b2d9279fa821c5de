#include "ch05_resting_contact/clear/clear_run.hpp"

#include <memory>

#include "ch04_multibody_stepping/on_pieces.hpp"
#include "ch05_resting_contact/clear/clear_resting.hpp"

namespace fc::resting {

int run_clear_scene(const Scene& scene, const RunContext& context, Summary& summary,
                    const clear::Pieces& pieces) {
  if (!scene.envelope)
    throw InputError(
        SourceMark{scene.file.string()},
        "the clear version needs resting contact; give the scene an envelope, or leave --clear and "
        "--mine out");
  std::unique_ptr<ClearResting> resting;
  ClearReport all, last;
  const auto prepare = [&](world::World& world) {
    world::put_on_pieces(world, scene, pieces.world);
    resting = std::make_unique<ClearResting>(scene, world, scene.step->dt, pieces);
  };
  const auto step = [&](world::World& world, double, const world::Listeners& listeners) {
    last = resting->step(world, listeners);
    all.plans += last.plans;
    all.halved += last.halved;
    all.correction_energy += last.correction_energy;
    return last.step;
  };
  world::MoreColumns more;
  more.columns = {{"correction_energy", "J"}};
  more.cells = [&] { return std::vector<Cell>{last.correction_energy}; };
  const int code = world::run_scene(scene, context, summary, step, true, prepare, more);
  summary.add("envelope", resting->envelope(), "m");
  summary.add("energy added by corrections", all.correction_energy, "J");
  summary.counter("plans", all.plans, 0);
  summary.counter("plans that could not be proved", all.halved, 0);
  return code;
}

}  // namespace fc::resting
