#include "ch05_resting_contact/pile_rows.hpp"

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/impact.hpp"

namespace fc::resting {

// A member's, at the end.
Twist free_velocities(const Courses& courses, std::size_t i) {
  const Twist &mean = courses.drift[i], &more = courses.last[i];
  return {mean.linear + more.linear, mean.angular + more.angular};
}

bool are_slow(std::span<const Member> members, double speed) {
  double energy = 0, mass = 0;
  for (const Member& member : members) {
    energy += member.state.kinetic_energy();
    mass += member.state.mass;
  }
  return energy < 0.5 * mass * speed * speed;
}

void PileRows::start(const world::World& world) {
  rows_.clear();
  late_.clear();
  first_row_.clear();
  gauss_seidel_->clear();
  add_members();
  for (int i = 0; i < static_cast<int>(courses_.candidates.size()); ++i) {
    courses_.fetch_ahead(at(i));
    add_pair(world, i);
  }
}

// Adds the members that the sweeps do not know yet, and their pairs.
void PileRows::add_members() {
  for (std::size_t i = at(gauss_seidel_->bodies()); i < courses_.members.size(); ++i)
    gauss_seidel_->add_body(courses_.members[i].state, free_velocities(courses_, i), courses_.drift[i]);
  first_row_.resize(courses_.candidates.size(), -1);
}

lcp::Contact PileRows::contact_of(const world::World& world, const Row& row) const {
  const Candidate& pair = courses_.candidates[at(row.pair)];
  const Pose &a = courses_.paths[at(pair.a)].start, &b = courses_.paths[at(pair.b)].start;
  const ContactPoint& point = point_of(row);
  const Vec3 normal = point.normal_at(a, b), on_a = point.a.at(a, normal), on_b = point.b.at(b, -normal);
  return {pair.a,
          pair.b,
          0.5 * (on_a + on_b),
          normal,
          normal.dot(on_b - on_a),
          0,
          world.turns(courses_.members[at(pair.a)].number),
          world.turns(courses_.members[at(pair.b)].number)};
}

// All rows of a pair have been added, from `first` on.
void PileRows::end_pair(int candidate, int first) {
  if (first == count()) return;
  const PairContacts& pair = *courses_.candidates[at(candidate)].contacts;
  guesses_.clear();
  for (int i = first; i < count(); ++i)
    guesses_.push_back(rows_[at(i)].late ? Vec3(Vec3::Zero())
                                         : Vec3(courses_.length() * point_of(rows_[at(i)]).force));
  gauss_seidel_->end_pair(first, pair.a, pair.b, guesses_);
}

// Adds rows for the points that the pair has at the start. Most share one normal.
void PileRows::add_pair(const world::World& world, int candidate) {
  const Candidate& pair = courses_.candidates[at(candidate)];
  const std::vector<ContactPoint>& points = pair.contacts->points;
  if (points.empty()) return;
  const Pose &a = courses_.paths[at(pair.a)].start, &b = courses_.paths[at(pair.b)].start;
  lcp::Contact contact;
  contact.body_a = pair.a;
  contact.body_b = pair.b;
  contact.turns_a = world.turns(pair.contacts->a);
  contact.turns_b = world.turns(pair.contacts->b);
  const int first = count();
  for (std::size_t place = 0; place < points.size(); ++place) {
    const ContactPoint& point = points[place];
    const ContactPoint& last = points[place == 0 ? 0 : place - 1];
    if (place == 0 || point.balls || point.of_b != last.of_b || point.local_normal != last.local_normal)
      contact.normal = point.normal_at(a, b);
    const Vec3 on_a = point.a.at(a, contact.normal), on_b = point.b.at(b, -contact.normal);
    contact.point = 0.5 * (on_a + on_b);
    contact.gap = contact.normal.dot(on_b - on_a);
    add_row(contact, candidate, static_cast<int>(place), false);
  }
  end_pair(candidate, first);
}

int PileRows::add_row(const lcp::Contact& contact, int candidate, int place, bool late) {
  Row row{candidate, place, first_row_[at(candidate)], 0, late, late};
  const double margin = contacts_.margin(), length = courses_.length();
  row.arrives = late || contact.gap > margin;
  const double guess = late ? 0 : contact.normal.dot(point_of(row).force) * length;
  const int number =
      gauss_seidel_->add(contact, std::max(0.0, contact.gap - 0.5 * margin) / length,
                         (contact.gap - wanted_gap(contact.gap, margin)) / length, guess, 0.5 * guess);
  row.before = gauss_seidel_->start_speed(number);
  first_row_[at(candidate)] = number;
  rows_.push_back(row);
  return number;
}

// Renews the rows of a pair whose paths are not clear: with the gaps that it will have at the end, and with all points
// there.
void PileRows::look_again(const world::World& world, int candidate) {
  const Candidate pair = courses_.candidates[at(candidate)];
  const Path &a = courses_.paths[at(pair.a)], &b = courses_.paths[at(pair.b)];
  const double rest = 0.5 * contacts_.margin();
  const auto correct = [&](int row) {
    const double gap = point_of(rows_[at(row)]).gap_at(a.end, b.end);
    gauss_seidel_->set_room(row, (gap - rest) / courses_.length() - gauss_seidel_->path_speed(row));
  };
  for (int row = first_row_[at(candidate)]; row >= 0; row = rows_[at(row)].next) correct(row);
  double gap = 0;
  const int first = count();
  for (const ContactPoint& point : contacts_.points_at(world, *pair.contacts, a.end, b.end, gap)) {
    bool known = false;
    for (int row = first_row_[at(candidate)]; row >= 0 && !known; row = rows_[at(row)].next)
      known = point_of(rows_[at(row)]).is_same(point, contacts_.margin());
    if (known) continue;
    late_.push_back(point);
    const int place = static_cast<int>(late_.size()) - 1;
    correct(add_row(contact_of(world, {candidate, place, -1, 0, true, true}), candidate, place, true));
  }
  end_pair(candidate, first);
}

// An impulse at the end of a path needs a contact there: others are dropped.
int PileRows::drop_what_acts_on_air() {
  constexpr int kMostTimes = 3, kSweeps = 4;
  int swept = 0;
  for (int times = 0; times < kMostTimes; ++times) {
    bool any = false;
    for (int i = 0; i < count(); ++i) {
      const Row& row = rows_[at(i)];
      if (!row.arrives || !(gauss_seidel_->impulse(i) > 0)) continue;
      const Candidate& pair = courses_.candidates[at(row.pair)];
      const double gap = point_of(row).gap_at(courses_.paths[at(pair.a)].end, courses_.paths[at(pair.b)].end);
      if (gap <= contacts_.margin()) continue;
      gauss_seidel_->drop(i);
      any = true;
    }
    if (!any) break;
    if (times + 1 < kMostTimes) swept += gauss_seidel_->run_velocities(kSweeps);
  }
  return swept;
}

// What bounces gives back what its restitution says, with the largest common factor <= 1 for which this takes no more
// energy than the impulses gave (see impact_law.hpp).
void PileRows::give_back(const world::World& world, double rest_speed, std::vector<RigidBody>& bodies) {
  back_.assign(rows_.size(), 0);
  bool any = false;
  for (int i = 0; i < count(); ++i) {
    const Row& row = rows_[at(i)];
    const PairContacts& pair = *courses_.candidates[at(row.pair)].contacts;
    if (row.before >= -rest_speed || point_of(row).lasts) continue;
    back_[at(i)] = gauss_seidel_->impulse(i) * world.restitution_of(pair.a, pair.b);
    any = any || back_[at(i)] > 0;
  }
  if (!any) return;
  std::vector<RigidBody> bounced = bodies;
  for (int i = 0; i < count(); ++i)
    if (back_[at(i)] > 0) lcp::apply_impulse(bounced, contact_of(world, rows_[at(i)]), back_[at(i)]);
  double gave = 0, takes = 0;  // z'Az and r'Ar, from what the impulses do to the velocities
  for (int i = 0; i < count(); ++i) {
    const double z = gauss_seidel_->impulse(i);
    if (!(z > 0)) continue;
    const lcp::Contact contact = contact_of(world, rows_[at(i)]);
    const double end = lcp::contact_velocity(bodies, contact);
    gave += z * (end - rows_[at(i)].before);
    takes += back_[at(i)] * (lcp::contact_velocity(bounced, contact) - end);
  }
  const double cap = takes > gave ? std::sqrt(std::max(0.0, gave) / takes) : 1;
  for (int i = 0; i < count(); ++i) {
    back_[at(i)] *= cap;
    if (back_[at(i)] > 0) lcp::apply_impulse(bodies, contact_of(world, rows_[at(i)]), back_[at(i)]);
  }
}

// Stores guesses for the next plan, and which contacts last: all points of a pair, if one of them pushes.
void PileRows::remember() const {
  std::vector<char> pushes(courses_.candidates.size(), 0);
  for (int i = 0; i < count(); ++i)
    pushes[at(rows_[at(i)].pair)] |= gauss_seidel_->impulse(i) > 0 && !rows_[at(i)].arrives;
  for (int i = 0; i < count(); ++i) {
    const Row& row = rows_[at(i)];
    if (row.late) continue;
    ContactPoint& point = courses_.candidates[at(row.pair)].contacts->points[at(row.place)];
    point.force = gauss_seidel_->whole_impulse(i) / courses_.length();
    point.lasts = pushes[at(row.pair)] && !row.arrives;
  }
}

// Reports what the rows did. swept, bounced: the members at the end, before and after they give back.
void PileRows::report(const world::World& world, std::span<const RigidBody> swept,
                      std::span<const RigidBody> bounced, bool all, Planned& result) const {
  std::vector<Twist> without;
  for (std::size_t i = 0; i < courses_.members.size(); ++i) without.push_back(free_velocities(courses_, i));
  const std::vector<RigidBody> free = courses_.with(without);
  for (int i = 0; i < count(); ++i) {
    const Row& row = rows_[at(i)];
    const Candidate& pair = courses_.candidates[at(row.pair)];
    if (!(gauss_seidel_->impulse(i) > 0)) continue;
    PlannedRow reported;
    reported.contact = contact_of(world, row);
    reported.impulse = gauss_seidel_->whole_impulse(i);
    reported.back = back_[at(i)] * reported.contact.normal;
    if (world.is_moving_kinematic(pair.contacts->a) || world.is_moving_kinematic(pair.contacts->b))
      result.kinematic_work +=
          lcp::kinematic_work(swept, reported.contact, Vec3(reported.impulse + reported.back));
    if (!all) continue;
    reported.before = lcp::relative_velocity(free, reported.contact);
    reported.after = lcp::relative_velocity(bounced, reported.contact);
    reported.key = point_of(row).key;
    reported.patch = gauss_seidel_->patch_of(i);
    reported.arrives = row.arrives;
    if (row.arrives) {
      const Path &a = courses_.paths[at(pair.a)], &b = courses_.paths[at(pair.b)];
      reported.contact.gap = point_of(row).gap_at(a.end, b.end);
      reported.contact.point = point_of(row).middle(a.end, b.end);
    }
    reported.contact.body_a = pair.contacts->a;
    reported.contact.body_b = pair.contacts->b;
    result.rows.push_back(reported);
  }
}

}  // namespace fc::resting
