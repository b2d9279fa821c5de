// The options that every chapter's executable takes (contract 1.3).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fc {

// In a list of frames: the first one with an impact or a contact.
constexpr int kFirstContact = 0;

struct Options {
  std::filesystem::path scene;
  std::optional<std::filesystem::path> out;      // --out
  std::vector<std::string> sets;                 // --set, in order
  std::string sweep;                             // --sweep; empty = none
  std::vector<std::filesystem::path> mesh_path;  // --mesh-path, in order
  bool explain = false, certificate = false, poses = false, quiet = false, clear = false, mine = false;
  std::vector<int> algorithm = {kFirstContact};  // --algorithm: frames whose steps the recording shows
  std::optional<int> live;                       // --live: the port; 0 = any free one
  std::string help;                              // the text for --help; empty = not asked for
};

// An option that has an effect in some chapters only: in all others it is refused.
struct ChapterOption {
  std::string name;  // "--poses"
  int first, last;   // the chapters
  std::string what;  // what it does there: "writes poses.csv: every body at every frame"
};
const std::vector<ChapterOption>& chapter_options();

// Parses the command line of a chapter. `purpose` and `example` appear in the help. Throws InputError for bad
// options, and for those that have no effect in the chapter.
Options parse_options(int argc, char** argv, int chapter, const std::string& purpose,
                      const std::string& example);

}  // namespace fc
