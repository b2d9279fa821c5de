#include "ch05_resting_contact/courses.hpp"

#include <algorithm>

#include "ch04_multibody_stepping/sensors.hpp"

namespace fc::resting {
namespace {

// Boxes are wider than paths by this part of them: paths may still change a little.
constexpr double kWider = 0.5;

// Of the margin: contact points of a crowd are searched anew after so much motion.
constexpr double kAgain = 4;

// The mean of the spin that turns one orientation into another in a time.
Vec3 mean_spin(const Mat3& from, const Mat3& to, double time) {
  const Eigen::AngleAxisd turn(to * from.transpose());
  return turn.angle() / time * turn.axis();
}

}  // namespace

void Courses::start(const world::World& world, std::span<const Member> all, double now, double length) {
  ++number_;
  now_ = now;
  length_ = length;
  checked_ = 0;
  for (const Member& member : members) place_of_[at(member.number)] = -1;
  place_of_.resize(world.bodies.size(), -1);
  members.clear();
  drift.clear();
  last.clear();
  tracks.clear();
  moved_.clear();
  candidates.clear();
  boxes_.clear();
  for (const Member& member : all) add_member(world, member);
}

void Courses::add_member(const world::World& world, const Member& member) {
  place_of_[at(member.number)] = static_cast<int>(members.size());
  members.push_back(member);
  moved_.push_back(0);
  if (!member.dynamic) {
    tracks.push_back(track_of(world, member.number, now_, length_));
    const Track& track = tracks.back();
    members.back().state.velocity = track.motion.velocity;
    members.back().state.spin = track.motion.spin;
    drift.push_back({track.motion.velocity, track.motion.spin});
    last.emplace_back();
    return;
  }
  ca::Motion flight = world.motion(member.number, now_);
  flight.position = Vec3::Zero();  // so that no digits are lost to where it is
  Twist u;
  u.linear = flight.drag == 0 ? Vec3(flight.velocity + 0.5 * length_ * flight.acceleration)
                              : Vec3(flight.position_at(length_) / length_);
  u.angular = flight.free || flight.spin_drag > 0
                  ? mean_spin(flight.rotation, flight.rotation_at(length_), length_)
                  : flight.spin;
  drift.push_back(u);
  last.push_back({flight.velocity_at(length_) - u.linear, flight.spin_at(length_) - u.angular});
  const double reach = world.shapes[at(world.bodies[at(member.number)].shape)].reach;
  tracks.push_back(straight_track(member.state, u.linear, u.angular, reach, length_));
}

void Courses::go(int member, const Twist& path) {
  Track& track = tracks[at(member)];
  if (!members[at(member)].dynamic || (track.velocity == path.linear && track.spin == path.angular)) return;
  moved_[at(member)] +=
      length_ * ((path.linear - track.velocity).norm() + track.reach * (path.angular - track.spin).norm());
  track = straight_track(members[at(member)].state, path.linear, path.angular, track.reach, length_);
}

world::Bounds Courses::box_of(const world::World& world, int member) const {
  const Track& t = tracks[at(member)];
  const std::size_t shape = at(world.bodies[at(members[at(member)].number)].shape);
  const double turn = std::min(2.0, t.spin_rate * length_) * t.reach;
  const Vec3 half =
      (t.start.rotation.cwiseAbs() * world.half_extents[shape]).cwiseMin(Vec3::Constant(t.reach)) +
      Vec3::Constant(0.5 * contacts_.margin() + turn);
  return {t.start.position.cwiseMin(t.end.position) - half, t.start.position.cwiseMax(t.end.position) + half};
}

// By how much the two may come nearer each other.
double Courses::way(const Candidate& pair) const {
  const Track &a = tracks[at(pair.a)], &b = tracks[at(pair.b)];
  return length_ * ((b.velocity - a.velocity).norm() + a.spin_rate * a.reach + b.spin_rate * b.reach);
}

int Courses::candidate_of(PairContacts* contacts, int a, int b) {
  if (contacts->plan != number_) {
    contacts->plan = number_;
    contacts->place = static_cast<int>(candidates.size());
    candidates.push_back({contacts, a, b});
  }
  return contacts->place;
}

void Courses::add_pair(const world::World& world, int i, int j, bool far) {
  PairContacts& contacts = contacts_.pair(members[at(i)].number, members[at(j)].number);
  const std::size_t before = candidates.size();
  const bool in_order = contacts.a == members[at(i)].number;
  const int number = candidate_of(&contacts, in_order ? i : j, in_order ? j : i);
  if (at(number) < before) return;
  const Candidate& pair = candidates[at(number)];
  SearchOptions options;
  options.reach = contacts_.margin() + (far ? way(pair) : 0);
  if (far) options.again = kAgain * contacts_.margin();
  contacts_.update(world, contacts, tracks[at(pair.a)].start, tracks[at(pair.b)].start, options);
}

void Courses::find(const world::World& world, bool far) {
  const bool first = boxes_.empty();
  const int count = static_cast<int>(members.size());
  std::vector<int> wider;  // members whose boxes are new
  for (int i = 0; i < count; ++i) {
    if (first) boxes_.emplace_back();
    if (!members[at(i)].dynamic) continue;
    const world::Bounds box = box_of(world, i);
    if (!first && (box.low.array() >= boxes_[at(i)].low.array()).all() &&
        (box.high.array() <= boxes_[at(i)].high.array()).all())
      continue;
    const Vec3 more = Vec3::Constant(
        contacts_.margin() +
        kWider * length_ * (tracks[at(i)].velocity.norm() + tracks[at(i)].spin_rate * tracks[at(i)].reach));
    boxes_[at(i)] = {box.low - more, box.high + more};
    if (!first) tree_.replace(i, boxes_[at(i)]);
    wider.push_back(i);
  }
  if (first) tree_.build(boxes_);
  for (const int i : wider) {
    others_.clear();
    tree_.overlapping(boxes_[at(i)], [&](int j) {
      if (j != i && members[at(j)].dynamic && (!first || j > i)) others_.push_back(j);
    });
    std::sort(others_.begin(), others_.end());
    for (const int j : others_) add_pair(world, i, j, far);
    others_.clear();
    world.schedule.overlapping(boxes_[at(i)], [&](int other) {
      if (!world.yields(other) && !world::is_sensor_pair(world, members[at(i)].number, other))
        others_.push_back(other);
    });
    std::sort(others_.begin(), others_.end());
    for (const int other : others_) {
      if (place_of_[at(other)] < 0) {
        const RigidBody state = world.state_at(other, now_);
        add_member(world, {other, state, false});
        boxes_.emplace_back();
      }
      add_pair(world, i, place_of_[at(other)], far);
    }
  }
}

PathVerdict Courses::check(const world::World& world, const Candidate& pair, const Track& a, const Track& b,
                           PathOptions options) {
  ++checked_;
  constexpr double kTouching = 1.0 / 64;  // of the tolerance
  const double gap = pair.contacts->gap;
  options.need = std::min(options.need, 0.5 * gap);
  if (gap <= kTouching * world.tolerance) {
    // It started like this, touching: then it need only not become less, but for rounding.
    const ca::PairPose pose(tracks[at(pair.a)].start, tracks[at(pair.b)].start);
    options.need = gap - 64 * ca::rounding_term(world.model_of(pair.contacts->a).whole(),
                                                world.model_of(pair.contacts->b).whole(), pose);
  }
  return check_path(world, contacts_, *pair.contacts, a, b, length_, options);
}

}  // namespace fc::resting
