// Sweeps: one run per value of one scene key, one row per run in sweep.csv.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/program.hpp"

namespace fc {

// A --sweep option taken apart.
struct Sweep {
  std::string key;                  // "ccd.tolerance"
  std::vector<std::string> values;  // as written; commas inside brackets or quotes do not separate
};

// Splits "key.path=v1,v2,..." into its values. Throws InputError if there is no key or an empty value.
Sweep parse_sweep(const std::string& text);

// A folder for each value, all different: "ccd.tolerance=1e-4".
std::vector<std::string> sweep_folders(const Sweep& sweep);

// One run of a sweep.
struct SweepRun {
  std::string value;
  Summary summary;
  int exit_code = 0;
};

// One row per run: the value, every entry of the summaries, runs and time of every counter, the exit code.
// A value that a run's summary lacks is "none".
void write_sweep(const std::filesystem::path& file, const Sweep& sweep, const std::vector<SweepRun>& runs);

}  // namespace fc
