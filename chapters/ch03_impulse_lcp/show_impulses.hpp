// The impulses of an instant, drawn: contacts, velocities, and Dantzig's method pivot by pivot.
#pragma once

#include <span>
#include <vector>

#include "ch03_impulse_lcp/impact.hpp"
#include "common/algorithm.hpp"

namespace fc::lcp {

// Contacts between bodies at one time, as they are drawn.
struct ShownContacts {
  std::span<const RigidBody> bodies;
  std::span<const int> numbers;  // of the bodies in the scene
  std::span<const Contact> contacts;
  double arrow = 1;  // m: the length of the longest arrow
};

// z and w after each exchange of a row; the first are those before any. By the clear version of the method, which is run anew
// up to each exchange. Empty for more than `most` rows, and where it finds no solution.
struct Pivot {
  VecX z, w;
};
std::vector<Pivot> pivots_of(const MatX& A, const VecX& b, int most = 24);

// "contact 2 (bodies 0 and 3)".
std::string contact_name(const ShownContacts& shown, std::size_t i);

// Points and normals of all contacts.
void add_contacts(const ShownContacts& shown, algorithm::Step& step);
// Impulses (N s, world, on B) as arrows at their contacts.
void add_impulses(const ShownContacts& shown, std::span<const Vec3> impulses, algorithm::Role role,
                  algorithm::Step& step);
// Velocities of the bodies' centres as arrows; `fastest` (m/s) is as long as the longest arrow.
void add_velocities(const ShownContacts& shown, std::span<const RigidBody> bodies, double fastest,
                    algorithm::Role role, algorithm::Step& step);

// One step for each pivot of w = A z + b, z >= 0, w >= 0, z'w = 0, whose rows are the contacts.
std::vector<algorithm::Step> show_pivots(const ShownContacts& shown, const MatX& A, const VecX& b);

// An impact by resolve_impact(): contacts, each solve pivot by pivot, velocities before and after. solver: the name of the
// method that options.solver is.
std::vector<algorithm::Step> show_impact(const ShownContacts& shown, const ImpactOptions& options,
                                         const std::string& solver);

}  // namespace fc::lcp
