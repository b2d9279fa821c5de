// Demo of exercise 1.1: a door swings shut against a ball. How many advances does your bound need, and how
// many the naive one? Writes door.csv.
#include <cstdio>
#include <filesystem>

#include "ch01_convex_advancement/gjk.hpp"
#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex01_door.hpp"

namespace {

using namespace fc;

// The gap of the door's corners and the ball at time s, by GJK.
double gap_at(const exercises::Door& door, const Vec3& ball, double radius, double s, Vec3& normal) {
  std::vector<Vec3> corners;
  const Mat3 turn = ca::rotation_about(door.axis, door.spin * s + 0.5 * door.spin_up * s * s);
  for (const Vec3& corner : door.corners) corners.push_back(turn * (corner - door.hinge));
  const std::vector<Vec3> point{Vec3::Zero()};
  ca::Motion still, at_ball;
  still.position = door.hinge;
  at_ball.position = ball;
  const ca::GjkResult g = ca::distance({corners, 0, ca::reach_of(corners)}, {point, radius, 0},
                                       ca::PairPose(still, at_ball, 0), {1e-12, 1e-9, 128});
  normal = g.normal;
  return g.lower;
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch01_ex01";
  const exercises::Door door{
      {0, 0, 0}, Vec3::UnitZ(), 0.2, 0.8, {{0, 0, -1}, {0.9, 0, -1}, {0.9, 0, 1}, {0, 0, 1}}};
  const Vec3 ball(-0.2, 0.6,
                  2.2);  // above the door's top edge, and off to the side: the door just reaches it
  const double radius = 1.24, interval = 4, tolerance = 1e-6;
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "door.csv", {{"bound", ""}, {"advance", ""}, {"t", "s"}, {"gap", "m"}});
    double reach = 0;
    for (const Vec3& corner : door.corners) reach = std::max(reach, (corner - door.hinge).norm());
    for (const bool yours : {false, true}) {
      double t = 0;
      std::int64_t advance = 0;
      for (; advance < 1000; ++advance) {
        Vec3 normal;
        const double gap = gap_at(door, ball, radius, t, normal);
        table.row({std::string(yours ? "yours" : "naive"), advance, t, gap});
        if (gap <= tolerance || t >= interval) break;
        const double naive =
            std::max(std::abs(door.spin + door.spin_up * t), door.spin + door.spin_up * interval) * reach;
        const double speed = yours ? exercises::door_speed_bound(door, normal, t, interval) : naive;
        t = speed > 0 ? std::min(interval, t + (gap - 0.5 * tolerance) / speed) : interval;
      }
      std::printf("%s bound: %ld advances, stopped at %.6f s\n", yours ? "your" : "naive",
                  static_cast<long>(advance), t);
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch01_ex01_door.py %s\n", folder.string().c_str());
}
