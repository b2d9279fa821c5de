// Meshes that the tests write themselves, and checks that share no code with the library.
#pragma once

#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "common/mesh.hpp"

namespace fc::test {

inline TriangleMesh box_mesh(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) ? high.x() : low.x(), (i & 2) ? high.y() : low.y(),
                               (i & 4) ? high.z() : low.z());
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

inline TriangleMesh unit_cube() {
  return box_mesh(Vec3::Zero(), Vec3::Ones());
}

// A sphere of 2 * rings * (rings - 1) * 2 triangles by latitude and longitude; its vertices lie on the
// sphere.
inline TriangleMesh sphere_mesh(double radius, int rings) {
  const int around = 2 * rings;
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0, 0, radius);
  for (int i = 1; i < rings; ++i) {
    const double theta = std::numbers::pi * i / rings;
    for (int j = 0; j < around; ++j) {
      const double phi = 2 * std::numbers::pi * j / around;
      mesh.vertices.push_back(
          radius * Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
    }
  }
  mesh.vertices.emplace_back(0, 0, -radius);
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int i, int j) { return 1 + (i - 1) * around + j % around; };
  for (int j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({at(rings - 1, j), last, at(rings - 1, j + 1)});
  }
  return mesh;
}

inline TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const int shift = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({i + shift, j + shift, k + shift});
  return a;
}

inline TriangleMesh reversed(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline TriangleMesh moved(TriangleMesh mesh, const Pose& pose) {
  for (Vec3& v : mesh.vertices) v = pose * v;
  return mesh;
}

// Each triangle with corners of its own, as an STL file has it.
inline TriangleMesh torn_apart(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const auto& t : mesh.triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    for (int v : t) soup.vertices.push_back(mesh.vertices[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

// By brute force: every directed edge is used once, and so is its opposite.
inline bool closed_and_oriented(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> uses;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : uses) {
    if (count != 1 || !uses.contains({edge.second, edge.first})) return false;
  }
  return true;
}

inline double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    sum += (mesh.vertices[j] - mesh.vertices[i]).cross(mesh.vertices[k] - mesh.vertices[i]).norm() / 2;
  }
  return sum;
}

inline Mat3 random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Quat(normal(random), normal(random), normal(random), normal(random)).normalized().toRotationMatrix();
}

inline Vec3 random_vector(std::mt19937_64& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  const double x = uniform(random), y = uniform(random);
  return {x, y, uniform(random)};
}

// A generator of numbers that RapidCheck chose, so that a failing case can be shrunk to its seed and
// replayed.
inline std::mt19937_64 random_engine() {
  return std::mt19937_64(*rc::gen::inRange<std::uint64_t>(0, 1'000'000));
}

// A file in a fresh folder that goes away with the object.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& bytes) {
    std::string pattern = (std::filesystem::temp_directory_path() / "fc_mesh_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    path = folder_ / name;
    std::ofstream(path, std::ios::binary) << bytes;
  }
  ~TemporaryFile() { std::filesystem::remove_all(folder_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::filesystem::path path;

 private:
  std::filesystem::path folder_;
};

inline const char* const kBunny = "/usr/share/glmark2/models/bunny.obj";

}  // namespace fc::test
