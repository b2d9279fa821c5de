#include "ch06_friction/coulomb_law.hpp"

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"

namespace fc::friction {
namespace {

using resting::at;

// Sweeps go on until impulses change by less than this share of the largest velocity.
constexpr double kTolerance = 1e-14;

// Sweeps and solves of all contacts at once, by turns: the residual with which each turn is content, for few contacts
// (the first number) and for more. Solves of all at once aim at kWanted.
struct Turn {
  int sweeps;
  double enough_of_few, enough;
};
constexpr Turn kTurns[] = {{40, 1e-12, 1e-10}, {100, 1e-10, 1e-9}, {400, 1e-8, 1e-8}};
// kWanted for kOneWanted contacts, and in proportion for more. From kMany contacts on, where each solve takes long, there is one
// turn, which is content with kLoosely times as much.
constexpr double kWanted = 1e-12, kOneWanted = 100, kLoosely = 10;
constexpr std::size_t kMany = 600;
// Of all impulses on a body that should cancel, the part that is round-off: see ContactLaw::left(). Of many contacts more.
constexpr double kLeft = 6e-11, kLeftOfMany = 2e-10;
constexpr int kRounds = 20;
// The residual may be this share of the speed that counts as standing still.
constexpr double kOfStill = 0.1;

// Up to kFewest contacts Newton's method runs on their impulses; up to kFew, all methods run in the end; up to
// kFewSlips, plans end where a slip ends.
constexpr int kFewest = 12, kFew = 32, kFewSlips = 16;
// Above these residuals an island counts as not solved: with few contacts, and with more.
constexpr double kAcceptedOfFew = 1e-6, kAccepted = 1e-4;

// The work that a frame may take: see event_work(). Counted in visits to contacts, some 5 ms for each body, and much
// more for few bodies, which should be exact.
constexpr double kOfStanding = 15, kOfArrival = 30, kOfIsland = 3e6, kOfBody = 3e4;
// In visits: a dense Newton step, for each contact; and a pivot.
constexpr double kOfNewton = 15, kOfPivot = 3;

constexpr int kManySweeps = 600, kSweepsHeld = 100;
constexpr double kHeld = 1e-8;  // of the largest velocity, for corrections

// A contact inside its cone by more than this share of it sticks.
constexpr double kSticking = 1e-9;

// A plan does not end where a slip ends before the first of these shares of it, or after the second.
constexpr double kShortest = 1.0 / 2048, kNearlyAll = 0.99;
// m: a slip over a shorter path has ended; a slip that keeps less than this share of its speed at the middle of the
// plan has stopped.
constexpr double kNoPath = 1e-10, kStopped = 1e-9;

Vec3 along_surface(const Vec3& normal, const Vec3& v) {
  return v - normal.dot(v) * normal;
}

}  // namespace

bool asks_for_friction(const Scene& scene) {
  if (scene.friction.value_or(0) > 0) return true;
  const auto rubs = [](const auto& spec) { return spec.friction.value_or(0) > 0; };
  return std::any_of(scene.shapes.begin(), scene.shapes.end(), rubs) ||
         std::any_of(scene.pairs.begin(), scene.pairs.end(), rubs);
}

CoulombLaw::CoulombLaw(world::World& world) : world_(world), left_(kLeft) {
  world.effects.arms = true;
}

double CoulombLaw::mu(const ContactSet& set, const lcp::Contact& contact) const {
  const auto shape = [&](int body) { return world_.bodies[at(set.numbers[at(body)])].shape; };
  return world_.pair_rules.friction(world_.shapes, shape(contact.body_a), shape(contact.body_b));
}

bool CoulombLaw::rubs(const ContactSet& set) {
  mu_.clear();
  for (const lcp::Contact& contact : set.contacts) mu_.push_back(mu(set, contact));
  return std::any_of(mu_.begin(), mu_.end(), [](double m) { return m > 0; });
}

void CoulombLaw::start(const ContactSet& set, std::span<const Vec3> offsets, std::span<const Vec3> impulses,
                       double still) {
  sweeps_.start(set.bodies, kOfStill * still / kTurns[0].enough);
  for (std::size_t i = 0; i < set.contacts.size(); ++i)
    sweeps_.add(set.contacts[i], mu_[i], offsets[i], impulses[i]);
}

// ANCHOR: push
IslandResult CoulombLaw::push(const ContactSet& set, std::span<const double> limits, std::span<Vec3> impulses,
                              const IslandOptions& options) {
  holds_.assign(set.contacts.size(), 0);
  if (!rubs(set)) return NormalLaw::push(set, limits, impulses, options);
  offsets_.clear();
  for (std::size_t i = 0; i < limits.size(); ++i)
    offsets_.push_back(limits[i] * set.contacts[i].normal +
                       (set.bends.empty() ? Vec3(Vec3::Zero()) : set.bends[i]));
  IslandResult result;
  result.residual = std::numeric_limits<double>::infinity();
  const std::size_t count = set.contacts.size();
  const double loosely = count < kMany ? 1 : kLoosely;
  const double wanted = count < kMany ? kWanted * std::max(1.0, static_cast<double>(count) / kOneWanted)
                                      : loosely * kTurns[0].enough;
  left_ = count < kMany ? kLeft : kLeftOfMany;
  const double accepted = count <= kFew ? kAcceptedOfFew : kAccepted;
  start(set, offsets_, impulses, options.still);
  double& left = result.residual;
  const auto take = [&](double residual) {
    if (residual > left) return;
    left = residual;
    for (std::size_t i = 0; i < count; ++i) impulses[i] = sweeps_.impulse(static_cast<int>(i));
  };
  if (count > kFew) take(sweeps_.run(0, kTolerance));  // the guess may be good enough
  for (const Turn& turn : kTurns) {  // what one method has reached is a new start for the other
    const double enough = count > kFewest ? loosely * turn.enough : turn.enough_of_few;
    if (left <= enough) break;
    take(sweeps_.run(turn.sweeps, kTolerance));
    if (left > enough && count <= kFewest) solve_by_matrix(set, Method::newton, impulses, result);
    if (left > enough) take(sweeps_.run_together(kRounds, wanted));
    if (left <= enough || count >= kMany) break;
  }
  work_ += sweeps_.take_work();
  if (left > accepted && count <= kFew) solve_by_matrix(set, Method::combined, impulses, result);
  result.solved = left <= accepted;
  if (!result.solved) return result;
  result.status = lcp::Status::solved;
  for (std::size_t i = 0; i < impulses.size(); ++i) {
    lcp::apply_impulse(set.bodies, set.contacts[i], impulses[i]);
    const double normal = impulses[i].dot(set.contacts[i].normal);
    holds_[i] = normal > 0 &&
                along_surface(set.contacts[i].normal, impulses[i]).norm() < (1 - kSticking) * mu_[i] * normal;
  }
  return result;
}
// ANCHOR_END: push

// Continues from what sweeps have reached.
void CoulombLaw::solve_by_matrix(const ContactSet& set, Method method, std::span<Vec3> impulses,
                                 IslandResult& result) {
  const auto n = static_cast<Eigen::Index>(set.contacts.size());
  std::vector<lcp::Contact> rows;  // of each contact, along its normal and two tangents
  VecX offset(3 * n), guess(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const lcp::Contact& contact = set.contacts[static_cast<std::size_t>(i)];
    const Mat3 frame = contact_frame(contact.normal);
    for (int k = 0; k < 3; ++k) {
      rows.push_back(contact);
      rows.back().normal = frame.col(k);
    }
    offset.segment<3>(3 * i) = frame.transpose() * offsets_[static_cast<std::size_t>(i)];
    guess.segment<3>(3 * i) = frame.transpose() * impulses[static_cast<std::size_t>(i)];
  }
  const lcp::ImpactProblem problem = lcp::assemble(set.bodies, rows);
  const VecX b = problem.v_before + offset, mu = Eigen::Map<const VecX>(mu_.data(), n);
  const ConeResult found =
      solve(ConeProblem{problem.A, b, mu}, method, {.tolerance = kWanted, .start = &guess});
  const auto count = static_cast<double>(n);
  work_ += count * (found.sweeps + kOfNewton * count * found.steps + kOfPivot * found.pivots);
  if (!found.r.allFinite() || found.residual > result.residual) return;
  result.residual = found.residual;
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t c = static_cast<std::size_t>(i);
    impulses[c] = contact_frame(set.contacts[c].normal) * found.r.segment<3>(3 * i);
  }
}

