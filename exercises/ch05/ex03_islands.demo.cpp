// Exercise 5.3, to be seen: cubes in a grid, all on one floor or one above the other, whose neighbours touch with a
// given chance; the largest island, and what the largest would be if floors joined. Writes islands.csv.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <random>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex03_islands.hpp"

namespace {

using namespace fc::exercises;

constexpr int kSide = 80;

std::int64_t largest(const std::vector<char>& fixed, const std::vector<Touch>& contacts) {
  std::size_t most = 0;
  for (const Island& island : islands_of(fixed, contacts)) most = std::max(most, island.contacts.size());
  return static_cast<std::int64_t>(most);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch05_ex03";
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "islands.csv", {{"scene", ""},
                                               {"chance", ""},
                                               {"contacts", ""},
                                               {"islands", ""},
                                               {"largest", ""},
                                               {"largest if floors join", ""}});
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> any(0, 1);
    for (const bool wall : {false, true}) {
      for (int percent = 0; percent <= 100; percent += 4) {
        // Body 0 is the floor. Cubes that lie on it all touch it; of a wall only the lowest row does.
        std::vector<Touch> contacts;
        const auto body = [](int column, int row) { return 1 + column + kSide * row; };
        for (int row = 0; row < kSide; ++row)
          for (int column = 0; column < kSide; ++column) {
            if (!wall || row == 0) contacts.push_back({0, body(column, row)});
            if (column > 0 && any(random) < 0.01 * percent)
              contacts.push_back({body(column - 1, row), body(column, row)});
            if (row > 0 && any(random) < 0.01 * percent)
              contacts.push_back({body(column, row - 1), body(column, row)});
          }
        std::vector<char> fixed(1 + kSide * kSide, 0), none = fixed;
        fixed[0] = 1;
        table.row({wall ? "wall" : "lying", 0.01 * percent, static_cast<std::int64_t>(contacts.size()),
                   static_cast<std::int64_t>(islands_of(fixed, contacts).size()), largest(fixed, contacts),
                   largest(none, contacts)});
      }
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch05_ex03_islands.py %s\n", folder.string().c_str());
}
