// ch03_study: what accuracy costs with each solver, how the cost grows, and which solver is best how often.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "ch03_impulse_lcp/study_parts.hpp"
#include "common/errors.hpp"
#include "common/text.hpp"

namespace {

using namespace fc;

enum ExitCode { done = 0, bad_input = 2, failed = 3 };

const std::vector<std::string> kParts = {"accuracy", "growth", "profiles", "all"};

struct Arguments {
  std::string part;
  lcp::StudyOptions study;
  std::string help;  // not empty: asked for
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  lcp::StudyOptions& study = arguments.study;
  CLI::App app(
      "Measures chapter 3's solvers on problems whose answers are known. Each part writes tables into --out; "
      "columns that end in _ns are times of this machine, or follow from them, all others are the same in "
      "every "
      "run:\n\n"
      "  accuracy  residual against cost (accuracy.csv), and within 0.1, 1 and 10 ms (budget.csv)\n"
      "  growth    pivots, sweeps, steps and time against the rows (growth.csv, exponents.csv)\n"
      "  profiles  every solver on hundreds of problems (profiles.csv)\n"
      "  all       all of them");
  app.footer("Example:\n  build/bin/ch03_study --part growth --rows 128 --out out/ch03/study");
  app.add_option("--part", arguments.part, "What to measure")->required()->check(CLI::IsMember(kParts));
  app.add_option("--out", study.out, "The folder for the tables")->required()->type_name("DIR");
  app.add_option("--rows", study.rows, "Rows of the largest problems")
      ->capture_default_str()
      ->check(CLI::Range(16, 4096));
  app.add_option("--seeds", study.seeds, "Problems of each family and size")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
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
  const lcp::StudyOptions& study = arguments.study;
  std::error_code error;
  std::filesystem::create_directories(study.out, error);
  if (error) throw InputError(study.out.string() + ": cannot be made: " + error.message());
  const bool all = arguments.part == "all";
  if (all || arguments.part == "accuracy") lcp::study_accuracy(study);
  if (all || arguments.part == "growth") lcp::study_growth(study);
  if (all || arguments.part == "profiles") lcp::study_profiles(study);
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
