#include "common/scene_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/text.hpp"

namespace fc {
namespace {

std::string digits(double x) {
  return fmt::format("{}", x);
}

std::string digits(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}

std::string digits(const Quat& q) {
  const Eigen::Vector4d d = quaternion_digits(q);
  return fmt::format("[{}, {}, {}, {}]", d[0], d[1], d[2], d[3]);
}

// In double quotes, where every character can be written; characters that a text file may not have are escaped.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (byte < 0x20 || byte == 0x7f)
      out += fmt::format("\\x{:02X}", byte);
    else
      out += c;
  }
  return out + '"';
}

// A name as it is, if it cannot be taken for anything but a text.
std::string word(const std::string& text) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  constexpr std::string_view kOthers = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  const std::vector<std::string> meant = {"null", "true", "false", "yes", "no", "on", "off", "y", "n"};
  std::string lower = text;
  for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  const bool plain = !text.empty() && kLetters.find(text[0]) != std::string_view::npos &&
                     text.find_first_not_of(kOthers) == std::string::npos &&
                     std::find(meant.begin(), meant.end(), lower) == meant.end();
  return plain ? text : quoted(text);
}

std::string path_text(const std::filesystem::path& file) {
  return quoted(std::filesystem::absolute(file).string());
}

// The entries of a map on one line: "{a: 1, b: 2}".
class Entries {
 public:
  void add(const std::string& key, const std::string& value) {
    text_ += (text_.empty() ? "" : ", ") + key + ": " + value;
  }
  template <class Value>
  void add_if_set(const std::string& key, const std::optional<Value>& value) {
    if (value) add(key, digits(*value));
  }
  template <class Value>
  void add_unless(const Value& usual, const std::string& key, const Value& value) {
    if (value != usual) add(key, digits(value));
  }
  bool empty() const { return text_.empty(); }
  std::string text() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

// The kind's key with its value.
void add_kind(const SphereSpec& s, Entries& out) {
  out.add("sphere", fmt::format("{{radius: {}}}", s.radius));
}
void add_kind(const BoxSpec& s, Entries& out) {
  out.add("box", "{size: " + digits(s.size) + "}");
}
void add_kind(const CapsuleSpec& s, Entries& out) {
  out.add("capsule", fmt::format("{{radius: {}, length: {}}}", s.radius, s.length));
}
void add_kind(const CylinderSpec& s, Entries& out) {
  out.add("cylinder", fmt::format("{{radius: {}, length: {}}}", s.radius, s.length));
}
void add_kind(const ConeSpec& s, Entries& out) {
  out.add("cone", fmt::format("{{radius: {}, length: {}}}", s.radius, s.length));
}
void add_kind(const HullSpec& s, Entries& out) {
  std::string points;
  for (const Vec3& p : s.points) points += (points.empty() ? "" : ", ") + digits(p);
  out.add("hull", "{points: [" + points + "]}");
}
void add_kind(const MeshSpec& s, Entries& out) {
  out.add("mesh", path_text(s.file));
  out.add_unless(1.0, "scale", s.scale);
}
void add_placed(const Vec3& position, const Quat& orientation, Entries& out) {
  out.add_unless(Vec3(Vec3::Zero()), "position", position);
  if (orientation.coeffs() != Quat::Identity().coeffs()) out.add("orientation", digits(orientation));
}
void add_kind(const CompoundSpec& s, Entries& out) {
  std::string parts;
  for (const PartSpec& part : s.parts) {
    Entries own;
    std::visit([&](const auto& geometry) { add_kind(geometry, own); }, part.geometry);
    add_placed(part.position, part.orientation, own);
    parts += (parts.empty() ? "" : ", ") + own.text();
  }
  out.add("parts", "[" + parts + "]");
}

std::string inertia_text(const Mat3& i) {
  if (i(0, 1) == 0 && i(0, 2) == 0 && i(1, 2) == 0) return digits(Vec3(i.diagonal()));
  return fmt::format("[{}, {}, {}, {}, {}, {}]", i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2));
}

std::string shape_text(const ShapeSpec& shape) {
  Entries out;
  std::visit([&](const auto& geometry) { add_kind(geometry, out); }, shape.geometry);
  out.add_if_set("density", shape.density);
  out.add_if_set("mass", shape.mass);
  if (shape.inertia) out.add("inertia", inertia_text(*shape.inertia));
  out.add_if_set("center_of_mass", shape.center_of_mass);
  out.add_if_set("restitution", shape.restitution);
  out.add_if_set("friction", shape.friction);
  return out.text();
}

std::string fixed_text(const BodySpec& body) {
  std::string words;
  for (const auto& [free, prefix] : {std::pair(body.free_moves, ""), std::pair(body.free_turns, "r")})
    for (int axis = 0; axis < 3; ++axis)
      if (free[axis] == 0) words += (words.empty() ? "" : ", ") + std::string(prefix) + "xyz"[axis];
  return words.empty() ? "" : "[" + words + "]";
}

std::string body_text(const Scene& scene, const BodySpec& body) {
  Entries out;
  if (!body.name.empty()) out.add("name", quoted(body.name));
  out.add("shape", word(scene.shapes[static_cast<std::size_t>(body.shape)].name));
  if (body.is_static) out.add("static", "true");
  if (body.is_kinematic) out.add("kinematic", "true");
  if (body.is_sensor) out.add("sensor", "true");
  if (body.path_file) {
    out.add("path", path_text(*body.path_file));
    return out.text();  // which says where it is
  }
  add_placed(body.position, body.orientation, out);
  out.add_unless(Vec3(Vec3::Zero()), "velocity", body.velocity);
  out.add_unless(Vec3(Vec3::Zero()), "spin", body.spin);
  if (const std::string fixed = fixed_text(body); !fixed.empty()) out.add("fixed", fixed);
  return out.text();
}

