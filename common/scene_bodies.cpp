#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "common/scene_parts.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

constexpr std::int64_t most_bodies = 1'000'000;

using ShapeIndex = std::unordered_map<std::string, int>;

int shape_index(const Section& body, const ShapeIndex& index) {
  const std::string name = body.get(text_value, "shape");
  if (const auto it = index.find(name); it != index.end()) return it->second;
  std::vector<std::string> names;
  for (const auto& [known, number] : index) names.push_back(known);
  std::sort(names.begin(), names.end());
  refuse(body.node("shape").place, fmt::format("no shape is named {}; the nearest name under 'shapes' is {}",
                                               in_quotes(name), in_quotes(nearest(name, names))));
}

BodySpec read_body(const Section& body, const ShapeIndex& index) {
  BodySpec spec;
  spec.where = body.place().mark();
  spec.shape = shape_index(body, index);
  spec.is_static = body.get_or(boolean_value, "static", false);
  spec.is_kinematic = body.get_or(boolean_value, "kinematic", false);
  spec.is_sensor = body.get_or(boolean_value, "sensor", false);
  if (spec.is_static && spec.is_kinematic)
    refuse(body.entry("kinematic").key_place, "a static body does not move; remove 'kinematic' or 'static'");
  spec.position = body.get_or(vector_value, "position", spec.position);
  spec.orientation = body.get_or(quaternion_value, "orientation", spec.orientation);
  spec.velocity = body.get_or(vector_value, "velocity", spec.velocity);
  spec.spin = body.get_or(vector_value, "spin", spec.spin);
  for (const char* key : {"velocity", "spin"}) {
    if (spec.is_static && body.has(key) && !body.get(vector_value, key).isZero(0)) {
      refuse(body.entry(key).key_place,
             fmt::format("a static body does not move; remove its '{}' or 'static'", key));
    }
  }
  return spec;
}

// Appends the body, or its copies on its grid: x fastest, then y, then z.
void append_bodies(const Section& body, const BodySpec& spec, std::vector<BodySpec>& bodies) {
  std::array<int, 3> count = {1, 1, 1};
  Vec3 spacing = Vec3::Zero();
  if (body.has("grid")) {
    const Section grid = body.section("grid");
    count = grid.get(integers_value, "count");
    spacing = grid.get(vector_value, "spacing");
  }
  const std::int64_t copies = std::int64_t{count[0]} * count[1] * count[2];  // each at most 1e6: fits
  if (static_cast<std::int64_t>(bodies.size()) + copies > most_bodies) {
    refuse(body.place(), fmt::format("more than {} bodies; use a smaller grid", most_bodies));
  }
  for (int z = 0; z < count[2]; ++z) {
    for (int y = 0; y < count[1]; ++y) {
      for (int x = 0; x < count[0]; ++x) {
        bodies.push_back(spec);
        bodies.back().position += Vec3(x, y, z).cwiseProduct(spacing);
      }
    }
  }
}

}  // namespace

std::vector<BodySpec> read_bodies(const Section& scene, const std::vector<ShapeSpec>& shapes) {
  ShapeIndex index;
  for (const ShapeSpec& shape : shapes) index.emplace(shape.name, static_cast<int>(index.size()));
  std::vector<BodySpec> bodies;
  for (const YamlPtr& item : scene.node("bodies").items) {
    const Section body(*item, "bodies[]");
    append_bodies(body, read_body(body, index), bodies);
  }
  return bodies;
}

std::vector<ContactSpec> read_contacts(const Section& scene, const std::vector<BodySpec>& bodies) {
  const auto body_number = [&](const Section& contact, const char* key) {
    const int number = contact.get(integer_value, key);
    if (static_cast<std::size_t>(number) < bodies.size()) return number;
    refuse(contact.node(key).place,
           fmt::format("there is no body {}; the bodies are numbered 0 to {}", number, bodies.size() - 1));
  };
  std::vector<ContactSpec> contacts;
  for (const YamlPtr& item : scene.node("contacts").items) {
    const Section contact(*item, "contacts[]");
    ContactSpec spec;
    spec.where = contact.place().mark();
    spec.body_a = body_number(contact, "a");
    spec.body_b = body_number(contact, "b");
    if (spec.body_a == spec.body_b) {
      refuse(contact.node("b").place, "a body cannot touch itself; name two bodies");
    }
    const auto is_static = [&](int body) { return bodies[static_cast<std::size_t>(body)].is_static; };
    if (is_static(spec.body_a) && is_static(spec.body_b)) {
      refuse(contact.place(), "both bodies of this contact are static; remove it");
    }
    spec.point = contact.get(vector_value, "point");
    spec.normal = contact.get(vector_value, "normal");
    constexpr double shortest =
        1e-9;  // below it, the digits that are left say nothing certain of a direction
    if (spec.normal.stableNorm() < shortest) {
      refuse(contact.node("normal").place, "'normal' is zero; write the direction from body a to body b");
    }
    spec.normal.stableNormalize();
    contacts.push_back(spec);
  }
  return contacts;
}

LcpSpec read_lcp(const Section& lcp, const SceneSource& source) {
  LcpSpec spec;
  spec.where = lcp.place().mark();
  const bool has_files = lcp.has("matrix") || lcp.has("vector") || lcp.has("solution");
  const bool has_numbers = lcp.has("A") || lcp.has("b");
  if (has_files && has_numbers) {
    refuse(lcp.place(), "'lcp' has both files and numbers; keep matrix and vector, or A and b");
  }
  const std::string first = has_files ? "matrix" : "A", second = has_files ? "vector" : "b";
  if (!lcp.has(first) || !lcp.has(second)) {
    refuse(lcp.place(), "'lcp' is incomplete; give matrix and vector (files), or A and b (numbers)");
  }
  if (has_files) {
    spec.matrix_file = resolved_file(lcp, "matrix", source);
    spec.vector_file = resolved_file(lcp, "vector", source);
    if (lcp.has("solution")) spec.solution_file = resolved_file(lcp, "solution", source);
    return spec;
  }
  spec.matrix = lcp.get(matrix_value, "A");
  spec.vector = lcp.get(numbers_value, "b");
  if (spec.vector->size() != spec.matrix->rows()) {
    refuse(lcp.node("b").place,
           fmt::format("'b' has {} numbers and A has {} rows; give as many numbers as rows",
                       spec.vector->size(), spec.matrix->rows()));
  }
  return spec;
}

}  // namespace fc
