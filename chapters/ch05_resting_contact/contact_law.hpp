// What the contacts of an island can do to its bodies. Without friction they push along their normals; a later
// chapter's law, which may do more, takes the same place.
#pragma once

#include <limits>

#include <memory>

#include "ch05_resting_contact/island_solver.hpp"

namespace fc::resting {

struct ContactSet {
  std::span<RigidBody> bodies;
  std::span<const int> numbers;            // of the bodies in the world
  std::span<const lcp::Contact> contacts;  // n; bodies by their places here
  // n, or none: m/s, along the surfaces. By this much a slip is larger in the middle of a plan than at its start, with
  // the same velocities, because bodies have turned and moved on by then.
  std::span<const Vec3> bends = {};
};

class ContactLaw {
 public:
  virtual ~ContactLaw() = default;

  // Finds impulses (n; N s, world, on B) that the law allows, after which contact i closes in with at most limits_i
  // (m/s; negative: it must part), and changes the bodies' velocities. `impulses` comes in as a guess. Unless solved,
  // nothing changes.
  virtual IslandResult push(const ContactSet& set, std::span<const double> limits, std::span<Vec3> impulses,
                            const IslandOptions& options) = 0;
  // The same for velocities of paths, which correct gaps, after push() for the same contacts. The n impulses are along
  // the normals, >= 0.
  virtual IslandResult correct(const ContactSet& set, std::span<const double> limits,
                               std::span<double> impulses, const IslandOptions& options) = 0;
  // After a compression the contacts give back these normal impulses (n, N s). What acts is added to `total` (n).
  virtual void give_back(const ContactSet& set, std::span<const double> normals, std::span<Vec3> total) = 0;
  // The time (s), in a plan of `length`, up to which the impulses that push() found can act evenly: with the bodies
  // now, and their mean velocities in the set.
  virtual double holds_until(const ContactSet& mean, std::span<const RigidBody> now,
                             std::span<const Vec3> impulses, double length) const = 0;
  // Whether push() uses the set's bends.
  virtual bool looks_at_bends() const { return false; }
  // An estimate of the work of stepping a group of bodies from event to event.
  //   arrivals: pairs that may come into contact; rank: contact points that can push at once.
  virtual double event_work(double arrivals, int rank) const {
    const double rows = 8 + rank;
    return (1 + arrivals) * rows * rows;
  }
  // The work done since the start: how often a solver visited a contact.
  double work() const { return work_; }
  // The most work, in the same count, that an island of this many bodies may take in a frame.
  virtual double most_work(int /*bodies*/) const { return std::numeric_limits<double>::infinity(); }
  // The residual, as a share of all impulses on a body, that may be left where they should cancel.
  virtual double left() const { return 0; }
  // The solver of a pile.
  virtual std::unique_ptr<GaussSeidel> gauss_seidel() const { return std::make_unique<GaussSeidel>(); }

 protected:
  double work_ = 0;
};

// Contacts that push along their normals alone.
class NormalLaw : public ContactLaw {
 public:
  IslandResult push(const ContactSet& set, std::span<const double> limits, std::span<Vec3> impulses,
                    const IslandOptions& options) override;
  IslandResult correct(const ContactSet& set, std::span<const double> limits, std::span<double> impulses,
                       const IslandOptions& options) override;
  void give_back(const ContactSet& set, std::span<const double> normals, std::span<Vec3> total) override;
  double holds_until(const ContactSet&, std::span<const RigidBody>, std::span<const Vec3>,
                     double length) const override {
    return length;
  }

 private:
  IslandSolver solver_;
  std::vector<double> normals_;
};

}  // namespace fc::resting
