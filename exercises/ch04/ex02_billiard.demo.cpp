// Exercise 4.2, to be seen: two billiards in one ellipse, between the foci and around them. Writes billiard.csv.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex02_billiard.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  using exercises::Vec2;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch04_ex02";
  const exercises::Ellipse wall{2, 1.3};
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "billiard.csv", {{"start", ""}, {"bounce", ""}, {"x", "m"}, {"y", "m"}});
    for (const double start : {0.4, 1.7}) {  // m from the centre: the foci are at 1.52 m
      Vec2 x(start, 0), v(0.3, 1);
      for (std::int64_t i = 0; i <= 150; ++i) {
        table.row({start, i, x.x(), x.y()});
        x = exercises::next_bounce(wall, x, v).place;
        v = exercises::reflect(wall, x, v);
      }
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch04_ex02_billiard.py %s\n", folder.string().c_str());
}
