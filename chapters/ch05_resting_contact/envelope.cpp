#include "ch05_resting_contact/envelope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace fc::resting {
namespace {

constexpr double kShareOfReach = 1e-3;
constexpr double kLeastTolerances = 100;
constexpr double kMostRounding = 1e-6;  // of the envelope: the rounding of how far bodies fall in a frame

[[noreturn]] void refuse(const Scene& scene, const std::string& what) {
  throw InputError(scene.mark("envelope").value_or(SourceMark{scene.file.string()}), what);
}

// Half of the smallest extent (m) of a body that can be moved, along any of its axes.
double thinnest(const world::World& world) {
  double half = std::numeric_limits<double>::infinity();
  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body)
    if (world.is_dynamic(body))
      half =
          std::min(half, world.half_extents[static_cast<std::size_t>(world.bodies[body].shape)].minCoeff());
  return half;
}

}  // namespace

double envelope_of(const Scene& scene, const world::World& world, double dt) {
  double envelope = *scene.envelope;
  if (envelope == 0) {
    double smallest = std::numeric_limits<double>::infinity();
    for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body)
      if (world.is_dynamic(body)) smallest = std::min(smallest, world.shapes[world.bodies[body].shape].reach);
    envelope = smallest < std::numeric_limits<double>::infinity() ? kShareOfReach * smallest : 1;
  }
  if (envelope < kLeastTolerances * world.tolerance)
    refuse(
        scene,
        fmt::format("an envelope of {:.3g} m is less than {:.0f} tolerances of {:.3g} m; widen it, or lower "
                    "ccd.tolerance",
                    envelope, kLeastTolerances, world.tolerance));
  if (const double half = thinnest(world); envelope > half)
    refuse(
        scene,
        fmt::format("an envelope of {:.3g} m is more than half of the thickness of the thinnest moving body "
                    "({:.3g} m); narrow it",
                    envelope, 2 * half));
  const double fall = world.effects.gravity ? world.effects.gravity->norm() * dt * dt : 0;
  if (std::numeric_limits<double>::epsilon() * fall > kMostRounding * envelope)
    refuse(scene,
           fmt::format(
               "bodies fall {:.3g} m in a frame of {:.3g} s, and the rounding of that is not small beside an "
               "envelope of {:.3g} m; shorten step.dt, or widen the envelope",
               0.5 * fall, dt, envelope));
  return envelope;
}

}  // namespace fc::resting
