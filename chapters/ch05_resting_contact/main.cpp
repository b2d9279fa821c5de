// Chapter 5: resting and sliding contact inside a thin shell around every body; all else is chapter 4's.
#include <fmt/format.h>

#include <memory>

#include "ch04_multibody_stepping/run.hpp"
#include "ch05_resting_contact/resting.hpp"

namespace {

using namespace fc;

std::vector<Effect> explain(const Scene& scene) {
  std::vector<Effect> list = world::explain(scene);
  if (!scene.envelope) return list;
  const world::World world = world::build_world(scene);
  list.push_back({"envelope", "declared at " + scene.mark("envelope")->text(),
                  fmt::format("contacts within {:.3g} m last: one LCP per island and frame",
                              resting::envelope_of(scene, world)),
                  1});
  return list;
}

int run(const Scene& scene, const RunContext& context, Summary& summary) {
  if (!scene.envelope)
    return world::run_scene(scene, context, summary, world::step, true);  // chapter 4's motion, to the byte
  std::unique_ptr<resting::Resting> resting;
  resting::RestReport all;
  const auto prepare = [&](world::World& world) {
    resting = std::make_unique<resting::Resting>(scene, world, scene.step->dt);
  };
  const auto step = [&](world::World& world, double, const world::Listeners& listeners) {
    const resting::RestReport report = resting->step(world, listeners);
    all.resting += report.resting;
    all.plans += report.plans;
    all.searched += report.searched;
    all.checked += report.checked;
    all.sweeps += report.sweeps;
    all.shortened += report.shortened;
    all.lost_impulse += report.lost_impulse;
    all.correction_energy += report.correction_energy;
    all.correction = std::max(all.correction, report.correction);
    all.largest_island = std::max(all.largest_island, report.largest_island);
    return report.step;
  };
  const int code = world::run_scene(scene, context, summary, step, true, prepare);
  summary.add("envelope", resting->envelope(), "m");
  summary.add("resting contacts with an impulse", std::int64_t{all.resting});
  summary.add("largest island", std::int64_t{all.largest_island}, "contact points");
  summary.add("largest correction of a position in a frame", all.correction, "m");
  summary.add("potential energy added by corrections", all.correction_energy, "J");
  summary.add("bodies of piles that were shortened", std::int64_t{all.shortened});
  summary.add("momentum that this took", all.lost_impulse, "N s");
  summary.counter("plans", all.plans, 0);
  summary.counter("paths of pairs that were proved", all.checked, 0);
  summary.counter("envelope (pairs whose contacts were searched)", all.searched, 0);
  summary.counter("sweeps of Gauss-Seidel", all.sweeps, 0);
  return code;
}

void check(const Scene& scene) {
  world::World world = world::build_world(scene);
  if (scene.envelope) resting::Resting(scene, world, scene.step->dt);
}

}  // namespace

int main(int argc, char** argv) {
  Chapter chapter;
  chapter.number = 5;
  chapter.name = "ch05_resting_contact";
  chapter.purpose =
      "Moves rigid bodies that collide, rest, slide and stack, without friction. With the key `envelope`, "
      "contacts within that distance last from frame to frame; without it, everything is as in chapter 4. "
      "Crowds of more than 400 contact rows are solved to a residual that is told, and cost several times "
      "what they cost in other engines; nothing overlaps.";
  chapter.example = "build/bin/ch05_resting_contact chapters/ch05_resting_contact/scenes/stack.yaml";
  chapter.explain = explain;
  chapter.run = run;
  chapter.check = check;
  return run_program(argc, argv, chapter);
}
