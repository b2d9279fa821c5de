// Meshes, rotations, motion and momenta of the independent overlap check.
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "support/independent_overlap.hpp"

namespace independent {

Matrix transposed(const Matrix& m) {
  return {Vec{m[0].x, m[1].x, m[2].x}, Vec{m[0].y, m[1].y, m[2].y}, Vec{m[0].z, m[1].z, m[2].z}};
}

Matrix operator*(const Matrix& a, const Matrix& b) {
  const Matrix columns = transposed(b);
  Matrix product;
  for (int i = 0; i < 3; ++i)
    product[i] = {dot(a[i], columns[0]), dot(a[i], columns[1]), dot(a[i], columns[2])};
  return product;
}

Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Matrix rotation(const Quaternion& q) {
  const double s = 2 / (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {Vec{1 - s * (q.y * q.y + q.z * q.z), s * (q.x * q.y - q.z * q.w), s * (q.x * q.z + q.y * q.w)},
          Vec{s * (q.x * q.y + q.z * q.w), 1 - s * (q.x * q.x + q.z * q.z), s * (q.y * q.z - q.x * q.w)},
          Vec{s * (q.x * q.z - q.y * q.w), s * (q.y * q.z + q.x * q.w), 1 - s * (q.x * q.x + q.y * q.y)}};
}

Mesh read_obj(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot open " + file.string());
  Mesh mesh;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Vec v;
      words >> v.x >> v.y >> v.z;
      mesh.vertices.push_back(v);
    } else if (word == "f") {
      std::array<int, 3> t{};
      for (int& corner : t) {
        words >> word;
        corner = std::stoi(word) - 1;  // up to the slash
      }
      if (words >> word) throw std::runtime_error("not a triangle: " + line);
      mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

void write_obj(const Mesh& mesh, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << std::setprecision(17);
  for (const Vec& v : mesh.vertices) out << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
  for (const auto& t : mesh.triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
}

Mesh bumpy_sphere(int rings, int around, double bump) {
  const double pi = std::acos(-1.0);
  Mesh mesh;
  const auto add = [&](double down, double turn) {
    const double r = 1 + bump * (std::sin(5 * turn + 0.3) * std::sin(down) * std::sin(4 * down) +
                                 0.4 * std::cos(3 * down + 0.7));
    mesh.vertices.push_back(
        {r * std::sin(down) * std::cos(turn), r * std::sin(down) * std::sin(turn), r * std::cos(down)});
  };
  add(0, 0);
  for (int i = 1; i < rings; ++i)
    for (int k = 0; k < around; ++k) add(pi * i / rings, 2 * pi * (k + 0.5 * (i % 2)) / around);
  add(pi, 0);
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int ring, int k) { return 1 + (ring - 1) * around + (k + around) % around; };
  for (int k = 0; k < around; ++k) {
    mesh.triangles.push_back({0, at(1, k), at(1, k + 1)});
    mesh.triangles.push_back({last, at(rings - 1, k + 1), at(rings - 1, k)});
  }
  for (int i = 1; i + 1 < rings; ++i)
    for (int k = 0; k < around; ++k) {
      const int shift = i % 2;  // odd rings stand half a step further
      mesh.triangles.push_back({at(i, k), at(i + 1, k + shift), at(i, k + 1)});
      mesh.triangles.push_back({at(i + 1, k + shift - 1), at(i + 1, k + shift), at(i, k)});
    }
  return mesh;
}

Mesh box(const Vec& size) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(
        {(i & 1 ? 0.5 : -0.5) * size.x, (i & 2 ? 0.5 : -0.5) * size.y, (i & 4 ? 0.5 : -0.5) * size.z});
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

Vec center(const Solid& solid, const State& state) {
  return state.position + rotation(state.orientation) * solid.centroid;
}

State moved(const Solid& solid, const State& state, double seconds) {
  State next = state;
  const double rate = norm(state.spin), half = 0.5 * rate * seconds;
  if (rate > 0) {
    const Vec axis = (std::sin(half) / rate) * state.spin;
    next.orientation = Quaternion{std::cos(half), axis.x, axis.y, axis.z} * state.orientation;
  }
  const Vec travel = seconds * state.velocity + (0.5 * seconds * seconds) * state.acceleration;
  next.position = center(solid, state) + travel - rotation(next.orientation) * solid.centroid;
  next.velocity = state.velocity + seconds * state.acceleration;
  return next;
}

Vec velocity_at(const Solid& solid, const State& state, const Vec& point) {
  return state.velocity + cross(state.spin, point - center(solid, state));
}

Totals totals(const std::vector<Solid>& solids, const std::vector<State>& states) {
  Totals sum;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const Matrix turn = rotation(states[i].orientation);
    const Vec own = turn * (solids[i].inertia * (transposed(turn) * states[i].spin));
    const Vec p = solids[i].mass * states[i].velocity, orbit = cross(center(solids[i], states[i]), p);
    sum.linear = sum.linear + p;
    sum.angular = sum.angular + orbit + own;
    sum.linear_size += norm(p);
    sum.angular_size += norm(orbit) + norm(own);
    sum.kinetic += 0.5 * dot(p, states[i].velocity) + 0.5 * dot(own, states[i].spin);
  }
  return sum;
}

}  // namespace independent
