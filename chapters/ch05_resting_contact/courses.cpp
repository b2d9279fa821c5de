#include "ch05_resting_contact/courses.hpp"

#include <algorithm>
#include <utility>

#include "ch04_multibody_stepping/sensors.hpp"

namespace fc::resting {
namespace {

// By this part of the paths boxes are wider than they: paths may still change a little.
constexpr double kWider = 0.5;

// Limits where pairs are kept: the number of starts; and boxes are also wider by this part of a body's reach.
constexpr int kMostStarts = 16;
constexpr double kWiderIfKept = 0.05;

// In margins: contact points of a pile are searched again after this much motion.
constexpr double kAgain = 4;

// The mean spin that turns one orientation into another in a given time.
Vec3 mean_spin(const Mat3& from, const Mat3& to, double time) {
  const Eigen::AngleAxisd turn(to * from.transpose());
  return turn.angle() / time * turn.axis();
}

}  // namespace

void Courses::start(const world::World& world, std::span<const Member> all, double now, double length) {
  now_ = now;
  length_ = length;
  checked_ = 0;
  fresh_ = true;
  if (keeps(world, all)) {
    for (std::size_t i = 0; i < members.size(); ++i)
      set_member(
          world, i,
          i < all.size() ? all[i] : Member{members[i].number, world.state_at(members[i].number, now), false});
    std::fill(moved_.begin(), moved_.end(), 0);
    for (Candidate& pair : candidates) pair = {pair.contacts, pair.a, pair.b};
    return;
  }
  number_ = contacts_.next_number();
  age_ = 0;
  first_ = all.size();
  for (const Member& member : members) place_of_[at(member.number)] = -1;
  place_of_.resize(world.bodies.size(), -1);
  members.clear();
  drift.clear();
  last.clear();
  paths.clear();
  moved_.clear();
  candidates.clear();
  boxes_.clear();
  for (const Member& member : all) add_member(world, member);
}

// Whether the pairs of the last start, with those of bodies that leave their boxes, are enough: for some time, if the
// bodies are the same and no kinematic body moves.
bool Courses::keeps(const world::World& world, std::span<const Member> all) {
  const bool recent = std::exchange(frame_, contacts_.frame()) + 1 >=
                      contacts_.frame();  // otherwise pairs may have been forgotten
  if (!keep_ || !recent || ++age_ > kMostStarts || first_ != all.size() || boxes_.empty()) return false;
  for (std::size_t i = 0; i < first_; ++i)
    if (members[i].number != all[i].number) return false;
  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body)
    if (world.is_moving_kinematic(body)) return false;
  return true;
}

void Courses::add_member(const world::World& world, const Member& member) {
  place_of_[at(member.number)] = static_cast<int>(members.size());
  members.emplace_back();
  moved_.push_back(0);
  drift.emplace_back();
  last.emplace_back();
  paths.emplace_back();
  set_member(world, members.size() - 1, member);
}

void Courses::set_member(const world::World& world, std::size_t i, const Member& member) {
  members[i] = member;
  if (!member.dynamic) {
    paths[i] = path_of(world, member.number, now_, length_);
    members[i].state.velocity = paths[i].motion.velocity;
    members[i].state.spin = paths[i].motion.spin;
    drift[i] = {paths[i].motion.velocity, paths[i].motion.spin};
    last[i] = {};
    return;
  }
  ca::Motion flight = world.motion(member.number, now_);
  flight.position = Vec3::Zero();  // so that no digits are lost to the position
  Twist& u = drift[i];
  u.linear = flight.drag == 0 ? Vec3(flight.velocity + 0.5 * length_ * flight.acceleration)
                              : Vec3(flight.position_at(length_) / length_);
  u.angular = flight.free || flight.spin_drag > 0
                  ? mean_spin(flight.rotation, flight.rotation_at(length_), length_)
                  : flight.spin;
  last[i] = {flight.velocity_at(length_) - u.linear, flight.spin_at(length_) - u.angular};
  const double reach = world.shapes[at(world.bodies[at(member.number)].shape)].reach;
  paths[i] = straight_path(member.state, u.linear, u.angular, reach, length_);
}

std::vector<RigidBody> Courses::with(const std::vector<Twist>& velocities) const {
  std::vector<RigidBody> bodies;
  for (std::size_t i = 0; i < members.size(); ++i) {
    bodies.push_back(members[i].state);
    bodies.back().velocity = velocities[i].linear;
    bodies.back().spin = velocities[i].angular;
  }
  return bodies;
}

