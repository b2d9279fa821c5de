// A frame with contacts that last, drawn: envelope, contact patches, impulses, plans, and how their paths are proved.
#pragma once

#include "ch04_multibody_stepping/show_frame.hpp"
#include "ch05_resting_contact/resting.hpp"

namespace fc::resting {

// What a contact law was asked for, and what it found.
struct SeenPush {
  double time = 0;        // s in the frame
  bool corrects = false;  // of gaps, by the velocities of paths
  bool of_plan = false;   // for a plan; else for an instant, after which nothing may close in
  std::vector<int> numbers;
  std::vector<RigidBody> before, after;  // the bodies
  std::vector<lcp::Contact> contacts;    // bodies by their places
  std::vector<double> limits;            // m/s, at which each contact may close in
  std::vector<Vec3> bends;               // m/s, see ContactSet
  std::vector<Vec3> impulses;            // N s, on B
  IslandResult result;

  bool is_instant() const { return !corrects && !of_plan; }
  lcp::ShownContacts shown(const world::World& world) const;
  std::vector<algorithm::BodyPose> poses() const;  // of its bodies that can be moved
};

// What is noted while a frame is stepped.
struct RestWatch {
  static constexpr std::size_t kMost = 200, kMostContacts = 400;
  const world::World* world = nullptr;  // that is being stepped
  double now = 0;                       // s in the frame
  std::vector<SeenPush> pushes;
  std::vector<world::Body> planned;  // the bodies just after the first plans were made
  double plan_end = 0;               // s in the frame, when the first of these ends
  world::FrameWatch frame;
  std::vector<world::ImpactRecord> records;
  RestReport report;
};

// Answers as another law, and notes what it was asked.
class WatchedLaw final : public ContactLaw {
 public:
  WatchedLaw(std::unique_ptr<ContactLaw> law, RestWatch& watch) : law_(std::move(law)), watch_(watch) {}
  IslandResult push(const ContactSet& set, std::span<const double> limits, std::span<Vec3> impulses,
                    const IslandOptions& options) override;
  IslandResult correct(const ContactSet& set, std::span<const double> limits, std::span<double> impulses,
                       const IslandOptions& options) override;
  void give_back(const ContactSet& set, std::span<const double> normals, std::span<Vec3> total) override {
    law_->give_back(set, normals, total);
  }
  double holds_until(const ContactSet& mean, std::span<const RigidBody> now, std::span<const Vec3> impulses,
                     double length) const override {
    return law_->holds_until(mean, now, impulses, length);
  }
  bool looks_at_bends() const override { return law_->looks_at_bends(); }
  double event_work(double arrivals, int rank) const override { return law_->event_work(arrivals, rank); }
  double most_work(int bodies) const override { return law_->most_work(bodies); }
  double left() const override { return law_->left(); }
  std::unique_ptr<GaussSeidel> gauss_seidel() const override { return law_->gauss_seidel(); }

 private:
  SeenPush begin(const ContactSet& set, std::span<const double> limits) const;
  void end(SeenPush seen, const ContactSet& set, const IslandResult& result);

  std::unique_ptr<ContactLaw> law_;
  RestWatch& watch_;
};

// Steps the world for one frame, and notes what happens.
RestWatch watched_frame(const Scene& scene, world::World& world, std::unique_ptr<ContactLaw> law);

// The pushes that count: of those at one time for one island, each kind's last.
std::vector<const SeenPush*> pushes_that_count(const RestWatch& watch);

// The account of the frame that begins with the world, which is stepped. law: null: this chapter's. More parts: what a later
// chapter adds, from what was seen. A scene without an envelope: chapter 4's account.
using MoreParts =
    std::function<std::vector<algorithm::Part>(const world::World&, const RestWatch&, double t0)>;
algorithm::Document show_rest(const Scene& scene, world::World& world, std::int64_t before, double t0,
                              std::unique_ptr<ContactLaw> law = {}, const MoreParts& more = {});
algorithm::Document show_frame(const Scene& scene, world::World& world, std::int64_t before, double t0);

}  // namespace fc::resting
