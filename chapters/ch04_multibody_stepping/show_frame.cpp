#include "ch04_multibody_stepping/show_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "ch02_hull_hierarchy/show_search.hpp"
#include "ch04_multibody_stepping/sensors.hpp"

namespace fc::world {
namespace {

constexpr std::size_t kMostPairs = 3, kMostInstants = 3;
constexpr double kArrow = 0.9;  // of the largest reach

ca::ShownPair shown(const World& world, const SeenSearch& search) {
  return {search.a,
          search.b,
          world.model_of(search.a).leaf(0),
          world.model_of(search.b).leaf(0),
          search.motion_a,
          search.motion_b,
          search.from,
          search.to,
          world.keep()};
}

void add_hierarchies(const World& world, const SeenSearch& search, double t0, algorithm::Document& document) {
  hulls::ShownModels shown{search.a,
                           search.b,
                           world.model_of(search.a),
                           world.model_of(search.b),
                           search.motion_a,
                           search.motion_b,
                           search.from,
                           {}};
  shown.options.interval = search.to - search.from;
  shown.options.tolerance = world.tolerance;
  shown.options.target = 0.5 * world.keep();  // the gap rule's, of a pair that is far apart
  shown.options.slack = 0.25 * world.tolerance;
  shown.options.start = world.keep();
  shown.options.max_pairs = world.max_pairs;
  document.parts.push_back(
      {2, fmt::format("bodies {} and {}: the search in two hierarchies", search.a, search.b),
       hulls::show_search(shown, hulls::certified_search(shown), t0)});
}

algorithm::Part show_instants(const World& world, const FrameWatch& watch) {
  algorithm::Part part{3, "the impulses of an instant", {}};
  std::size_t instants = 0, left = 0;
  for (const SeenEvent& event : watch.events) {
    if (event.instant.contacts.empty()) continue;
    if (++instants > kMostInstants) {
      ++left;
      continue;
    }
    const SeenInstant& seen = event.instant;
    const lcp::ShownContacts contacts{seen.states, seen.numbers, seen.contacts,
                                      arrow_length(world, seen.numbers)};
    for (algorithm::Step step : lcp::show_impact(contacts, world.impact, world.solver.method)) {
      if (step.poses.empty()) step.poses = poses_of(event.states, world);
      part.steps.push_back(step);
    }
  }
  if (left > 0 && !part.steps.empty())
    part.steps.back().text += fmt::format(" {} further instants of this frame are not shown.", left);
  return part;
}

}  // namespace

double arrow_length(const World& world, const std::vector<int>& bodies) {
  double reach = 0;
  for (const int body : bodies)
    if (world.is_dynamic(body))
      reach = std::max(
          reach,
          world.shapes[static_cast<std::size_t>(world.bodies[static_cast<std::size_t>(body)].shape)].reach);
  return kArrow * (reach > 0 ? reach : 1);
}

// Bodies on paths get their velocities only when the step begins, so pairs with them are left out.
ShownSearches::ShownSearches(const World& world, double dt) {
  std::vector<Bounds> boxes;
  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body)
    boxes.push_back(world.swept_bounds(body, 0, dt));
  BoundsTree tree;
  tree.build(boxes);
  double nearest = std::numeric_limits<double>::infinity();
  tree.overlapping_pairs([&](int one, int other) {
    const auto [a, b] = std::minmax(one, other);
    const Body &body_a = world.bodies[static_cast<std::size_t>(a)],
               &body_b = world.bodies[static_cast<std::size_t>(b)];
    if (!world.may_meet(a, b) || is_sensor_pair(world, a, b) || body_a.path || body_b.path) return;
    const ca::PairPose pose(world.motion(a, 0), world.motion(b, 0), 0);
    const double gap =
        hulls::model_distance(world.model_of(a), world.model_of(b), pose, world.tolerance, nearest).lower;
    if (gap >= nearest || gap <= world.keep()) return;
    nearest = gap;
    nearest_ = {a, b, 0, dt, world.motion(a, 0), world.motion(b, 0)};
  });
}

std::vector<SeenSearch> ShownSearches::searches(const World& world, const FrameWatch& watch) const {
  std::vector<SeenSearch> list;
  for (const SeenEvent& event : watch.events) {
    if (event.kind != SeenEvent::Kind::contact || event.stalled || list.size() == kMostPairs) continue;
    const SeenSearch& search = event.search;
    const auto is_same = [&](const SeenSearch& s) { return s.a == search.a && s.b == search.b; };
    if (std::any_of(list.begin(), list.end(), is_same)) continue;
    // A pair that has just collided is within the tolerance: the search that follows spends half of what is left.
    const ca::PairPose pose(search.motion_a, search.motion_b, 0);
    const double gap =
        hulls::model_distance(world.model_of(search.a), world.model_of(search.b), pose, world.tolerance)
            .lower;
    if (gap > world.keep()) list.push_back(search);
  }
  if (list.empty() && nearest_.a != nearest_.b) list.push_back(nearest_);
  return list;
}

void ShownSearches::add_parts(const World& world, const FrameWatch& watch, double t0,
                              algorithm::Document& document) const {
  for (const SeenSearch& search : searches(world, watch)) {
    if (!world.convex(search.a) || !world.convex(search.b)) {
      add_hierarchies(world, search, t0, document);
      continue;
    }
    const ca::ShownPair pair = shown(world, search);
    algorithm::Part part{1, fmt::format("bodies {} and {}: the first time of contact", search.a, search.b),
                         ca::show_advance(pair, ca::certified_advance(pair), t0)};
    const auto is_ball = [&](int body) {
      return world.ball_radius[static_cast<std::size_t>(world.bodies[static_cast<std::size_t>(body)].shape)] >
             0;
    };
    if (is_ball(search.a) && is_ball(search.b))
      part.steps.back().text += " The step itself finds the same for two balls by a quadratic equation.";
    document.parts.push_back(part);
  }
}

algorithm::Document show_frame(const Scene& scene, World& world, std::int64_t before, double t0) {
  const double dt = scene.step->dt;
  algorithm::Document document{static_cast<int>(before) + 1, t0, t0 + dt, {}};
  const ShownSearches searches(world, dt);
  FrameWatch watch;
  watched_step(world, dt, watch);
  searches.add_parts(world, watch, t0, document);
  algorithm::Part instants = show_instants(world, watch);
  if (!instants.steps.empty()) document.parts.push_back(std::move(instants));
  document.parts.push_back(show_events(world, watch, dt, t0));
  return document;
}

}  // namespace fc::world
