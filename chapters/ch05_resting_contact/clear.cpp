#include "ch05_resting_contact/clear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"
#include "ch03_impulse_lcp/solver.hpp"
#include "ch05_resting_contact/envelope.hpp"
#include "common/scene_failure.hpp"

namespace fc::resting {

using world::ContactKind;
using world::Listeners;
using world::World;

namespace {

constexpr int kMostBounces = 8;            // in one instant; then nothing bounces any more
constexpr int kMostRounds = 8;             // in which a plan's ends are measured again
constexpr int kMostProofs = 3;             // of one plan, each with more rows
constexpr double kClosed = 1e-6;           // of the margin: how exactly contacts close at a plan's end
constexpr double kShortest = 1.0 / 65536;  // of a frame: no plan is shorter
// Of what a gap lacks of the rest gap, so much is put right in a plan; and gaps below this part of the margin at once.
constexpr double kCorrect = 0.2, kLeastGap = 0.25;

std::vector<RigidBody> states_of(const std::vector<Member>& members) {
  std::vector<RigidBody> states;
  for (const Member& member : members) states.push_back(member.state);
  return states;
}

// Faster than round-off.
bool anything_closes(const std::vector<RigidBody>& bodies, const std::vector<lcp::Contact>& contacts) {
  const double rounding = lcp::approach_rounding(bodies, contacts);
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const lcp::Contact& c) { return lcp::contact_velocity(bodies, c) < -rounding; });
}

void apply(std::vector<RigidBody>& bodies, const std::vector<lcp::Contact>& contacts, const VecX& impulses) {
  for (int i = 0; i < std::ssize(contacts); ++i)
    if (const double z = impulses[i]; z > 0) lcp::apply_impulse(bodies, contacts[i], z);
}

// Chapter 3's problem with another right-hand side, solved by its Dantzig: impulses z >= 0 after which contact i closes with
// no more than room_i (m/s), and which act only where it closes with just that. No solution: velocities stay, and z is 0.
bool push(std::vector<RigidBody>& bodies, const std::vector<lcp::Contact>& contacts, const VecX& room,
          VecX& z) {
  z = VecX::Zero(room.size());
  if (contacts.empty()) return true;
  const lcp::ImpactProblem problem = lcp::assemble(bodies, contacts);
  const VecX b = problem.v_before + room;
  const lcp::LcpResult result = lcp::solve({problem.A, b});
  if (result.status != lcp::Status::solved) return false;
  z = result.z;
  apply(bodies, contacts, z);
  return true;
}

// What impulses did between two sets of velocities, for listeners: bodies by their numbers in the world.
std::vector<world::ImpactRecord> records_of(const std::vector<Member>& members,
                                            const std::vector<RigidBody>& before,
                                            const std::vector<RigidBody>& after,
                                            const std::vector<lcp::Contact>& contacts, const VecX& impulses,
                                            double time, ContactKind kind) {
  std::vector<world::ImpactRecord> records;
  for (int i = 0; i < std::ssize(contacts); ++i) {
    if (!(impulses[i] > 0)) continue;
    const double v_before = lcp::contact_velocity(before, contacts[i]),
                 v_after = lcp::contact_velocity(after, contacts[i]);
    records.push_back({time, contacts[i], {i, 0, v_before, v_after, impulses[i]}, kind});
    for (int* body : {&records.back().contact.body_a, &records.back().contact.body_b})
      *body = members[*body].number;
  }
  return records;
}

SceneFailure failure(const char* what, int rows) {
  return SceneFailure(
      fmt::format("{} contacts that belong together {}; shorten step.dt, or take less unequal masses", rows,
                  what),
      "envelope");
}

// The points of an island that are in contact.
struct Touching {
  std::vector<lcp::Contact> contacts;  // bodies by their places among the members
  VecX restitution;
  std::vector<int> lasting;  // those at which a plan has pushed up to now
  double fastest =
      0;  // m/s: how fast the fastest comes in (< 0) of those at which no plan has pushed up to now
};

