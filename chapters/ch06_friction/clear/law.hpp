// Coulomb's law for an island in its clear form: three rows a contact, and sweeps that ask one function, that of one contact.
#pragma once

#include "ch06_friction/clear/one_contact.hpp"
#include "ch06_friction/coulomb_law.hpp"

namespace fc::friction::clear {

using ContactSolver = Answer(const Mat3& A, const Vec3& q, double mu);

// Gauss-Seidel on u = A r + b: each contact in turn, as if the others were known, until the residual (cone_problem.hpp) is
// small. r comes in as a guess. Returns whether it is small enough, and after how many sweeps.
bool sweep_contacts(ContactSolver* one_contact, const ConeProblem& problem, VecX& r, int& sweeps);

// In the place of CoulombLaw. What is not the push is CoulombLaw's: corrections of gaps, expansions of impacts, where slips end.
class ClearLaw : public CoulombLaw {
 public:
  ClearLaw(world::World& world, ContactSolver* one_contact) : CoulombLaw(world), one_contact_(one_contact) {}

  IslandResult push(const ContactSet& set, std::span<const double> limits, std::span<Vec3> impulses,
                    const IslandOptions& options) override;
  // How often sweeps did not solve an island: it is a pile then, which the law does not solve.
  int unsolved() const { return unsolved_; }

 private:
  ContactSolver* one_contact_;
  int unsolved_ = 0;
};

}  // namespace fc::friction::clear
