// Chapter 6 beside Bullet and ODE: boxes heaped into a pit, pyramids, a wall, an arch, a stack, all with friction;
// without bounce or sleep. Ten seconds of each, from the start, with the same coefficient and one overlap check for all
// (chapter 5's benchmark says more about the rows).
//
// `rest_frame` is the first frame from which on all bodies together have less than a microjoule; it is the number of
// frames if they have more at the end. For structures that should stand the rows say how far a body sank or moved
// sideways, at most, in all that time, and how many bodies have fallen: their centres have moved by more than half
// their narrowest side.
//
// --frames=N: at most N frames of each, to see that everything runs.
#include "ch06_friction/coulomb_law.hpp"
#include "tests/bench/boxes_bench.hpp"
#include "tests/bench/ch05_boxes.hpp"

int main(int argc, char** argv) {
  using namespace fc::bench;
  const int frames = most_frames(argc, argv);
  const auto add = [&](const char* name, fc::Scene scene, double friction, bool stands) {
    scene.friction = friction;
    add_case({name, scene, frames, false, stands,
              [](fc::world::World& world) { return std::make_unique<fc::friction::CoulombLaw>(world); }});
  };
  add("heap_friction_1000", heap(8, 8, 16), 0.5, false);
  add("heap_friction_200", heap(4, 4, 12), 0.5, false);
  add("pyramid_13", pyramid(13), 0.6, true);
  add("pyramid_44", pyramid(44), 0.6, true);
  add("wall", free_wall(10, 10), 0.6, true);
  add("arch_101", arch(101), 0.5, true);
  add("stack_50", stack(50), 0.6, true);
  return run_cases(argc, argv);
}
