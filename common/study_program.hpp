// What the chapters' studies share: executables that measure, and write tables (ch02_study and later).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fc {

struct StudyPart {
  std::string name, what;  // for --part, and a line of help
  std::function<void()> run;
};

struct StudyProgram {
  std::string purpose, example;  // for --help
  std::vector<StudyPart> parts;
  bool all = false;  // has a part "all", which runs every one
  std::function<void(CLI::App&)> add_options = {};
  std::function<void()> prepare = {};  // after the options, before the part
};

// Reads the options (--part, --out, --quiet and the program's own), makes the folder, and runs the part. Exit
// codes: 0 done, 2 bad input, 3 failed, the latter two with one line on standard error.
int run_study(int argc, char** argv, const StudyProgram& program, std::filesystem::path& out, bool& quiet);

}  // namespace fc
