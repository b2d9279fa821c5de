// Chapter 1: the first contact of two moving convex bodies, by conservative advancement.
#include "ch01_convex_advancement/advance.hpp"
#include "ch01_convex_advancement/clear/pieces.hpp"
#include "ch01_convex_advancement/query_run.hpp"
#include "common/errors.hpp"

namespace {

using namespace fc;

// What the clear version does not have.
void check_clear(const Scene& scene) {
  if (scene.linear)
    throw InputError(*scene.mark("linear"),
                     "corners that fly straight have no clear version; run without --clear and --mine");
  if (scene.mark("ccd.bound") && scene.ccd.bound != "directional")
    throw InputError(*scene.mark("ccd.bound"),
                     "the clear version has one motion bound, directional; write that, "
                     "or run without --clear and --mine");
  if (scene.mark("ccd.warm_start"))
    throw InputError(*scene.mark("ccd.warm_start"),
                     "the clear version has no warm start; remove it, or run without --clear and --mine");
}

int run(const Scene& scene, const RunContext& context, const ca::clear::Pieces& pieces, Summary& summary) {
  if (context.clear) check_clear(scene);
  if (scene.linear) {
    const std::vector<ca::LinearQuery> queries = ca::linear_queries(scene);
    ca::run_queries(
        scene, queries.size(),
        [&](std::size_t q, const ca::AdvanceOptions& options) { return ca::advance(queries[q], options); },
        context, summary);
    return 0;
  }
  const std::vector<Shape> shapes = build_shapes(scene, false);
  const auto core_of = [&](int body) {
    const Shape& shape = shapes[scene.bodies[body].shape];
    return ca::ConvexCore(shape.core.vertices, shape.disks);
  };
  const ca::ConvexCore core_a = core_of(0), core_b = core_of(1);
  const ca::Convex a = core_a.convex(shapes[scene.bodies[0].shape].radius);
  const ca::Convex b = core_b.convex(shapes[scene.bodies[1].shape].radius);
  ca::run_queries(
      scene, shapes, ca::query_motions(scene, shapes),
      [&](const ca::Motion& motion_a, const ca::Motion& motion_b, const ca::AdvanceOptions& options) {
        return context.clear ? pieces.advance(a, motion_a, b, motion_b, options, pieces)
                             : ca::advance(a, motion_a, b, motion_b, options);
      },
      context, summary);
  return 0;
}

void check(const Scene& scene) {
  if (scene.linear) ca::linear_queries(scene);
  if (!scene.linear) ca::query_motions(scene, build_shapes(scene, false));
}

std::vector<Effect> explain(const Scene& scene) {
  if (scene.linear)
    return {{"collision queries", "declared at line " + std::to_string(scene.mark("linear")->line),
             "distance and exact safe time of three or four corner differences; conservative advancement",
             0}};
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
      "Finds the first contact of two moving convex bodies (sphere, box, capsule, cylinder, cone, hull) by "
      "conservative advancement: never late, and within the tolerance. Witness features are read from the "
      "simplex. With `linear`: of vertices and triangles, or edges, whose corners fly straight (no picture "
      "of their motion is written).";
  chapter.example =
      "build/bin/ch01_convex_advancement chapters/ch01_convex_advancement/scenes/spinning_box.yaml "
      "--certificate";
  chapter.explain = explain;
  ca::clear::Pieces pieces;
  chapter.pieces = ca::clear::slots(pieces);
  chapter.run = [&pieces](const Scene& scene, const RunContext& context, Summary& summary) {
    return run(scene, context, pieces, summary);
  };
  chapter.check = check;
  return run_program(argc, argv, chapter);
}
