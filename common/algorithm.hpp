// An account of one frame that a student steps through, picture by picture: plain data, and its JSON (live/STREAM.md,
// "Algorithm"). Chapters make the steps; the page draws them, beside a scene that runs and in a recording.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/types.hpp"

namespace fc::algorithm {

// What something drawn is about; the page gives each a colour.
enum class Role {
  a,      // the first body
  b,      // the second
  now,    // what this step adds
  past,   // what earlier steps added
  good,   // proved, accepted
  bad,    // refused, violated
  force,  // a force or an impulse
};

// Something to draw, in world coordinates, m.
struct Mark {
  enum class Kind { point, line, arrow, plane, mesh, label };
  Kind kind = Kind::point;
  Role role = Role::now;
  std::vector<Vec3> points;  // point, label: one; arrow: from, to; plane: a point of it, its unit normal
  std::vector<std::array<int, 3>> triangles = {};  // of a mesh, which is see-through
  double radius = 0;                               // m, of a plane: it is drawn as a disc
  bool closed = false;                             // of a line: its last point joins the first
  std::string text = {};                           // of a label
};
Mark point(const Vec3& at, Role role);
Mark line(std::vector<Vec3> points, Role role, bool closed = false);
Mark arrow(const Vec3& from, const Vec3& to, Role role);
Mark plane(const Vec3& at, const Vec3& normal, double radius, Role role);
Mark mesh(std::vector<Vec3> points, std::vector<std::array<int, 3>> triangles, Role role);
Mark label(const Vec3& at, std::string text);

struct Curve {
  std::string name;
  Role role = Role::now;
  std::vector<std::array<double, 2>> points;
  bool steps = false;  // drawn as a staircase
};
struct ChartNote {
  double x = 0, y = 0;
  std::string text;
};
struct Chart {
  std::string x, y;  // "time of the frame [s]", "gap [m]"
  bool log = false;  // of the y axis
  std::vector<Curve> curves;
  std::vector<ChartNote> notes;
};

struct Bar {
  std::string label;
  double value = 0;
  Role role = Role::now;
  std::string note = {};  // a word or two
};
struct Bars {
  std::string title, unit;
  std::vector<Bar> rows;
};

// A body that is drawn elsewhere than at the frame's start.
struct BodyPose {
  int body = 0;
  Vec3 position = Vec3::Zero();
  Quat orientation = Quat::Identity();
};

struct Step {
  std::string text;  // one or two short sentences with this step's numbers and units
  std::vector<BodyPose> poses = {};
  std::vector<Mark> draw = {};
  std::optional<Chart> chart = {};
  std::optional<Bars> bars = {};
};

// What one chapter's code did.
struct Part {
  int chapter = 0;
  std::string title;
  std::vector<Step> steps;
};

struct Document {
  int frame = 0;          // the frame that is made, counted from 1
  double t0 = 0, t1 = 0;  // s, its start and end
  std::vector<Part> parts;
};

inline constexpr std::size_t kMostBytes = 400'000;  // of a document

// As JSON of at most kMostBytes: numbers have 7 digits. Where it would be longer, steps of the longest part are left out from
// its middle, and the part's last step says how many. Throws std::invalid_argument for a number that is not finite.
std::string json(const Document& document);

// "1 contact", "3 contacts": a number with its noun, and an s where it is not one.
std::string count(std::int64_t n, const std::string& noun);
// At most four digits, as texts of steps have them: "0.214", "1.2e-07".
std::string number(double x);

}  // namespace fc::algorithm
