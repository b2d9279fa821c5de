#include "ch06_friction/coulomb_law.hpp"

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"

namespace fc::friction {
namespace {

using resting::at;

// Sweeps until impulses change by less than this, of the largest velocity. With a larger residual than the second the matrix is
// looked at, of so many contacts at most; then many sweeps are tried, and with more than the last it is not solved.
constexpr double kTolerance = 1e-14, kExact = 1e-12, kAccepted = 1e-6;
constexpr int kFewSweeps = 40, kMostOfMatrix = 250, kManySweeps = 3000;

// A contact inside its cone by more than this part of it sticks.
constexpr double kSticking = 1e-9;

// The part of a plan that is not cut off to end it where something stops: shorter than this, or longer.
constexpr double kShortest = 1.0 / 64, kNearlyAll = 0.99;
// m/s: a slower slip has stopped.
constexpr double kStopped = 1e-9;

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

CoulombLaw::CoulombLaw(world::World& world) : world_(world) {
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

void CoulombLaw::start(const ContactSet& set, std::span<const double> limits,
                       std::span<const Vec3> impulses) {
  sweeps_.start(set.bodies);
  for (std::size_t i = 0; i < set.contacts.size(); ++i)
    sweeps_.add(set.contacts[i], mu_[i], limits[i], impulses[i],
                set.bends.empty() ? Vec3(Vec3::Zero()) : set.bends[i]);
}

void CoulombLaw::sweep(const ContactSet& set, std::span<const double> limits, int most,
                       std::span<Vec3> impulses, IslandResult& result) {
  start(set, limits, impulses);
  result.residual = sweeps_.run(most, kTolerance);
  for (std::size_t i = 0; i < impulses.size(); ++i) impulses[i] = sweeps_.impulse(static_cast<int>(i));
}

// ANCHOR: push
IslandResult CoulombLaw::push(const ContactSet& set, std::span<const double> limits, std::span<Vec3> impulses,
                              const IslandOptions& options) {
  holds_.assign(set.contacts.size(), 0);
  if (!rubs(set)) return NormalLaw::push(set, limits, impulses, options);
  IslandResult result;
  sweep(set, limits, kFewSweeps, impulses, result);
  if (result.residual > kExact && !solve_by_matrix(set, limits, impulses, result))
    sweep(set, limits, kManySweeps, impulses, result);
  result.solved = result.residual <= kAccepted;
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

// With the matrix, Newton's method finds in a few steps what sweeps come near to, one by one; from where they got to.
bool CoulombLaw::solve_by_matrix(const ContactSet& set, std::span<const double> limits,
                                 std::span<Vec3> impulses, IslandResult& result) {
  const auto n = static_cast<Eigen::Index>(set.contacts.size());
  if (n > kMostOfMatrix) return false;
  std::vector<lcp::Contact> rows;  // of each contact along its normal and two tangents
  VecX limit = VecX::Zero(3 * n), guess(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const lcp::Contact& contact = set.contacts[static_cast<std::size_t>(i)];
    const Mat3 frame = contact_frame(contact.normal);
    for (int k = 0; k < 3; ++k) {
      rows.push_back(contact);
      rows.back().normal = frame.col(k);
    }
    limit[3 * i] = limits[static_cast<std::size_t>(i)];
    if (!set.bends.empty())
      limit.segment<2>(3 * i + 1) = frame.rightCols<2>().transpose() * set.bends[static_cast<std::size_t>(i)];
    guess.segment<3>(3 * i) = frame.transpose() * impulses[static_cast<std::size_t>(i)];
  }
  const lcp::ImpactProblem problem = lcp::assemble(set.bodies, rows);
  const VecX b = problem.v_before + limit, mu = Eigen::Map<const VecX>(mu_.data(), n);
  const ConeProblem cones{problem.A, b, mu};
  ConeResult found = solve(cones, Method::newton, {.start = &guess});
  if (found.status != Status::solved) found = solve(cones, Method::combined, {.start = &guess});
  if (!found.r.allFinite() || found.residual > result.residual) return false;
  result.residual = found.residual;
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t c = static_cast<std::size_t>(i);
    impulses[c] = contact_frame(set.contacts[c].normal) * found.r.segment<3>(3 * i);
  }
  return result.residual <= kAccepted;
}

IslandResult CoulombLaw::correct(const ContactSet& set, std::span<const double> limits,
                                 std::span<double> impulses, const IslandOptions& options) {
  if (std::none_of(holds_.begin(), holds_.end(), [](char holds) { return holds; }))
    return NormalLaw::correct(set, limits, impulses, options);
  std::vector<Vec3> guesses;
  for (std::size_t i = 0; i < impulses.size(); ++i) guesses.push_back(impulses[i] * set.contacts[i].normal);
  start(set, limits, guesses);
  IslandResult result;
  result.residual = sweeps_.run_held(holds_, kManySweeps, 1e-9);
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

void CoulombLaw::give_back(const ContactSet& set, std::span<const double> normals, std::span<Vec3> total) {
  if (!rubs(set)) return NormalLaw::give_back(set, normals, total);
  const std::vector<double> limits(normals.size(), 0.0);
  const std::vector<Vec3> none(normals.size(), Vec3::Zero());
  start(set, limits, none);
  sweeps_.run_discs(normals, kManySweeps, kTolerance);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3 impulse = sweeps_.impulse(static_cast<int>(i));
    lcp::apply_impulse(set.bodies, set.contacts[i], impulse);
    total[i] += impulse;
  }
}

std::unique_ptr<resting::GaussSeidel> CoulombLaw::gauss_seidel() const {
  return std::make_unique<PatchedGaussSeidel>(world_);
}

// The slip of a contact changes evenly: from what it is now, over its mean, to as much on the other side. If it would turn back
// on the way, it stops there; if the push stops it at once, half of the time is tried.
double CoulombLaw::holds_until(const ContactSet& mean, std::span<const RigidBody> now,
                               std::span<const Vec3> impulses, double length) const {
  if (mean.contacts.size() > kMostOfMatrix) return length;
  double until = length;
  for (std::size_t i = 0; i < mean.contacts.size(); ++i) {
    const lcp::Contact& contact = mean.contacts[i];
    if (!(impulses[i].dot(contact.normal) > 0) || !(mu(mean, contact) > 0)) continue;
    const Vec3 slip = along_surface(contact.normal, lcp::relative_velocity(now, contact));
    Vec3 middle = along_surface(contact.normal, lcp::relative_velocity(mean.bodies, contact));
    if (!mean.bends.empty()) middle += mean.bends[i];
    const double speed = slip.norm();
    if (speed * length < kStopped) continue;
    const double left = middle.dot(slip) / speed;  // of the speed, in the middle of the plan
    if (left >= 0.5 * speed) continue;             // it slides on until the end
    const double stop = left > kStopped * speed ? 0.5 * length * speed / (speed - left) : 0.5 * length;
    if (stop < kNearlyAll * length) until = std::min(until, std::max(stop, 0.0));
  }
  return until;
}

}  // namespace fc::friction
