#include "common/display_mesh.hpp"

#include <cmath>
#include <numbers>

namespace fc {
namespace {

constexpr int kAround = 24;            // corners of a circle
constexpr std::size_t kSmooth = 1000;  // a mesh of more triangles than this is drawn smooth

void add_vertex(DisplayMesh& mesh, const Vec3& position, const Vec3& normal) {
  for (int k = 0; k < 3; ++k) {
    mesh.positions.push_back(static_cast<float>(position[k]));
    mesh.normals.push_back(static_cast<float>(normal[k]));
  }
}

// One ring of a surface of revolution about z.
struct Ring {
  double radius, z;              // m
  double normal_out, normal_up;  // the unit normal, away from the axis and along it
};

// The surface through rings from the bottom up.
void add_surface(DisplayMesh& mesh, const std::vector<Ring>& rings) {
  const int first = static_cast<int>(mesh.positions.size() / 3);
  for (const Ring& ring : rings)
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround, c = std::cos(angle), s = std::sin(angle);
      add_vertex(mesh, {ring.radius * c, ring.radius * s, ring.z},
                 {ring.normal_out * c, ring.normal_out * s, ring.normal_up});
    }
  for (int ring = 0; ring + 1 < static_cast<int>(rings.size()); ++ring)
    for (int i = 0; i < kAround; ++i) {
      const int a = first + ring * kAround + i, b = first + ring * kAround + (i + 1) % kAround;
      if (rings[ring].radius > 0) mesh.triangles.push_back({a, b, b + kAround});
      if (rings[ring + 1].radius > 0) mesh.triangles.push_back({a, b + kAround, a + kAround});
    }
}

// Half a ball's rings, from the equator to the pole or the other way round.
void add_cap(std::vector<Ring>& rings, double radius, double middle, bool upper) {
  constexpr int steps = 8;
  for (int k = 0; k <= steps; ++k) {
    const double angle = 0.5 * std::numbers::pi * (upper ? k : k - steps) / steps;
    const bool pole = upper ? k == steps : k == 0;
    const double out = pole ? 0 : std::cos(angle), up = pole ? (upper ? 1 : -1) : std::sin(angle);
    rings.push_back({radius * out, middle + radius * up, out, up});
  }
}

std::vector<Ring> ball(double radius, double bottom, double top) {
  std::vector<Ring> rings;
  add_cap(rings, radius, bottom, false);
  add_cap(rings, radius, top, true);
  return rings;
}

}  // namespace

