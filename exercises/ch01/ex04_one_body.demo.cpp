// Demo of exercise 1.4: the outlines of A, of B, of B - A, and of the region that B - A sweeps over, seen
// from above. Writes outline.csv.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex04_one_body.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  using namespace fc::exercises;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch01_ex04";
  Rounded a{{{-1, -0.5, 0}, {1, -0.5, 0}, {1, 0.5, 0}, {-1, 0.5, 0}}, 0, Mat3::Identity(), {0, 0, 0}};
  a.rotation = Eigen::AngleAxisd(0.4, Vec3::UnitZ()).toRotationMatrix();
  const Rounded b{{{0, -0.6, 0}, {0, 0.6, 0}}, 0.35, Mat3::Identity(), {2.6, 1.6, 0}};
  const Vec3 travel(-1.8, -3.2, 0);
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "outline.csv", {{"set", ""}, {"x", "m"}, {"y", "m"}});
    for (int k = 0; k <= 720; ++k) {
      const double angle = k * std::numbers::pi / 360;
      const Vec3 d(std::cos(angle), std::sin(angle), 0);
      const auto row = [&](const char* set, const Vec3& p) { table.row({std::string(set), p.x(), p.y()}); };
      row("A", support(a, d));
      row("B", support(b, d));
      row("B - A", difference_support(a, b, d));
      row("swept", swept_support(a, b, travel, d));
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch01_ex04_one_body.py %s\n", folder.string().c_str());
}
