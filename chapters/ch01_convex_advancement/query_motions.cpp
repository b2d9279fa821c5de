// Reading motions files and linear files.
#include <cmath>

#include "ch01_convex_advancement/query_run.hpp"
#include "common/table_reader.hpp"

namespace fc::ca {
namespace {

constexpr int kCellsPerBody = 13;
constexpr double kLargest = 1e9;  // of any cell: the range of positions, velocities and spins in scenes
const std::array<const char*, kCellsPerBody> kNames = {"px", "py", "pz", "qw", "qx", "qy", "qz",
                                                       "vx", "vy", "vz", "wx", "wy", "wz"};

std::string header_text() {
  std::string text;
  for (const char* body : {"a_", "b_"})
    for (const char* name : kNames) text += (text.empty() ? "" : ",") + std::string(body) + name;
  return text;
}

double number(const ReadTable& table, const ReadTable::Row& row, int column) {
  const double value = table.number(row, column);
  if (std::abs(value) > kLargest)
    throw InputError(
        table.mark(row, column),
        row.cells[column] + " is out of range [-1e9, 1e9], as in scenes; write a smaller number");
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
  const ReadTable table = read_table(*scene.motions, header_text());
  std::vector<QueryMotions> queries;
  for (const ReadTable::Row& row : table.rows) {
    std::array<double, kCellsPerBody> a{}, b{};
    for (int k = 0; k < 2 * kCellsPerBody; ++k)
      (k < kCellsPerBody ? a[k] : b[k - kCellsPerBody]) = number(table, row, k);
    queries.push_back({motion_from(a, shape_a, scene.bodies[0], table.mark(row, 0)),
                       motion_from(b, shape_b, scene.bodies[1], table.mark(row, 0))});
  }
  if (queries.empty())
    throw InputError({table.file}, "has no queries; write one row for each below the header");
  return queries;
}

constexpr int kLinearCells = 1 + 4 * 2 * 3;

std::string linear_header() {
  std::string text = "kind";
  for (int end = 0; end < 2; ++end)
    for (int point = 0; point < 4; ++point)
      for (const char* axis : {"x", "y", "z"})
        text += ",p" + std::to_string(point) + "_" + axis + std::to_string(end);
  return text;
}

LinearQuery::Kind linear_kind(const ReadTable& table, const ReadTable::Row& row) {
  if (row.cells[0] == "vf") return LinearQuery::Kind::vertex_face;
  if (row.cells[0] == "ee") return LinearQuery::Kind::edge_edge;
  throw InputError(table.mark(row, 0), "\"" + row.cells[0] +
                                           "\" is not a kind of query; write vf (a vertex and a triangle) or "
                                           "ee (two edges)");
}

}  // namespace

std::vector<LinearQuery> linear_queries(const Scene& scene) {
  const ReadTable table = read_table(*scene.linear, linear_header());
  std::vector<LinearQuery> queries;
  for (const ReadTable::Row& row : table.rows) {
    LinearQuery query;
    query.kind = linear_kind(table, row);
    for (int cell = 1; cell < kLinearCells; ++cell) {
      const int point = (cell - 1) / 3, axis = (cell - 1) % 3;
      (point < 4 ? query.start[point] : query.end[point - 4])[axis] = number(table, row, cell);
    }
    queries.push_back(query);
  }
  if (queries.empty())
    throw InputError({table.file}, "has no queries; write one row for each below the header");
  return queries;
}

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
