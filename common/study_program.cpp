#include "common/study_program.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "common/errors.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

enum ExitCode { done = 0, bad_input = 2, failed = 3 };

std::string help_text(const StudyProgram& program) {
  std::size_t width = 3;
  for (const StudyPart& part : program.parts) width = std::max(width, part.name.size());
  std::string text = program.purpose + "\n";
  for (const StudyPart& part : program.parts) text += "\n  " + padded(part.name, width + 2) + part.what;
  if (program.all) text += "\n  " + padded("all", width + 2) + "all of them";
  return text;
}

void measure(int argc, char** argv, const StudyProgram& program, std::filesystem::path& out, bool& quiet) {
  std::string name;
  std::vector<std::string> names;
  for (const StudyPart& part : program.parts) names.push_back(part.name);
  if (program.all) names.push_back("all");
  CLI::App app(help_text(program));
  app.footer("Example:\n  " + program.example);
  app.add_option("--part", name, "What to measure")->required()->check(CLI::IsMember(names));
  app.add_option("--out", out, "The folder for the tables")->required()->type_name("DIR");
  if (program.add_options) program.add_options(app);
  app.add_flag("--quiet", quiet, "No progress");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}\n", app.help());
    return;
  } catch (const CLI::ParseError& error) {
    throw InputError(one_line(error.what()) + "; see --help");
  }
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) throw InputError(out.string() + ": cannot be made: " + error.message());
  if (program.prepare) program.prepare();
  for (const StudyPart& part : program.parts)
    if (name == part.name || name == "all") part.run();
}

}  // namespace

int run_study(int argc, char** argv, const StudyProgram& program, std::filesystem::path& out, bool& quiet) {
  try {
    measure(argc, argv, program, out, quiet);
    return done;
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", one_line(error.what()));
    return bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", one_line(error.what()));
    return failed;
  }
}

}  // namespace fc
