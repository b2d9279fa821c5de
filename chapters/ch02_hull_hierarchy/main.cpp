// Chapter 2: the first contact of two moving bodies of any shape, by a hierarchy of convex hulls.
#include <chrono>

#include "ch01_convex_advancement/query_run.hpp"
#include "ch02_hull_hierarchy/advance.hpp"
#include "common/convex_hull.hpp"

namespace {

using namespace fc;

// The hulls of the upper levels of a shape's hierarchy, to be looked at.
void record_levels(MotionRecording& motion, int shape, const hulls::Model& model) {
  constexpr std::size_t kMostHulls = 64;  // of a level: more are too many to see, and to store
  std::vector<int> level{0};
  for (int k = 0; !level.empty() && level.size() <= kMostHulls; ++k) {
    std::vector<int> next;
    for (const int n : level) {
      const hulls::HullNode& node = model.tree.nodes[n];
      if (const auto hull = hull_mesh(model.tree.hull(node))) motion.add_hull(shape, k, *hull);
      if (!node.leaf()) next.insert(next.end(), {node.left, node.right});
    }
    level = std::move(next);
  }
}

int run(const Scene& scene, const RunContext& context, Summary& summary) {
  const std::vector<Shape> shapes = build_shapes(scene, false);
  std::vector<hulls::Model> models;
  for (const Shape& shape : shapes) {
    const auto start = std::chrono::steady_clock::now();
    models.push_back(hulls::build_model(shape));
    const std::int64_t built_ns = (std::chrono::steady_clock::now() - start) / std::chrono::nanoseconds(1);
    if (shape.kind != Shape::Kind::mesh) continue;
    const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
    summary.add("shape " + shape.name, shape.report.text());
    summary.add("shape " + shape.name + ", convex pieces", count(models.back().pieces.start.size()) - 1);
    summary.add("shape " + shape.name + ", nodes", count(models.back().tree.nodes.size()));
    summary.add("shape " + shape.name + ", hull points", count(models.back().tree.points.size()));
    summary.add_time("shape " + shape.name + ", time to build", built_ns);
  }
  const hulls::Model& a = models[scene.bodies[0].shape];
  const hulls::Model& b = models[scene.bodies[1].shape];
  ca::run_queries(
      scene, shapes, ca::query_motions(scene, shapes),
      [&](const ca::Motion& motion_a, const ca::Motion& motion_b, const ca::AdvanceOptions& options) {
        return hulls::advance(a, motion_a, b, motion_b, options);
      },
      context, summary,
      [&](MotionRecording& motion) {
        for (std::size_t i = 0; i < models.size(); ++i) record_levels(motion, static_cast<int>(i), models[i]);
      });
  return 0;
}

std::vector<Effect> explain(const Scene&) {
  return {{"collision query", "derived: the scene has two bodies",
           "convex pieces, a hierarchy of their hulls, best-first conservative advancement, contact features",
           0}};
}

}  // namespace

int main(int argc, char** argv) {
  Chapter chapter;
  chapter.number = 2;
  chapter.name = "ch02_hull_hierarchy";
  chapter.purpose =
      "Finds the first contact of two moving bodies of any shape, meshes included, and all contact features "
      "there, by "
      "conservative advancement on a hierarchy of convex hulls. First true form: one search, without the "
      "comparisons and "
      "the temporal coherence of the complete chapter.";
  chapter.example = "build/bin/ch02_hull_hierarchy chapters/ch02_hull_hierarchy/scenes/two_bunnies.yaml";
  chapter.explain = explain;
  chapter.run = run;
  return run_program(argc, argv, chapter);
}
