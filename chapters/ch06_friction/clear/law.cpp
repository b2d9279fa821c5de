#include "ch06_friction/clear/law.hpp"

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"

namespace fc::friction::clear {
namespace {

constexpr int kSweeps = 4000;
constexpr double kWanted = 1e-11, kAccepted = 1e-6;  // residuals
constexpr double kSticking = 1e-9;  // a contact inside its cone by more than this part of it sticks

// N s, world: the impulse of contact i in r.
Vec3 in_world(const lcp::Contact& contact, const VecX& r, std::size_t i) {
  return contact_frame(contact.normal) * r.segment<3>(3 * static_cast<Eigen::Index>(i));
}

// Each contact as three rows: along its normal, and along two tangents.
std::vector<lcp::Contact> three_rows(std::span<const lcp::Contact> contacts) {
  std::vector<lcp::Contact> rows;
  for (const lcp::Contact& contact : contacts) {
    const Mat3 frame = contact_frame(contact.normal);
    for (int k = 0; k < 3; ++k) {
      rows.push_back(contact);
      rows.back().normal = frame.col(k);
    }
  }
  return rows;
}

// Chapter 5's push with three rows for each contact: impulses r that Coulomb's law allows for the velocities
// afterwards, A r + J v + spare.
bool push(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts, const VecX& spare,
          const VecX& mu, ContactFunction* solve_contact, VecX& r, int& sweeps) {
  if (contacts.empty()) return true;
  const lcp::ImpactProblem rows = lcp::assemble(bodies, three_rows(contacts));
  const VecX b = rows.v_before + spare;
  if (!sweep_contacts(solve_contact, {rows.A, b, mu}, r, sweeps)) return false;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    lcp::apply_impulse(bodies, contacts[i], in_world(contacts[i], r, i));
  return true;
}

}  // namespace

// ANCHOR: clear_sweep
bool sweep_contacts(ContactFunction* solve_contact, const ConeProblem& problem, VecX& r, int& sweeps) {
  const auto& [A, b, mu] = problem;
  double left = residual(problem, r, A * r + b);
  for (sweeps = 0; sweeps < kSweeps && left > kWanted; ++sweeps) {
    for (Eigen::Index i = 0; i < problem.contacts(); ++i) {
      const Mat3 own = problem.block(i);
      const Vec3 u = A.middleRows<3>(3 * i) * r + b.segment<3>(3 * i);
      const Vec3 q = u - own * r.segment<3>(3 * i);  // the velocity without this contact's impulse
      r.segment<3>(3 * i) = solve_contact(own, q, mu[i]).r;
    }
    left = residual(problem, r, A * r + b);
  }
  return left <= kAccepted;
}
// ANCHOR_END: clear_sweep

IslandResult ClearLaw::push(const ContactSet& set, std::span<const double> limits, std::span<Vec3> impulses,
                            const IslandOptions& options) {
  if (!rubs(set)) return CoulombLaw::push(set, limits, impulses, options);
  const auto n = static_cast<Eigen::Index>(set.contacts.size());
  const VecX mu = Eigen::Map<const VecX>(mu_.data(), n);
  VecX spare(3 * n), r(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t c = static_cast<std::size_t>(i);
    const Mat3 frame = contact_frame(set.contacts[c].normal);
    spare.segment<3>(3 * i) = Vec3(limits[c], 0, 0);
    if (!set.bends.empty()) spare.segment<3>(3 * i) += frame.transpose() * set.bends[c];
    r.segment<3>(3 * i) = frame.transpose() * impulses[c];
  }
  int sweeps = 0;
  IslandResult result;
  result.solved = clear::push(set.bodies, set.contacts, spare, mu, solve_contact_, r, sweeps);
  work_ += static_cast<double>(n) * sweeps;
  holds_.assign(set.contacts.size(), 0);
  if (!result.solved) {
    ++unsolved_;
    return result;
  }
  result.status = lcp::Status::solved;
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t c = static_cast<std::size_t>(i);
    const Vec3 own = r.segment<3>(3 * i);
    impulses[c] = in_world(set.contacts[c], r, c);
    holds_[c] = own[0] > 0 && own.tail<2>().norm() < (1 - kSticking) * mu[i] * own[0];
  }
  return result;
}

}  // namespace fc::friction::clear
