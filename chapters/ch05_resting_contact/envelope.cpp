#include "ch05_resting_contact/envelope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace fc::resting {
namespace {

constexpr double kShareOfReach = 1e-3;
constexpr double kLeastTolerances = 100;

}  // namespace

double envelope_of(const Scene& scene, const world::World& world) {
  double envelope = *scene.envelope;
  if (envelope == 0) {
    double smallest = std::numeric_limits<double>::infinity();
    for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body)
      if (world.yields(body)) smallest = std::min(smallest, world.shapes[world.bodies[body].shape].reach);
    envelope = smallest < std::numeric_limits<double>::infinity() ? kShareOfReach * smallest : 1;
  }
  if (envelope < kLeastTolerances * world.tolerance)
    throw InputError(
        scene.mark("envelope").value_or(SourceMark{scene.file.string()}),
        fmt::format("an envelope of {:.3g} m is less than {:.0f} tolerances of {:.3g} m; widen it, or "
                    "lower ccd.tolerance",
                    envelope, kLeastTolerances, world.tolerance));
  return envelope;
}

}  // namespace fc::resting
