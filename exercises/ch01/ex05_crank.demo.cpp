// Demo of exercise 1.5: advances against tolerance, with your step and with the linear one. Writes crank.csv.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex05_crank.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  using namespace fc::exercises;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch01_ex05";
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "crank.csv",
                      {{"step", ""}, {"case", ""}, {"tolerance", "m"}, {"advances", ""}});
    for (const bool yours : {false, true})
      for (const auto& [name, clearance] :
           {std::pair{"hit at 30 degrees", 0.5}, std::pair{"grazing", 0.999999}}) {
        const Crank crank{1, clearance, -1, 1};
        for (int digits = 1; digits <= 12; ++digits) {
          const double tolerance = std::pow(10, -digits), speed = crank.arm * std::abs(crank.spin);
          double t = 0;
          std::int64_t n = 0;
          for (; n < 1'000'000 && gap(crank, t) > tolerance; ++n)
            t += yours ? safe_step(crank, t, tolerance / 2) : (gap(crank, t) - tolerance / 2) / speed;
          table.row({std::string(yours ? "yours" : "linear"), std::string(name), tolerance, n});
        }
      }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch01_ex05_crank.py %s\n", folder.string().c_str());
}
