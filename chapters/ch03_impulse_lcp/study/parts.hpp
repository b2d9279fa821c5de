// The measurements behind chapter 3's figures: each writes its tables (the executable ch03_study). Columns
// that end in _ns are times on this machine, or follow from them; all others are the same in every run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ch03_impulse_lcp/problem_factory.hpp"
#include "ch03_impulse_lcp/solver.hpp"

namespace fc::lcp {

struct StudyOptions {
  std::filesystem::path out;
  int rows = 1024;     // of the largest problem, >= 16
  int seeds = 5;       // problems of a family and size
  bool quiet = false;  // no progress
};

void study_accuracy(const StudyOptions& options);  // accuracy.csv, budget.csv
void study_growth(const StudyOptions& options);    // growth.csv, exponents.csv
void study_profiles(const StudyOptions& options);  // profiles.csv

// One solve, with its time: the median of repetitions, at most 5, fewer once they took 20 ms together.
struct Timed {
  LcpResult result;
  double ns = 0;
};
Timed timed_solve(const Lcp& problem, Method method, const SolveOptions& options);

// Several problems of a kind with one method and options; unsuited ones are left out. `error` needs the known
// answer: max |w - w*| / max |b|, velocities over velocities.
struct Tally {
  std::vector<double> work, residual, error, ns;
  int solved = 0;

  void add(const KnownProblem& problem, const Timed& timed);
};

// At least half of the values lie at or below it; 0 if there are none.
double median(std::vector<double> values);

// The cost of a solve in products A z of 2 n^2 operations: a pivot or a sweep costs one; a Newton step n / 3,
// the elimination of an n by n matrix.
double products(Method method, double work, Eigen::Index n);

bool iterative(Method method);

}  // namespace fc::lcp
