#include "ch02_hull_hierarchy/hull_model.hpp"

#include <numeric>
#include <stdexcept>

#include "ch02_hull_hierarchy/convex_pieces.hpp"

namespace fc::hulls {

std::vector<std::vector<Vec3>> points_of_pieces(const FeatureMesh& mesh, const Lists& pieces) {
  if (mesh.triangles.empty()) return {mesh.vertices};
  std::vector<std::vector<Vec3>> points;
  for (std::size_t piece = 0; piece + 1 < pieces.start.size(); ++piece) {
    std::vector<int> ids;
    for (int k = pieces.start[piece]; k < pieces.start[piece + 1]; ++k)
      for (const int v : mesh.triangles[pieces.items[k]]) ids.push_back(v);
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    points.emplace_back();
    for (const int v : ids) points.back().push_back(mesh.vertices[v]);
  }
  return points;
}

HullModel build_hull_model(const Model& model, clear::HullTreeFunction* hull_tree) {
  if (model.curved() || !model.parts.empty())
    throw std::invalid_argument(
        "build_hull_model: the model is curved, or has parts; only points have hulls here");
  HullModel hulls;
  hulls.radius = model.radius;
  hulls.reach = model.reach;
  if (model.filled) {
    hulls.pieces.items.resize(model.mesh.triangles.size());
    std::iota(hulls.pieces.items.begin(), hulls.pieces.items.end(), 0);
    hulls.pieces.start.push_back(static_cast<int>(hulls.pieces.items.size()));
  } else {
    hulls.pieces = convex_pieces(model.mesh);
  }
  hulls.tree = hull_tree(points_of_pieces(model.mesh, hulls.pieces));
  return hulls;
}

std::int64_t points_in(const HullTree& tree) {
  std::size_t points = 0;
  for (const HullNode& node : tree.nodes) points += node.points.size();
  return static_cast<std::int64_t>(points);
}

void add_hulls(Model& model, const clear::Pieces& pieces) {
  model.hulls = std::make_shared<const HullModel>(build_hull_model(model, pieces.hull_tree));
}

}  // namespace fc::hulls
