// Chapter 6's contact law: Coulomb's, in place of chapter 5's law, which only pushes along normals.
#pragma once

#include "ch05_resting_contact/contact_law.hpp"
#include "ch06_friction/contact_sweeps.hpp"
#include "ch06_friction/friction_patches.hpp"
#include "ch06_friction/friction_solver.hpp"

namespace fc::friction {

using resting::ContactSet;
using resting::IslandOptions;
using resting::IslandResult;

// Whether any two shapes of the scene have friction; if not, chapter 5's law is all that is needed.
bool asks_for_friction(const Scene& scene);

// Contacts without friction in any pair are solved as in chapter 5, bit for bit.
class CoulombLaw : public resting::NormalLaw {
 public:
  // Sets the world's effects: balls with friction turn.
  explicit CoulombLaw(world::World& world);

  // Coulomb's law for the velocities afterwards, with limits as in NormalLaw: K* ∋ (u_N + limit + µ|u_T|, u_T) ⟂ r ∈ K.
  IslandResult push(const ContactSet& set, std::span<const double> limits, std::span<Vec3> impulses,
                    const IslandOptions& options) override;
  // Contacts that stuck in the last push() do not slip.
  IslandResult correct(const ContactSet& set, std::span<const double> limits, std::span<double> impulses,
                       const IslandOptions& options) override;
  // With friction of at most µ times the normal impulse that is given back.
  void give_back(const ContactSet& set, std::span<const double> normals, std::span<Vec3> total) override;
  bool looks_at_bends() const override { return true; }
  double event_work(double arrivals, int rank) const override;
  double most_work(int bodies) const override;
  double left() const override { return left_; }
  std::unique_ptr<resting::GaussSeidel> gauss_seidel() const override;
  // Until the first sliding contact comes to rest.
  double holds_until(const ContactSet& mean, std::span<const RigidBody> now, std::span<const Vec3> impulses,
                     double length) const override;

 protected:
  double mu(const ContactSet& set, const lcp::Contact& contact) const;
  bool rubs(const ContactSet& set);
  void start(const ContactSet& set, std::span<const Vec3> offsets, std::span<const Vec3> impulses,
             double still);
  void solve_by_matrix(const ContactSet& set, Method method, std::span<Vec3> impulses, IslandResult& result);

  const world::World& world_;
  ContactSweeps sweeps_;
  std::vector<Vec3> offsets_;  // m/s, world: added to each contact's velocity
  std::vector<double> mu_;     // of each contact of the current set
  std::vector<char> holds_;    // of each contact of the last push: whether it sticks
  double left_;                // of the last push
};

}  // namespace fc::friction
