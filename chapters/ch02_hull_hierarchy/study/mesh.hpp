// Coarser meshes, to see what the number of triangles costs.
#pragma once

#include <filesystem>

#include "common/shape.hpp"

namespace fc::hulls {

// Where Debian's package glmark2-data has the bunny: 69,666 triangles, closed.
inline constexpr const char* kBunny = "/usr/share/glmark2/models/bunny.obj";

// The solid that a mesh file describes, filled evenly.
Shape mesh_shape(const std::filesystem::path& file);

// Collapses the shortest edges of a closed mesh to their middles until `target` triangles are left, or no
// edge can be removed: the mesh stays closed, and locally does not cross itself (an edge's ends must have two
// common neighbours, and no triangle may turn over).
TriangleMesh decimated(const TriangleMesh& mesh, std::size_t target);

// The same shape with about this many triangles, still closed; its centre of mass stays where it was.
Shape coarser(const Shape& shape, std::size_t triangles);

// The longest side of its box, m.
double size_of(const Shape& shape);

}  // namespace fc::hulls
