// The hand that pulls a body of a live scene: before each frame a bounded impulse at the grabbed point. The step then sees a
// body with another velocity and nothing else, so every guarantee holds: a body that is pulled into a wall stays outside.
#pragma once

#include "ch04_multibody_stepping/world.hpp"

namespace fc::world {

class Hand {
 public:
  // point: m, world; moved towards the body's centre if the body does not reach so far (the page saw an earlier pose). Throws
  // InputError for a body that no impulse moves.
  void grab(const World& world, const Scene& scene, int body, const Vec3& point);
  void drag(const Vec3& to);  // m, world. Throws InputError if nothing is grabbed
  void drop() { body_ = -1; }
  // Pulls for a frame of dt seconds, and wakes the body; size: m, of the scene. Returns the work, J.
  double pull(World& world, double dt, double size) const;

  int body() const { return body_; }  // -1: none
  Vec3 point(const World& world) const;
  const Vec3& target() const { return target_; }

 private:
  int body_ = -1;
  Vec3 local_ = Vec3::Zero();  // m, body axes, from the centre of mass
  Vec3 target_ = Vec3::Zero();
};

// Throws InputError unless all numbers are finite and within what a scene may have.
void check_vector(const Vec3& v, const char* what);

}  // namespace fc::world
