#include "ch02_hull_hierarchy/hull_model.hpp"

#include <numeric>
#include <stdexcept>

#include "ch02_hull_hierarchy/pieces.hpp"

namespace fc::hulls {

HullModel build_hull_model(const Model& model) {
  if (model.curved() || !model.parts.empty())
    throw std::invalid_argument("build_hull_model: the model is curved, or has parts; hulls are of points");
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
  hulls.tree = build_hull_tree(model.mesh, hulls.pieces);
  return hulls;
}

}  // namespace fc::hulls
