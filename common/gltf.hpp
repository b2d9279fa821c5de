// A writer of binary glTF 2.0 files, as far as recorded motion needs them. Only motion_recording.cpp includes
// this: its JSON library is slow to compile.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace fc::gltf {

using Json = nlohmann::ordered_json;  // keeps its order: the same run writes the same bytes

// How many floats one element of an accessor has.
enum class Element { scalar = 1, vec3 = 3, vec4 = 4 };

// Collects nodes, meshes and animation channels in `json` (the glTF schema's own names), and their numbers
// in the one binary chunk.
class File {
 public:
  Json json;

  File();

  // Numbers for the binary chunk; the result is the accessor's index. `of_vertices` marks vertex attributes.
  int floats(std::span<const float> values, Element element, bool of_vertices = false);
  int indices(std::span<const std::array<int, 3>> triangles, std::size_t vertices);
  // Appends to one of the top arrays ("nodes", "meshes", ...) and returns the index there.
  int add(const char* array, Json item);
  // One animated property ("translation", "rotation", "scale") of a node: keys at the times of one accessor.
  void channel(int node, const char* property, int times, int values, bool stepwise);

  // The whole file: header, JSON chunk, binary chunk.
  std::string bytes() const;

 private:
  int view(const void* data, std::size_t size, int target);

  std::string binary_;
};

}  // namespace fc::gltf
