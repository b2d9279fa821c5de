// Demo of exercise 2.1: a fat capsule tumbles towards a post. How many advances does your step need, and how
// many that of FCL and C2A, whose bound includes the radius? Writes capsule.csv.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex01_capsule.hpp"

namespace {

using namespace fc;
using exercises::Capsule;

Capsule later(const Capsule& c, double t) {
  Capsule at = c;
  const Mat3 turn = Eigen::AngleAxisd(c.spin.norm() * t, c.spin.normalized()).toRotationMatrix();
  at.middle += t * c.velocity;
  at.p = turn * c.p;
  at.q = turn * c.q;
  return at;
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch02_ex01";
  const Capsule a{{0, 0, 0}, {0.8, 0, 0}, {0.2, 0.4, 3}, {0.3, 1, 0.2}, {-0.3, -1, 0}, 0.6};
  const Capsule post{{4, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 0, -1}, 0.2};
  const Vec3 n = Vec3::UnitX();
  const double tolerance = 1e-9;
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "capsule.csv", {{"step", ""}, {"advance", ""}, {"t", "s"}, {"gap", "m"}});
    for (const char* whose : {"with the radius", "your speed", "your step"}) {
      double t = 0;
      std::int64_t advance = 0;
      for (; advance < 1000; ++advance) {
        const Capsule now = later(a, t);
        const double gap = exercises::gap(now, post, n, 0), room = gap - tolerance / 2;
        table.row({std::string(whose), advance, t, gap});
        if (gap <= tolerance) break;
        const double reach =
            std::max(a.p.cross(a.spin).norm(), a.q.cross(a.spin).norm()) / a.spin.norm() + a.radius;
        if (whose == std::string("with the radius"))
          t += room / (n.dot(a.velocity) + n.cross(a.spin).norm() * reach);
        else if (whose == std::string("your speed"))
          t += room / exercises::closing_speed(now, post, n);
        else
          t += exercises::safe_step(now, post, n, room);
      }
      std::printf("%s: %ld advances, stopped at %.9f s\n", whose, static_cast<long>(advance), t);
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch02_ex01_capsule.py %s\n", folder.string().c_str());
}
