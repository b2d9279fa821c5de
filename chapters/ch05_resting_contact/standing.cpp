#include "ch05_resting_contact/standing.hpp"

#include <algorithm>

namespace fc::resting {
namespace {

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

void Standing::begin(const world::World& world, double margin, double dt) {
  std::fill(passed_.begin(), passed_.end(), 0);
  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body) {
    if (!world.is_moving_kinematic(body)) continue;
    const Path path = path_of(world, body, 0, dt);
    const Vec3 reach = Vec3::Constant(path.reach + margin);
    world.schedule.overlapping({path.start.position.cwiseMin(path.end.position) - reach,
                                path.start.position.cwiseMax(path.end.position) + reach},
                               [&](int other) { passed_[at(other)] = 1; });
  }
}

const Standing::Known* Standing::known(const Island& island) const {
  return known_[at(island.members.front().number)].get();
}

Standing::Known& Standing::made(const std::vector<Member>& members) {
  std::unique_ptr<Known>& known = known_[at(members.front().number)];
  if (!known) known = std::make_unique<Known>();
  return *known;
}

std::shared_ptr<const Planned> Standing::plan(const Island& island, double length) const {
  const Known* known = this->known(island);
  if (known == nullptr || !known->plan || known->length != length ||
      !are_same(known->at_start, island.members))
    return {};
  const auto is_passed = [&](const Member& member) { return passed_[at(member.number)] != 0; };
  if (std::any_of(island.members.begin(), island.members.end(), is_passed)) return {};
  return known->plan;
}

void Standing::keep(const Island& island, double length, const std::shared_ptr<const Planned>& plan) {
  Known& known = made(island.members);
  known.length = length;
  known.at_start = island.members;
  known.plan = plan;
}

std::shared_ptr<const InstantResult> Standing::instant(Island& island) const {
  const Known* known = this->known(island);
  if (known == nullptr || !known->instant || !are_same(known->before, island.members)) return {};
  island.members = known->after;
  return known->instant;
}

void Standing::keep(const std::vector<Member>& before, const Island& after, const InstantResult& result) {
  if (!std::all_of(after.members.begin(), after.members.end(), stands)) return;
  Known& known = made(before);
  known.before = before;
  known.after = after.members;
  known.instant = std::make_shared<const InstantResult>(result);
}

}  // namespace fc::resting
