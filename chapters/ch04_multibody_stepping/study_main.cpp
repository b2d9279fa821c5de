// ch04_study: what each effect costs, how the cost grows with the bodies, and what accuracy costs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "ch04_multibody_stepping/study_parts.hpp"
#include "common/errors.hpp"
#include "common/text.hpp"

namespace {

using namespace fc;

enum ExitCode { done = 0, bad_input = 2, failed = 3 };

const std::vector<std::string> kParts = {"switches", "growth", "accuracy", "all"};

struct Arguments {
  std::string part;
  world::StudyOptions study;
  std::string help;  // not empty: asked for
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  world::StudyOptions& study = arguments.study;
  CLI::App app(
      "Measures chapter 4's step. Each part writes tables into --out; columns that end in _ns are times of "
      "this "
      "machine, or follow from them, all others are the same in every run:\n\n"
      "  switches  what each effect costs, on one scene (switches.csv)\n"
      "  growth    a gas of balls, blocks and hulls: cost against the number of bodies (growth.csv)\n"
      "  accuracy  error against cost (bounces.csv, trajectories.csv)\n"
      "  all       all of them");
  app.footer("Example:\n  build/bin/ch04_study --part growth --bodies 300 --out out/ch04/study");
  app.add_option("--part", arguments.part, "What to measure")->required()->check(CLI::IsMember(kParts));
  app.add_option("--out", study.out, "The folder for the tables")->required()->type_name("DIR");
  app.add_option("--bodies", study.bodies, "Bodies of the largest gas")
      ->capture_default_str()
      ->check(CLI::Range(100, 3000));
  app.add_option("--repeats", study.repeats, "Runs of each kind, for the median of their times")
      ->capture_default_str()
      ->check(CLI::Range(1, 100));
  app.add_flag("--quiet", study.quiet, "No progress");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    arguments.help = app.help();
  } catch (const CLI::ParseError& error) {
    throw InputError(one_line(error.what()) + "; see --help");
  }
  return arguments;
}

void run(const Arguments& arguments) {
  const world::StudyOptions& study = arguments.study;
  std::error_code error;
  std::filesystem::create_directories(study.out, error);
  if (error) throw InputError(study.out.string() + ": cannot be made: " + error.message());
  const bool all = arguments.part == "all";
  if (all || arguments.part == "switches") world::study_switches(study);
  if (all || arguments.part == "growth") world::study_growth(study);
  if (all || arguments.part == "accuracy") world::study_accuracy(study);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Arguments arguments = parse(argc, argv);
    if (!arguments.help.empty())
      fmt::print("{}\n", arguments.help);
    else
      run(arguments);
    return done;
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", one_line(error.what()));
    return bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", one_line(error.what()));
    return failed;
  }
}
