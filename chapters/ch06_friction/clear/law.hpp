// Coulomb's law for an island in its clear form: three rows for each contact, and sweeps that call one function, that
// of one contact.
#pragma once

#include "ch06_friction/clear/one_contact.hpp"
#include "ch06_friction/coulomb_law.hpp"

namespace fc::friction::clear {

// Gauss-Seidel on u = A r + b: each contact in turn, as if the others were known, until the residual (cone_problem.hpp)
// is small. r comes in as a guess. Returns whether the residual is small enough; `sweeps` becomes their number.
bool sweep_contacts(ContactFunction* solve_contact, const ConeProblem& problem, VecX& r, int& sweeps);

// Replaces CoulombLaw's push. All else is CoulombLaw's: corrections of gaps, expansions of impacts, where slips end.
class ClearLaw : public CoulombLaw {
 public:
  // unsolved: counts how often sweeps did not solve an island. Such an island becomes a pile, which this law does not
  // solve.
  ClearLaw(world::World& world, ContactFunction* solve_contact, int& unsolved)
      : CoulombLaw(world), solve_contact_(solve_contact), unsolved_(unsolved) {}

  IslandResult push(const ContactSet& set, std::span<const double> limits, std::span<Vec3> impulses,
                    const IslandOptions& options) override;

 private:
  ContactFunction* solve_contact_;
  int& unsolved_;
};

}  // namespace fc::friction::clear
