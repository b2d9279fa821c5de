// Exercise 4.4, to be seen: the world lines of beads of two masses. Writes beads.csv.
#include <cstdio>
#include <filesystem>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex04_beads.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch04_ex04";
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "beads.csv", {{"t", "s"}, {"bead", ""}, {"place", "m"}, {"mass", "kg"}});
    std::vector<exercises::Bead> start;
    for (int i = 0; i < 16; ++i) start.push_back({0.5 * i, i == 0 ? 3.0 : 0.0, i % 5 == 3 ? 4.0 : 1.0});
    start.push_back({9, -1.5, 8});
    for (int k = 0; k <= 300; ++k) {
      std::vector<exercises::Bead> beads = start;
      exercises::fly(beads, 0.03 * k);
      for (std::int64_t i = 0; i < static_cast<std::int64_t>(beads.size()); ++i)
        table.row(
            {0.03 * k, i, beads[static_cast<std::size_t>(i)].place, beads[static_cast<std::size_t>(i)].mass});
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch04_ex04_beads.py %s\n", folder.string().c_str());
}
