// ch04_study: what each effect costs, how the cost grows with the bodies, and what accuracy costs.
#include <CLI/CLI.hpp>

#include "ch04_multibody_stepping/study/parts.hpp"
#include "common/study_program.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  world::StudyOptions study;
  StudyProgram program;
  program.purpose =
      "Measures chapter 4's step. Each part writes tables into --out. Columns that end in _ns are times of "
      "this machine, or follow from them; all others are the same in every run:";
  program.example = "build/bin/ch04_study --part growth --bodies 300 --out out/ch04/study";
  program.parts = {
      {"switches", "what each effect costs, on one scene (switches.csv)",
       [&] { world::study_switches(study); }},
      {"growth", "a gas of balls, blocks and hulls: cost against the number of bodies (growth.csv)",
       [&] { world::study_growth(study); }},
      {"accuracy", "error against cost (bounces.csv, trajectories.csv)",
       [&] { world::study_accuracy(study); }}};
  program.all = true;
  program.add_options = [&](CLI::App& app) {
    app.add_option("--bodies", study.bodies, "Bodies of the largest gas")
        ->capture_default_str()
        ->check(CLI::Range(100, 3000));
    app.add_option("--repeats", study.repeats, "Runs of each kind, for the median of their times")
        ->capture_default_str()
        ->check(CLI::Range(1, 100));
  };
  return run_study(argc, argv, program, study.out, study.quiet);
}
