// Mass, centre of mass and inertia of solids, exactly (common/README.md derives the formulas).
#pragma once

#include "common/mesh.hpp"
#include "common/types.hpp"

namespace fc {

struct MassProperties {
  double mass = 0;                     // kg
  Vec3 center_of_mass = Vec3::Zero();  // m, the shape's own frame
  Mat3 inertia = Mat3::Zero();         // kg m^2, about the centre of mass, along the shape's own axes
};

MassProperties sphere_mass(double radius, double density);
MassProperties box_mass(const Vec3& size, double density);
// A capsule along z: a cylinder of the given length with two half-spheres (the length does not count the
// caps).
MassProperties capsule_mass(double radius, double length, double density);

// A cylinder and a cone along z; the cone's base is at z = -length/2, so its centre of mass at -length/4.
MassProperties cylinder_mass(double radius, double length, double density);
MassProperties cone_mass(double radius, double length, double density);
// A closed, outward oriented mesh filled with matter (integrals of tetrahedra over the origin, summed about a
// vertex near the middle so that a mesh far from its origin keeps its digits). Throws std::invalid_argument
// if the volume is not > 0.
MassProperties solid_mass(const TriangleMesh& mesh, double density);

// The same body made of matter `factor` times as dense.
MassProperties scaled(MassProperties properties, double factor);

}  // namespace fc