namespace {

void append(DisplayMesh& whole, const DisplayMesh& part) {
  const int first = static_cast<int>(whole.positions.size() / 3);
  whole.positions.insert(whole.positions.end(), part.positions.begin(), part.positions.end());
  whole.normals.insert(whole.normals.end(), part.normals.begin(), part.normals.end());
  for (const auto& [a, b, c] : part.triangles) whole.triangles.push_back({first + a, first + b, first + c});
}

// A surface of revolution about another axis than z: drawn about z, then turned.
DisplayMesh turned_mesh(const Shape& shape) {
  Shape upright = shape;
  upright.axis = Vec3::UnitZ();
  const Vec3 along = shape.axis.dot(shape.core.vertices[0]) * shape.axis;
  for (Vec3& v : upright.core.vertices) v = Vec3(0, 0, shape.axis.dot(v));
  DisplayMesh mesh = display_mesh(upright);
  const Mat3 turn = Quat::FromTwoVectors(Vec3::UnitZ(), shape.axis).toRotationMatrix();
  const Vec3 aside = shape.core.vertices[0] - along;
  for (auto* of : {&mesh.positions, &mesh.normals})
    for (std::size_t i = 0; i < of->size(); i += 3) {
      Vec3 x = turn * Vec3((*of)[i], (*of)[i + 1], (*of)[i + 2]);
      if (of == &mesh.positions) x += aside;
      for (int k = 0; k < 3; ++k) (*of)[i + static_cast<std::size_t>(k)] = static_cast<float>(x[k]);
    }
  return mesh;
}

// Gives each triangle three vertices of its own, with its normal, so that it is drawn flat beside round
// parts.
DisplayMesh with_flat_normals(const DisplayMesh& mesh) {
  DisplayMesh flat;
  const auto at = [&](int v) {
    const std::size_t i = 3 * static_cast<std::size_t>(v);
    return Vec3(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 normal = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
    const int first = static_cast<int>(flat.positions.size() / 3);
    for (const int v : {a, b, c}) add_vertex(flat, at(v), normal);
    flat.triangles.push_back({first, first + 1, first + 2});
  }
  return flat;
}

}  // namespace

DisplayMesh display_mesh(const Shape& shape) {
  DisplayMesh mesh;
  for (const Shape& part : shape.parts) {
    const DisplayMesh drawn = display_mesh(part);
    append(mesh, drawn.normals.empty() ? with_flat_normals(drawn) : drawn);
  }
  if (!shape.parts.empty()) return mesh;
  const bool of_revolution =
      shape.kind == Shape::Kind::sphere || shape.kind == Shape::Kind::capsule || !shape.disks.empty();
  if (of_revolution && shape.axis != Vec3::UnitZ()) return turned_mesh(shape);
  if (shape.kind == Shape::Kind::sphere || shape.kind == Shape::Kind::capsule) {
    add_surface(mesh, ball(shape.radius, shape.core.vertices.front().z(), shape.core.vertices.back().z()));
    const Vec3 middle = 0.5 * (shape.core.vertices.front() + shape.core.vertices.back());
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
      for (int k = 0; k < 2; ++k) mesh.positions[i + k] += static_cast<float>(middle[k]);
    return mesh;
  }
  if (!shape.disks.empty()) {  // two disks, and the slope between their rims
    const double low = shape.disks[0], high = shape.disks[1];
    const double bottom = shape.core.vertices[0].z(), top = shape.core.vertices[1].z();
    const double size = std::hypot(top - bottom, low - high), out = (top - bottom) / size,
                 up = (low - high) / size;
    add_surface(mesh, {{0, bottom, 0, -1}, {low, bottom, 0, -1}});
    add_surface(mesh, {{low, bottom, out, up}, {high, top, out, up}});
    if (high > 0) add_surface(mesh, {{high, top, 0, 1}, {0, top, 0, 1}});
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
      for (int k = 0; k < 2; ++k) mesh.positions[i + k] += static_cast<float>(shape.core.vertices[0][k]);
    return mesh;
  }
  std::vector<Vec3> normals(shape.core.vertices.size(), Vec3::Zero());
  for (const auto& [a, b, c] : shape.core.triangles) {
    const std::vector<Vec3>& x = shape.core.vertices;
    const Vec3 normal = (x[b] - x[a]).cross(x[c] - x[a]);  // its length weighs by area
    for (const int i : {a, b, c}) normals[i] += normal;
  }
  const bool smooth = shape.core.triangles.size() > kSmooth;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const double size = normals[i].norm();
    add_vertex(mesh, shape.core.vertices[i], size > 0 ? Vec3(normals[i] / size) : Vec3(Vec3::UnitZ()));
  }
  if (!smooth) mesh.normals.clear();
  mesh.triangles = shape.core.triangles;
  return mesh;
}

DisplayMesh arrow_mesh() {
  DisplayMesh mesh;
  add_surface(mesh, ball(0.06, 0, 0));
  add_surface(mesh, {{0.022, 0, 1, 0}, {0.022, 0.72, 1, 0}});
  add_surface(mesh, {{0, 0.72, 0, -1}, {0.07, 0.72, 0, -1}});
  const double slope = 0.07 / 0.28, out = 1 / std::hypot(1.0, slope);
  add_surface(mesh, {{0.07, 0.72, out, slope * out}, {0, 1, out, slope * out}});
  return mesh;
}

}  // namespace fc
