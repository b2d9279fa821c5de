#include "common/mass_properties.hpp"

#include <numbers>
#include <stdexcept>
#include <string>

namespace fc {
namespace {

// The vertex closest to the middle of the mesh's bounding box. Summing about it keeps the tetrahedra as small
// as the mesh itself, however far from its frame's origin it lies; a difference of two vertices of a far mesh
// is nearly always exact.
Vec3 vertex_near_the_middle(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return Vec3::Zero();
  Eigen::AlignedBox3d box;
  for (const Vec3& v : mesh.vertices) box.extend(v);
  const Vec3 middle = box.center();
  Vec3 best = mesh.vertices.front();
  for (const Vec3& v : mesh.vertices) {
    if ((v - middle).squaredNorm() < (best - middle).squaredNorm()) best = v;
  }
  return best;
}

Mat3 diagonal(double x, double y, double z) {
  return Vec3(x, y, z).asDiagonal();
}

}  // namespace

MassProperties sphere_mass(double radius, double density) {
  const double mass = density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  const double i = 0.4 * mass * radius * radius;
  return {mass, Vec3::Zero(), diagonal(i, i, i)};
}

MassProperties box_mass(const Vec3& size, double density) {
  const double mass = density * size.prod();
  const Vec3 s = size.cwiseProduct(size) * (mass / 12);
  return {mass, Vec3::Zero(), diagonal(s.y() + s.z(), s.z() + s.x(), s.x() + s.y())};
}

MassProperties capsule_mass(double radius, double length, double density) {
  const double r2 = radius * radius;
  const double cylinder = density * std::numbers::pi * r2 * length;
  const double caps = density * 4.0 / 3.0 * std::numbers::pi * r2 * radius;  // both together
  const double along = cylinder * r2 / 2 + caps * 0.4 * r2;
  // Each cap's own centre of mass is 3/8 r beyond the cylinder's end (common/README.md).
  const double across = cylinder * (r2 / 4 + length * length / 12) +
                        caps * (0.4 * r2 + length * length / 4 + 3.0 / 8.0 * length * radius);
  return {cylinder + caps, Vec3::Zero(), diagonal(across, across, along)};
}

MassProperties cylinder_mass(double radius, double length, double density) {
  const double r2 = radius * radius, mass = density * std::numbers::pi * r2 * length;
  const double across = mass * (r2 / 4 + length * length / 12);
  return {mass, Vec3::Zero(), diagonal(across, across, mass * r2 / 2)};
}

MassProperties cone_mass(double radius, double length, double density) {
  const double r2 = radius * radius, mass = density * std::numbers::pi / 3 * r2 * length;
  const double across = mass * 3 / 20 * (r2 + length * length / 4);
  return {mass, Vec3(0, 0, -length / 4), diagonal(across, across, mass * 0.3 * r2)};
}

MassProperties solid_mass(const TriangleMesh& mesh, double density) {
  const Vec3 origin = vertex_near_the_middle(mesh);
  double volume = 0;           // m^3, of all tetrahedra (origin, a, b, c), with sign
  Vec3 first = Vec3::Zero();   // m^4, integral of x
  Mat3 second = Mat3::Zero();  // m^5, integral of x x^T
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = mesh.vertices[i] - origin, b = mesh.vertices[j] - origin, c = mesh.vertices[k] - origin;
    const Vec3 sum = a + b + c;
    const double det = a.dot(b.cross(c));
    volume += det / 6;
    first += det / 24 * sum;
    second += det / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  if (!(volume > 0)) {
    throw std::invalid_argument("solid_mass: the volume is " + std::to_string(volume) +
                                " m^3, expected > 0: is the mesh closed, and do its triangles face outward?");
  }
  const Vec3 center = first / volume;
  const Mat3 center_squared =
      center * center.transpose();  // by itself first: it must stay symmetric to the last bit
  const Mat3 about_center = second - volume * center_squared;
  const Mat3 inertia = density * (about_center.trace() * Mat3::Identity() - about_center);
  return {density * volume, origin + center, inertia};
}

MassProperties scaled(MassProperties properties, double factor) {
  properties.mass *= factor;
  properties.inertia *= factor;
  return properties;
}

double signed_volume(const TriangleMesh& mesh) {
  const Vec3 origin = vertex_near_the_middle(mesh);
  double sum = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = mesh.vertices[i] - origin, b = mesh.vertices[j] - origin, c = mesh.vertices[k] - origin;
    sum += a.dot(b.cross(c));
  }
  return sum / 6;
}

}  // namespace fc
