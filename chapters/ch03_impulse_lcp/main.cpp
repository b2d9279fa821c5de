// Chapter 3: solves the impact of bodies that touch, or an LCP given directly.
#include "ch03_impulse_lcp/clear/solver.hpp"
#include "ch03_impulse_lcp/impact_run.hpp"
#include "ch03_impulse_lcp/lcp_run.hpp"
#include "ch03_impulse_lcp/solver.hpp"
#include "common/program.hpp"
#include "common/shape.hpp"

namespace {

using namespace fc;
using namespace fc::lcp;

std::vector<Effect> explain(const Scene& scene) {
  const auto line = [](const SourceMark& mark) { return "declared at line " + std::to_string(mark.line); };
  const std::string solver = "solver (" + scene.solver.method + ")";
  if (scene.lcp) return {{"lcp", line(scene.lcp->where), solver, 1}};
  std::vector<Effect> effects;
  if (!scene.contacts.empty()) {
    effects.push_back({"contacts", line(scene.contacts.front().where), "Delassus matrix, " + solver, 1});
  }
  if (const auto mark = scene.mark("restitution")) {
    effects.push_back({"restitution", line(*mark), "right-hand side (1 + epsilon) v", 0});
  } else {
    for (const ShapeSpec& shape : scene.shapes) {
      if (!shape.restitution) continue;
      effects.push_back({"restitution", line(shape.where), "right-hand side (1 + epsilon) v", 0});
      break;
    }
    if (effects.empty() || effects.back().name != "restitution")
      if (const auto pairs = scene.mark("pairs"))
        effects.push_back({"restitution", line(*pairs), "right-hand side (1 + epsilon) v", 0});
  }
  for (const BodySpec& body : scene.bodies) {
    if (body.free_moves.isOnes(0) && body.free_turns.isOnes(0)) continue;
    effects.push_back({"fixed degrees of freedom", line(body.where), "zeros in the inverse masses", 0});
    break;
  }
  return effects;
}

void check(const Scene& scene) {
  if (scene.lcp) {
    check_lcp(*scene.lcp);
  } else {
    build_shapes(scene, true);
  }
}

int run(const Scene& scene, const clear::Pieces& pieces, const RunContext& context, Summary& summary) {
  const Solver solve = context.clear ? clear::solver_of(scene.solver, pieces) : solver_of(scene.solver);
  return scene.lcp ? run_lcp(*scene.lcp, scene.solver, solve, context, summary)
                   : run_impact(scene, solve, context, summary);
}

}  // namespace

int main(int argc, char** argv) {
  clear::Pieces pieces;  // filled before run() if the options ask for it
  return run_program(
      argc, argv,
      {.number = 3,
       .name = "ch03_impulse_lcp",
       .purpose =
           "Finds the impulses of bodies that hit each other at many contacts at once, or solves "
           "a linear complementarity problem, by Dantzig's method or, with solver: {method: ...}, another; "
           "solver: {compare: true} runs them all. The LCP of a scene with contacts is written as A.mtx, "
           "b.mtx.",
       .example = "build/bin/ch03_impulse_lcp chapters/ch03_impulse_lcp/scenes/newtons_cradle.yaml",
       .explain = explain,
       .run = [&pieces](const Scene& scene, const RunContext& context,
                        Summary& summary) { return run(scene, pieces, context, summary); },
       .check = check,
       .pieces = clear::slots(pieces)});
}
