// Chapter 1: the first contact of two moving convex bodies, by conservative advancement.
#include "ch01_convex_advancement/advance.hpp"
#include "ch01_convex_advancement/query_run.hpp"

namespace {

using namespace fc;

int run(const Scene& scene, const RunContext& context, Summary& summary) {
  const std::vector<Shape> shapes = build_shapes(scene, false);
  std::array<ca::Convex, 2> convex;
  for (int i = 0; i < 2; ++i) {
    const Shape& shape = shapes[scene.bodies[i].shape];
    convex[i] = {shape.core.vertices, shape.radius, ca::reach_of(shape.core.vertices)};
  }
  ca::run_queries(
      scene, shapes, ca::query_motions(scene, shapes),
      [&](const ca::Motion& a, const ca::Motion& b, const ca::AdvanceOptions& options) {
        return ca::advance(convex[0], a, convex[1], b, options);
      },
      context, summary);
  return 0;
}

std::vector<Effect> explain(const Scene& scene) {
  return {{"collision query", "derived: the scene has two bodies",
           "GJK distance with a certified bound; the " + scene.ccd.bound +
               " motion bound; conservative advancement",
           0}};
}

}  // namespace

int main(int argc, char** argv) {
  Chapter chapter;
  chapter.number = 1;
  chapter.name = "ch01_convex_advancement";
  chapter.purpose =
      "Finds the first contact of two moving convex bodies (sphere, box, capsule, hull) by conservative "
      "advancement: "
      "never late, and within the tolerance. First true form: witness features are read from the simplex; "
      "queries with "
      "straight vertex motion (`linear`) come with the complete chapter.";
  chapter.example =
      "build/bin/ch01_convex_advancement chapters/ch01_convex_advancement/scenes/spinning_box.yaml "
      "--certificate";
  chapter.explain = explain;
  chapter.run = run;
  return run_program(argc, argv, chapter);
}
