// How accurate sweeps are: in a stack of ten, where every force is known, and in a heap.
#include <limits>

#include "ch05_resting_contact/study/parts.hpp"
#include "common/program.hpp"
#include "common/table.hpp"

namespace fc::resting {
namespace {

// Gaps are at the rest gap from the start: only forces have to be found.
void study_forces(const StudyOptions& options) {
  TableWriter table(options.out / "forces.csv", {{"solver", ""},
                                                 {"knob", ""},  // sweeps of each plan
                                                 {"first_error", ""},
                                                 {"force_error", ""},
                                                 {"drift", "m"},
                                                 {"lost", "s"},
                                                 {"rows", ""},
                                                 {"sweeps", ""},
                                                 {"second_ns", ""}});
  const auto row = [&](const char* solver, double knob, const RestOptions& rest) {
    const StackResult r =
        measure_stack({.scene = stack_scene(0.5 * kEnvelope), .rest = rest}, options.repeats);
    table.row({std::string(solver), knob, r.first_error, r.force_error, r.drift, r.run.lost, r.run.rows,
               r.run.sweeps, r.run.second_ns(3)});
  };
  row("dantzig", 0, {});
  for (int sweeps = 1; sweeps <= 1024; sweeps *= 2) {
    RestOptions rest;
    rest.most_work = 0;  // a pile
    rest.sweeps = sweeps;
    rest.visits = rest.settling_visits = 0;
    row("gauss-seidel", sweeps, rest);
  }
  table.close();
}

// 36 boxes, as a pile whose rows are swept this many times, whatever residual is left. Sweeps 0: island by island, by
// Dantzig's method.
void study_heap(const StudyOptions& options) {
  TableWriter table(options.out / "heap.csv", {{"sweeps", ""},
                                               {"mean_residual", ""},
                                               {"worst_residual", ""},
                                               {"corrected", "J"},
                                               {"shortened", ""},
                                               {"lost_impulse", "N s"},
                                               {"rows", ""},
                                               {"queries", ""},
                                               {"all_sweeps", ""},
                                               {"second_ns", ""}});
  for (const int sweeps : {0, 2, 4, 8, 16, 32, 64, 128}) {
    Setting setting{.scene = heap_scene(3, 4), .seconds = 3};
    setting.rest.most_work = sweeps == 0 ? std::numeric_limits<double>::infinity() : 0;
    setting.rest.sweeps = sweeps;
    setting.rest.visits = setting.rest.settling_visits = 0;
    const Run r = run(setting, 1);
    table.row({std::int64_t{sweeps}, r.mean_residual, r.worst_residual, r.corrected, r.shortened,
               r.lost_impulse, r.rows, r.queries, r.sweeps, r.second_ns(setting.seconds)});
  }
  table.close();
}

}  // namespace

void study_solvers(const StudyOptions& options) {
  Progress progress("solvers", 2, options.quiet);
  study_forces(options);
  progress.update(1);
  study_heap(options);
  progress.update(2);
}

}  // namespace fc::resting
