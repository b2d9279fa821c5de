#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <unordered_map>

#include "common/number_text.hpp"
#include "common/scene_parts.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

constexpr std::int64_t most_bodies = 1'000'000;

using ShapeIndex = std::unordered_map<std::string, int>;

ShapeIndex index_of(const std::vector<ShapeSpec>& shapes) {
  ShapeIndex index;
  for (const ShapeSpec& shape : shapes) index.emplace(shape.name, static_cast<int>(index.size()));
  return index;
}

// The shape that a key of a section names.
int shape_index(const Section& section, const char* key, const ShapeIndex& index) {
  const std::string name = section.get(text_value, key);
  if (const auto it = index.find(name); it != index.end()) return it->second;
  std::vector<std::string> names;
  for (const auto& [known, number] : index) names.push_back(known);
  std::sort(names.begin(), names.end());
  refuse(section.node(key).place, fmt::format("no shape is named {}; the nearest name under 'shapes' is {}",
                                              in_quotes(name), in_quotes(nearest(name, names))));
}

// A body's name, which must not mean anything else: a number belongs to another body, and `world` is no body.
std::string read_name(const Section& body) {
  const std::string name = body.get(text_value, "name");
  const auto refuse_name = [&](const std::string& problem) {
    refuse(body.node("name").place, in_quotes(name) + " " + problem);
  };
  double ignored = 0;
  if (read_number(name, ignored) != NumberText::not_a_number)
    refuse_name("is a number, as every body has one; give it a name of letters");
  if (name == "world") refuse_name("is what bodies are joined to; give the body another name");
  if (body.has("grid")) refuse_name("would be the name of every body of the grid; remove 'name' or 'grid'");
  return name;
}

BodySpec read_body(const Section& body, const ShapeIndex& index, const SceneSource& source) {
  BodySpec spec;
  spec.where = body.place().mark();
  if (body.has("name")) spec.name = read_name(body);
  spec.shape = shape_index(body, "shape", index);
  spec.is_static = body.get_or(boolean_value, "static", false);
  spec.is_kinematic = body.get_or(boolean_value, "kinematic", false);
  spec.is_sensor = body.get_or(boolean_value, "sensor", false);
  if (spec.is_static && spec.is_kinematic)
    refuse(body.entry("kinematic").key_place, "a static body does not move; remove 'kinematic' or 'static'");
  spec.position = body.get_or(vector_value, "position", spec.position);
  spec.orientation = read_orientation(body);
  spec.velocity = body.get_or(vector_value, "velocity", spec.velocity);
  spec.spin = body.get_or(vector_value, "spin", spec.spin);
  for (const char* key : {"velocity", "spin"}) {
    if (spec.is_static && body.has(key) && !body.get(vector_value, key).isZero(0)) {
      refuse(body.entry(key).key_place,
             fmt::format("a static body does not move; remove its '{}' or 'static'", key));
    }
  }
  if (body.has("fixed")) read_freedom(body, spec);
  if (body.has("path")) read_path(body, source, spec);
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

Quat read_orientation(const Section& placed) {
  if (!placed.has("rotation")) return placed.get_or(quaternion_value, "orientation", Quat::Identity());
  if (placed.has("orientation"))
    refuse(placed.entry("rotation").key_place, "'rotation' beside 'orientation'; keep one of them");
  const Section rotation = placed.section("rotation");
  constexpr double full_turn = 360;  // beyond it an angle says nothing new, and its half loses digits
  const double degrees = std::remainder(rotation.get(number_value, "degrees"), full_turn);
  return Quat(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, rotation.get(direction_value, "axis")));
}

std::vector<PairSpec> read_pairs(const Section& scene, const std::vector<ShapeSpec>& shapes) {
  const ShapeIndex index = index_of(shapes);
  std::vector<PairSpec> pairs;
  for (const YamlPtr& item : scene.node("pairs").items) {
    const Section pair(*item, "pairs[]");
    PairSpec spec;
    std::tie(spec.shape_a, spec.shape_b) =
        std::minmax({shape_index(pair, "a", index), shape_index(pair, "b", index)});
    if (pair.has("restitution")) spec.restitution = pair.get(number_value, "restitution");
    if (pair.has("friction")) spec.friction = pair.get(number_value, "friction");
    spec.where = pair.place().mark();
    for (const PairSpec& other : pairs)
      if (other.shape_a == spec.shape_a && other.shape_b == spec.shape_b)
        refuse(pair.place(), fmt::format("the pair of {} and {} stands at {} already; keep one of them",
                                         in_quotes(pair.get(text_value, "a")),
                                         in_quotes(pair.get(text_value, "b")), other.where.text()));
    pairs.push_back(spec);
  }
  return pairs;
}

std::vector<BodySpec> read_bodies(const Section& scene, const std::vector<ShapeSpec>& shapes,
                                  const SceneSource& source) {
  const ShapeIndex index = index_of(shapes);
  std::unordered_map<std::string, std::size_t> named;
  std::vector<BodySpec> bodies;
  for (const YamlPtr& item : scene.node("bodies").items) {
    const Section body(*item, "bodies[]");
    if (body.has("name")) {
      const auto [known, is_new] = named.emplace(body.get(text_value, "name"), bodies.size());
      if (!is_new)
        refuse(body.node("name").place, fmt::format("body {} is named {} already; give each its own name",
                                                    known->second, in_quotes(known->first)));
    }
    append_bodies(body, read_body(body, index, source), bodies);
  }
  return bodies;
}

std::vector<ContactSpec> read_contacts(const Section& scene, const std::vector<BodySpec>& bodies) {
  std::vector<std::string> names;
  for (const BodySpec& body : bodies) names.push_back(body.name);
  const auto body_number = [&](const Section& contact, const char* key) {
    return body_value(contact.node(key), contact.row(key), names);
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
    spec.normal = contact.get(direction_value, "normal");
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
