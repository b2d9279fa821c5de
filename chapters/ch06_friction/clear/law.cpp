#include "ch06_friction/clear/law.hpp"

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"

namespace fc::friction::clear {
namespace {

constexpr int kSweeps = 4000;
constexpr double kWanted = 1e-11, kAccepted = 1e-6;  // residuals
constexpr double kSticking = 1e-9;  // a contact inside its cone by more than this part of it sticks

// Each contact three times: along its normal, and along two tangents.
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

void apply(std::span<RigidBody> bodies, const std::vector<lcp::Contact>& rows, const VecX& r) {
  for (int i = 0; i < std::ssize(rows); ++i)
    lcp::apply_impulse(bodies, rows[static_cast<std::size_t>(i)], r[i]);
}

// Chapter 5's push with three rows a contact: impulses r that Coulomb's law allows for the velocities after, with room (m/s, by
// rows) added. No solution: velocities stay.
bool push(ContactFunction* solve_contact, std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
          const VecX& mu, const VecX& room, VecX& r, int& sweeps) {
  if (contacts.empty()) return true;
  const std::vector<lcp::Contact> rows = three_rows(contacts);
  const lcp::ImpactProblem problem = lcp::assemble(bodies, rows);
  const VecX b = problem.v_before + room;
  if (!sweep_contacts(solve_contact, {problem.A, b, mu}, r, sweeps)) return false;
  apply(bodies, rows, r);
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
      const Vec3 q = u - own * r.segment<3>(3 * i);  // if this contact did nothing
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
  VecX room(3 * n), r(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t c = static_cast<std::size_t>(i);
    const Mat3 frame = contact_frame(set.contacts[c].normal);
    room.segment<3>(3 * i) = Vec3(limits[c], 0, 0);
    if (!set.bends.empty()) room.segment<3>(3 * i) += frame.transpose() * set.bends[c];
    r.segment<3>(3 * i) = frame.transpose() * impulses[c];
  }
  int sweeps = 0;
  IslandResult result;
  result.solved = clear::push(solve_contact_, set.bodies, set.contacts, mu, room, r, sweeps);
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
    impulses[c] = contact_frame(set.contacts[c].normal) * own;
    holds_[c] = own[0] > 0 && own.tail<2>().norm() < (1 - kSticking) * mu[i] * own[0];
  }
  return result;
}

}  // namespace fc::friction::clear
