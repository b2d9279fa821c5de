// How a run's summary and effects are printed and written.
#pragma once

#include <string>
#include <vector>

#include "common/program.hpp"
#include "common/sweep.hpp"

namespace fc {

// The summary as aligned lines "name  value unit".
std::string summary_text(const Summary& summary);

// summary.json: what was run, how it ended (`failure` is empty if it did not fail), the entries, and one
// counter per stage. `files` lists the files beside it, all of them from this run.
void write_summary(const std::filesystem::path& file, const Chapter& chapter, const Scene& scene,
                   const Summary& summary, int exit_code, const std::string& failure);

// summary.json of a whole sweep: what was swept, in which folders its runs are, and how it ended.
void write_sweep_summary(const std::filesystem::path& file, const Chapter& chapter, const Scene& scene,
                         const Sweep& sweep, int exit_code);

// The effects as printed by --explain.
std::string effects_text(const std::vector<Effect>& effects);

}  // namespace fc
