#include "ch05_resting_contact/clear/clear_plan.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace fc::resting {
namespace {

constexpr int kMostRounds = 8;    // of measuring a plan's ends
constexpr int kMostProofs = 3;    // of one plan, each with more rows
constexpr double kClosed = 1e-6;  // of the margin: how exactly gaps close at a plan's end

}  // namespace

ClearPlan::ClearPlan(const world::World& world, Contacts& contacts, clear::RestingStepFunction* resting_step,
                     const clear::LcpFunction& solve_lcp, const Island& island, double now_, double length_)
    : now(now_),
      length(length_),
      members(island.members),
      world_(world),
      contacts_(contacts),
      resting_step_(resting_step),
      solve_lcp_(solve_lcp) {
  const auto is_member = [&](int body) {
    return std::any_of(members.begin(), members.end(), [&](const Member& m) { return m.number == body; });
  };
  for (int body = 0; body < std::ssize(world.bodies); ++body)
    if (!world.is_dynamic(body) && !is_member(body))
      members.push_back({body, world.state_at(body, now), false});
  problem.length = length;
  problem.rest_gap = 0.5 * contacts.margin();
  for (const Member& member : members) {
    const bool falls = member.dynamic && world.effects.gravity;
    problem.bodies.push_back(member.state);
    problem.gravity.push_back(falls ? world.gravity_on(member.state) : Vec3(Vec3::Zero()));
    paths_.push_back(path_of(world, member.number, now, length));
  }
  for (const IslandPair& pair : island.pairs)
    for (const ContactPoint& point : pair.contacts->points) add_row(*pair.contacts, pair.a, pair.b, point);
}

void ClearPlan::add_row(PairContacts& pair, int a, int b, const ContactPoint& point) {
  problem.rows.push_back({contact_at(world_, members, problem.bodies, a, b, point)});
  points_.push_back({&pair, point});
}

bool ClearPlan::has_new_rows() {
  return ++proofs_ <= kMostProofs && std::ssize(points_) > std::exchange(known_, std::ssize(points_));
}

// ANCHOR: close_ends
// A chord method: solve, measure the gaps where the bodies would stand at the end, and solve again with these.
bool ClearPlan::close_ends() {
  for (int round = 0; round < kMostRounds; ++round) {
    result = resting_step_(problem, solve_lcp_);
    if (!result.solved) return false;
    follow_paths();
    double worst = 0;
    for (int row = 0; row < std::ssize(points_); ++row) worst = std::max(worst, measure(row));
    if (worst <= kClosed * contacts_.margin()) return true;
  }
  return false;
}

// Moves the members to where they stand at the end.
void ClearPlan::follow_paths() {
  ends_ = result.w;
  for (int i = 0; i < std::ssize(members); ++i) {
    Path& path = paths_[i];
    if (members[i].dynamic)
      path = straight_path(members[i].state, result.y[i].velocity, result.y[i].spin, path.reach, length);
    ends_[i].position = path.end.position;
    ends_[i].orientation = Quat(path.end.rotation);
  }
}

// Measures a row's point at the end. Returns how far (m) it is from what the solution assumed.
double ClearPlan::measure(int number) {
  clear::RestingRow& row = problem.rows[number];
  const lcp::Contact& start = row.contact;
  const lcp::Contact end =
      contact_at(world_, members, ends_, start.body_a, start.body_b, points_[number].point);
  points_[number].end_gap = end.gap;
  const double first_order = start.gap + length * lcp::contact_velocity(result.y, start);
  const double bend_before = std::exchange(row.bend, end.gap - first_order);
  row.end_speed = std::max(0.0, -lcp::contact_velocity(ends_, end));
  const bool pushes = number < result.z.size() && result.z[number] > 0;
  const double too_fast = pushes ? lcp::contact_velocity(result.w, start) - row.end_speed : 0;
  return std::max(std::abs(row.bend - bend_before), length * too_fast);
}
// ANCHOR_END: close_ends

// ANCHOR: prove
bool ClearPlan::prove() {
  planned.assign(members.size(), 0);
  for (int i = 0; i < std::ssize(points_); ++i) {
    const lcp::Contact& start = problem.rows[i].contact;
    const bool pushes = result.z[i] > 0 || result.c[i] > 0;
    if (pushes && std::max(start.gap, points_[i].end_gap) > contacts_.margin()) return false;
    for (const int member : {start.body_a, start.body_b})
      if (pushes || points_[i].end_gap < contacts_.margin()) planned[member] = members[member].dynamic;
  }
  bool clear = true;
  for (int i = 0; i < std::ssize(members); ++i)
    for (int j = 0; j < i; ++j)
      if ((members[i].dynamic || members[j].dynamic) && !is_clear(i, j)) clear = false;
  return clear;
}

// Chapter 4's gap rule for a pair on its paths in the plan: it must keep half of its gap, or of the rest gap.
bool ClearPlan::is_clear(int i, int j) {
  PairContacts& pair = contacts_.pair(members[i].number, members[j].number);
  if (pair.a != members[i].number) std::swap(i, j);
  const Path &a = paths_[i], &b = paths_[j];
  contacts_.update(world_, pair, a.start, b.start);
  const double rounding = ca::rounding_term(world_.model_of(pair.a).whole(), world_.model_of(pair.b).whole(),
                                            ca::PairPose(a.start, b.start));
  const double required_gap = 0.5 * std::min(pair.gap, 0.5 * contacts_.margin()) - 64 * rounding;
  if (check_path(world_, contacts_, pair, a, b, length, {.required_gap = required_gap}).clear) return true;
  if (pair.gap > contacts_.margin()) return false;
  double gap = 0;
  for (const ContactPoint& point : contacts_.points_at(world_, pair, a.end, b.end, gap)) {
    add_row(pair, i, j, point);
    measure(static_cast<int>(points_.size()) - 1);
  }
  return false;
}
// ANCHOR_END: prove

void ClearPlan::remember() const {
  std::set<const PairContacts*> pushed;
  for (int i = 0; i < std::ssize(points_); ++i) {
    if (result.z[i] > 0) pushed.insert(points_[i].pair);
    for (ContactPoint& point : points_[i].pair->points) point.lasts = false;
  }
  for (int i = 0; i < std::ssize(points_); ++i) {
    const double widest = std::max(problem.rows[i].contact.gap, points_[i].end_gap);
    if (widest > contacts_.margin() || !pushed.contains(points_[i].pair)) continue;
    for (ContactPoint& point : points_[i].pair->points)
      if (point.key == points_[i].point.key) point.lasts = true;
  }
}

}  // namespace fc::resting
