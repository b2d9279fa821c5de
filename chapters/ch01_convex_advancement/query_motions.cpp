// Reading motions files.
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "ch01_convex_advancement/query_run.hpp"

namespace fc::ca {
namespace {

constexpr int kCellsPerBody = 13;
constexpr double kLargest = 1e9;  // of any cell: the range of positions, velocities and spins in scenes
const std::array<const char*, kCellsPerBody> kNames = {"px", "py", "pz", "qw", "qx", "qy", "qz",
                                                       "vx", "vy", "vz", "wx", "wy", "wz"};

std::vector<std::string> split(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const auto first = cell.find_first_not_of(" \t");
    const auto last = cell.find_last_not_of(" \t");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  if (!line.empty() && line.back() == ',') cells.emplace_back();
  return cells;
}

std::string header_text() {
  std::string text;
  for (const char* body : {"a_", "b_"})
    for (const char* name : kNames) text += (text.empty() ? "" : ",") + std::string(body) + name;
  return text;
}

double number(const std::string& cell, const SourceMark& where) {
  double value = 0;
  const char* end = cell.data() + cell.size();
  const auto [rest, error] = std::from_chars(cell.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value))
    throw InputError(where, "\"" + cell + "\" is not a finite number; write one, for example 0.5");
  if (std::abs(value) > kLargest)
    throw InputError(where, cell + " is out of range [-1e9, 1e9], as in scenes; write a smaller number");
  return value;
}

// The spec's own position, orientation and velocities replaced by a row's cells.
Motion motion_from(const std::array<double, kCellsPerBody>& x, const Shape& shape, BodySpec spec,
                   const SourceMark& where) {
  spec.position = {x[0], x[1], x[2]};
  spec.orientation = Quat(x[3], x[4], x[5], x[6]);
  if (!(spec.orientation.norm() > 0))
    throw InputError(where, "the quaternion is zero; write 1,0,0,0 for no rotation");
  spec.orientation.normalize();
  spec.velocity = {x[7], x[8], x[9]};
  spec.spin = {x[10], x[11], x[12]};
  spec.is_static = false;
  RigidBody body = make_body(shape, spec);
  body.velocity = spec.velocity;
  body.spin = spec.spin;
  return Motion(body);
}

std::vector<QueryMotions> read_motions(const Scene& scene, const Shape& shape_a, const Shape& shape_b) {
  const std::string file = scene.motions->string();
  std::ifstream stream(file);
  if (!stream) throw InputError({file}, "cannot be read; check its path and permissions");
  std::string line;
  if (!std::getline(stream, line) || split(line) != split(header_text()))
    throw InputError({file, 1, 1}, "the header must be " + header_text());
  std::vector<QueryMotions> queries;
  for (int row = 2; std::getline(stream, line); ++row) {
    if (line.empty() || line == "\r") continue;
    const std::vector<std::string> cells = split(line);
    if (cells.size() != 2 * kCellsPerBody)
      throw InputError({file, row, 1}, std::to_string(cells.size()) + " cells; a row has " +
                                           std::to_string(2 * kCellsPerBody) + ", as the header");
    std::array<double, kCellsPerBody> a{}, b{};
    int column = 1;
    for (int k = 0; k < 2 * kCellsPerBody; ++k) {
      (k < kCellsPerBody ? a[k] : b[k - kCellsPerBody]) = number(cells[k], {file, row, column});
      column += static_cast<int>(cells[k].size()) + 1;
    }
    queries.push_back({motion_from(a, shape_a, scene.bodies[0], {file, row, 1}),
                       motion_from(b, shape_b, scene.bodies[1], {file, row, 1})});
  }
  if (queries.empty()) throw InputError({file}, "has no queries; write one row for each below the header");
  return queries;
}

}  // namespace

std::vector<QueryMotions> query_motions(const Scene& scene, const std::vector<Shape>& shapes) {
  const Shape& shape_a = shapes[scene.bodies[0].shape];
  const Shape& shape_b = shapes[scene.bodies[1].shape];
  if (scene.motions) return read_motions(scene, shape_a, shape_b);
  std::array<Motion, 2> motions;
  for (int i = 0; i < 2; ++i) {
    RigidBody body = make_body(shapes[scene.bodies[i].shape], scene.bodies[i]);
    if (!scene.bodies[i].is_static) {
      body.velocity = scene.bodies[i].velocity;
      body.spin = scene.bodies[i].spin;
    }
    motions[i] = Motion(body);
  }
  return {{motions[0], motions[1]}};
}

}  // namespace fc::ca
