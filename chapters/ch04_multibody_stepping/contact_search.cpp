#include "ch04_multibody_stepping/contact_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ch02_hull_hierarchy/features.hpp"
#include "ch04_multibody_stepping/passing_plane.hpp"
#include "ch04_multibody_stepping/sensors.hpp"
#include "common/scene_failure.hpp"

namespace fc::world {
namespace {

constexpr double kRoundingTerms = 64;  // a certified gap below this many rounding terms cannot be spent

// A gap of this share of the tolerance has been halved seven times, by one impact after another. Following a pair that
// slides or turns in so small a gap takes steps that shrink with it: a million of them below 1e-12 m. An impact that
// still closes in belongs to a pile-up of impacts. Consequence: with the default tolerance, bodies that come to rest
// are frozen at gaps below 1e-8 m.
constexpr double kStallShare = 0.01;

// A pair with no gap left to spend either parts, which some tens of steps prove, or slides or turns in contact, which
// no number of steps would prove. This many pairs of nodes decide (for convex bodies, and for meshes); more only cost
// time. Consequence: a pair that needs more is frozen for the rest of the frame.
constexpr std::int64_t kStallPairs = 256, kStallPairsOfMeshes = 10'000;

constexpr double kSharpShare = 0.25;  // of the tolerance: a gap below it is measured more precisely

// The gap of a pair beyond the tolerance is only reported: this relative accuracy suffices.
constexpr double kRoughShare = 0.25;

// For two balls in closed form: the error of their gap in epsilons of the coordinates, and the largest share of the
// spent gap that this error may be.
constexpr double kBallRounding = 16;
constexpr double kSpendShare = 0.01;
constexpr double kFarAway = std::numeric_limits<double>::infinity();  // m
constexpr double kNever = std::numeric_limits<double>::infinity();    // s

// The bounding balls of the bodies stay apart until the frame's end: no closer look is needed.
bool out_of_reach(const World& world, const Pair& pair, const ca::Motion& a, const ca::Motion& b, double left,
                  double within) {
  if (!world.effects.swept) return false;
  const double reach =
      world.shapes[world.bodies[pair.a].shape].reach + world.shapes[world.bodies[pair.b].shape].reach;
  const double travel =
      left * (ca::relative_velocity(a, b, 0).norm() + 0.5 * left * ca::relative_acceleration(a, b, 0).norm());
  return (b.position - a.position).norm() > reach + travel + within;
}

// Two balls whose relative motion is a straight line: both are free, both fall, or one is at rest without gravity.
struct Balls {
  Vec3 apart, velocity;  // of B's centre, relative to A's
  double drag;           // 1/s, of the balls that move
  Vec3 centre_a;
  double radius_a, radii;
  bool straight;

  Balls(const World& world, const Pair& pair, double now) {
    const ca::Motion a = world.centre_motion(pair.a, now), b = world.centre_motion(pair.b, now);
    apart = b.position - a.position;
    velocity = b.velocity - a.velocity;
    centre_a = a.position;
    radius_a = world.ball_radius[world.bodies[pair.a].shape];
    radii = radius_a + world.ball_radius[world.bodies[pair.b].shape];
    // Drag does not bend the line if it is the same for both balls, or if one of them does not move: it only slows the
    // motion along it.
    const bool same_drag =
        a.drag == b.drag || (a.drag == 0 && a.velocity.isZero(0)) || (b.drag == 0 && b.velocity.isZero(0));
    straight = a.acceleration == b.acceleration && same_drag;
    drag = std::max(a.drag, b.drag);
    // The error that the gap may have: round-off of coordinates, and of squares of distances.
    rounding = kBallRounding * std::numeric_limits<double>::epsilon() *
               (a.position.cwiseAbs().maxCoeff() + b.position.cwiseAbs().maxCoeff() + apart.norm() + radii);
  }
  double gap() const { return apart.norm() - radii; }
  double rounding;

