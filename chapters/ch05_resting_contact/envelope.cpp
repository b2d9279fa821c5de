#include "ch05_resting_contact/envelope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "ch04_multibody_stepping/contact_search.hpp"
#include "ch04_multibody_stepping/sensors.hpp"

namespace fc::resting {
namespace {

constexpr double kShareOfReach = 1e-3;
constexpr double kLeastTolerances = 100;

bool same(const Pose& x, const Pose& y) {
  return x.position == y.position && x.rotation == y.rotation;
}

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

void Shell::find(const world::World& world) {
  const std::vector<ShellContact> before = std::move(contacts_);
  const std::vector<Known> known = std::move(known_);
  contacts_.clear();
  known_.clear();
  searched_ = 0;

  std::vector<world::Bounds> boxes;
  boxes.reserve(world.bodies.size());
  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body) {
    world::Bounds box = world.swept_bounds(body, 0, 0);
    box.low -= Vec3::Constant(0.5 * envelope_);
    box.high += Vec3::Constant(0.5 * envelope_);
    boxes.push_back(box);
  }
  tree_.build(boxes);
  std::vector<std::pair<int, int>> pairs;
  tree_.overlapping_pairs([&](int a, int b) {
    if (!world::is_sensor_pair(world, a, b) && (world.yields(a) || world.yields(b)))
      pairs.emplace_back(std::min(a, b), std::max(a, b));
  });
  std::sort(pairs.begin(), pairs.end());

  auto at = known.begin();
  for (const auto& [a, b] : pairs) {
    while (at != known.end() && std::pair(at->a, at->b) < std::pair(a, b)) ++at;
    const bool is_known = at != known.end() && at->a == a && at->b == b;
    add(world, a, b, is_known ? &*at : nullptr, before);
  }
  sharpen(world);
}

// The smallest gap: rough bounds tell which pairs can have it, and those are measured.
void Shell::sharpen(const world::World& world) {
  smallest_gap_ = std::numeric_limits<double>::infinity();
  for (const Known& pair : known_)
    if (pair.sharp) smallest_gap_ = std::min(smallest_gap_, pair.gap);
  for (Known& pair : known_) {
    if (pair.sharp || pair.gap >= smallest_gap_) continue;
    const ca::PairPose pose(ca::Motion(world.bodies[pair.a].state), ca::Motion(world.bodies[pair.b].state),
                            0);
    pair.gap = hulls::model_distance(world.model_of(pair.a), world.model_of(pair.b), pose, world.tolerance,
                                     envelope_)
                   .lower;
    pair.sharp = true;
    smallest_gap_ = std::min(smallest_gap_, pair.gap);
  }
}

void Shell::add(const world::World& world, int a, int b, const Known* known,
                const std::vector<ShellContact>& before) {
  const RigidBody &body_a = world.bodies[a].state, &body_b = world.bodies[b].state;
  Known now{a,
            b,
            body_a.pose(),
            body_b.pose(),
            static_cast<int>(contacts_.size()),
            0,
            std::numeric_limits<double>::infinity(),
            false};
  if (known != nullptr && same(known->pose_a, now.pose_a) && same(known->pose_b, now.pose_b)) {
    now.gap = known->gap;
    now.sharp = known->sharp;
    contacts_.insert(contacts_.end(), before.begin() + known->first,
                     before.begin() + known->first + known->count);
  } else {
    ++searched_;
    const ca::Motion motion_a(body_a), motion_b(body_b);
    const ca::PairPose pose(motion_a, motion_b, 0);
    for (const ca::FeaturePair& f :
         world::near_features(world, a, b, pose, body_a.position, envelope_, &now.gap)) {
      ShellContact contact;
      contact.contact = {
          a, b, 0.5 * (f.point_a + f.point_b), f.normal, f.gap, 0, world.turns(a), world.turns(b)};
      // As a guess: what the nearest contact of this pair took in the frame before.
      double nearest = std::numeric_limits<double>::infinity();
      for (int i = 0; known != nullptr && i < known->count; ++i) {
        const ShellContact& old = before[static_cast<std::size_t>(known->first + i)];
        const double distance = (old.contact.point - contact.contact.point).squaredNorm();
        if (distance >= nearest) continue;
        nearest = distance;
        contact.impulse = old.impulse;
      }
      contacts_.push_back(contact);
    }
  }
  now.count = static_cast<int>(contacts_.size()) - now.first;
  known_.push_back(now);
}

}  // namespace fc::resting
