#include "ch05_resting_contact/shell.hpp"

#include <algorithm>
#include <cmath>

#include "ch04_multibody_stepping/contact_search.hpp"
#include "ch04_multibody_stepping/sensors.hpp"

namespace fc::resting {
namespace {

// Parts of the envelope: by how much two bodies may have moved against each other before their contacts are
// searched again; by how much a face's plane may tell less than the best one and still be taken; how wide a
// gap may be at a point of a patch.
constexpr double kSearchAgain = 1.0 / 4, kSlack = 1.0 / 64, kFar = 4;

// Of the envelope: with a certified gap below this a pair is searched again, too.
constexpr double kLeastKnown = 1.0 / 16;

// How rough the distance of meshes may be that are not in each other's shell, and how far it is asked for.
constexpr double kRough = 0.5, kNever = std::numeric_limits<double>::infinity();

// Boxes of the list of pairs are wider than a frame needs by so many frames' ways.
constexpr double kSpareFrames = 3;

// By how much at most any point of the smaller body has moved, as seen from the larger one.
double moved(const Pose& from, const Pose& to, double reach) {
  constexpr double kFrobenius = 0.7071067811865476;  // of a difference of rotations, to its largest stretch
  return (to.position - from.position).norm() + kFrobenius * reach * (to.rotation - from.rotation).norm();
}

// The pose of one body in another one's axes.
Pose seen_from(const Pose& viewer, const Pose& body) {
  return {viewer.rotation.transpose() * body.rotation,
          viewer.rotation.transpose() * (body.position - viewer.position)};
}

}  // namespace

Shell::Shell(const world::World& world, double envelope) : envelope_(envelope) {
  for (std::size_t s = 0; s < world.shapes.size(); ++s)
    facets_.push_back(world.shapes[s].convex() ? build_facets(world.models[s].mesh) : Facets{});
}

void Shell::find(const world::World& world, const std::vector<Sweep>& sweeps) {
  poses_.clear();
  for (const world::Body& body : world.bodies) poses_.push_back(body.state.pose());
  list_pairs(world, sweeps);
  contacts_.swap(before_);
  contacts_.clear();
  searched_ = 0;
  smallest_gap_ = std::numeric_limits<double>::infinity();
  for (ShellPair& pair : pairs_) {
    pair.fresh = false;
    update(world, pair);
    if (pair.count > 0) smallest_gap_ = std::min(smallest_gap_, pair.gap);
  }
}

void Shell::extend(const world::World& world, const std::vector<Sweep>& sweeps) {
  list_pairs(world, sweeps);
  for (ShellPair& pair : pairs_) {
    if (!pair.fresh) continue;
    pair.fresh = false;
    update(world, pair);
  }
}

// The list serves as long as every body stays in the box with which it was made.
void Shell::list_pairs(const world::World& world, const std::vector<Sweep>& sweeps) {
  const std::size_t count = world.bodies.size();
  std::vector<world::Bounds> boxes(count);
  bool valid = listed_.size() == count;
  for (std::size_t i = 0; i < count; ++i) {
    const world::Body& body = world.bodies[i];
    const double reach = world.shapes[body.shape].reach;
    const Vec3 half = poses_[i].rotation.cwiseAbs() * world.half_extents[body.shape];
    const double room = envelope_ + std::min(sweeps[i].turn, 2.0) * reach + sweeps[i].sag;
    const Vec3 margin = half.cwiseMin(Vec3::Constant(reach)) + Vec3::Constant(room);
    boxes[i] = {poses_[i].position.cwiseMin(sweeps[i].end) - margin,
                poses_[i].position.cwiseMax(sweeps[i].end) + margin};
    valid = valid && (boxes[i].low.array() >= listed_[i].low.array()).all() &&
            (boxes[i].high.array() <= listed_[i].high.array()).all();
  }
  if (valid) return;
  for (std::size_t i = 0; i < count; ++i) {
    const world::Body& body = world.bodies[i];
    const double way =
        (sweeps[i].end - poses_[i].position).norm() + sweeps[i].turn * world.shapes[body.shape].reach;
    const Vec3 spare = Vec3::Constant(kSpareFrames * way + (body.state.is_static() ? 0 : envelope_));
    boxes[i].low -= spare;
    boxes[i].high += spare;
  }
  listed_ = boxes;
  tree_.build(boxes);
  std::vector<std::pair<int, int>> found;
  tree_.overlapping_pairs([&](int a, int b) {
    if (!world::is_sensor_pair(world, a, b) && (world.yields(a) || world.yields(b)))
      found.emplace_back(std::min(a, b), std::max(a, b));
  });
  std::sort(found.begin(), found.end());
  pairs_.swap(pairs_before_);
  pairs_.clear();
  auto at = pairs_before_.begin();
  for (const auto& [a, b] : found) {
    while (at != pairs_before_.end() && std::pair(at->a, at->b) < std::pair(a, b)) ++at;
    if (at != pairs_before_.end() && at->a == a && at->b == b) {
      pairs_.push_back(*at);
    } else {
      pairs_.emplace_back();
      pairs_.back().fresh = true;
      pairs_.back().a = a;
      pairs_.back().b = b;
    }
  }
}

void Shell::update(const world::World& world, ShellPair& pair) {
  const Pose &a = poses_[static_cast<std::size_t>(pair.a)], &b = poses_[static_cast<std::size_t>(pair.b)];
  pair.axis_known = false;
  if (pair.known && !pair.stale) {
    const double reach_a = world.shapes[world.bodies[pair.a].shape].reach,
                 reach_b = world.shapes[world.bodies[pair.b].shape].reach;
    const double way = reach_a < reach_b ? moved(pair.searched, seen_from(b, a), reach_a)
                                         : moved(pair.searched, seen_from(a, b), reach_b);
    pair.gap = pair.searched_gap - way;
    if (pair.gap > envelope_) {
      pair.count = 0;
      return;
    }
    if (pair.count > 0 && way <= kSearchAgain * envelope_) {
      if (convex(world, pair)) {
        if (way > 0) pair.axis_gap = axis_gap(world, pair, a, b);
        pair.axis_known = true;
        pair.gap = std::max(pair.gap, pair.axis_gap);
      }
      // A bound that says too little would let the way come nearer than it may: see need().
      if (way == 0 || pair.gap > kLeastKnown * envelope_) {
        keep(pair, a, b);
        return;
      }
    }
    if (convex(world, pair)) {
      pair.axis_gap = axis_gap(world, pair, a, b);
      pair.axis_known = true;
      if (pair.axis_gap > envelope_) {
        pair.searched = reach_a < reach_b ? seen_from(b, a) : seen_from(a, b);
        pair.searched_gap = pair.gap = pair.axis_gap;
        pair.count = 0;
        return;
      }
    }
  }
  pair.gap = search(world, pair, a, b);
}

double Shell::axis_gap(const world::World& world, const ShellPair& pair, const Pose& a, const Pose& b) const {
  return ca::support_gap(world.model_of(pair.a).leaf(0), world.model_of(pair.b).leaf(0), ca::PairPose(a, b),
                         pair.axis_at(a, b));
}

// The contacts of the frame before, as the bodies stand now.
void Shell::keep(ShellPair& pair, const Pose& a, const Pose& b) {
  const int first = static_cast<int>(contacts_.size());
  for (int i = 0; i < pair.count; ++i) {
    ShellContact contact = before_[static_cast<std::size_t>(pair.first + i)];
    contact.lift = 0;
    const Vec3 point_a = a.position + a.rotation * contact.local_a,
               point_b = b.position + b.rotation * contact.local_b;
    contact.contact.normal = contact.normal_at(a, b);
    contact.contact.point = 0.5 * (point_a + point_b);
    contact.contact.gap = contact.gap_at(a, b);
    contacts_.push_back(contact);
  }
  pair.first = first;
}

double Shell::search_at(const world::World& world, ShellPair& pair, const Pose& a, const Pose& b) {
  const double start_gap = pair.gap;
  pair.count = 0;  // no guesses: what it has stays, with its impulses
  const double gap = search(world, pair, a, b);
  const Pose &a_now = poses_[static_cast<std::size_t>(pair.a)],
             &b_now = poses_[static_cast<std::size_t>(pair.b)];
  pair.stale = true;
  pair.gap = start_gap;
  if (convex(world, pair)) pair.axis_gap = axis_gap(world, pair, a_now, b_now);
  // For its rows: its points as they are now.
  for (int i = pair.first; i < pair.first + pair.count; ++i) {
    ShellContact& c = contacts_[static_cast<std::size_t>(i)];
    c.contact.point =
        0.5 * ((a_now.position + a_now.rotation * c.local_a) + (b_now.position + b_now.rotation * c.local_b));
  }
  return gap;
}

ca::GjkResult Shell::nearest(const world::World& world, ShellPair& pair, const ca::PairPose& pose) const {
  const ca::Convex a = world.model_of(pair.a).leaf(0), b = world.model_of(pair.b).leaf(0);
  ca::GjkResult result = ca::distance(a, b, pose, {.absolute = world.tolerance / 16},
                                      pair.simplex.count > 0 ? &pair.simplex : nullptr);
  pair.simplex = result.cache;
  if (result.status != ca::GjkResult::Status::separated || result.lower < world.tolerance)
    result = hulls::leaf_distance(a, b, pose, world.tolerance);
  return result;
}

double Shell::search(const world::World& world, ShellPair& pair, const Pose& a, const Pose& b) {
  ++searched_;
  const int first = static_cast<int>(contacts_.size()), old = pair.first, olds = pair.count;
  const double restitution = world.restitution_of(pair.a, pair.b);
  const bool turns_a = world.turns(pair.a), turns_b = world.turns(pair.b);
  const auto add = [&](const Vec3& local_a, const Vec3& local_b, const Vec3& normal, bool of_b,
                       std::uint64_t key) {
    ShellContact c;
    c.local_a = local_a;
    c.local_b = local_b;
    c.of_b = of_b;
    c.local_normal = (of_b ? b : a).rotation.transpose() * normal;
    c.key = key;
    const Vec3 point_a = a.position + a.rotation * local_a, point_b = b.position + b.rotation * local_b;
    c.contact = {pair.a,  pair.b, 0.5 * (point_a + point_b), normal, c.gap_at(a, b), restitution,
                 turns_a, turns_b};
    // As a guess: what the same contact took in the frame before, or the nearest one.
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < olds; ++i) {
      const ShellContact& before = before_[static_cast<std::size_t>(old + i)];
      const double distance = before.key == key ? -1 : (before.local_a - local_a).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      c.impulse = before.impulse;
      c.bounce = before.bounce;
      c.bounce_next = before.bounce_next;
    }
    contacts_.push_back(c);
  };
  double gap = std::numeric_limits<double>::infinity();
  if (convex(world, pair)) {
    const ca::PairPose pose(a, b);
    ca::GjkResult result = nearest(world, pair, pose);
    if (!(result.lower > 0) && pair.known) {
      // An overlap (of a pose that will not be) has no plane: the last one will be near to the next.
      const double along = axis_gap(world, pair, a, b);
      if (along > result.lower) {
        result.lower = along;
        result.normal = pair.axis_at(a, b);
        result.status = ca::GjkResult::Status::overlapping;
      }
    }
    gap = result.lower;
    pair.of_b = false;
    pair.axis = a.rotation.transpose() * result.normal;
    pair.axis_gap = gap;
    pair.axis_known = true;
    if (gap <= envelope_) {
      Patch patch;
      find_patch({world.model_of(pair.a), facets_[static_cast<std::size_t>(world.bodies[pair.a].shape)]},
                 {world.model_of(pair.b), facets_[static_cast<std::size_t>(world.bodies[pair.b].shape)]},
                 pose, result, std::clamp(0.25 * gap, 0.0, kSlack * envelope_), kFar * envelope_, patch);
      pair.axis_gap = patch.gap;
      gap = std::max(gap, patch.gap);
      pair.of_b = patch.of_b;
      pair.axis = (patch.of_b ? b : a).rotation.transpose() * patch.normal;
      for (int i = 0; i < patch.count; ++i) {
        const PatchPoint& p = patch.points[static_cast<std::size_t>(i)];
        add(p.point_a, p.point_b, patch.normal, patch.of_b, p.key);
      }
    }
  } else {
    const ca::PairPose pose(a, b);
    gap = hulls::model_distance(world.model_of(pair.a), world.model_of(pair.b), pose, world.tolerance, kNever,
                                kRough)
              .lower;
    std::vector<ca::FeaturePair> features;
    double of_features = gap;  // certified, too, but to a sixteenth of the distance that is asked for
    if (gap <= envelope_)
      features = world::near_features(world, pair.a, pair.b, pose, a.position, (1 + kSearchAgain) * envelope_,
                                      &of_features);
    gap = std::max(gap, of_features);
    for (const ca::FeaturePair& f : features) {
      const bool of_b = f.kind_b == ca::FeatureKind::face;
      const auto key = static_cast<std::uint64_t>(f.kind_a) << 62 |
                       static_cast<std::uint64_t>(f.kind_b) << 60 | static_cast<std::uint64_t>(f.id_a) << 30 |
                       static_cast<std::uint64_t>(f.id_b);
      add(a.rotation.transpose() * (f.point_a - a.position),
          b.rotation.transpose() * (f.point_b - b.position), f.normal, of_b, key);
    }
  }
  pair.first = first;
  pair.count = static_cast<int>(contacts_.size()) - first;
  pair.searched_gap = gap;
  const bool a_is_smaller =
      world.shapes[world.bodies[pair.a].shape].reach < world.shapes[world.bodies[pair.b].shape].reach;
  pair.searched = a_is_smaller ? seen_from(b, a) : seen_from(a, b);
  pair.known = true;
  pair.stale = false;
  return gap;
}

}  // namespace fc::resting
