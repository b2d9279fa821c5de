#include "ch05_resting_contact/clear/resting_step.hpp"

#include <algorithm>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"

namespace fc::resting::clear {

// ANCHOR: push
// Chapter 3's problem with another right-hand side: A z + J v + spare >= 0.
bool push(std::vector<RigidBody>& bodies, std::span<const lcp::Contact> contacts, const VecX& spare,
          const LcpFunction& solve_lcp, VecX& z) {
  z = VecX::Zero(spare.size());
  if (contacts.empty()) return true;
  const lcp::ImpactProblem rows = lcp::assemble(bodies, contacts);
  if (!solve_lcp(rows.A, rows.v_before + spare, z)) return false;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (z[i] > 0) lcp::apply_impulse(bodies, contacts[i], z[i]);
  return true;
}
// ANCHOR_END: push

// ANCHOR: resting_step
RestingResult resting_step(const RestingProblem& island, const LcpFunction& solve_lcp) {
  constexpr double kCorrect = 0.2;   // share of a gap's lack (to the rest gap) that a plan makes up,
  constexpr double kLeastGap = 0.5;  // and the part of the rest gap that it reaches at once
  const double T = island.length, rest = island.rest_gap;

  // How fast each gap may close: for velocities, and for paths.
  std::vector<lcp::Contact> contacts;
  VecX spare(island.rows.size()), spare_on_path(island.rows.size());
  for (std::size_t i = 0; i < island.rows.size(); ++i) {
    const RestingRow& row = island.rows[i];
    const double gap = row.contact.gap;
    const double keep = std::min(gap, rest);
    const double want = std::max(keep + kCorrect * (rest - keep), kLeastGap * rest);
    contacts.push_back(row.contact);
    spare[i] = std::max((gap + row.bend - keep) / T, -row.end_speed);
    spare_on_path[i] = (gap + row.bend - want) / T;
  }

  // Half of gravity, and the push: u becomes w.
  RestingResult result;
  result.w = island.bodies;
  for (std::size_t k = 0; k < result.w.size(); ++k) result.w[k].velocity += 0.5 * T * island.gravity[k];
  result.solved = push(result.w, contacts, spare, solve_lcp, result.z);

  // The correction: w becomes y, which only the path follows. If there is no room for it, gaps stay as they are.
  result.y = result.w;
  push(result.y, contacts, spare_on_path, solve_lcp, result.c);
  return result;
}
// ANCHOR_END: resting_step

}  // namespace fc::resting::clear