std::string pair_text(const Scene& scene, const PairSpec& pair) {
  Entries out;
  out.add("a", word(scene.shapes[static_cast<std::size_t>(pair.shape_a)].name));
  out.add("b", word(scene.shapes[static_cast<std::size_t>(pair.shape_b)].name));
  out.add_if_set("restitution", pair.restitution);
  out.add_if_set("friction", pair.friction);
  return out.text();
}

std::string contact_text(const ContactSpec& contact) {
  return fmt::format("{{a: {}, b: {}, point: {}, normal: {}}}", contact.body_a, contact.body_b,
                     digits(contact.point), digits(contact.normal));
}

std::string lcp_text(const LcpSpec& lcp) {
  Entries out;
  if (lcp.matrix_file) out.add("matrix", path_text(*lcp.matrix_file));
  if (lcp.vector_file) out.add("vector", path_text(*lcp.vector_file));
  if (lcp.solution_file) out.add("solution", path_text(*lcp.solution_file));
  const auto row = [](const auto& numbers) {
    std::string text;
    for (const double x : numbers) text += (text.empty() ? "" : ", ") + digits(x);
    return "[" + text + "]";
  };
  if (lcp.matrix) {
    std::string rows;
    for (Eigen::Index i = 0; i < lcp.matrix->rows(); ++i)
      rows += (rows.empty() ? "" : ", ") + row(VecX(lcp.matrix->row(i).transpose()));
    out.add("A", "[" + rows + "]");
  }
  if (lcp.vector) out.add("b", row(*lcp.vector));
  return out.text();
}

std::string ccd_text(const CcdSpec& ccd) {
  const CcdSpec usual;
  Entries out;
  out.add_unless(usual.tolerance, "tolerance", ccd.tolerance);
  if (ccd.bound != usual.bound) out.add("bound", ccd.bound);
  if (ccd.max_iterations != usual.max_iterations)
    out.add("max_iterations", std::to_string(ccd.max_iterations));
  if (!ccd.warm_start) out.add("warm_start", "false");
  return out.empty() ? "" : out.text();
}

std::string solver_text(const SolverSpec& solver) {
  const SolverSpec usual;
  Entries out;
  if (solver.method != usual.method) out.add("method", solver.method);
  if (solver.limit != usual.limit) out.add("limit", std::to_string(solver.limit));
  out.add_unless(usual.tolerance, "tolerance", solver.tolerance);
  if (solver.compare) out.add("compare", "true");
  return out.empty() ? "" : out.text();
}

template <class Items, class ItemText>
std::string list_text(const std::string& key, const Items& items, const ItemText& text_of) {
  if (items.empty()) return "";
  std::string text = key + ":\n";
  for (const auto& item : items) text += "  - " + text_of(item) + "\n";
  return text;
}

// The keys above the shapes.
std::string rules_text(const Scene& scene) {
  std::string out = "name: " + word(scene.name) + "\n";
  const auto line = [&out](const std::string& key, const std::string& value) {
    if (!value.empty()) out += key + ": " + value + "\n";
  };
  if (scene.step) line("step", fmt::format("{{dt: {}, duration: {}}}", scene.step->dt, scene.step->duration));
  if (scene.gravity) line("gravity", digits(*scene.gravity));
  if (scene.gyroscopic) line("gyroscopic", "true");
  if (scene.drag)
    line("drag", fmt::format("{{linear: {}, angular: {}}}", scene.drag->linear, scene.drag->angular));
  if (scene.sleep)
    line("sleep", fmt::format("{{after: {}, speed: {}}}", scene.sleep->after, scene.sleep->speed));
  if (scene.envelope) line("envelope", digits(*scene.envelope));
  if (scene.restitution) line("restitution", digits(*scene.restitution));
  if (scene.friction) line("friction", digits(*scene.friction));
  line("ccd", ccd_text(scene.ccd));
  line("solver", solver_text(scene.solver));
  if (scene.interval != 1) line("interval", digits(scene.interval));
  if (scene.motions) line("motions", path_text(*scene.motions));
  if (scene.linear) line("linear", path_text(*scene.linear));
  if (scene.lcp) line("lcp", lcp_text(*scene.lcp));
  return out;
}

}  // namespace

Eigen::Vector4d quaternion_digits(const Quat& quaternion) {
  constexpr int kMultiples = 4096;
  const Eigen::Vector4d wanted(quaternion.w(), quaternion.x(), quaternion.y(), quaternion.z());
  for (int k = 0; k < kMultiples; ++k) {
    const Eigen::Vector4d digits = wanted * (1 + k * std::numeric_limits<double>::epsilon());
    const double length = digits.stableNorm();  // as quaternion_value() reads it
    const Eigen::Vector4d read = length != 1 ? Eigen::Vector4d(digits / length) : digits;
    if (read == wanted) return digits;
  }
  return wanted;
}

std::string scene_text(const Scene& scene) {
  std::string out = rules_text(scene);
  if (!scene.shapes.empty()) {
    out += "shapes:\n";
    for (const ShapeSpec& shape : scene.shapes)
      out += "  " + word(shape.name) + ": " + shape_text(shape) + "\n";
  }
  out += list_text("pairs", scene.pairs, [&](const PairSpec& pair) { return pair_text(scene, pair); });
  out += list_text("bodies", scene.bodies, [&](const BodySpec& body) { return body_text(scene, body); });
  out += list_text("contacts", scene.contacts, contact_text);
  return out;
}

}  // namespace fc