Touching touching(const World& world, const Island& island, const std::vector<RigidBody>& bodies,
                  double margin) {
  Touching result;
  std::vector<double> e;
  for (const IslandPair& pair : island.pairs)
    for (const ContactPoint& point : pair.contacts->points) {
      const lcp::Contact contact = contact_at(world, island.members, bodies, pair.a, pair.b, point);
      if (contact.gap > margin) continue;
      result.contacts.push_back(contact);
      e.push_back(world.restitution_of(pair.contacts->a, pair.contacts->b));
      if (point.lasts)
        result.lasting.push_back(static_cast<int>(e.size()) - 1);
      else
        result.fastest = std::min(result.fastest, lcp::contact_velocity(bodies, contact));
    }
  result.restitution = Eigen::Map<const VecX>(e.data(), std::ssize(e));
  return result;
}

}  // namespace

// A plan in the making: of an island, and of all that no impulse moves.
struct ClearDraft {
  // A point at which two members push, and what is known of its gap at the plan's end.
  struct Row {
    PairContacts* pair;
    ContactPoint point;
    double keep, want;  // m, what velocities must leave of it, and what paths must
    double bend = 0;    // m, by which it differs from its first order
    double taken = std::numeric_limits<double>::infinity();  // m/s: so fast the point closes there
    double end = 0;                                          // m
  };
  const World& world;
  Contacts& contacts;
  double now, length;  // s
  std::vector<Member> members;
  std::vector<RigidBody> mean, fast, path, ends;  // with velocities u, w, and y; at the end of y, with w
  std::vector<Path> paths;                        // along y
  std::vector<char> planned;                      // of each member: it is pushed, or ends in contact
  std::vector<Row> rows;
  std::vector<lcp::Contact> starts;  // of the rows, now; bodies by their places among the members
  int proofs = 0;                    // up to now
  std::ptrdiff_t known = 0;          // rows, at the last of them
  VecX z, c;                         // N s, of the rows: impulses, and those of corrections

  ClearDraft(const World& world_, Contacts& contacts_, const Island& island, double now_, double length_);
  void add_row(PairContacts& pair, int a, int b, const ContactPoint& point, double gap);
  VecX room(bool correcting) const;
  void follow_paths();
  double measure(int number);
  bool is_clear(int i, int j);

  bool has_new_rows();
  bool close_ends();
  bool prove();
};

ClearDraft::ClearDraft(const World& world_, Contacts& contacts_, const Island& island, double now_,
                       double length_)
    : world(world_), contacts(contacts_), now(now_), length(length_), members(island.members) {
  const auto is_member = [&](int body) {
    return std::any_of(members.begin(), members.end(), [&](const Member& m) { return m.number == body; });
  };
  for (int body = 0; body < std::ssize(world.bodies); ++body)
    if (!world.is_dynamic(body) && !is_member(body))
      members.push_back({body, world.state_at(body, now), false});
  mean = states_of(members);
  for (int i = 0; i < std::ssize(members); ++i) {
    if (members[i].dynamic && world.effects.gravity)
      mean[i].velocity += 0.5 * length * world.gravity_on(mean[i]);
    paths.push_back(path_of(world, members[i].number, now, length));
  }
  for (const IslandPair& pair : island.pairs)
    for (const ContactPoint& point : pair.contacts->points)
      add_row(*pair.contacts, pair.a, pair.b, point,
              contact_at(world, members, mean, pair.a, pair.b, point).gap);
}

void ClearDraft::add_row(PairContacts& pair, int a, int b, const ContactPoint& point, double gap) {
  const double rest = 0.5 * contacts.margin(), keep = std::min(gap, rest);
  rows.push_back(
      {&pair, point, keep, std::max(keep + kCorrect * (rest - keep), kLeastGap * contacts.margin())});
  starts.push_back(contact_at(world, members, mean, a, b, point));
}

// What each row may lose of its gap per second: for velocities, or for paths. A velocity is made to part by no more than the
// speed that the plan's end takes back: else it would be energy from nowhere.
VecX ClearDraft::room(bool correcting) const {
  VecX room(rows.size());
  for (int i = 0; i < std::ssize(rows); ++i) {
    const double spare = (starts[i].gap + rows[i].bend - (correcting ? rows[i].want : rows[i].keep)) / length;
    room[i] = correcting ? spare : std::max(spare, -rows[i].taken);
  }
  return room;
}