  // When the gap has come down to `target`, in s from now; infinite if it never does. apart^2 = (radii + target)^2 is a
  // quadratic equation; this form of its earlier root loses no digits where the later root is far off.
  double time_to(double target) const {
    const double closing = -apart.dot(velocity);
    if (closing <= 0) return kNever;
    const double limit = radii + target, c = apart.squaredNorm() - limit * limit;
    const double discriminant = closing * closing - velocity.squaredNorm() * c;
    if (!(discriminant > 0)) return kNever;
    const double time = c / (closing + std::sqrt(discriminant));  // without drag
    if (drag == 0) return time;
    return drag * time < 1 ? -std::log1p(-drag * time) / drag : kNever;
  }
};

bool are_balls(const World& world, const Pair& pair) {
  return world.ball_radius[world.bodies[pair.a].shape] > 0 &&
         world.ball_radius[world.bodies[pair.b].shape] > 0;
}

// The least gap along a plane (m) of bodies that do not overlap: a gap between it and zero is rounding, and the two
// touch.
double least_gap(const NearPair& pair) {
  return -kRoundingTerms * ca::rounding_term(pair.a.whole(), pair.b.whole(), pair.pose);
}

// Gives a contact another normal. A rounded shape then touches where its own surface has this normal: the contact of a
// ball stays on the line through its centre, or an impulse would turn the ball.
void turn_contact(const NearPair& near, const Vec3& normal, ca::FeaturePair& f) {
  const Vec3 turned = normal - f.normal;
  f.point_a += near.a.radius * turned;
  f.point_b -= near.b.radius * turned;
  f.normal = normal;
  f.gap = normal.dot(f.point_b - f.point_a);
  if (near.a.radius > 0)
    f.point_b = f.point_a + f.gap * normal;
  else if (near.b.radius > 0)
    f.point_a = f.point_b - f.gap * normal;
}

// A contact of edges or corners may have any normal between those of the faces beside it. It gets the normal of the
// face along which the bodies close in slowest, if there is one that separates them: see passing_plane.hpp.
void turn_to_passing_planes(const NearPair& near, const Vec3& origin_a,
                            std::vector<ca::FeaturePair>& features) {
  if (!near.a.filled || !near.b.filled) return;  // a mesh is more than its hull
  for (ca::FeaturePair& f : features) {
    if (f.kind_a == ca::FeatureKind::face || f.kind_b == ca::FeatureKind::face) continue;
    const Witnesses at = near.cores(f.point_a - origin_a, f.point_b - origin_a, f.normal);
    const double fastest = closing_speed(near, f.normal, at);
    if (const auto plane = slowest_plane(near, faces_beside(near, f), at, fastest, least_gap(near)))
      turn_contact(near, *plane, f);
  }
}

// The contacts of one pair at time `now`, none if it does not touch; `certified` becomes its certified gap (m).
std::vector<lcp::Contact> contacts_of(const World& world, const Pair& pair, double now, double& certified) {
  const double within = world.tolerance;
  if (are_balls(world, pair)) {
    const Balls balls(world, pair, now);
    const double gap = balls.gap();
    if (gap > within) return {};
    certified = gap - balls.rounding;
    const Vec3 normal = balls.apart.normalized();
    return {{pair.a, pair.b, balls.centre_a + (balls.radius_a + 0.5 * gap) * normal, normal, gap,
             world.restitution_of(pair.a, pair.b), world.turns(pair.a), world.turns(pair.b)}};
  }
  const ca::Motion motion_a = world.motion(pair.a, now), motion_b = world.motion(pair.b, now);
  if (out_of_reach(world, pair, motion_a, motion_b, 0, within)) return {};
  const NearPair near{world.model_of(pair.a), motion_a, world.model_of(pair.b), motion_b, 0};
  std::vector<ca::FeaturePair> features =
      near_features(world, pair.a, pair.b, near.pose, motion_a.position, within, &certified);
  turn_to_passing_planes(near, motion_a.position, features);
  std::vector<lcp::Contact> contacts;
  for (const ca::FeaturePair& feature : features)
    contacts.push_back({pair.a, pair.b, 0.5 * (feature.point_a + feature.point_b), feature.normal,
                        feature.gap, world.restitution_of(pair.a, pair.b), world.turns(pair.a),
                        world.turns(pair.b)});
  return contacts;
}

// The gap rule for a certified gap that may be off by `rounding` (both m).
clear::NextGap next_gap(const World& world, double gap, double rounding) {
  return world.gap_rule(gap, {world.keep(), kStallShare * world.tolerance, rounding});
}

// find_next_contact() for two balls, in closed form. False where the search may do better: little gap is left to spend,
// or the round-off of the coordinates is no longer small compared with it.
bool balls_meet(const World& world, Pair& pair, double now, double dt, StepReport& report) {
  const Balls balls(world, pair, now);
  const double gap = balls.gap();
  const clear::NextGap next = next_gap(world, gap, balls.rounding);
  if (!balls.straight || next.spent || balls.rounding > kSpendShare * std::min(gap, world.keep()))
    return false;
  report.min_gap = std::min(report.min_gap, gap);
  ++report.queries;
  const double time = now + balls.time_to(next.target);
  if (time >= dt) return true;
  if (!(time > now)) return false;
  pair.contact = true;
  pair.time = time;
  return true;
}

// A certified gap of the pair (m), for the step's smallest one: rough where the pair is far apart, and no more precise
// than needed.
double reported_gap(const World& world, const Pair& pair, const ca::PairPose& pose, double found,
                    const StepReport& report) {
  if (found >= report.min_gap) return found;
  const double cutoff = std::max(world.tolerance, report.min_gap);
  const double lower = hulls::model_distance(world.model_of(pair.a), world.model_of(pair.b), pose,
                                             world.tolerance, cutoff, kRoughShare)
                           .lower;
  return std::max(found, lower);
}

// Whether two bodies that are near each other pass without meeting, for `interval` seconds from near.time on.
bool passes(const World& world, const NearPair& near, double interval, const hulls::LeafPair& nearest) {
  const Witnesses at = near.cores(nearest.gjk.point_a, nearest.gjk.point_b, nearest.gjk.normal);
  const double least = least_gap(near), fastest = world.keep() / interval;
  const auto plane = slowest_plane(near, faces_beside(near, nearest, at), at, fastest, least);
  if (!plane) return false;
  const double gap = gap_along(near, *plane);
  return clear_along(near, *plane, next_gap(world, gap, -least).target, interval) >= interval;
}

// Measures a known gap (m) more precisely where little of it is left: a distance is known only to a sixteenth of the
// tolerance asked for. Returns true if the pair, which slides or turns on a face, is now proved to pass along that
// face: the search would creep.
bool slides_past(const World& world, const NearPair& near, double interval, double& gap) {
  if (gap >= kSharpShare * world.tolerance) return false;
  const hulls::ModelDistance sharp =
      hulls::model_distance(near.a, near.b, near.pose, kSharpShare * kStallShare * world.tolerance);
  gap = std::max(gap, sharp.lower);
  return sharp.nearest.a >= 0 && passes(world, near, interval, sharp.nearest);
}

// Sets how much of a gap (m) the search may spend. Returns whether that is so little that impacts pile up.
bool aim_from(const World& world, const NearPair& near, const Pair& pair, double gap,
              hulls::TocOptions& options) {
  const double smallest = -least_gap(near);
  const clear::NextGap next = next_gap(world, gap, smallest);
  options.target = next.target;
  options.slack = 0.25 * (gap > smallest ? std::min({gap, world.keep(), world.tolerance}) : smallest);
  options.start = -1;
  const bool convex = world.convex(pair.a) && world.convex(pair.b);
  if (next.spent) options.max_pairs = std::min(world.max_pairs, convex ? kStallPairs : kStallPairsOfMeshes);
  return next.spent;
}

SceneFailure no_progress(const World& world, const Pair& pair) {
  return SceneFailure(
      fmt::format("ccd.max_iterations = {} pairs of nodes were not enough for any progress in the search for "
                  "the next contact of bodies {} and {}; raise it",
                  world.max_pairs, pair.a, pair.b),
      "ccd.max_iterations");
}

}  // namespace

std::vector<ca::FeaturePair> near_features(const World& world, int a, int b, const ca::PairPose& pose,
                                           const Vec3& origin_a, double within, double* gap) {
  const hulls::Model &model_a = world.model_of(a), &model_b = world.model_of(b);
  std::vector<ca::FeaturePair> features =
      hulls::contact_features(model_a, model_b, pose, origin_a, within, gap);
  if (within > world.tolerance && world.convex(a) && world.convex(b))
    std::erase_if(features, [&](const ca::FeaturePair& f) {
      return ca::support_gap(model_a.whole(), model_b.whole(), pose, f.normal) < -within;
    });
  return features;
}

void find_next_contact(const World& world, Pair& pair, double now, double dt, std::optional<double> gap,
                       StepReport& report) {
  pair.contact = pair.stalled = false;
  pair.time = dt;
  if (!world.may_meet(pair.a, pair.b) || world.frozen_together(pair.a, pair.b)) return;
  if (are_balls(world, pair) && balls_meet(world, pair, now, dt, report)) return;
  const ca::Motion motion_a = world.motion(pair.a, now), motion_b = world.motion(pair.b, now);
  if (out_of_reach(world, pair, motion_a, motion_b, dt - now, world.keep())) return;

  const hulls::Model &model_a = world.model_of(pair.a), &model_b = world.model_of(pair.b);
  const NearPair near{model_a, motion_a, model_b, motion_b, 0};
  hulls::TocOptions options;
  options.interval = dt - now;
  options.tolerance = world.tolerance;
  options.max_pairs = world.max_pairs;
  ++report.queries;
  hulls::TimeOfContact toc;
  const auto search = [&] {
    toc = hulls::time_of_contact(model_a, motion_a, model_b, motion_b, options, world.memory);
    report.node_pairs += toc.node_pairs;
    report.advances += toc.advances;
  };
  if (!gap) {  // a pair that is already within the tolerance reaches `start` at once
    options.target = next_gap(world, kFarAway, 0).target;
    options.slack = 0.25 * world.tolerance;
    options.start = world.keep();
    search();
    if (toc.status == hulls::TimeOfContact::Status::reached && toc.time == 0)
      gap = hulls::model_distance(model_a, model_b, near.pose, world.tolerance).lower;
    if (toc.status == hulls::TimeOfContact::Status::clear)
      report.min_gap = std::min(report.min_gap, reported_gap(world, pair, near.pose, toc.start_gap, report));
  }
  bool little = false;  // no gap to spend
  if (gap) {
    const bool slides = slides_past(world, near, options.interval, *gap);
    report.min_gap = std::min(report.min_gap, *gap);
    if (slides) return;
    little = aim_from(world, near, pair, *gap, options);
    search();
  }
  if (toc.status == hulls::TimeOfContact::Status::clear) return;
  const bool limit = toc.status == hulls::TimeOfContact::Status::limit;
  if (!limit) {  // it comes near, but only slides past
    const NearPair there{model_a, motion_a, model_b, motion_b, toc.time};
    if (passes(world, there, options.interval - toc.time, toc.pair)) return;
  }
  pair.stalled = limit ? little : little || !(now + toc.time > now);
  pair.contact = !limit || pair.stalled;
  pair.time = pair.stalled ? now : now + toc.time;
  if (!pair.contact && !(pair.time > now)) throw no_progress(world, pair);
}

Island touching_island(const World& world, int a, int b, double now, StepReport& report) {
  Island island;
  std::vector<int> open;
  std::vector<int> seen;                          // pairs
  std::vector<std::pair<int, int>> seen_at_rest;  // bodies of pairs that are not in the schedule
  const auto add_body = [&](int body) {
    if (world.bodies[body].state.is_static()) return;
    if (std::find(island.bodies.begin(), island.bodies.end(), body) != island.bodies.end()) return;
    island.bodies.push_back(body);
    open.push_back(body);
  };
  // A frozen group is one body to all others, even where two of its bodies are slightly more than the tolerance apart.
  std::vector<int> groups;  // added already
  const auto add_group = [&](int body) {
    const int group = world.bodies[body].group;
    if (group < 0 || std::find(groups.begin(), groups.end(), group) != groups.end()) return;
    groups.push_back(group);
    for (int other = 0; other < static_cast<int>(world.bodies.size()); ++other)
      if (world.frozen_together(body, other)) add_body(other);
  };
  const auto add_contacts = [&](const Pair& other) {
    if (is_sensor_pair(world, other.a, other.b)) return;
    PairGap touching{other.a, other.b, 0};
    const std::vector<lcp::Contact> contacts = contacts_of(world, other, now, touching.gap);
    if (contacts.empty()) return;
    island.gaps.push_back(touching);
    island.contacts.insert(island.contacts.end(), contacts.begin(), contacts.end());
    add_body(other.a);
    add_body(other.b);
  };
  // Two stationary bodies have no pair in the schedule. If something hits one of them, their contact matters.
  const auto add_contacts_at_rest = [&](int body) {
    if (!world.is_stationary(body)) return;
    std::vector<int> others;
    world.schedule.overlapping(world.swept_bounds(body, now, now), [&](int other) {
      if (other != body && world.is_stationary(other) && world.schedule.find(body, other) < 0)
        others.push_back(other);
    });
    std::sort(others.begin(), others.end());
    for (const int other : others) {
      const std::pair<int, int> names = std::minmax(body, other);
      if (std::find(seen_at_rest.begin(), seen_at_rest.end(), names) != seen_at_rest.end()) continue;
      seen_at_rest.push_back(names);
      Pair resting;
      resting.a = names.first;
      resting.b = names.second;
      add_contacts(resting);
    }
  };
  add_body(a);
  add_body(b);
  while (!open.empty()) {
    const int body = open.back();
    open.pop_back();
    add_group(body);
    for (const int number : world.schedule.pairs_of(body)) {
      if (std::find(seen.begin(), seen.end(), number) != seen.end()) continue;
      seen.push_back(number);
      add_contacts(world.schedule.pair(number));
    }
    add_contacts_at_rest(body);
  }
  std::sort(island.bodies.begin(), island.bodies.end());
  std::stable_sort(island.contacts.begin(), island.contacts.end(),
                   [](const lcp::Contact& x, const lcp::Contact& y) {
                     return x.body_a != y.body_a ? x.body_a < y.body_a : x.body_b < y.body_b;
                   });
  for (const lcp::Contact& contact : island.contacts) {
    report.min_gap = std::min(report.min_gap, contact.gap);
    report.max_penetration = std::max(report.max_penetration, -contact.gap);
  }
  return island;
}

}  // namespace fc::world
