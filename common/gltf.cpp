#include "common/gltf.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace fc::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's numbers are little-endian");

// The schema's numbers.
enum { kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126 };
enum { kArrayBuffer = 34962, kElementArrayBuffer = 34963 };

void append_word(std::string& out, std::uint32_t word) {
  out.append(reinterpret_cast<const char*>(&word), sizeof word);
}

void append_chunk(std::string& out, const char* type, std::string data, char padding) {
  data.resize((data.size() + 3) / 4 * 4, padding);
  append_word(out, static_cast<std::uint32_t>(data.size()));
  out.append(type, 4);
  out += data;
}

}  // namespace

File::File() {
  json["asset"] = {{"version", "2.0"}, {"generator", "First Contact"}};
}

int File::add(const char* array, Json item) {
  json[array].push_back(std::move(item));
  return static_cast<int>(json[array].size()) - 1;
}

int File::view(const void* data, std::size_t size, int target) {
  Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}};
  if (target != 0) view["target"] = target;
  binary_.append(static_cast<const char*>(data), size);
  binary_.resize((binary_.size() + 3) / 4 * 4);  // every accessor begins at a multiple of its numbers' size
  return add("bufferViews", std::move(view));
}

int File::floats(std::span<const float> values, Element element, bool of_vertices) {
  const auto width = static_cast<std::size_t>(element);
  static const char* const names[] = {"", "SCALAR", "", "VEC3", "VEC4"};
  Json low = Json::array(), high = Json::array();
  for (std::size_t k = 0; k < width; ++k) {
    float least = values[k], most = values[k];
    for (std::size_t i = k; i < values.size(); i += width) {
      least = std::min(least, values[i]);
      most = std::max(most, values[i]);
    }
    low.push_back(least);
    high.push_back(most);
  }
  return add("accessors",
             {{"bufferView", view(values.data(), values.size_bytes(), of_vertices ? kArrayBuffer : 0)},
              {"componentType", kFloat},
              {"count", values.size() / width},
              {"type", names[width]},
              {"min", low},
              {"max", high}});
}

int File::indices(std::span<const std::array<int, 3>> triangles, std::size_t vertices) {
  const bool narrow = vertices < 65535;  // the largest 16-bit number means something else
  std::vector<std::uint16_t> small;
  std::vector<std::uint32_t> large;
  for (const auto& triangle : triangles)
    for (const int i : triangle)
      narrow ? small.push_back(static_cast<std::uint16_t>(i))
             : large.push_back(static_cast<std::uint32_t>(i));
  const int numbers = narrow ? view(small.data(), small.size() * sizeof small[0], kElementArrayBuffer)
                             : view(large.data(), large.size() * sizeof large[0], kElementArrayBuffer);
  return add("accessors", {{"bufferView", numbers},
                           {"componentType", narrow ? kUnsignedShort : kUnsignedInt},
                           {"count", 3 * triangles.size()},
                           {"type", "SCALAR"}});
}

void File::channel(int node, const char* property, int times, int values, bool stepwise) {
  if (!json.contains("animations"))
    json["animations"] = {{{"name", "motion"}, {"samplers", Json::array()}, {"channels", Json::array()}}};
  Json& animation = json["animations"][0];
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", property}}}});
  animation["samplers"].push_back(
      {{"input", times}, {"output", values}, {"interpolation", stepwise ? "STEP" : "LINEAR"}});
}

std::string File::bytes() const {
  Json whole = json;
  whole["buffers"] = {{{"byteLength", binary_.size()}}};
  std::string chunks;
  append_chunk(chunks, "JSON", whole.dump(), ' ');
  append_chunk(chunks, std::string("BIN\0", 4).c_str(), binary_, '\0');
  std::string out = "glTF";
  append_word(out, 2);
  append_word(out, static_cast<std::uint32_t>(12 + chunks.size()));
  return out + chunks;
}

}  // namespace fc::gltf
