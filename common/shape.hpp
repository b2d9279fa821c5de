// Shapes ready for collision and dynamics, built from their specifications.
//
// Every shape is a core plus a rounding radius: a sphere is a point, a capsule a segment, a box and a hull
// closed meshes, a mesh itself, a cylinder and a cone the hull of two disks; a compound is the union of such
// parts. Coordinates are relative to the centre of mass, along the shape's
// own axes, so that a body's pose for collision is (its orientation, its centre of mass).
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "common/mass_properties.hpp"
#include "common/mesh.hpp"
#include "common/rigid_body.hpp"
#include "common/scene.hpp"

namespace fc {

struct Shape {
  enum class Kind { sphere, capsule, cylinder, cone, box, hull, mesh, compound };

  std::string name;
  Kind kind = Kind::sphere;
  // Relative to the centre of mass. Sphere: 1 vertex, no triangles. Capsule: 2 vertices, bottom and top end
  // of its axis, no triangles. Box: 8 vertices, vertex i at (x, y, z) = (bit 0, bit 1, bit 2 of i: - or +),
  // and 12 triangles, two for each of the sides -x, +x, -y, +y, -z, +z. Hull: its vertices and triangles.
  // Mesh: as prepare_mesh left it.
  TriangleMesh core;
  // Cylinder and cone: 2 vertices on the axis, bottom and top, and for each the radius in m of a disk about
  // it, across the axis (0: none); the core is the convex hull of both disks. Empty for all others.
  std::vector<double> disks;
  Vec3 axis = Vec3::UnitZ();  // unit: of a sphere, capsule, cylinder or cone; not z only in a part
  // Compound: its convex parts, relative to the whole's centre of mass and along its axes. Of a part only
  // kind, core, disks, axis and radius are set. The whole's own core is that of all parts together. Empty for
  // all other kinds.
  std::vector<Shape> parts;
  double radius = 0;    // m, rounding radius around the core
  bool solid = true;    // has an inside (false: a mesh that is only its surface)
  double reach = 0;     // m, the largest distance of the shape from its centre of mass, radius included
  MassProperties mass;  // center_of_mass is in the shape's own frame; all zero if the scene gives no mass
  // "density", "mass", "mass and inertia", "none"; for a surface without inside "density, of the convex hull"
  // or "mass, of the convex hull".
  std::string mass_source;
  double restitution = 0;  // the shape's own, or the scene's, or 0
  double friction = 0;     // likewise
  MeshReport report;       // meshes only

  bool convex() const { return kind != Kind::mesh && kind != Kind::compound; }
};
inline std::ostream& operator<<(std::ostream& out, Shape::Kind kind) {
  constexpr const char* kNames[] = {"sphere", "capsule", "cylinder", "cone",
                                    "box",    "hull",    "mesh",     "compound"};
  return out << kNames[static_cast<int>(kind)];
}

// The smallest box along the shape's axes that holds it; m, relative to the centre of mass.
Eigen::AlignedBox3d bounds_of(const Shape& shape);

// Builds one shape. Its mass and centre of mass, in this order:
//   mass and inertia   as given; the centre is center_of_mass, else the centroid of the solid
//   mass, or density   the solid filled evenly; of a mesh without inside, its convex hull filled evenly; of
//                      a compound each part in full, also where parts overlap
//   neither            no mass; the centre is the centroid: a query's body turns about its true centre
// The centroid of a mesh without inside is that of its convex hull, filled; of a flat one, the mean over its
// area.
//
// Throws InputError at the shape's line: a hull that spans no volume, a flat open mesh with a mass or density
// but no inertia, an inertia that is not symmetric and positive definite or whose largest principal moment
// exceeds the sum of the other two. A mesh file's errors carry the file's own name and line.
Shape build_shape(const ShapeSpec& spec, double scene_restitution);

// Builds all shapes of a scene, and checks that each shape of a body that moves has a mass (from chapter 3
// on; the caller decides by `masses_needed`).
std::vector<Shape> build_shapes(const Scene& scene, bool masses_needed);

// The body that a scene places: its centre of mass goes where the shape's frame puts it. Static bodies have
// no mass and no velocities, kinematic ones no mass; a body whose shape has no mass has its velocities, for
// queries.
RigidBody make_body(const Shape& shape, const BodySpec& spec);

// Where the shape's own frame is, given the body (the inverse of what make_body did to the position).
Vec3 frame_position(const Shape& shape, const RigidBody& body);

}  // namespace fc
