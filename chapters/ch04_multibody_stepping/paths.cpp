#include "ch04_multibody_stepping/paths.hpp"

#include <algorithm>
#include <limits>

#include "ch04_multibody_stepping/world.hpp"

namespace fc::world {
namespace {

constexpr double kSoon =
    1e-12;  // of a frame: a row this near to one of its ends counts as at the end; times are sums of frames

}  // namespace

Path::Path(const std::vector<PathRow>& rows, const Shape& shape) : rows_(rows) {
  for (PathRow& row : rows_) row.position += row.orientation * shape.mass.center_of_mass;
}

RigidBody Path::at(double time, double soon) const {
  const auto later = std::upper_bound(rows_.begin(), rows_.end(), time + soon,
                                      [](double t, const PathRow& row) { return t < row.time; });
  const PathRow& from = later == rows_.begin() ? rows_.front() : *(later - 1);
  RigidBody body;
  body.position = from.position;
  body.orientation = from.orientation;
  if (later == rows_.begin() || later == rows_.end()) return body;
  const double between = later->time - from.time, since = std::max(0.0, time - from.time);
  Quat turn = later->orientation * from.orientation.conjugate();
  if (turn.w() < 0) turn.coeffs() *= -1;  // the shorter rotation
  const Eigen::AngleAxisd angle(turn);
  body.velocity = (later->position - from.position) / between;
  body.spin = angle.angle() / between * angle.axis();
  body.position += since * body.velocity;
  body.orientation =
      Quat(Eigen::AngleAxisd(angle.angle() * (since / between), angle.axis())) * from.orientation;
  return body;
}

double Path::next_after(double time) const {
  const auto later = std::upper_bound(rows_.begin(), rows_.end(), time,
                                      [](double t, const PathRow& row) { return t < row.time; });
  return later == rows_.end() ? std::numeric_limits<double>::infinity() : later->time;
}

void follow_paths(World& world, double dt) {
  for (int i = 0; i < static_cast<int>(world.bodies.size()); ++i) {
    const Body& body = world.bodies[static_cast<std::size_t>(i)];
    if (body.path && !body.frozen)
      world.set_motion(i, body.path->at(body.clock + body.time, kSoon * dt), body.time);
  }
}

double until_next_row(const World& world, double dt) {
  double until = dt;
  for (const Body& body : world.bodies) {
    if (!body.path) continue;
    const double row = body.path->next_after(body.clock + kSoon * dt) - body.clock;
    if (row < dt - kSoon * dt) until = std::min(until, row);
  }
  return until;
}

Listeners from(double start, const Listeners& listeners) {
  if (start == 0) return listeners;
  Listeners later;
  if (listeners.impact)
    later.impact = [start, &listeners](ImpactRecord impact) {
      impact.time += start;
      listeners.impact(impact);
    };
  if (listeners.instant)
    later.instant = [start, &listeners](const World& world, double time) {
      listeners.instant(world, start + time);
    };
  if (listeners.sighting)
    later.sighting = [start, &listeners](Sighting sighting) {
      sighting.time += start;
      listeners.sighting(sighting);
    };
  return later;
}

void add(const StepReport& part, StepReport& all) {
  all.contacts += part.contacts;
  all.impacts += part.impacts;
  all.lcp_rows += part.lcp_rows;
  all.solves += part.solves;
  all.lcp_residual = std::max(all.lcp_residual, part.lcp_residual);
  all.min_gap = std::min(all.min_gap, part.min_gap);
  all.max_penetration = std::max(all.max_penetration, part.max_penetration);
  all.lost_time += part.lost_time;
  all.momentum_error = std::max(all.momentum_error, part.momentum_error);
  all.energy_error = std::max(all.energy_error, part.energy_error);
  all.energy_gain = std::max(all.energy_gain, part.energy_gain);
  all.kinematic_work += part.kinematic_work;
  all.slept_energy += part.slept_energy;
  all.falls_asleep += part.falls_asleep;
  all.wakes += part.wakes;
  all.sightings += part.sightings;
  all.pairs += part.pairs;
  all.advances += part.advances;
  all.queries += part.queries;
  all.node_pairs += part.node_pairs;
  all.lcp_ns += part.lcp_ns;
  all.broad_ns += part.broad_ns;
}

}  // namespace fc::world
