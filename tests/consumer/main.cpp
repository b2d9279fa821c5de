// Steps a scene and prints where its bodies are: consumer SCENE.
#include <cstdio>

#include "ch05_resting_contact/resting.hpp"
#include "common/scene.hpp"

int main(int, char** argv) {
  const fc::Scene scene = fc::read_scene({argv[1], {}, {}, 5});
  fc::world::World world = fc::world::build_world(scene);
  fc::resting::Resting resting(scene, world, scene.step->dt);
  for (int frame = 0; frame < scene.step->frames; ++frame) resting.step(world);
  for (const fc::world::Body& body : world.bodies) {
    const fc::Vec3& centre = body.state.position;
    std::printf("%g %g %g\n", centre.x(), centre.y(), centre.z());
  }
}
