// The header of a PLY file, which describes the rows that follow it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/mesh_formats.hpp"

namespace fc::mesh_formats {

enum class PlyScalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyScalar type = PlyScalar::float32;
  std::optional<PlyScalar> count_type;  // a list: its length comes first
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  std::optional<std::size_t> find(std::string_view property) const {
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].name == property) return i;
    }
    return std::nullopt;
  }
};

enum class PlyEncoding { text, little, big };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements;
  int lines = 0;

  const PlyElement* find(std::string_view element) const {
    for (const PlyElement& e : elements) {
      if (e.name == element) return &e;
    }
    return nullptr;
  }
};

// Reads the header of a file that begins with "ply", and removes it: the file's bytes are then the rows
// alone.
PlyHeader read_ply_header(InputFile& file);

}  // namespace fc::mesh_formats