void Courses::go(int member, const Twist& twist) {
  Path& path = paths[at(member)];
  if (!members[at(member)].dynamic || (path.velocity == twist.linear && path.spin == twist.angular)) return;
  moved_[at(member)] +=
      length_ * ((twist.linear - path.velocity).norm() + path.reach * (twist.angular - path.spin).norm());
  path = straight_path(members[at(member)].state, twist.linear, twist.angular, path.reach, length_);
}

world::Bounds Courses::box_of(const world::World& world, int member) const {
  const Path& t = paths[at(member)];
  const std::size_t shape = at(world.bodies[at(members[at(member)].number)].shape);
  const double turn = std::min(2.0, t.spin_rate * length_) * t.reach;
  const Vec3 half =
      (t.start.rotation.cwiseAbs() * world.half_extents[shape]).cwiseMin(Vec3::Constant(t.reach)) +
      Vec3::Constant(0.5 * contacts_.margin() + turn);
  return {t.start.position.cwiseMin(t.end.position) - half, t.start.position.cwiseMax(t.end.position) + half};
}

// By how much the two may approach each other (m).
double Courses::approach(const Candidate& pair) const {
  const Path &a = paths[at(pair.a)], &b = paths[at(pair.b)];
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
  if (at(number) == before) update(world, candidates[before], far);
}

// The pair's contacts at the start.
void Courses::update(const world::World& world, const Candidate& pair, bool far) {
  SearchOptions options;
  options.reach = contacts_.margin() + (far ? approach(pair) : 0);
  if (far) options.again = kAgain * contacts_.margin();
  contacts_.update(world, *pair.contacts, paths[at(pair.a)].start, paths[at(pair.b)].start, options);
}

// Gives new boxes to members whose paths have left theirs. Returns these members.
std::vector<int> Courses::widen(const world::World& world) {
  std::vector<int> wider;
  const bool none = boxes_.empty();
  boxes_.resize(members.size());
  for (int i = 0; i < static_cast<int>(members.size()); ++i) {
    if (!members[at(i)].dynamic) continue;
    const world::Bounds box = box_of(world, i);
    world::Bounds& wide = boxes_[at(i)];
    if (!none && (box.low.array() >= wide.low.array()).all() && (box.high.array() <= wide.high.array()).all())
      continue;
    const Path& path = paths[at(i)];
    const double distance = length_ * (path.velocity.norm() + path.spin_rate * path.reach);
    const Vec3 more =
        Vec3::Constant(contacts_.margin() + kWider * distance + (keep_ ? kWiderIfKept * path.reach : 0));
    wide = {box.low - more, box.high + more};
    if (!none) tree_.replace(i, wide);
    wider.push_back(i);
  }
  if (none) tree_.build(boxes_);
  return wider;
}

void Courses::find(const world::World& world, bool far) {
  const bool none = boxes_.empty();
  if (std::exchange(fresh_, false))
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      fetch_ahead(i);
      const Candidate& pair = candidates[i];
      contacts_.use(*pair.contacts);
      update(world, pair, far);
    }
  for (const int i : widen(world)) {
    others_.clear();
    tree_.overlapping(boxes_[at(i)], [&](int j) {
      if (j != i && members[at(j)].dynamic && (!none || j > i)) others_.push_back(j);
    });
    std::sort(others_.begin(), others_.end());
    for (const int j : others_) add_pair(world, i, j, far);
    others_.clear();
    world.schedule.overlapping(boxes_[at(i)], [&](int other) {
      if (!world.is_dynamic(other) && !world::is_sensor_pair(world, members[at(i)].number, other))
        others_.push_back(other);
    });
    std::sort(others_.begin(), others_.end());
    for (const int other : others_) {
      if (place_of_[at(other)] < 0) {
        add_member(world, {other, world.state_at(other, now_), false});
        boxes_.emplace_back();
      }
      add_pair(world, i, place_of_[at(other)], far);
    }
  }
}

PathVerdict Courses::check(const world::World& world, const Candidate& pair, const Path& a, const Path& b,
                           PathOptions options) {
  ++checked_;
  constexpr double kTouching = 1.0 / 64;  // of the tolerance
  const double gap = pair.contacts->gap;
  options.required_gap = std::min(options.required_gap, 0.5 * gap);
  if (gap <= kTouching * world.tolerance) {
    // The pair started like this, touching: its gap need only not shrink, except by rounding.
    const ca::PairPose pose(paths[at(pair.a)].start, paths[at(pair.b)].start);
    options.required_gap = gap - 64 * ca::rounding_term(world.model_of(pair.contacts->a).whole(),
                                                        world.model_of(pair.contacts->b).whole(), pose);
  }
  return check_path(world, contacts_, *pair.contacts, a, b, length_, options);
}

}  // namespace fc::resting
