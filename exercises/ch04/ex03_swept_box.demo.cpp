// Exercise 4.3, to be seen: how many pairs of boxes overlap in a gas of spinning blocks, for longer and longer frames:
// with balls around the blocks, as in the chapter, and with the learner's boxes. Writes swept.csv.
#include <cstdio>
#include <filesystem>
#include <random>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex03_swept_box.hpp"

namespace {

using namespace fc;

std::int64_t overlapping(const std::vector<world::Bounds>& boxes) {
  world::BoundsTree tree;
  tree.build(boxes);
  std::int64_t pairs = 0;
  tree.overlapping_pairs([&](int, int) { ++pairs; });
  return pairs;
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch04_ex03";
  const Vec3 half(0.6, 0.15, 0.1);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
  std::vector<RigidBody> blocks(1000);
  for (RigidBody& block : blocks) {
    block.position = 8 * vector();
    block.orientation = Eigen::AngleAxisd(3 * any(random), vector().normalized());
    block.velocity = 3 * vector();
    block.spin = 5 * vector();
  }
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "swept.csv", {{"dt", "s"}, {"pairs of balls", ""}, {"pairs of boxes", ""}});
    for (const double dt : {0.0, 1 / 240.0, 1 / 120.0, 1 / 60.0, 1 / 30.0, 1 / 15.0, 1 / 8.0, 0.25, 0.5}) {
      std::vector<world::Bounds> balls, boxes;
      for (const RigidBody& block : blocks) {
        const Vec3 stop = block.position + dt * block.velocity, reach = Vec3::Constant(half.norm());
        balls.push_back({block.position.cwiseMin(stop) - reach, block.position.cwiseMax(stop) + reach});
        boxes.push_back(exercises::swept_box(half, block, Vec3::Zero(), dt));
      }
      table.row({dt, overlapping(balls), overlapping(boxes)});
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch04_ex03_swept_box.py %s\n", folder.string().c_str());
}
