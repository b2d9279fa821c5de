// Chapter 5 beside Bullet and ODE: boxes heaped into a pit, a wall, a stack; without friction, bounce or sleep. Ten
// seconds of each, from the start. Peers take a step and repair what overlaps; the rows say how deep that is (one
// overlap check for all): `failed` counts the frames after which boxes overlap by more than a millimetre. Only our
// engine runs the meshes (a chain, rings, a bunny in a bowl), judged by its certified gap.
//
// For our engine the rows also report the price: `shortened_percent` of the bodies in a frame, `lost_ms`, and
// `energy_up_J`, the largest rise in a frame beyond what corrections report.
//
// --frames=N: at most N frames of each, to see that everything runs.
#include <algorithm>
#include <filesystem>

#include "tests/bench/boxes_bench.hpp"
#include "tests/bench/ch05_boxes.hpp"

int main(int argc, char** argv) {
  using namespace fc::bench;
  constexpr int kMeshFrames = 120;
  const int most = most_frames(argc, argv), some = std::min(most, kMeshFrames);
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "fc_bench_ch05";
  std::filesystem::create_directories(folder);
  add_case({"heap_1000", heap(8, 8, 16), most});
  add_case({"heap_200", heap(4, 4, 12), most});
  add_case({"wall_10x10", wall(10, 10), most});
  add_case({"stack_50", stack(50), most});
  add_case({"chain_66", chain(66, folder / "link.obj"), some, true});
  add_case({"rings_40", rings(40), some, true});
  if (std::filesystem::exists("/usr/share/glmark2/models/bunny.obj"))
    add_case({"bunny_in_a_bowl", bunny_in_a_bowl(), some, true});
  return run_cases(argc, argv);
}
