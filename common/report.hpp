// How a run's summary and effects are printed and written.
#pragma once

#include <string>
#include <vector>

#include "common/program.hpp"

namespace fc {

// The summary as aligned lines "name  value unit".
std::string summary_text(const Summary& summary);

// summary.json: what was run, how it ended (`failure` is empty if it did not fail), the entries, and one
// counter per stage.
void write_summary(const std::filesystem::path& file, const Chapter& chapter, const Scene& scene,
                   const Summary& summary, int exit_code, const std::string& failure);

// The effects as printed by --explain.
std::string effects_text(const std::vector<Effect>& effects);

}  // namespace fc
