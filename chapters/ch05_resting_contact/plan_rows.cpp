#include "ch05_resting_contact/plan_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ch03_impulse_lcp/impact.hpp"

namespace fc::resting {
namespace {

// The share of a gap's lack (to the rest gap) that a plan makes up; and the part of the margin that it reaches at once.
constexpr double kCorrect = 0.2, kLeastGap = 0.25;
constexpr double kNearRest = 0.99999;  // of the rest gap: from here on nothing is corrected

constexpr int kMostRounds = 8;          // of measuring the paths' ends
constexpr double kNearlyClosed = 1e-2;  // of the margin: with a larger error a shorter plan is made
constexpr double kClosed = 1e-6;        // of the margin: how exactly contacts close at the plan's end
constexpr double kCloseEnough =
    1e-4;  // the same, where slips change along the path, after the patient rounds
constexpr int kPatientRounds = 4;

}  // namespace

double wanted_gap(double gap, double margin) {
  const double rest = 0.5 * margin;
  if (gap >= kNearRest * rest) return std::min(gap, rest);
  return std::max(gap + kCorrect * (rest - gap), kLeastGap * margin);
}

void PlanRows::start(const IslandOptions& options) {
  options_ = options;
  rows.clear();
  fast = courses_.with(courses_.drift);
  corrects_ = true;
  residual = solves = 0;
}

PlanRow PlanRows::row_of(const world::World& world, int candidate, const ContactPoint& point,
                         bool arrives) const {
  const Candidate& pair = courses_.candidates[at(candidate)];
  PlanRow row{candidate, point, contact_at(world, courses_.members, fast, pair.a, pair.b, point)};
  row.arrives = arrives;
  const double rest = 0.5 * margin_, gap = arrives ? std::min(pair.contacts->gap, rest) : row.contact.gap;
  row.keep = std::min(gap, rest);
  row.want = wanted_gap(gap, margin_);
  if (!arrives) {
    row.impulse = courses_.length() * point.force;
    return row;
  }
  row.end_gap = point.gap_at(courses_.paths[at(pair.a)].end, courses_.paths[at(pair.b)].end);
  row.bend = bend(row);
  return row;
}

PlanResult PlanRows::close() {
  const auto is_put_out =
      [&](const PlanRow& row) {  // by corrections: it leaves the contact although it pushes
        return row.push() > 0 && !row.arrives && row.end_gap > margin_;
      };
  const PlanResult ends = close_ends();
  if (!corrects_ || std::none_of(rows.begin(), rows.end(), is_put_out)) return ends;
  corrects_ = false;
  return close_ends();
}

// ANCHOR: close_ends
PlanResult PlanRows::close_ends() {
  double worst = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    if (!solve()) return PlanResult::unsolved;
    for (std::size_t i = 0; i < courses_.members.size(); ++i)
      courses_.go(static_cast<int>(i), {path[i].velocity, path[i].spin});
    worst = 0;
    for (PlanRow& row : rows) worst = std::max(worst, measure(row));
    const bool patient = round < kPatientRounds || !law_.looks_at_bends();
    if (worst <= (patient ? kClosed : kCloseEnough) * margin_) break;
  }
  return worst <= kNearlyClosed * margin_ ? PlanResult::proved : PlanResult::unproved;
}

// Measures a row at the end of the paths. Returns how far (m) it is from what the solution assumed.
double PlanRows::measure(PlanRow& row) const {
  const Path &a = courses_.paths[at(row.contact.body_a)], &b = courses_.paths[at(row.contact.body_b)];
  row.end_gap = row.point.gap_at(a.end, b.end);
  if (row.end_gap >= margin_ && !(row.push() > 0 || row.correction > 0)) return 0;
  const double bend_before = std::exchange(row.bend, bend(row));
  row.most_push = std::max(0.0, -end_speed(row, fast));
  const double parts = row.push() > 0 ? lcp::contact_velocity(fast, row.contact) - row.most_push : 0;
  const double worst = std::max(std::abs(row.bend - bend_before), courses_.length() * parts);
  if (!law_.looks_at_bends() || row.arrives) return worst;
  const Vec3 slip_before = std::exchange(row.slip_bend, slip_bend(row));
  return std::max(worst, courses_.length() * (row.slip_bend - slip_before).norm());
}
// ANCHOR_END: close_ends

// Steps 1 and 2, with the rows' current right-hand sides.
bool PlanRows::solve() {
  fast = courses_.with(courses_.drift);
  gather(true);
  if (!push(fast)) return false;
  for (std::size_t r = 0; r < rows.size(); ++r) rows[r].impulse = impulses_[r];
  if (!correct()) {  // nothing to correct, or no room for all of it: gaps stay as they are
    path = fast;
    std::fill(corrections_.begin(), corrections_.end(), 0.0);
  }
  for (std::size_t r = 0; r < rows.size(); ++r) rows[r].correction = corrections_[r];
  return true;
}

