// The scene of a live world, as data: with balls that were thrown, and as it stands now.
#pragma once

#include "ch04_multibody_stepping/world.hpp"

namespace fc::world {

// A ball that somebody threw into the scene.
struct Throw {
  double radius = 0;                                      // m
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero();  // m, m/s, when it was thrown
};
// Appends a body for each ball, of one shape, "thrown" (or "thrown-2", …, if the scene has that).
void add_throws(Scene& scene, const std::vector<Throw>& balls);
// Throws InputError if the body, the world's last one, is nearer to another than the tolerance, or inside of it.
void refuse_overlap_of_last(const World& world, const Scene& scene);

// The scene with the bodies' poses and velocities of now. Throws InputError if a body is on its way along a path: a path is a
// table of times since the scene's start, in a file of its own, and a scene cannot begin in the middle of one.
Scene scene_as_it_stands(Scene scene, const World& world);

// The scene has the lines of another one with the same shapes and bodies, for messages and --explain.
void keep_marks(const Scene& from, Scene& scene);

}  // namespace fc::world