IslandResult CoulombLaw::correct(const ContactSet& set, std::span<const double> limits,
                                 std::span<double> impulses, const IslandOptions& options) {
  if (std::none_of(holds_.begin(), holds_.end(), [](char holds) { return holds; }))
    return NormalLaw::correct(set, limits, impulses, options);
  std::vector<Vec3> guesses;
  for (std::size_t i = 0; i < impulses.size(); ++i) guesses.push_back(impulses[i] * set.contacts[i].normal);
  std::vector<Vec3> offsets;
  for (std::size_t i = 0; i < limits.size(); ++i) offsets.push_back(limits[i] * set.contacts[i].normal);
  start(set, offsets, guesses, options.still);
  IslandResult result;
  result.residual = sweeps_.run_held(holds_, set.contacts.size() <= kFew ? kSweepsHeld : 0, kHeld);
  if (result.residual > kHeld) result.residual = sweeps_.run_held_together(holds_, kRounds, kHeld);
  work_ += sweeps_.take_work();
  result.solved = result.residual <= 1e-3;
  if (!result.solved) return result;
  result.status = lcp::Status::solved;
  for (std::size_t i = 0; i < impulses.size(); ++i) {
    const Vec3 impulse = sweeps_.impulse(static_cast<int>(i));
    impulses[i] = std::max(0.0, impulse.dot(set.contacts[i].normal));
    lcp::apply_impulse(set.bodies, set.contacts[i], impulse);
  }
  return result;
}

