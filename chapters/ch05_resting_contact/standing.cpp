#include "ch05_resting_contact/standing.hpp"

#include <algorithm>

namespace fc::resting {
namespace {

// Where impulses are so large that they cancel less exactly, bodies slower than this part of the margin in a frame
// stand still: paths are proved with more room than that.
constexpr double kMostStill = 1e-6;

bool is_same(const Member& m, const Member& n) {
  const RigidBody &a = m.state, &b = n.state;
  return m.number == n.number && a.position == b.position &&
         a.orientation.coeffs() == b.orientation.coeffs() && a.velocity == b.velocity && a.spin == b.spin;
}

bool are_same(const std::vector<Member>& a, const std::vector<Member>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), is_same);
}

bool stands(const Member& member) {
  return !member.dynamic || (member.state.velocity.isZero(0) && member.state.spin.isZero(0));
}

}  // namespace

double fastest_point(const world::World& world, int body, const Vec3& velocity, const Vec3& spin) {
  return velocity.norm() + world.shapes[at(world.bodies[at(body)].shape)].reach * spin.norm();
}

void Standing::next_frame() {
  std::fill(pushed_.begin(), pushed_.end(), 0);
  std::fill(stopped_.begin(), stopped_.end(), 0);
}

void Standing::begin(const world::World& world, double dt) {
  dt_ = dt;
  std::fill(passed_.begin(), passed_.end(), 0);
  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body) {
    if (!world.is_moving_kinematic(body)) continue;
    const Path path = path_of(world, body, 0, dt);
    const Vec3 reach = Vec3::Constant(path.reach + margin_);
    world.schedule.overlapping({path.start.position.cwiseMin(path.end.position) - reach,
                                path.start.position.cwiseMax(path.end.position) + reach},
                               [&](int other) { passed_[at(other)] = 1; });
  }
}

// m/s: a body in contact stands still if its points are slower.
double Standing::still_speed(const world::World& world, int body) const {
  const double left = law_.left() * pushed_[at(body)] * world.bodies[at(body)].state.inverse_mass;
  return std::min(kStill * margin_ / dt_ + left, kMostStill * margin_ / dt_);
}

void Standing::stop(const world::World& world, std::span<Member> members) {
  for (Member& member : members) {
    if (!member.dynamic) continue;
    const double speed = fastest_point(world, member.number, member.state.velocity, member.state.spin);
    double& stopped = stopped_[at(member.number)];
    if (stopped + speed >= still_speed(world, member.number)) continue;
    stopped += speed;
    member.state.velocity = member.state.spin = Vec3::Zero();
  }
}

bool Standing::stop(world::World& world, const Planned& plan) const {
  const bool corrects = plan.correction > kStill * margin_;
  bool all = true;
  for (const int body : plan.bodies) {
    world::Plan& motion = world.bodies[at(body)].plan;
    const double speed = fastest_point(world, body, motion.linear, motion.angular);
    if (speed < (corrects ? kStill * margin_ / dt_ : still_speed(world, body)))
      motion.linear = motion.angular = Vec3::Zero();
    else
      all = false;
  }
  return all;
}

std::shared_ptr<const Planned> Standing::plan(const Island& island, double length) const {
  const Known& known = known_[at(island.members.front().number)];
  const auto is_passed = [&](const Member& member) { return passed_[at(member.number)] != 0; };
  if (!known.plan || known.length != length || !are_same(known.at_start, island.members) ||
      std::any_of(island.members.begin(), island.members.end(), is_passed))
    return {};
  return known.plan;
}

void Standing::keep(const Island& island, double length, const std::shared_ptr<const Planned>& plan) {
  Known& known = known_[at(island.members.front().number)];
  known.length = length;
  known.at_start = island.members;
  known.plan = plan;
}

std::shared_ptr<const InstantResult> Standing::instant(Island& island) const {
  const Known& known = known_[at(island.members.front().number)];
  if (!known.instant || !are_same(known.before, island.members)) return {};
  island.members = known.after;
  return known.instant;
}

void Standing::keep(const std::vector<Member>& before, const Island& after, const InstantResult& result) {
  if (!std::all_of(after.members.begin(), after.members.end(), stands)) return;
  Known& known = known_[at(before.front().number)];
  known.before = before;
  known.after = after.members;
  known.instant = std::make_shared<const InstantResult>(result);
}

}  // namespace fc::resting
