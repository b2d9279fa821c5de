// Demo of exercise 3.1: which contacts push, for every b of the plane? Writes cones.csv.
#include <cstdio>
#include <filesystem>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex01_two_contacts.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch03_ex01";
  struct Case {
    const char* name;
    double a, b, c, d;
  };
  const Case cases[] = {{"three balls in a row", 2, -1, -1, 2},
                        {"a corner of 120 degrees", 2, 1, 1, 2},
                        {"the same contact twice", 1, 1, 1, 1},
                        {"a ball between two walls", 1, -1, -1, 1},
                        {"no frictionless world", 1, 2, 2, 1}};
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "cones.csv",
                      {{"matrix", ""}, {"b 1", "m/s"}, {"b 2", "m/s"}, {"pushing", ""}, {"answers", ""}});
    for (const Case& one : cases) {
      exercises::Mat2 A;
      A << one.a, one.b, one.c, one.d;
      std::int64_t none = 0, several = 0;
      constexpr int kHalf = 30;  // the grid avoids the axes and the diagonals, where answers tie
      for (int i = -kHalf; i < kHalf; ++i)
        for (int k = -kHalf; k < kHalf; ++k) {
          const exercises::Vec2 b(4 * i + 1, 4 * k + 2);
          const auto answers = exercises::solve_two(A, b);
          for (const auto& answer : answers) {
            const bool first = answer.z[0] > 0, second = answer.z[1] > 0;
            const char* pushing = first && second ? "both" : first ? "1" : second ? "2" : "nobody";
            table.row({std::string(one.name), b[0], b[1], std::string(pushing),
                       static_cast<std::int64_t>(answers.size())});
          }
          if (answers.empty())
            table.row({std::string(one.name), b[0], b[1], std::string("no answer"), std::int64_t{0}});
          none += answers.empty();
          several += answers.size() > 1;
        }
      std::printf("%s: of %d places %ld have no answer, %ld several\n", one.name, 4 * kHalf * kHalf,
                  static_cast<long>(none), static_cast<long>(several));
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch03_ex01_two_contacts.py %s\n", folder.string().c_str());
}
