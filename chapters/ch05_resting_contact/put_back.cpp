// Of a frame: what in a crowd cannot be mended goes less far.
#include <algorithm>

#include "ch05_resting_contact/resting.hpp"

namespace fc::resting {
namespace {

// A body that is put back goes so much of the way that is free; or none, if that is less than the second.
constexpr double kShareOfFree = 0.9, kLeastShare = 0.1;

// Envelopes that a body may be put back, and the part of a crowd that may be put back farther.
constexpr double kMostPutBack = 4, kMostFar = 0.02;

constexpr int kMostRounds = 20;  // in which one body that is put back stops the next

}  // namespace

// Looks again at the ways of all pairs whose bodies have got another way; open_ is then what is not proved.
void Resting::check_changed(const world::World& world, RestReport& report) {
  open_.clear();
  std::vector<ShellPair>& pairs = shell_.pairs();
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    ShellPair& pair = pairs[p];
    if (!changed_[at(pair.a)] && !changed_[at(pair.b)]) continue;
    pair.proved = false;
    if (!concerns(world, pair)) continue;
    ++report.checked;
    const PathVerdict verdict =
        check_path(world, shell_, pair, tracks_[at(pair.a)], tracks_[at(pair.b)], dt_, need(world, pair));
    pair.proved = verdict.clear;
    if (!verdict.clear) open_.emplace_back(p, verdict.time);
  }
  std::fill(changed_.begin(), changed_.end(), 0);
}

// This part of the frame is taken back: nobody was put back far in it.
bool Resting::give_up_put_back() {
  for (std::size_t body = 0; body < full_ways_.size(); ++body)
    if (full_ways_[body].far) is_far_[body] = 0;
  return false;
}

// Ways of a crowd that are not proved yet: their bodies go less far in this part of the frame, as if
// positions alone had been put back, and so do those that would run into them. Velocities stay. False if
// somebody would have to be put back too far: then the world is to be begun anew.
bool Resting::put_back(world::World& world, RestReport& report) {
  const std::vector<ShellPair>& pairs = shell_.pairs();
  full_ways_.assign(world.bodies.size(), {});
  int may_go_far = static_cast<int>(kMostFar * std::count(crowded_.begin(), crowded_.end(), 1));
  for (int round = 0; !open_.empty(); ++round) {
    for (const auto& [p, time] : open_) {
      if (!is_crowded_pair(pairs[p]) || round == kMostRounds) return give_up_put_back();
      bool any = false;
      for (const int number : {pairs[p].a, pairs[p].b}) {
        if (!crowded_[at(number)] || !tracks_[at(number)].moves) continue;
        any = true;
        const Track& track = tracks_[at(number)];
        const Vec3 velocity = (track.end.position - track.start.position) / dt_;  // on the whole
        FullWay& full = full_ways_[at(number)];
        if (full.share == 1) {
          full.linear = velocity;
          full.angular = track.spin;
        }
        const double share = full.share * kShareOfFree * time / dt_;
        full.share = share < kLeastShare ? 0 : share;
        const double way = (1 - full.share) * dt_ * (full.linear.norm() + track.reach * full.angular.norm());
        if (way > kMostPutBack * shell_.envelope() && !full.far) {
          if (was_far_[at(number)] || is_far_[at(number)] || may_go_far-- == 0) return give_up_put_back();
          full.far = true;
          is_far_[at(number)] = 1;
        }
        world::Body& body = world.bodies[number];
        if (!body.steered) body.steer_velocity = body.steer_spin = Vec3::Zero();
        body.steered = true;
        body.steer_velocity += full.share * full.linear - velocity;
        body.steer_spin += full.share * full.angular - track.spin;
        ++report.put_back;
        follow(world, number);
      }
      if (!any) return give_up_put_back();  // who comes is driven
    }
    shell_.extend(world, sweeps_);
    take(world);
    check_changed(world, report);
  }
  return true;
}

// What could not be mended: the crowd stands still for this part of the frame, and only its gaps are put
// right. Whoever cannot even do that is not moved at all, nor whoever would then run into it.
void Resting::stop_crowd(world::World& world, RestReport& report) {
  crowd_.forget_displacements();
  for (int number = 0; number < static_cast<int>(crowded_.size()); ++number) {
    if (!crowded_[at(number)]) continue;
    world::Body& body = world.bodies[number];
    body.held = true;
    body.steered = false;
    ++report.stopped;
    follow(world, number);
  }
  steer(world, report);
  shell_.extend(world, sweeps_);
  take(world);
  std::fill(changed_.begin(), changed_.end(), 1);
  do {
    check_changed(world, report);
    for (const auto& [p, time] : open_) {
      const ShellPair& pair = shell_.pairs()[p];
      if (!is_crowded_pair(pair)) continue;
      for (const int number : {pair.a, pair.b}) {
        if (world.bodies[number].steered)
          world.bodies[number].steered = false;
        else if (tracks_[at(number)].moves)
          world.bodies[number].held = true;  // driven, or from outside: it would go through who stands
        else
          continue;
        follow(world, number);
      }
    }
  } while (std::any_of(changed_.begin(), changed_.end(), [](char changed) { return changed != 0; }));
}

}  // namespace fc::resting
