// Demo of exercise 1.3: an ellipsoid tumbles down to the floor z = 0. How many advances does your bound need,
// and how many with the longest half axis as reach? Writes ellipsoid.csv.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "ch01_convex_advancement/motion.hpp"
#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex03_ellipsoid.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch01_ex03";
  const Vec3 half_axes(0.15, 0.1, 1), spin(0.6, 0, 5);  // it spins almost about its longest axis
  const double height = 2, fall = 0.7, interval = 4, tolerance = 1e-9;
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "ellipsoid.csv", {{"bound", ""}, {"advance", ""}, {"t", "s"}, {"gap", "m"}});
    for (const bool yours : {false, true}) {
      double t = 0;
      std::int64_t advance = 0;
      for (; advance < 1000; ++advance) {
        const Mat3 turn = ca::rotation_about(spin.normalized(), spin.norm() * t);
        const Vec3 down = turn.transpose() * -Vec3::UnitZ();  // the body's own axes
        const double gap = height - fall * t - down.dot(exercises::ellipsoid_support(half_axes, down));
        table.row({std::string(yours ? "yours" : "longest half axis"), advance, t, gap});
        if (gap <= tolerance || t >= interval) break;
        const double turning =
            yours ? exercises::ellipsoid_speed_bound(half_axes, down, turn.transpose() * spin)
                  : spin.norm() * half_axes.maxCoeff();
        t = std::min(interval, t + (gap - 0.5 * tolerance) / (fall + turning));
      }
      std::printf("%s: %ld advances, stopped at %.9f s\n", yours ? "your bound" : "longest half axis",
                  static_cast<long>(advance), t);
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch01_ex03_ellipsoid.py %s\n", folder.string().c_str());
}
