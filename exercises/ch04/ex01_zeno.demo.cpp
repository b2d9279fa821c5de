// Exercise 4.1, to be seen: the chapter's engine, which stops where the bounces pile up, and the closed form. Writes
// zeno.csv.
#include <cstdio>
#include <filesystem>

#include "ch04_multibody_stepping/world.hpp"
#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex01_zeno.hpp"

namespace {

fc::Scene bouncing(const fc::exercises::Drop& drop) {
  fc::Scene scene;
  scene.gravity = fc::Vec3(0, 0, -drop.gravity);
  scene.restitution = drop.restitution;
  fc::ShapeSpec ball, floor;
  ball.geometry = fc::SphereSpec{0.5};
  ball.mass = 1;
  floor.geometry = fc::BoxSpec{fc::Vec3(4, 4, 1)};
  scene.shapes = {ball, floor};
  fc::BodySpec above, below;
  above.position = fc::Vec3(0, 0, 0.5 + drop.height);
  below.shape = 1;
  below.is_static = true;
  below.position = fc::Vec3(0, 0, -0.5);
  scene.bodies = {above, below};
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch04_ex01";
  const exercises::Drop drop{2, 0, 0.7, 9.81};
  constexpr double kFrame = 0.01;  // s
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "zeno.csv", {{"t", "s"},
                                            {"height", "m"},
                                            {"bounces", ""},
                                            {"engine height", "m"},
                                            {"engine impacts", ""},
                                            {"lost time", "s"}});
    world::World world = world::build_world(bouncing(drop));
    std::int64_t impacts = 0;
    double lost = 0;
    for (int frame = 1; frame <= 420; ++frame) {
      const world::StepReport report = world::step(world, kFrame);
      impacts += report.impacts;
      lost += report.lost_time;
      const exercises::BallState ball = exercises::ball_at(drop, kFrame * frame);
      table.row({kFrame * frame, ball.height, ball.bounces, world.bodies[0].state.position.z() - 0.5, impacts,
                 lost});
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch04_ex01_zeno.py %s\n", folder.string().c_str());
}
