// Caught by: Ex06Hopping.ABoxBouncesAndRests
// Without restitution nothing hops.
#include "ex06_hopping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ch03_impulse_lcp/solver.hpp"

namespace fc::exercises {
namespace {

constexpr int kMostBounces = 8;  // in one instant; then nothing bounces any more
// A plan makes up this part of what a gap lacks to h/2; and at once what it lacks to this part of h.
constexpr double kCorrect = 0.2, kLeastGap = 0.25;
constexpr double kRounding = 1e-12;  // of the largest speed: nothing closes as slowly as that
constexpr double kNever = std::numeric_limits<double>::infinity();

// Contacts, each by the number of the box above it.
using Rows = std::vector<int>;

VecX velocities_of(const Pile& pile) {
  VecX v(std::ssize(pile.boxes));
  for (int i = 0; i < v.size(); ++i) v[i] = pile.boxes[i].velocity;
  return v;
}

// J v: how fast each gap grows, m/s.
VecX opening(const Rows& rows, const VecX& v) {
  VecX speeds(std::ssize(rows));
  for (int k = 0; k < speeds.size(); ++k) speeds[k] = v[rows[k]] - (rows[k] > 0 ? v[rows[k] - 1] : 0);
  return speeds;
}

// v + M^-1 J' z: pushes of z (N s) act on the box above, and on the one below.
void apply(const Pile& pile, const Rows& rows, const VecX& z, VecX& v) {
  for (int k = 0; k < z.size(); ++k) {
    const int above = rows[k], below = above - 1;
    v[above] += z[k] / pile.boxes[above].mass;
    if (below >= 0) v[below] -= z[k] / pile.boxes[below].mass;
  }
}

// A = J M^-1 J', column by column: what 1 N s at one contact does to all of them.
MatX delassus(const Pile& pile, const Rows& rows) {
  const auto n = std::ssize(rows);
  MatX A(n, n);
  for (int k = 0; k < n; ++k) {
    VecX v = VecX::Zero(std::ssize(pile.boxes));
    apply(pile, rows, VecX::Unit(n, k), v);
    A.col(k) = opening(rows, v);
  }
  return A;
}

// Changes v by impulses z >= 0 (N s) after which gap k shrinks with no more than room_k (m/s), and which act
// only where it shrinks with just that. In a pile there is always one such z.
VecX push(const Pile& pile, const Rows& rows, const VecX& room, VecX& v) {
  if (rows.empty()) return VecX(0);
  const VecX z = lcp::solve({delassus(pile, rows), opening(rows, v) + room}).z;
  apply(pile, rows, z, v);
  return z;
}

Rows contacts_of(const Pile& pile) {
  Rows rows;
  for (int i = 0; i < std::ssize(pile.boxes); ++i)
    if (gap_below(pile, i) <= pile.envelope) rows.push_back(i);
  return rows;
}

// The contacts of each island: of boxes that follow each other without a wide gap.
std::vector<Rows> islands_of(const Pile& pile) {
  std::vector<Rows> islands;
  for (const int row : contacts_of(pile)) {
    if (islands.empty() || islands.back().back() != row - 1) islands.emplace_back();
    islands.back().push_back(row);
  }
  return islands;
}

struct Plan {
  double length = 0;             // s
  Rows rows;                     // the contacts at which it may push
  VecX z, gaps;                  // N s and m, of the rows: the push, and the gaps at its start
  VecX w, path;                  // m/s: velocities with the push, and with corrections
  std::vector<char> planned;     // of each box: it goes by the plan; the others fly
  std::vector<char> has_pushed;  // of each box: the contact below it
};

Plan plan_of(const Pile& pile, double length) {
  const std::size_t boxes = pile.boxes.size();
  Plan plan;
  plan.length = length;
  plan.rows = contacts_of(pile);
  plan.planned.assign(boxes, 0);
  plan.has_pushed.assign(boxes, 0);
  const double h = pile.envelope, rest = 0.5 * h;
  const auto n = std::ssize(plan.rows);
  VecX room(n), room_of_path(n);
  plan.gaps.resize(n);
  for (int k = 0; k < n; ++k) {
    const int above = plan.rows[k];
    const double gap = gap_below(pile, above), keep = std::min(gap, rest);
    const double want = std::max(keep + kCorrect * (rest - keep), kLeastGap * h);
    plan.gaps[k] = gap;
    room[k] = (gap - keep) / length;
    room_of_path[k] = (gap - want) / length;
    plan.planned[above] = 1;
    if (above > 0) plan.planned[above - 1] = 1;
  }
  plan.w = velocities_of(pile).array() - 0.5 * length * pile.gravity;
  plan.z = push(pile, plan.rows, room, plan.w);
  plan.path = plan.w;
  push(pile, plan.rows, room_of_path, plan.path);
  for (int k = 0; k < n; ++k) plan.has_pushed[plan.rows[k]] = plan.z[k] > 0;
  return plan;
}

// How a box goes on: after t seconds it is speed t - fall t^2 / 2 higher.
struct Course {
  double speed = 0, fall = 0;  // m/s, m/s^2
};

// When two boxes meet, or a box and the floor: s from now, or never.
double first_meeting(const Pile& pile, const Plan& plan) {
  const auto course_of = [&](int box) {
    if (box < 0) return Course{};
    return plan.planned[box] ? Course{plan.path[box], 0} : Course{pile.boxes[box].velocity, pile.gravity};
  };
  double first = kNever;
  for (int i = 0; i < std::ssize(pile.boxes); ++i) {
    if (std::find(plan.rows.begin(), plan.rows.end(), i) != plan.rows.end())
      continue;  // the plan keeps it open
    const Course below = course_of(i - 1), above = course_of(i);
    const double speed = above.speed - below.speed, fall = above.fall - below.fall;
    // gap + speed t - fall t^2 / 2 = h/4, in the form in which no digits cancel while it closes.
    const double left = gap_below(pile, i) - 0.25 * pile.envelope, square = speed * speed + 2 * fall * left;
    const double divisor = square >= 0 ? std::sqrt(square) - speed : 0;
    if (divisor > 0) first = std::min(first, 2 * left / divisor);
  }
  return first;
}

// All boxes go on for t seconds, at most the plan's length. A plan that is cut has given its share.
void follow(Pile& pile, const Plan& plan, double now, double t, Report& report) {
  const double share = t / plan.length;
  for (int i = 0; i < std::ssize(pile.boxes); ++i) {
    Box& box = pile.boxes[i];
    if (plan.planned[i]) {
      const double end = plan.w[i] - 0.5 * plan.length * pile.gravity;
      box.bottom += t * plan.path[i];
      box.velocity += share * (end - box.velocity);
      report.lifted += box.mass * pile.gravity * t * (plan.path[i] - plan.w[i]);
    } else {
      box.bottom += t * (box.velocity - 0.5 * t * pile.gravity);
      box.velocity -= t * pile.gravity;
    }
  }
  for (int k = 0; k < std::ssize(plan.rows); ++k)
    if (const int row = plan.rows[k]; plan.z[k] > 0)
      report.impulses.push_back({row, share * plan.z[k], now, std::max(plan.gaps[k], gap_below(pile, row))});
}

// The instant's law, for the contacts of an island.
void stop(Pile& pile, const Rows& rows, const std::vector<char>& has_pushed, double now, double dt,
          Report& report) {
  VecX v = velocities_of(pile), total = VecX::Zero(std::ssize(rows));
  const double rounding = kRounding * v.cwiseAbs().maxCoeff();
  VecX restitution(total.size());
  const VecX before = opening(rows, v);
  Rows lasting;
  std::vector<int> places;
  bool impact = false;
  for (int k = 0; k < total.size(); ++k) {
    restitution[k] = 0;
    if (!has_pushed[rows[k]]) {
      impact = impact || before[k] < -pile.envelope / dt;
    } else {
      lasting.push_back(rows[k]);
      places.push_back(k);
    }
  }
  // That a lasting contact closes is the other half of its force: no blow, and nothing to give back.
  total(places) += push(pile, lasting, VecX::Zero(std::ssize(lasting)), v);
  for (int round = 1; round <= kMostBounces && opening(rows, v).minCoeff() < -rounding; ++round) {
    const VecX z = push(pile, rows, VecX::Zero(total.size()), v);
    total += z;
    if (!impact || round == kMostBounces) continue;
    const VecX r = restitution.cwiseProduct(z);
    const MatX A = delassus(pile, rows);
    const double gave = z.dot(A * z), takes = r.dot(A * r), k = takes > gave ? std::sqrt(gave / takes) : 1;
    apply(pile, rows, k * r, v);
    total += k * r;
  }
  for (int i = 0; i < v.size(); ++i) pile.boxes[i].velocity = v[i];
  for (int k = 0; k < total.size(); ++k)
    if (total[k] > 0) report.impulses.push_back({rows[k], total[k], now, gap_below(pile, rows[k])});
}

}  // namespace

double gap_below(const Pile& pile, int box) {
  const double below = box > 0 ? pile.boxes[box - 1].bottom + pile.boxes[box - 1].height : 0;
  return pile.boxes[box].bottom - below;
}

Report step(Pile& pile, double dt) {
  Report report;
  std::vector<char> has_pushed(pile.boxes.size(), 0);
  for (double now = 0;;) {
    for (const Rows& island : islands_of(pile)) stop(pile, island, has_pushed, now, dt, report);
    if (now >= dt) return report;
    const Plan plan = plan_of(pile, dt - now);
    const double meeting = first_meeting(pile, plan);
    const bool is_cut = meeting < plan.length;
    follow(pile, plan, now, is_cut ? meeting : plan.length, report);
    report.cut += is_cut;
    now = is_cut ? now + meeting : dt;
    has_pushed = plan.has_pushed;
  }
}

}  // namespace fc::exercises