// Where the bodies stand at the end.
void ClearDraft::follow_paths() {
  ends = fast;
  for (int i = 0; i < std::ssize(members); ++i) {
    Path& t = paths[i];
    if (members[i].dynamic)
      t = straight_path(members[i].state, path[i].velocity, path[i].spin, t.reach, length);
    ends[i].position = t.end.position;
    ends[i].orientation = Quat(t.end.rotation);
  }
}

// Looks at a row's gap at the end. Returns by how much its bend was wrong (m).
double ClearDraft::measure(int number) {
  Row& row = rows[number];
  const lcp::Contact& start = starts[number];
  const lcp::Contact end = contact_at(world, members, ends, start.body_a, start.body_b, row.point);
  const double bend = end.gap - start.gap - length * lcp::contact_velocity(path, start);
  row.end = end.gap;
  row.taken = std::max(0.0, -lcp::contact_velocity(ends, end));
  return std::abs(std::exchange(row.bend, bend) - bend);
}

// Whether it is worth while to close the ends: for the first time, or again.
bool ClearDraft::has_new_rows() {
  return ++proofs <= kMostProofs && std::ssize(rows) > std::exchange(known, std::ssize(rows));
}

// Chapter 4's gap rule for a pair on its paths in the plan: it keeps half of its gap, or of the rest gap.
bool ClearDraft::is_clear(int i, int j) {
  PairContacts& pair = contacts.pair(members[i].number, members[j].number);
  if (pair.a != members[i].number) std::swap(i, j);
  const Path &a = paths[i], &b = paths[j];
  contacts.update(world, pair, a.start, b.start);
  const double rounding = ca::rounding_term(world.model_of(pair.a).whole(), world.model_of(pair.b).whole(),
                                            ca::PairPose(a.start, b.start));
  const double required_gap = 0.5 * std::min(pair.gap, 0.5 * contacts.margin()) - 64 * rounding;
  if (check_path(world, contacts, pair, a, b, length, {.required_gap = required_gap}).clear) return true;
  double gap = 0;
  if (pair.gap > contacts.margin()) return false;
  for (const ContactPoint& point : contacts.points_at(world, pair, a.end, b.end, gap)) {
    add_row(pair, i, j, point, pair.gap);
    measure(static_cast<int>(rows.size()) - 1);
  }
  return false;
}

// Points at which a plan pushes are marked: that they close at its end is the other half of their force, and no impact.
void remember(const ClearDraft& draft) {
  for (const bool mark : {false, true})
    for (int i = 0; i < std::ssize(draft.rows); ++i)
      for (ContactPoint& point : draft.rows[i].pair->points)
        if (!mark || (point.key == draft.rows[i].point.key && draft.z[i] > 0)) point.lasts = mark;
}

ClearResting::ClearResting(const Scene& scene, World& world, double dt)
    : contacts_(world, envelope_of(scene, world, dt)),
      islands_(contacts_, world.bodies.size()),
      no_piles_(world.bodies.size(), -1),
      frame_(dt),
      dt_(dt) {
  const bool all_convex =
      std::all_of(world.shapes.begin(), world.shapes.end(), [](const Shape& s) { return s.convex(); });
  if (!all_convex || world.effects.drag || world.effects.sleep || world.effects.sensors ||
      world.effects.gyroscopic)
    throw InputError(scene.mark("envelope").value_or(SourceMark{scene.file.string()}),
                     "the clear version knows only convex bodies and gravity; take Resting");
  world.rest_gap = 0.5 * envelope();
}

ClearReport ClearResting::step(World& world, const Listeners& listeners) {
  report_ = {};
  contacts_.next_frame();
  const world::StepReport report = world::step_with(*this, world, frame_, listeners);
  report_.step = report;
  return report_;
}

// When a frame begins, a plan ends, or two bodies meet: whom that concerns goes on from there.
std::vector<int> ClearResting::begin(World& world, double dt, world::StepReport&,
                                     const Listeners& listeners) {
  dt_ = dt;
  listeners_ = &listeners;
  plans_.clear();
  std::vector<int> bodies;
  for (int body = 0; body < std::ssize(world.bodies); ++body)
    if (world.is_dynamic(body)) bodies.push_back(body);
  return go_on(world, bodies, 0);
}

