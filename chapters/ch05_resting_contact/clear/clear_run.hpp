// A scene on the clear version, from its first frame to its last.
#pragma once

#include "ch04_multibody_stepping/run.hpp"
#include "ch05_resting_contact/clear/pieces.hpp"

namespace fc::resting {

// As run_scene() of rest_run.hpp. Throws InputError for what ClearResting does not handle.
int run_clear_scene(const Scene& scene, const RunContext& context, Summary& summary,
                    const clear::Pieces& pieces);

}  // namespace fc::resting