// ANCHOR: give_back
void CoulombLaw::give_back(const ContactSet& set, std::span<const double> normals, std::span<Vec3> total) {
  if (!rubs(set)) return NormalLaw::give_back(set, normals, total);
  const std::vector<Vec3> none(normals.size(), Vec3::Zero());
  start(set, none, none, 0);
  sweeps_.run_discs(normals, kManySweeps, kTolerance);
  work_ += sweeps_.take_work();
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3 impulse = sweeps_.impulse(static_cast<int>(i));
    lcp::apply_impulse(set.bodies, set.contacts[i], impulse);
    total[i] += impulse;
  }
}
// ANCHOR_END: give_back

// Bodies that stand are solved once. Arrivals take much more work.
double CoulombLaw::event_work(double arrivals, int rank) const {
  const double rows = 8 + rank;
  return kOfStanding * rows + kOfArrival * arrivals * rows * rows;
}

double CoulombLaw::most_work(int bodies) const {
  return kOfIsland / bodies + kOfBody * bodies;
}

std::unique_ptr<resting::GaussSeidel> CoulombLaw::gauss_seidel() const {
  return std::make_unique<PatchedGaussSeidel>(world_);
}

// The slip of a contact changes evenly: from its present value, over its mean, to as much on the other side. If it would
// reverse on the way, it stops there. If the push stops it at once, its friction is a share of what the cone allows: with
// all of that, the slip would end after half of this share of the plan. The corners of a body share its friction
// arbitrarily, so the last of these guesses is tried: if it was too long, the next try starts from better values.
// ANCHOR: holds_until
double CoulombLaw::holds_until(const ContactSet& mean, std::span<const RigidBody> now,
                               std::span<const Vec3> impulses, double length) const {
  if (mean.contacts.size() > kFewSlips) return length;
  double until = length, stuck = 0;  // the first stop of contacts that slide; the last of those that stick
  for (std::size_t i = 0; i < mean.contacts.size(); ++i) {
    const lcp::Contact& contact = mean.contacts[i];
    if (!(impulses[i].dot(contact.normal) > 0) || !(mu(mean, contact) > 0)) continue;
    const Vec3 slip = along_surface(contact.normal, lcp::relative_velocity(now, contact));
    Vec3 middle = along_surface(contact.normal, lcp::relative_velocity(mean.bodies, contact));
    if (!mean.bends.empty()) middle += mean.bends[i];
    const double speed = slip.norm();
    const double left = speed > 0 ? middle.dot(slip) / speed : 0;  // of the speed, at the middle of the plan
    if (left >= 0.5 * speed) continue;                             // it slides on until the end
    const bool sticks = left <= kStopped * speed;
    const double normal = impulses[i].dot(contact.normal);
    const double part = along_surface(contact.normal, impulses[i]).norm() / (mu(mean, contact) * normal);
    const double stop = 0.5 * length * (sticks ? std::min(1.0, part) : speed / (speed - left));
    if (speed * stop < kNoPath || stop > kNearlyAll * length) continue;
    if (sticks)
      stuck = std::max(stuck, stop);
    else
      until = std::min(until, stop);
  }
  if (stuck > 0) until = std::min(until, stuck);
  return std::max(until, kShortest * length);
}
// ANCHOR_END: holds_until

}  // namespace fc::friction