bool PlanRows::correct() {
  const TimeInto time(times.corrections_ns);
  const double length = courses_.length();
  path = fast;
  corrections_.clear();
  bool short_of = false;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const PlanRow& row = rows[r];
    approach_limits_[r] = (row.contact.gap + row.bend - row.want) / length;
    corrections_.push_back(row.correction);
    if (lcp::contact_velocity(path, row.contact) + approach_limits_[r] < -kClosed * margin_ / length)
      short_of = true;
  }
  return corrects_ && short_of &&
         counts(law_.correct({path, numbers_, contacts_, bends_}, approach_limits_, corrections_, options_));
}

// Gathers the rows for the law: all of them, or those of contacts that last.
void PlanRows::gather(bool arrivals) {
  gathered_.clear();
  contacts_.clear();
  approach_limits_.clear();
  bends_.clear();
  impulses_.clear();
  for (PlanRow& row : rows) {
    if (row.arrives && !arrivals) continue;
    gathered_.push_back(&row);
    contacts_.push_back(row.contact);
    approach_limits_.push_back(
        std::max((row.contact.gap + row.bend - row.keep) / courses_.length(), -row.most_push));
    bends_.push_back(row.slip_bend);
    impulses_.push_back(row.impulse);
  }
  numbers_.clear();
  for (const Member& member : courses_.members) numbers_.push_back(member.number);
}

// Solves the gathered rows; the bodies get the velocities.
bool PlanRows::push(std::vector<RigidBody>& bodies) {
  const TimeInto time(times.solver_ns);
  return contacts_.empty() ||
         counts(law_.push({bodies, numbers_, contacts_, bends_}, approach_limits_, impulses_, options_));
}

bool PlanRows::counts(const IslandResult& result) {
  residual = std::max(residual, result.residual);
  ++solves;
  if (!result.solved) failed = result;
  return result.solved;
}

double PlanRows::bend(const PlanRow& row) const {
  return row.end_gap - row.contact.gap - courses_.length() * lcp::contact_velocity(path, row.contact);
}

double PlanRows::end_speed(const PlanRow& row, const std::vector<RigidBody>& bodies) const {
  const Path &path_a = courses_.paths[at(row.contact.body_a)],
             &path_b = courses_.paths[at(row.contact.body_b)];
  const RigidBody &a = bodies[at(row.contact.body_a)], &b = bodies[at(row.contact.body_b)];
  const Vec3 arm_a = row.point.on_a(path_a.end, path_b.end) - path_a.end.position,
             arm_b = row.point.on_b(path_a.end, path_b.end) - path_b.end.position;
  return row.point.normal_at(path_a.end, path_b.end)
      .dot(b.velocity + b.spin.cross(arm_b) - a.velocity - a.spin.cross(arm_a));
}

// How much larger the contact's slip is in the middle of the paths, with the poses and the point there.
Vec3 PlanRows::slip_bend(const PlanRow& row) const {
  const Path &path_a = courses_.paths[at(row.contact.body_a)],
             &path_b = courses_.paths[at(row.contact.body_b)];
  const double half = 0.5 * courses_.length();
  const Pose a = path_a.motion.pose_at(half), b = path_b.motion.pose_at(half);
  const RigidBody &of_a = fast[at(row.contact.body_a)], &of_b = fast[at(row.contact.body_b)];
  const Vec3 half_gap = 0.5 * row.point.gap_at(a, b) * row.point.normal_at(a, b);
  // The plane's own point stays behind while the other body's moves on.
  const Vec3 point =
      row.point.of_b ? Vec3(row.point.on_a(a, b) + half_gap) : Vec3(row.point.on_b(a, b) - half_gap);
  Vec3 slip = of_b.velocity - of_a.velocity;
  if (row.contact.turns_b) slip += of_b.spin.cross(point - b.position);
  if (row.contact.turns_a) slip -= of_a.spin.cross(point - a.position);
  const Vec3 bend = slip - lcp::relative_velocity(fast, row.contact);
  return bend - row.contact.normal.dot(bend) * row.contact.normal;
}

double PlanRows::holds_until() {
  gather(false);
  std::vector<RigidBody> now;
  for (const Member& member : courses_.members) now.push_back(member.state);
  return law_.holds_until({fast, numbers_, contacts_, bends_}, now, impulses_, courses_.length());
}

std::vector<RigidBody> PlanRows::without_arrivals() {
  bool any = false;
  for (PlanRow& row : rows) {
    row.early = row.impulse;
    any = any || (row.arrives && row.push() > 0);
  }
  if (!any) return fast;
  for (PlanRow& row : rows) row.early = Vec3::Zero();
  std::vector<RigidBody> bodies = courses_.with(courses_.drift);
  gather(false);
  if (push(bodies))
    for (std::size_t k = 0; k < gathered_.size(); ++k) gathered_[k]->early = impulses_[k];
  return bodies;
}

}  // namespace fc::resting
