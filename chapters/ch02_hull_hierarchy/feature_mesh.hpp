// A core with its edges and adjacencies, from which contact features are read.
#pragma once

#include <array>
#include <vector>

#include "common/mesh.hpp"
#include "common/shape.hpp"

namespace fc::hulls {

struct Edge {
  std::array<int, 2> vertex{};  // ascending
  bool flat = false;            // between two coplanar triangles: a line drawn on a face, no feature
};

// A vertex all of whose edges are flat is drawn on a face; one with two edges that are not, in one line, on
// an edge.
enum class Vertex : char { corner, on_edge, on_face };

// Lists of lists, one after another: list i is items[start[i]] .. items[start[i + 1]].
struct Lists {
  std::vector<int> start{0};
  std::vector<int> items;
};

struct FeatureMesh {
  std::vector<Vec3> vertices;                 // m, shape axes, about the centre of mass
  std::vector<std::array<int, 3>> triangles;  // outward, if the shape is solid
  std::vector<Vec3> normals;                  // unit, per triangle
  std::vector<Edge> edges;
  std::vector<Vertex> vertex_kind;
  Lists edge_triangles;  // the triangles at each edge
  Lists vertex_edges;    // the edges at each vertex
  Lists triangle_edges;  // the three edges of each triangle
  bool solid = true;

  // In the plane of a triangle, from one of its edges to its inside: unit, across the edge.
  Vec3 inward(int triangle, int edge) const;
};

// Of any core: a mesh; a segment (two vertices: one edge); a point.
FeatureMesh build_feature_mesh(const TriangleMesh& core, bool solid);

}  // namespace fc::hulls
