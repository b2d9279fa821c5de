// Chapter 2: the first contact of two moving bodies of any shape, by a hierarchy of convex hulls.

#include "ch01_convex_advancement/query_run.hpp"
#include "ch02_hull_hierarchy/advance.hpp"
#include "ch02_hull_hierarchy/hull_model.hpp"
#include "common/convex_hull.hpp"
#include "common/errors.hpp"
#include "common/stopwatch.hpp"

namespace {

using namespace fc;

// Adds the hulls of the upper levels of a shape's hierarchy to the picture.
void record_levels(MotionRecording& motion, int shape, const hulls::HullModel& model) {
  constexpr std::size_t kMostHulls = 64;  // of a level: more are too many to see, and to store
  std::vector<int> level{0};
  for (int k = 0; !level.empty() && level.size() <= kMostHulls; ++k) {
    std::vector<int> next;
    for (const int n : level) {
      const hulls::HullNode& node = model.tree.nodes[n];
      if (const auto hull = hull_mesh(node.points)) motion.add_hull(shape, k, *hull);
      if (!node.leaf()) next.insert(next.end(), {node.left, node.right});
    }
    level = std::move(next);
  }
}

// Makes a model ready for the clear search, or refuses it.
void prepare_clear(hulls::Model& model, const Shape& shape, const hulls::clear::Pieces& pieces) {
  if (model.curved() || !model.parts.empty())
    throw InputError(
        "shape " + shape.name +
        ": the clear search handles only meshes and hulls of points; run without --clear and --mine");
  hulls::add_hulls(model, pieces);
}

int run(const Scene& scene, const RunContext& context, Summary& summary, const hulls::clear::Pieces& pieces) {
  if (context.clear && context.certificate)
    throw InputError("a certificate is about the boxes of the fast search; run without --clear and --mine");
  const std::vector<Shape> shapes = build_shapes(scene, false);
  const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  std::vector<hulls::Model> models;
  for (const Shape& shape : shapes) {
    const Stopwatch watch;
    models.push_back(hulls::build_model(shape));
    if (context.clear) prepare_clear(models.back(), shape, pieces);
    const std::int64_t built_ns = watch.ns();
    if (shape.kind != Shape::Kind::mesh) continue;
    summary.add("shape " + shape.name, shape.report.text());
    summary.add("shape " + shape.name + ", boxes", count(4 * models.back().boxes.quads.size()));
    summary.add_time("shape " + shape.name + ", time to build", built_ns);
  }
  const hulls::Model& a = models[scene.bodies[0].shape];
  const hulls::Model& b = models[scene.bodies[1].shape];
  hulls::SearchMemory memory;
  if (context.clear) memory.pieces = &pieces;
  ca::AdvanceResult result;
  ca::run_queries(
      scene, shapes, ca::query_motions(scene, shapes),
      [&](const ca::Motion& motion_a, const ca::Motion& motion_b, const ca::AdvanceOptions& options) {
        hulls::advance(a, motion_a, b, motion_b, options, memory, result);
        return result;
      },
      context, summary,
      [&](MotionRecording& motion) {  // of a single query
        for (std::size_t i = 0; i < models.size(); ++i) {
          if (models[i].curved() || !models[i].parts.empty()) continue;  // there are no hulls of points
          if (!models[i].hulls) hulls::add_hulls(models[i], {});
          const hulls::HullModel& hulls = *models[i].hulls;
          record_levels(motion, static_cast<int>(i), hulls);
          if (shapes[i].kind != Shape::Kind::mesh) continue;
          summary.add("shape " + shapes[i].name + ", convex pieces", count(hulls.pieces.start.size()) - 1);
          summary.add("shape " + shapes[i].name + ", hulls", count(hulls.tree.nodes.size()));
          summary.add("shape " + shapes[i].name + ", hull points", points_in(hulls.tree));
        }
      });
  return 0;
}

std::vector<Effect> explain(const Scene&) {
  return {{"collision query", "derived: the scene has two bodies",
           "a hierarchy of boxes, best-first conservative advancement, contact features", 0}};
}

}  // namespace

int main(int argc, char** argv) {
  hulls::clear::Pieces pieces;
  Chapter chapter;
  chapter.number = 2;
  chapter.name = "ch02_hull_hierarchy";
  chapter.purpose =
      "Finds the first contact of two moving bodies of any shape, meshes included, and all contact features "
      "there, by best-first conservative advancement on a hierarchy of boxes, four at a time. Also makes the "
      "paper's convex pieces and their hierarchy of hulls, for the pictures of a single query; ch02_replay "
      "checks what --certificate writes.";
  chapter.example = "build/bin/ch02_hull_hierarchy chapters/ch02_hull_hierarchy/scenes/two_bunnies.yaml";
  chapter.explain = explain;
  chapter.pieces = hulls::clear::slots(pieces);
  chapter.run = [&](const Scene& scene, const RunContext& context, Summary& summary) {
    return run(scene, context, summary, pieces);
  };
  chapter.check = [](const Scene& scene) { ca::query_motions(scene, build_shapes(scene, false)); };
  return run_program(argc, argv, chapter);
}
