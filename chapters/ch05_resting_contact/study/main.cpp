// ch05_study: what accuracy costs, by the solver's residual, the envelope's width, the frame's length, and
// the method.
#include <CLI/CLI.hpp>

#include "ch05_resting_contact/study/parts.hpp"
#include "common/study_program.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  resting::StudyOptions study;
  StudyProgram program;
  program.purpose =
      "Measures chapter 5's step. Each part writes tables into --out. Columns that end in _ns are times of "
      "this machine; all others are the same in every run:";
  program.example = "build/bin/ch05_study --part knobs --out out/ch05/study";
  program.parts = {
      {"solvers", "residual and sweeps against forces (forces.csv, heap.csv)",
       [&] { resting::study_solvers(study); }},
      {"knobs", "the envelope's width and the frame's length (envelope.csv, step.csv)",
       [&] { resting::study_knobs(study); }},
      {"methods", "events, envelope, time stepping (methods.csv, weights.csv, histories.csv, ball.csv)",
       [&] { resting::study_methods(study); }}};
  program.all = true;
  program.add_options = [&](CLI::App& app) {
    app.add_option("--repeats", study.repeats, "Runs of each kind: their shortest time counts")
        ->capture_default_str()
        ->check(CLI::Range(1, 100));
  };
  return run_study(argc, argv, program, study.out, study.quiet);
}
