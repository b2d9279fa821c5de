// Exercise 6.2, to be seen: where a block stops that is thrown in each direction, by a box, two pyramids and the cone.
// Writes stops.csv.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex02_stop_points.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  using namespace fc::exercises;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch06_ex02";
  constexpr double kMu = 0.5, kGravity = 9.81, kDegree = std::numbers::pi / 180;
  const double speed = std::sqrt(2 * kMu * kGravity);  // m/s: it slides 1 m
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(
        folder / "stops.csv",
        {{"friction", ""}, {"direction", "degrees"}, {"x", "m"}, {"y", "m"}, {"angle", "degrees"}});
    for (const char* friction : {"cone", "box", "4 corners", "8 corners"}) {
      double most = 0;
      for (int degrees = 0; degrees <= 360; degrees += 3) {
        const Vec2 v = speed * Vec2(std::cos(degrees * kDegree), std::sin(degrees * kDegree));
        const Vec2 way = friction[0] == 'c'   ? stop_by_cone(v, kMu, kGravity)
                         : friction[0] == 'b' ? stop_by_box(v, kMu, kGravity)
                                              : stop_by_pyramid(v, kMu, kGravity, friction[0] - '0');
        const double angle = error_of(way, v, kMu, kGravity).angle / kDegree;
        most = std::max(most, std::abs(angle));
        table.row({friction, static_cast<double>(degrees), way[0], way[1], angle});
      }
      std::printf("%-9s  off by up to %.2f degrees\n", friction, most);
    }
    table.close();
    std::printf("corners for one degree: %d\n", corners_for(kDegree));
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch06_ex02_stop_points.py %s\n", folder.string().c_str());
}
