#include "common/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/errors.hpp"
#include "common/results_folder.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

using Json = nlohmann::ordered_json;

// A cell as JSON. JSON has no NaN and no infinity (nlohmann-json would write null): those become text.
Json json_value(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) {
    if (std::isfinite(*number)) return *number;
    return cell_text(cell);
  }
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return *integer;
  return std::get<std::string>(cell);
}

// Nanoseconds as people read them: "2.83 ms".
std::string time_text(const Cell& cell) {
  const auto ns = static_cast<double>(std::get<std::int64_t>(cell));
  if (ns < 1e3) return fmt::format("{:.0f} ns", ns);
  if (ns < 1e6) return fmt::format("{:.3g} us", ns * 1e-3);
  return ns < 1e9 ? fmt::format("{:.3g} ms", ns * 1e-6) : fmt::format("{:.3g} s", ns * 1e-9);
}

Json header(const Chapter& chapter, const Scene& scene, int exit_code) {
  Json json = {{"program", chapter.name},
               {"scene", scene.name},
               {"scene_file", scene.file.string()},
               {"exit_code", exit_code}};
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)  // tables have numbers only
    if (!scene.bodies[i].name.empty()) json["names of bodies"][std::to_string(i)] = scene.bodies[i].name;
  return json;
}

// Adds the list of all files beside it, itself included.
void write(const std::filesystem::path& file, Json json) {
  std::ofstream stream(file, std::ios::binary);
  if (!stream) {
    throw InputError({file.string()}, std::string("cannot be written: ") + std::strerror(errno) +
                                          "; choose another folder by --out");
  }
  json["files"] = files_below(file.parent_path());
  // Text that is not UTF-8 (a file's name may be anything) is replaced; it does not throw.
  stream << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  stream.close();
  if (!stream) throw std::runtime_error(file.filename().string() + ": cannot be written to the end");
}

}  // namespace

std::string summary_text(const Summary& summary) {
  std::size_t name_width = 0;
  for (const Summary::Entry& entry : summary.entries()) name_width = std::max(name_width, entry.name.size());
  std::string text;
  for (const Summary::Entry& entry : summary.entries()) {
    const std::string unit = entry.unit.empty() || entry.unit == "1" ? "" : " " + entry.unit;
    const std::string value =
        entry.kind == Summary::Kind::time ? time_text(entry.value) : cell_text(entry.value) + unit;
    text += fmt::format("  {}  {}\n", padded(entry.name, name_width), value);
  }
  return text;
}

void write_summary(const std::filesystem::path& file, const Chapter& chapter, const Scene& scene,
                   const Summary& summary, int exit_code, const std::string& failure) {
  Json json = header(chapter, scene, exit_code);
  if (!failure.empty()) json["failure"] = failure;
  json["entries"] = Json::object();
  for (const Summary::Entry& entry : summary.entries()) {
    json["entries"][entry.name] = {{"value", json_value(entry.value)}, {"unit", entry.unit}};
  }
  json["counters"] = Json::object();
  for (const Summary::Counter& counter : summary.counters()) {
    json["counters"][counter.stage] = {{"runs", counter.runs}, {"ns", counter.ns}};
  }
  write(file, std::move(json));
}

void write_sweep_summary(const std::filesystem::path& file, const Chapter& chapter, const Scene& scene,
                         const Sweep& sweep, int exit_code) {
  Json json = header(chapter, scene, exit_code);
  json["sweep"] = sweep.key;
  json["runs"] = Json::array();
  const std::vector<std::string> folders = sweep_folders(sweep);
  for (std::size_t i = 0; i < folders.size(); ++i)
    json["runs"].push_back({{"value", sweep.values[i]}, {"folder", folders[i]}});
  write(file, std::move(json));
}

std::string effects_text(const std::vector<Effect>& effects) {
  if (effects.empty()) return "  no effect is on\n";
  std::size_t name_width = 6, reason_width = 3, stages_width = 11;
  for (const Effect& effect : effects) {
    name_width = std::max(name_width, effect.name.size());
    reason_width = std::max(reason_width, effect.reason.size());
    stages_width = std::max(stages_width, effect.stages.size());
  }
  const auto line = [&](const std::string& name, const std::string& reason, const std::string& stages,
                        const std::string& unknowns) {
    return "  " + padded(name, name_width) + "  " + padded(reason, reason_width) + "  " +
           padded(stages, stages_width) + "  " + unknowns + "\n";
  };
  std::string text = line("effect", "why", "what it adds", "unknowns per contact");
  for (const Effect& effect : effects) {
    text += line(effect.name, effect.reason, effect.stages, std::to_string(effect.unknowns_per_contact));
  }
  return text;
}

}  // namespace fc
