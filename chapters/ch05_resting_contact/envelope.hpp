// The collision envelope: a thin shell around every body, inside of which contacts last.
#pragma once

#include <limits>
#include <vector>

#include "ch04_multibody_stepping/world.hpp"

namespace fc::resting {

// The envelope's width in m: the scene's, or, if that is 0, a thousandth of the smallest reach of a shape
// that moves. Throws InputError if it is less than a hundred tolerances: a contact of chapter 4 happens at
// half a tolerance, and must stay a small thing beside the shell.
double envelope_of(const Scene& scene, const world::World& world);

// A contact inside the shell: 0 < gap <= envelope, about.
struct ShellContact {
  lcp::Contact contact;  // at the frame's start; restitution 0; gap in m
  double impulse = 0;    // N s, of the last frame, or 0 if it is new
};

// The shell's contacts from frame to frame. A pair whose two bodies have not moved since keeps its contacts;
// any other is searched anew, and its contacts take over the impulses of the nearest ones of the frame
// before.
class Shell {
 public:
  explicit Shell(double envelope) : envelope_(envelope) {}
  double envelope() const { return envelope_; }

  // All contacts between bodies of the world as they stand now, by pairs in order.
  void find(const world::World& world);
  std::vector<ShellContact>& contacts() { return contacts_; }
  const std::vector<ShellContact>& contacts() const { return contacts_; }
  double smallest_gap() const { return smallest_gap_; }  // m, certified; infinite if no pair is in the shell
  std::int64_t searched() const { return searched_; }    // pairs, in the last find()

 private:
  struct Known {  // a pair of the frame before
    int a = 0, b = 0;
    Pose pose_a, pose_b;
    int first = 0, count = 0;  // of contacts_
    double gap = 0;            // m, certified; infinite if it is wider than the envelope
    bool sharp = false;        // to the tolerance; else to a part of the envelope
  };
  void sharpen(const world::World& world);
  void add(const world::World& world, int a, int b, const Known* known,
           const std::vector<ShellContact>& before);

  double envelope_;
  world::BoundsTree tree_;
  std::vector<Known> known_;
  std::vector<ShellContact> contacts_;
  std::int64_t searched_ = 0;
  double smallest_gap_ = 0;
};

}  // namespace fc::resting
