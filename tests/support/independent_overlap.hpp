// An independent check of overlaps and momenta: own mesh reader, own mass properties, own motion, own triangle test. It
// includes nothing of the engine and uses none of its libraries, so that no mistake of the engine can be repeated here.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace independent {

struct Vec {
  double x = 0, y = 0, z = 0;
};
inline Vec operator+(const Vec& a, const Vec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(const Vec& a, const Vec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator*(double s, const Vec& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline double dot(const Vec& a, const Vec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec& a) {
  return std::sqrt(dot(a, a));
}

using Matrix = std::array<Vec, 3>;  // rows
inline Vec operator*(const Matrix& m, const Vec& v) {
  return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}
Matrix transposed(const Matrix& m);
Matrix operator*(const Matrix& a, const Matrix& b);

struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;
};
Quaternion operator*(const Quaternion& a, const Quaternion& b);
Matrix rotation(const Quaternion& q);

struct Mesh {
  std::vector<Vec> vertices;  // m
  std::vector<std::array<int, 3>> triangles;
};
Mesh read_obj(const std::filesystem::path& file);
void write_obj(const Mesh& mesh, const std::filesystem::path& file);
// A closed surface around the origin, 2 * rings * around triangles less the poles: radius 1 with bumps and
// dents, no symmetry.
Mesh bumpy_sphere(int rings, int around, double bump);
Mesh box(const Vec& size);

// A box of triangles, with its two halves (or none).
struct Node {
  Vec middle, half;
  int left = -1, right = -1;  // nodes; -1: a leaf
  int begin = 0, end = 0;     // leaves: into Solid::order
};

// A closed mesh filled with matter: everything below is relative to its centre of mass.
struct Solid {
  Mesh mesh;
  Vec centroid;  // m, in the mesh's own frame
  double mass = 0;
  Matrix inertia;          // kg m^2, about the centroid
  double reach = 0;        // m, from the centroid
  bool is_static = false;  // two of these may overlap
  std::vector<Node> tree;
  std::vector<int> order;
};
Solid make_solid(const Mesh& mesh, double density);

// A row of poses.csv: position is that of the mesh's own frame. In free fall there is an acceleration, too.
struct State {
  Vec position;
  Quaternion orientation;
  Vec velocity, spin, acceleration;
};
Vec center(const Solid& solid, const State& state);
// The state after (or before) this many seconds of constant acceleration and spin about the centre of mass.
State moved(const Solid& solid, const State& state, double seconds);
Vec velocity_at(const Solid& solid, const State& state, const Vec& point);

struct Totals {
  Vec linear, angular;  // about the world's origin
  double linear_size = 0, angular_size = 0, kinetic = 0;
};
Totals totals(const std::vector<Solid>& solids, const std::vector<State>& states);

// Whether two triangles cross: an edge of one passes through the other. Within 1e-12 m counts as crossing.
bool triangles_cross(const std::array<Vec, 3>& a, const std::array<Vec, 3>& b);

enum class How { tree, every_pair };
// Whether two solids overlap: their surfaces cross, or one lies inside the other.
bool overlap(const Solid& a, const State& at_a, const Solid& b, const State& at_b, How how = How::tree);
// How often triangles wind around a point: 1 inside a closed surface that faces outwards, 0 outside.
double winding(const std::vector<std::array<Vec, 3>>& triangles, const Vec& point);
// The same for a solid's surface and a world point.
double winding(const Solid& solid, const State& state, const Vec& point);

}  // namespace independent
