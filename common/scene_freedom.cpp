// The keys that restrict or prescribe a body's motion: `fixed` and `path`.
#include <fmt/format.h>

#include <cmath>

#include "common/scene_parts.hpp"
#include "common/table_reader.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

constexpr double kLargest = 1e9;      // of a path's cells: the range of positions in scenes
constexpr double kAlongFixed = 1e-9;  // of a spin: less than this about a fixed axis is rounding

double cell(const ReadTable& table, const ReadTable::Row& row, int column) {
  const double value = table.number(row, column);
  if (std::abs(value) <= kLargest) return value;
  throw InputError(table.mark(row, column), row.cells[static_cast<std::size_t>(column)] +
                                                " is out of range [-1e9, 1e9]; write a smaller number");
}

}  // namespace

void read_freedom(const Section& body, BodySpec& spec) {
  for (const bool other : {spec.is_static, spec.is_kinematic})
    if (other)
      refuse(body.entry("fixed").key_place, fmt::format("no impulse moves a {} body; remove 'fixed'",
                                                        spec.is_static ? "static" : "kinematic"));
  for (const std::string& word : body.get(words_value, "fixed")) {
    const int axis = word.back() - 'x';
    (word.size() == 1 ? spec.free_moves : spec.free_turns)[axis] = 0;
  }
  for (int axis = 0; axis < 3; ++axis)
    if (spec.free_moves[axis] == 0 && spec.velocity[axis] != 0)
      refuse(body.node("velocity").place,
             fmt::format("'velocity' has {} m/s along {}, which is fixed; make it 0", spec.velocity[axis],
                         "xyz"[axis]));
  Vec3 turns = spec.orientation.conjugate() * spec.spin;
  for (int axis = 0; axis < 3; ++axis) {
    if (spec.free_turns[axis] != 0) continue;
    if (std::abs(turns[axis]) > kAlongFixed * spec.spin.norm())
      refuse(body.node("spin").place,
             fmt::format("'spin' has {:.3g} rad/s about the body's {}, which is fixed (r{}); make it 0",
                         turns[axis], "xyz"[axis], "xyz"[axis]));
    turns[axis] = 0;
  }
  if (!spec.free_turns.isOnes(0)) spec.spin = spec.orientation * turns;
}

void read_path(const Section& body, const SceneSource& source, BodySpec& spec) {
  if (!spec.is_kinematic)
    refuse(body.entry("path").key_place, "only a kinematic body follows a path; add 'kinematic: true'");
  for (const char* key : {"position", "orientation", "rotation", "velocity", "spin", "grid"})
    if (body.has(key))
      refuse(body.entry(key).key_place,
             fmt::format("'{}' beside 'path', which says where the body is; keep one of them", key));
  spec.path_file = resolved_file(body, "path", source);
  const ReadTable table = read_table(*spec.path_file, "t,px,py,pz,qw,qx,qy,qz");
  for (const ReadTable::Row& row : table.rows) {
    PathRow at;
    at.time = cell(table, row, 0);
    if (!spec.path.empty() && !(at.time > spec.path.back().time))
      throw InputError(table.mark(row, 0),
                       fmt::format("{} s is not later than the row before, {} s; times must ascend", at.time,
                                   spec.path.back().time));
    at.position = {cell(table, row, 1), cell(table, row, 2), cell(table, row, 3)};
    at.orientation = Quat(cell(table, row, 4), cell(table, row, 5), cell(table, row, 6), cell(table, row, 7));
    if (!(at.orientation.norm() > 0))
      throw InputError(table.mark(row, 4), "the quaternion is zero; write 1,0,0,0 for no rotation");
    at.orientation.normalize();
    spec.path.push_back(at);
  }
  if (spec.path.empty())
    throw InputError({table.file}, "has no rows; write one pose at least below the header");
}

}  // namespace fc
