// Exercise 5.2, to be seen: how many bounces envelopes of different widths leave, how much time they cut off, and when
// the ball is at rest in the chapter's engine. Writes last_bounce.csv.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "ch05_resting_contact/resting.hpp"
#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex02_last_bounce.hpp"

namespace {

using namespace fc;

constexpr double kFrame = 1. / 120;  // s

// When the ball stops moving in the engine, s.
double engine_rest(const exercises::Drop& drop, double width) {
  Scene scene;
  scene.gravity = Vec3(0, 0, -drop.gravity);
  scene.restitution = drop.restitution;
  scene.envelope = width;
  scene.ccd.tolerance = 1e-8;
  ShapeSpec ball, floor;
  ball.geometry = SphereSpec{0.5};
  ball.mass = 1;
  floor.geometry = BoxSpec{Vec3(4, 4, 1)};
  scene.shapes = {ball, floor};
  BodySpec above, below;
  above.position = Vec3(0, 0, 0.5 + drop.height);
  below.shape = 1;
  below.is_static = true;
  below.position = Vec3(0, 0, -0.5);
  scene.bodies = {above, below};
  world::World world = world::build_world(scene);
  resting::Resting rests(scene, world, kFrame);
  for (int frame = 1; frame < 2000; ++frame) {
    rests.step(world);
    if (world.bodies[0].state.velocity.norm() == 0) return frame * kFrame;
  }
  return std::nan("");
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch05_ex02";
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "last_bounce.csv", {{"restitution", ""},
                                                   {"width", "m"},
                                                   {"bounces", ""},
                                                   {"time", "s"},
                                                   {"engine", "s"},
                                                   {"cut", "s"},
                                                   {"frame", "s"},
                                                   {"widest", "m"}});
    for (const double e : {0.5, 0.7, 0.9}) {
      const exercises::Drop drop{1, e, 9.81};
      const double widest = exercises::widest_envelope(e, drop.gravity, kFrame);
      for (int i = 0; i <= 24; ++i) {
        const double width = 1e-5 * std::pow(10, i / 8.0);
        const exercises::Ending ending = exercises::ending(drop, width, kFrame);
        table.row(
            {e, width, ending.bounces, ending.time, engine_rest(drop, width), ending.cut, kFrame, widest});
      }
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch05_ex02_last_bounce.py %s\n", folder.string().c_str());
}
