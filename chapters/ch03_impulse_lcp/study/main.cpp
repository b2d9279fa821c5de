// ch03_study: what accuracy costs with each solver, how the cost grows, and which solver is best how often.
#include <CLI/CLI.hpp>

#include "ch03_impulse_lcp/study/parts.hpp"
#include "common/study_program.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  lcp::StudyOptions study;
  StudyProgram program;
  program.purpose =
      "Measures chapter 3's solvers on problems whose answers are known. Each part writes tables into "
      "--out; columns that end in _ns are times on this machine, or follow from them; all others are the "
      "same in every run:";
  program.example = "build/bin/ch03_study --part growth --rows 128 --out out/ch03/study";
  program.parts = {
      {"accuracy", "residual against cost (accuracy.csv), and within 0.1, 1 and 10 ms (budget.csv)",
       [&] { lcp::study_accuracy(study); }},
      {"growth", "pivots, sweeps, steps and time against the rows (growth.csv, exponents.csv)",
       [&] { lcp::study_growth(study); }},
      {"profiles", "every solver on hundreds of problems (profiles.csv)",
       [&] { lcp::study_profiles(study); }}};
  program.all = true;
  program.add_options = [&](CLI::App& app) {
    app.add_option("--rows", study.rows, "Rows of the largest problems")
        ->capture_default_str()
        ->check(CLI::Range(16, 4096));
    app.add_option("--seeds", study.seeds, "Problems of each family and size")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
  };
  return run_study(argc, argv, program, study.out, study.quiet);
}
