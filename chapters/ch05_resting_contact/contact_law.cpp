#include "ch05_resting_contact/contact_law.hpp"

#include "ch03_impulse_lcp/impact.hpp"

namespace fc::resting {

IslandResult NormalLaw::push(const ContactSet& set, std::span<const double> limits, std::span<Vec3> impulses,
                             const IslandOptions& options) {
  normals_.clear();
  for (std::size_t i = 0; i < impulses.size(); ++i)
    normals_.push_back(impulses[i].dot(set.contacts[i].normal));
  const IslandResult result = solver_.solve(set.bodies, set.contacts, limits, normals_, options);
  if (result.solved)
    for (std::size_t i = 0; i < impulses.size(); ++i) impulses[i] = normals_[i] * set.contacts[i].normal;
  return result;
}

IslandResult NormalLaw::correct(const ContactSet& set, std::span<const double> limits,
                                std::span<double> impulses, const IslandOptions& options) {
  return solver_.solve(set.bodies, set.contacts, limits, impulses, options);
}

void NormalLaw::give_back(const ContactSet& set, std::span<const double> normals, std::span<Vec3> total) {
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!(normals[i] > 0)) continue;
    const Vec3 impulse = normals[i] * set.contacts[i].normal;
    lcp::apply_impulse(set.bodies, set.contacts[i], impulse);
    total[i] += impulse;
  }
}

}  // namespace fc::resting
