// A chapter that does nothing but end in the way that its scene's name asks for.
#include <chrono>
#include <cstdlib>
#include <limits>
#include <thread>

#include "common/program.hpp"
#include "common/scene_failure.hpp"

namespace {

double books_twice(double x) {
  return 2 * x;
}
double books_half(double x) {
  return x / 2;
}
double (*twice)(double) = books_twice;
double (*half)(double) = books_half;

int run(const fc::Scene& scene, const fc::RunContext& context, fc::Summary& summary) {
  if (context.clear) summary.add("twice three", twice(3));
  summary.add("frames", std::int64_t{scene.step->frames});
  summary.add("duration", scene.step->duration, "s");
  summary.add("method", scene.solver.method);
  if (scene.name == "nan") summary.add("drift", std::numeric_limits<double>::quiet_NaN(), "J");
  if (scene.name == "nan") summary.add("gap", std::numeric_limits<double>::infinity(), "m");
  summary.counter("lcp", 12, 3400);
  fc::TableWriter table(context.out_dir / "steps.csv", {{"step", ""}, {"t", "s"}});
  table.row({0, 0.0});
  if (context.poses) fc::TableWriter(context.out_dir / "poses.csv", {{"t", "s"}}).row({0.0});
  if (scene.name == "hangs") {
    table.row({1, 0.1});
    table.close();
    std::this_thread::sleep_for(std::chrono::minutes(1));
  }
  if (scene.name == "bad-input") throw fc::InputError(scene.bodies[0].where, "the ball overlaps; move it");
  if (scene.name == "late" && scene.step->dt > 0.05)
    throw fc::InputError(scene.bodies[0].where, "the ball is too late; move it");
  if (scene.name == "keyed") throw fc::SceneFailure("the limit was reached; raise it", "solver.limit");
  if (scene.name == "memory") throw std::bad_alloc();
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
  fc::Chapter chapter{4, "ch04_tiny", "Tries what chapters share.", "ch04_tiny scene.yaml", explain, run};
  if (std::getenv("FC_NO_PIECES") == nullptr)
    chapter.pieces = {fc::slot("ch04/ex01_twice", "twice a number", twice),
                      fc::slot("ch04/ex02_half", "half a number", half)};
  return fc::run_program(argc, argv, chapter);
}
