// Convex surface decomposition: a mesh's triangles in groups whose convex hulls add nothing outside the
// solid.
#pragma once

#include <vector>

#include "ch02_hull_hierarchy/feature_mesh.hpp"

namespace fc::hulls {

struct PieceOptions {
  int max_triangles = 32;  // growing a piece costs its size squared
};

// The triangles of each piece, as lists over pieces. Every triangle is in exactly one piece.
//
// Two meshes are disjoint when their surfaces are and neither lies inside the other. A piece may stand in for
// its triangles if its hull is part of the solid: then the distance to the hulls is the distance to the
// solid. A piece is grown over edges while every triangle stays a face of the piece's hull (all its vertices
// on or below every plane); it is kept only if no other triangle of the mesh passes through the hull's inside. If one
// does, the piece gives up the later half of its triangles, and the rest is tested again. Deviations of up to 16 eps
// times the mesh's size count as rounding. Needle triangles (height below 1e-4 of the longest side), whose planes are
// uncertain, stay alone; a mesh that is not solid is taken triangle by triangle. Ehmann and Lin, "Accurate and Fast
// Proximity Queries Between Polyhedra Using Convex Surface Decomposition" (2001).
Lists convex_pieces(const FeatureMesh& mesh, const PieceOptions& options = {});

}  // namespace fc::hulls