double ClearResting::next_end() const {
  double first = std::numeric_limits<double>::infinity();
  for (const Plan& plan : plans_)
    if (plan.runs) first = std::min(first, plan.end);
  return first;
}

std::vector<int> ClearResting::end_plans(World& world, double now, world::StepReport&,
                                         const Listeners& listeners) {
  listeners_ = &listeners;
  std::vector<int> bodies;
  for (const Plan& plan : plans_)
    if (plan.runs && plan.end <= now) bodies.insert(bodies.end(), plan.bodies.begin(), plan.bodies.end());
  return go_on(world, bodies, now);
}

std::vector<int> ClearResting::meet(World& world, int a, int b, double now, world::StepReport&,
                                    const Listeners& listeners) {
  listeners_ = &listeners;
  std::vector<int> bodies;
  for (const int body : {a, b})
    if (world.is_dynamic(body)) bodies.push_back(body);
  return go_on(world, bodies, now);
}

void ClearResting::report_impulses(const std::vector<world::ImpactRecord>& records, double share) {
  for (world::ImpactRecord record : records) {
    record.impulse.impulse *= share;
    if (share > 0 && listeners_->impact) listeners_->impact(record);
  }
}

// ANCHOR: clear
// An instant: the plans that it touches end, in each island nothing may close any more, and then the island gets a plan.
std::vector<int> ClearResting::go_on(World& world, std::vector<int> bodies, double now) {
  islands_.begin(now);
  std::vector<int> changed;
  for (int i = 0; i < std::ssize(bodies); ++i) {  // the list grows
    if (islands_.is_in_island(bodies[i])) continue;
    Island island = islands_.grow(world, bodies[i], no_piles_);
    for (Member& member : island.members) {
      if (!member.dynamic) continue;
      end_plan_of(world, member.number, now, bodies);
      world.advance_to(member.number, now, now);
      member.state = world.bodies[member.number].state;
      changed.push_back(member.number);
    }
    stop_what_closes(world, island, now);
    for (const Member& member : island.members)
      if (member.dynamic) world.set_motion(member.number, member.state, now);
    if (!island.pairs.empty() && now < dt_) plan(world, island, now);
  }
  return now < dt_ ? changed : std::vector<int>{};
}

// All bodies of the plan stand where they are now; gravity and impulses have acted for their share of the time.
void ClearResting::end_plan_of(World& world, int body, double now, std::vector<int>& bodies) {
  const int number = world.bodies[body].plan.number;
  if (number < 0) return;
  Plan& plan = plans_[number];
  for (const int member : plan.bodies) {
    world.advance_to(member, now, now);
    world.bodies[member].plan = {};
    bodies.push_back(member);
  }
  const double share = (now - plan.start) / (plan.end - plan.start);
  report_impulses(plan.records, share);
  report_.correction_energy += share * plan.lift;
  plan.runs = false;
}

// The instant's law. First what lasts stops: that it closes is the other half of the plan's force. Then (Poisson) a compression
// stops all that closes; if something came in fast, an expansion gives back the part e of each impulse, but never more energy
// than the compression took.
void ClearResting::stop_what_closes(const World& world, Island& island, double now) {
  const std::vector<RigidBody> before = states_of(island.members);
  const auto [contacts, restitution, lasting, fastest] = touching(world, island, before, envelope());
  const bool impact = fastest < -envelope() / dt_;
  std::vector<RigidBody> bodies = before;
  VecX z, total = VecX::Zero(contacts.size());
  std::vector<lcp::Contact> last;
  for (const int i : lasting) last.push_back(contacts[i]);
  if (!push(bodies, last, VecX::Zero(last.size()), z)) throw failure("cannot be stopped", island.points());
  total(lasting) = z;
  for (int round = 1; round <= kMostBounces && anything_closes(bodies, contacts); ++round) {
    if (!push(bodies, contacts, VecX::Zero(contacts.size()), z))
      throw failure("cannot be stopped", island.points());
    total += z;
    if (!impact || round == kMostBounces) continue;
    const MatX A = lcp::assemble(bodies, contacts).A;
    const VecX r = restitution.cwiseProduct(z);
    const double gave = z.dot(A * z), takes = r.dot(A * r), k = takes > gave ? std::sqrt(gave / takes) : 1;
    apply(bodies, contacts, k * r);
    total += k * r;
  }
  const auto kind = impact ? ContactKind::impact : ContactKind::rest;
  report_impulses(records_of(island.members, before, bodies, contacts, total, now, kind), 1);
  for (int i = 0; i < std::ssize(bodies); ++i) island.members[i].state = bodies[i];
}

