// Demo of exercise 1.2: where your advancement looks while a rod tumbles to the floor. Writes miss.csv.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex02_miss.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch01_ex02";
  const exercises::Rod rod{1, 2.2, -0.55, 0.3, 4};
  const double interval = 3;
  try {
    const exercises::Answer answer = exercises::first_contact(rod, interval, 1e-6, 1000);
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "miss.csv", {{"what", ""}, {"t", "s"}, {"gap", "m"}});
    const auto row = [&](const char* what, double t) {
      const double gap =
          rod.height + rod.climb * t - rod.half_length * std::abs(std::sin(rod.tilt + rod.spin * t));
      table.row({std::string(what), t, gap});
    };
    for (int k = 0; k <= 600; ++k) row("truth", interval * k / 600);
    for (const double t : answer.visited) row("visited", t);
    table.close();
    std::printf("%s at %.6f s, after looking %zu times\n", ca::name_of(answer.status), answer.toc,
                answer.visited.size());
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch01_ex02_miss.py %s\n", folder.string().c_str());
}
