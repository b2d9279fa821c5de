// Exercise 5.5, to be seen: the gaps of a column, frame by frame, while they are corrected; and what this costs for
// columns of different heights. Writes column.csv and energy.csv.
#include <cstdio>
#include <filesystem>
#include <vector>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex05_column.hpp"

namespace {

using namespace fc::exercises;

constexpr double kWidth = 0.0005, kShare = 0.2, kGravity = 9.81;

double correct_once(std::vector<Box>& boxes) {  // J
  const Correction correction = correct(boxes, true, kWidth, kShare, kGravity);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    boxes[i].gap += correction.displaced[i] - (i > 0 ? correction.displaced[i - 1] : 0);
  return correction.energy;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch05_ex05";
  try {
    std::filesystem::create_directories(folder);
    TableWriter frames(folder / "column.csv", {{"scene", ""}, {"frame", ""}, {"box", ""}, {"gap", "m"}});
    for (const bool wide : {false, true}) {
      std::vector<Box> boxes(8, {1, 0});
      if (wide) boxes[4].gap = 3 * kWidth;
      for (std::int64_t frame = 0; frame <= 25; ++frame) {
        for (std::int64_t i = 0; i < static_cast<std::int64_t>(boxes.size()); ++i)
          frames.row({wide ? "a wide gap" : "touching", frame, i, boxes[static_cast<std::size_t>(i)].gap});
        correct_once(boxes);
      }
    }
    frames.close();
    TableWriter costs(folder / "energy.csv", {{"boxes", ""}, {"touching", "J"}, {"every fourth wide", "J"}});
    for (const int count : {1, 2, 5, 10, 20, 50, 100, 200, 500, 1000}) {
      std::vector<Box> touching(static_cast<std::size_t>(count), {1, 0}), loose = touching;
      for (std::size_t i = 3; i < loose.size(); i += 4) loose[i].gap = 2.5 * kWidth;
      double energy = 0, loose_energy = 0;
      for (int frame = 0; frame < 100; ++frame) {
        energy += correct_once(touching);
        loose_energy += correct_once(loose);
      }
      costs.row({count, energy, loose_energy});
    }
    costs.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch05_ex05_column.py %s\n", folder.string().c_str());
}
