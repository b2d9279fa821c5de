// The options that every chapter's executable takes (contract 1.3).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fc {

struct Options {
  std::filesystem::path scene;
  std::optional<std::filesystem::path> out;      // --out
  std::vector<std::string> sets;                 // --set, in order
  std::string sweep;                             // --sweep; empty = none
  std::vector<std::filesystem::path> mesh_path;  // --mesh-path, in order
  bool explain = false, certificate = false, poses = false, quiet = false;
  std::string help;  // the text for --help; empty = not asked for
};

// Parses the command line. `purpose` and `example` appear in the help. Throws InputError for bad options.
Options parse_options(int argc, char** argv, const std::string& purpose, const std::string& example);

}  // namespace fc