// Pushes (u becomes w) and corrects (w becomes y), until the gaps at the end are what the rows say: a chord method.
bool ClearDraft::close_ends() {
  for (int round = 0; round < kMostRounds; ++round) {
    fast = mean;
    if (!push(fast, starts, room(false), z)) return false;
    path = fast;
    push(path, starts, room(true), c);  // where there is no room for corrections, gaps stay as they are
    follow_paths();
    double worst = 0;
    for (int i = 0; i < std::ssize(rows); ++i) {
      worst = std::max(worst, measure(i));
      if (z[i] > 0)
        worst = std::max(worst, length * (lcp::contact_velocity(fast, starts[i]) - rows[i].taken));
    }
    if (worst <= kClosed * contacts.margin()) return true;
  }
  return false;
}

// Whether all that push are in contact, at both ends, and all paths are clear of each other. The points that a pair has at
// the end of paths that are not clear become rows.
bool ClearDraft::prove() {
  planned.assign(members.size(), 0);
  for (int i = 0; i < std::ssize(rows); ++i) {
    const bool pushes = z[i] > 0 || c[i] > 0;
    if (pushes && std::max(starts[i].gap, rows[i].end) > contacts.margin()) return false;
    for (const int member : {starts[i].body_a, starts[i].body_b})
      if (pushes || rows[i].end < contacts.margin()) planned[member] = members[member].dynamic;
  }
  bool clear = true;
  for (int i = 0; i < std::ssize(members); ++i)
    for (int j = 0; j < i; ++j)
      if ((members[i].dynamic || members[j].dynamic) && !is_clear(i, j)) clear = false;
  return clear;
}

// A plan for the island: to the frame's end, or half as long, and so on, until its paths are proved.
void ClearResting::plan(World& world, const Island& island, double now) {
  for (double length = dt_ - now; length > kShortest * (dt_ - now); length *= 0.5) {
    ClearDraft draft(world, contacts_, island, now, length);
    while (draft.has_new_rows() && draft.close_ends())
      if (draft.prove()) return follow(world, draft);
    ++report_.halved;
  }
  throw failure("have no plan that can be proved", island.points());
}

// Planned bodies go straight on with y, while their velocities change evenly from v to w and the other half of gravity. The
// others fly.
void ClearResting::follow(World& world, const ClearDraft& draft) {
  const double length = draft.length;
  Plan plan{draft.now, length == dt_ - draft.now ? dt_ : draft.now + length};
  for (int i = 0; i < std::ssize(draft.members); ++i) {
    if (!draft.planned[i]) continue;
    const RigidBody &v = draft.members[i].state, &u = draft.mean[i], &w = draft.fast[i], &y = draft.path[i];
    const Vec3 half = u.velocity - v.velocity;
    world.bodies[draft.members[i].number].plan = {static_cast<int>(plans_.size()), y.velocity, y.spin,
                                                  (w.velocity + half - v.velocity) / length,
                                                  (w.spin - v.spin) / length};
    plan.bodies.push_back(draft.members[i].number);
    plan.lift -= v.mass * 2 * half.dot(y.velocity - w.velocity);
  }
  plan.records =
      records_of(draft.members, draft.mean, draft.fast, draft.starts, draft.z, draft.now, ContactKind::rest);
  remember(draft);
  if (!plan.bodies.empty()) plans_.push_back(plan);
  ++report_.plans;
}
// ANCHOR_END: clear

}  // namespace fc::resting
