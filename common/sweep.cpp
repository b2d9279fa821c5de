#include "common/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/errors.hpp"
#include "common/scene_keys.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

// The text split at the commas outside brackets, braces and quotes.
std::vector<std::string> split_at_top_level(const std::string& text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth == 0) {
      parts.emplace_back();
      continue;
    }
    parts.back() += c;
  }
  return parts;
}

// The unit of a concrete key ("shapes.ball.mass", "bodies.0.velocity"), or "".
std::string unit_of(const std::string& concrete) {
  const auto is_number = [](const std::string& s) {
    return s.find_first_not_of("0123456789") == std::string::npos;
  };
  std::string pattern;
  for (std::size_t begin = 0; begin < concrete.size();) {
    const std::size_t end = std::min(concrete.find('.', begin), concrete.size());
    const std::string segment = concrete.substr(begin, end - begin);
    if (pattern == "shapes") {
      pattern += ".<name>";
    } else if (is_number(segment) && !find_scene_key(pattern + "." + segment)) {
      pattern += "[]";
    } else {
      pattern += (pattern.empty() ? "" : ".") + segment;
    }
    begin = end + 1;
  }
  const SceneKey* key = find_scene_key(pattern);
  return key ? key->unit : "";
}

// A summary's value by name, as a cell that a table accepts.
Cell entry_cell(const Summary& summary, const std::string& name) {
  for (const Summary::Entry& entry : summary.entries()) {
    if (entry.name != name) continue;
    const std::string text = cell_text(entry.value);
    return text == "nan" || text == "-nan" || text.empty() ? Cell("none") : entry.value;
  }
  return "none";
}

Cell counter_cell(const Summary& summary, const std::string& stage, std::int64_t Summary::Counter::*member) {
  for (const Summary::Counter& counter : summary.counters()) {
    if (counter.stage == stage) return counter.*member;
  }
  return "none";
}

// Column names must be unique: where a summary has a value by the name of the swept key (the envelope that
// the run used), its column is renamed.
void name_apart(std::vector<Column>& columns) {
  std::set<std::string> taken;
  for (Column& column : columns)
    while (!taken.insert(column.name).second) column.name += " in the run";
}

}  // namespace

Sweep parse_sweep(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string mark = "--sweep " + one_line(text);
  if (equals == std::string::npos || equals == 0) {
    throw InputError({mark}, "not a key and values; write e.g. ccd.tolerance=1e-3,1e-6");
  }
  Sweep sweep{text.substr(0, equals), split_at_top_level(text.substr(equals + 1))};
  for (const std::string& value : sweep.values) {
    if (value.find_first_not_of(' ') == std::string::npos) {
      throw InputError({mark}, "an empty value; write values between the commas");
    }
  }
  return sweep;
}

std::vector<std::string> sweep_folders(const Sweep& sweep) {
  std::vector<std::string> folders;
  std::set<std::string> used;
  for (const std::string& value : sweep.values) {
    const std::string plain = file_name_from(sweep.key + "=" + value);
    std::string folder = plain;
    for (int copy = 2; !used.insert(folder).second; ++copy) folder = fmt::format("{}_{}", plain, copy);
    folders.push_back(folder);
  }
  return folders;
}

void write_sweep(const std::filesystem::path& file, const Sweep& sweep, const std::vector<SweepRun>& runs) {
  std::vector<Column> columns = {{sweep.key, unit_of(sweep.key)}};
  std::vector<std::string> entries, stages;  // in order of first appearance
  const auto add_once = [](std::vector<std::string>& names, const std::string& name) {
    const bool is_new = std::find(names.begin(), names.end(), name) == names.end();
    if (is_new) names.push_back(name);
    return is_new;
  };
  for (const SweepRun& run : runs) {
    for (const Summary::Entry& entry : run.summary.entries()) {
      if (entry.kind == Summary::Kind::note || !add_once(entries, entry.name)) continue;
      const bool time = entry.kind == Summary::Kind::time;
      columns.push_back(time ? Column{entry.name + "_ns", ""} : Column{entry.name, entry.unit});
    }
  }
  for (const SweepRun& run : runs) {
    for (const Summary::Counter& counter : run.summary.counters()) {
      if (!add_once(stages, counter.stage)) continue;
      columns.push_back({counter.stage + "_runs", ""});
      columns.push_back({counter.stage + "_ns", ""});
    }
  }
  columns.push_back({"exit_code", ""});

  name_apart(columns);
  TableWriter table(file, columns);
  for (const SweepRun& run : runs) {
    std::vector<Cell> row = {run.value};
    for (const std::string& name : entries) row.push_back(entry_cell(run.summary, name));
    for (const std::string& stage : stages) {
      row.push_back(counter_cell(run.summary, stage, &Summary::Counter::runs));
      row.push_back(counter_cell(run.summary, stage, &Summary::Counter::ns));
    }
    row.emplace_back(std::int64_t{run.exit_code});
    table.row(row);
  }
  table.close();
}

}  // namespace fc
