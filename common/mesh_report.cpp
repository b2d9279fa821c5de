#include <fmt/format.h>

#include <string>

#include "common/mesh.hpp"

namespace fc {
namespace {

// 69666 as "69,666".
std::string grouped(int number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

std::string count(int number, const char* one, const char* many) {
  return grouped(number) + " " + (number == 1 ? one : many);
}

}  // namespace

std::string MeshReport::text() const {
  std::string line = count(triangles, "triangle", "triangles") + ", " + count(vertices, "vertex", "vertices");
  const auto add = [&](const std::string& part) { line += ", " + part; };
  const auto add_defect = [&](int number, const char* one, const char* many) {
    if (number > 0) add(count(number, one, many));
  };
  if (solid) {
    add("closed");
    add("consistently oriented");
  } else {
    add("a surface without an inside");
  }
  add(count(components, "component", "components"));
  add_defect(holes, "hole", "holes");
  add_defect(boundary_edges, "boundary edge", "boundary edges");
  add_defect(flipped_triangles, "flipped triangle", "flipped triangles");
  add_defect(one_sided, "one-sided part", "one-sided parts");
  add_defect(flipped_edges, "edge between triangles of opposite orientation",
             "edges between triangles of opposite orientation");
  add_defect(nonmanifold_edges, "edge of three or more triangles", "edges of three or more triangles");
  add_defect(degenerate_triangles, "degenerate triangle removed", "degenerate triangles removed");
  add_defect(duplicate_triangles, "duplicate triangle removed", "duplicate triangles removed");
  add_defect(reversed_components, "inside-out component turned", "inside-out components turned");
  if (overlapping > 0)
    add(grouped(overlapping) + " closed parts overlap (the shared volume is counted in each)");
  if (!left_out.empty()) add(left_out + " left out");
  return line;
}

}  // namespace fc
