// A chapter that does nothing but end in the way that its scene's name asks for.
#include <limits>

#include "common/program.hpp"

namespace {

int run(const fc::Scene& scene, const fc::RunContext& context, fc::Summary& summary) {
  summary.add("frames", std::int64_t{scene.step->frames});
  summary.add("duration", scene.step->duration, "s");
  summary.add("method", scene.solver.method);
  if (scene.name == "nan") summary.add("drift", std::numeric_limits<double>::quiet_NaN(), "J");
  if (scene.name == "nan") summary.add("gap", std::numeric_limits<double>::infinity(), "m");
  summary.counter("lcp", 12, 3400);
  fc::TableWriter table(context.out_dir / "steps.csv", {{"step", ""}, {"t", "s"}});
  table.row({0, 0.0});
  if (scene.name == "bad-input") throw fc::InputError(scene.bodies[0].where, "the ball overlaps; move it");
  if (scene.name == "numerical") throw fc::NumericalFailure("energy grew\nby 3 J at step 7");
  if (scene.name == "mistake") throw std::invalid_argument("radius is -1, expected > 0");
  if (scene.name == "slow" && scene.step->dt > 0.05) throw fc::NumericalFailure("dt is too long");
  table.close();
  return scene.name == "reported" ? 3 : 0;
}

std::vector<fc::Effect> explain(const fc::Scene& scene) {
  if (!scene.gravity) return {};
  return {{"gravity", "declared at line " + std::to_string(scene.mark("gravity")->line), "acceleration", 0}};
}

}  // namespace

int main(int argc, char** argv) {
  return fc::run_program(
      argc, argv, {4, "ch04_tiny", "Tries what chapters share.", "ch04_tiny scene.yaml", explain, run});
}
