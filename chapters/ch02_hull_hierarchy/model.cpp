#include "ch02_hull_hierarchy/model.hpp"

#include <algorithm>
#include <numeric>

#include "ch02_hull_hierarchy/pieces.hpp"

namespace fc::hulls {
namespace {

// Lists of what the triangles of each piece have, ascending and without repetition.
template <class ItemsOf>
Lists gather(const Lists& pieces, ItemsOf items_of) {
  Lists lists;
  std::vector<int> items;
  for (int piece = 0; piece + 1 < static_cast<int>(pieces.start.size()); ++piece) {
    items.clear();
    for (int k = pieces.start[piece]; k < pieces.start[piece + 1]; ++k)
      for (const int item : items_of(pieces.items[k])) items.push_back(item);
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
    lists.items.insert(lists.items.end(), items.begin(), items.end());
    lists.start.push_back(static_cast<int>(lists.items.size()));
  }
  return lists;
}

Lists one_piece(int count) {
  Lists lists;
  lists.items.resize(count);
  std::iota(lists.items.begin(), lists.items.end(), 0);
  lists.start.push_back(count);
  return lists;
}

std::vector<int> one_vertex_per_component(const FeatureMesh& mesh) {
  std::vector<int> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Edge& e : mesh.edges) {
    const int i = root(e.vertex[0]), j = root(e.vertex[1]);
    parent[std::max(i, j)] = std::min(i, j);
  }
  std::vector<int> roots;
  for (int v = 0; v < static_cast<int>(parent.size()); ++v)
    if (root(v) == v) roots.push_back(v);
  return roots;
}

}  // namespace

Model build_model(const Shape& shape) {
  Model model;
  model.mesh = build_feature_mesh(shape.core, shape.solid);
  const FeatureMesh& mesh = model.mesh;
  model.radius = shape.radius;
  model.reach = ca::reach_of(mesh.vertices);
  model.filled = shape.convex();
  if (shape.convex()) {
    model.pieces = one_piece(static_cast<int>(mesh.triangles.size()));
    model.piece_vertices = one_piece(static_cast<int>(mesh.vertices.size()));
    model.piece_edges = one_piece(static_cast<int>(mesh.edges.size()));
  } else {
    model.pieces = convex_pieces(mesh);
    model.piece_vertices = gather(model.pieces, [&](int t) { return mesh.triangles[t]; });
    model.piece_edges = gather(model.pieces, [&](int t) {
      const int first = mesh.triangle_edges.start[t];
      return std::array{mesh.triangle_edges.items[first], mesh.triangle_edges.items[first + 1],
                        mesh.triangle_edges.items[first + 2]};
    });
  }
  model.tree = build_hull_tree(mesh, model.pieces);
  model.component_vertex = one_vertex_per_component(mesh);
  return model;
}

}  // namespace fc::hulls
