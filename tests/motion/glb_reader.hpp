// Reads a binary glTF file back, with nothing of the writer's code, and refuses any file that breaks the format.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace fc_test {

struct Glb {
  nlohmann::json json;
  std::string binary;

  explicit Glb(const std::string& bytes) {
    need(bytes.size() > 28 && bytes.substr(0, 4) == "glTF" && word(bytes, 4) == 2, "header");
    need(word(bytes, 8) == bytes.size(), "total length");
    const std::uint32_t json_size = word(bytes, 12);
    need(json_size % 4 == 0 && bytes.substr(16, 4) == "JSON", "first chunk");
    json = nlohmann::json::parse(bytes.substr(20, json_size));
    const std::size_t at = 20 + json_size;
    need(word(bytes, at) % 4 == 0 && bytes.substr(at + 4, 4) == std::string("BIN\0", 4), "second chunk");
    binary = bytes.substr(at + 8);
    need(binary.size() == word(bytes, at), "length of the second chunk");
    need(json["buffers"].size() == 1 && json["buffers"][0]["byteLength"] <= binary.size(), "buffer");
    for (std::size_t i = 0; i < json["accessors"].size(); ++i) check_accessor(i);
  }

  // The numbers of an accessor, whatever their type.
  std::vector<double> numbers(std::size_t accessor) const {
    const auto& a = json["accessors"].at(accessor);
    const auto& view = json["bufferViews"].at(a["bufferView"].get<std::size_t>());
    const std::size_t count = a["count"].get<std::size_t>() * width(a), size = bytes_of(a["componentType"]);
    need(count * size == view["byteLength"], "length of a view");
    const std::size_t start = view["byteOffset"];
    need(start % 4 == 0 && start + count * size <= binary.size(), "place of a view");
    std::vector<double> out;
    for (std::size_t i = 0; i < count; ++i) {
      const char* const from = binary.data() + start + i * size;
      if (a["componentType"] == 5126)
        out.push_back(as<float>(from));
      else
        out.push_back(size == 2 ? as<std::uint16_t>(from) : as<std::uint32_t>(from));
    }
    return out;
  }

  std::size_t node(const std::string& name) const {
    for (std::size_t i = 0; i < json["nodes"].size(); ++i)
      if (json["nodes"][i]["name"] == name) return i;
    throw std::runtime_error("no node " + name);
  }
  bool moves(const std::string& name) const { return !channel(node(name), "translation").is_null(); }

  struct Track {
    std::vector<double> times, values;
    bool stepwise;
  };
  Track track(const std::string& name, const std::string& property) const {
    const nlohmann::json found = channel(node(name), property);
    const auto& sampler = json["animations"][0]["samplers"].at(found["sampler"].get<std::size_t>());
    return {numbers(sampler["input"]), numbers(sampler["output"]), sampler["interpolation"] == "STEP"};
  }

  static std::size_t width(const nlohmann::json& a) {
    return a["type"] == "SCALAR" ? 1
           : a["type"] == "VEC3" ? 3
           : a["type"] == "VEC4" ? 4
                                 : throw std::runtime_error("type");
  }

 private:
  static void need(bool holds, const std::string& what) {
    if (!holds) throw std::runtime_error("not a right glTF file: " + what);
  }
  template <class T>
  static T as(const char* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
  }
  static std::uint32_t word(const std::string& bytes, std::size_t at) {
    return as<std::uint32_t>(bytes.substr(at, 4).data());
  }
  static std::size_t bytes_of(int type) {
    return type == 5126 || type == 5125 ? 4 : type == 5123 ? 2 : throw std::runtime_error("component type");
  }
  // Its numbers are in the buffer, finite, and its bounds are true.
  void check_accessor(std::size_t index) const {
    const std::vector<double> values = numbers(index);
    const auto& a = json["accessors"][index];
    const std::size_t n = width(a);
    for (const double v : values) need(std::isfinite(v), "a number that is not finite");
    if (!a.contains("min")) return;
    for (std::size_t k = 0; k < n; ++k) {
      double low = values[k], high = values[k];
      for (std::size_t i = k; i < values.size(); i += n)
        low = std::min(low, values[i]), high = std::max(high, values[i]);
      need(a["min"][k] == low && a["max"][k] == high, "bounds of an accessor");
    }
  }
  nlohmann::json channel(std::size_t node_index, const std::string& property) const {
    if (json.contains("animations"))
      for (const auto& c : json["animations"][0]["channels"])
        if (c["target"]["node"] == node_index && c["target"]["path"] == property) return c;
    return nullptr;
  }
};

}  // namespace fc_test
