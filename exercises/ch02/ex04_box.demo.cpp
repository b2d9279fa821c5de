// Demo of exercise 2.4: a ball comes down to a slanted plate. How many pairs of nodes does it take to
// separate them, with your boxes and with boxes along x, y, z? Writes pairs.csv.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex04_box.hpp"

namespace {

using namespace fc;
using exercises::Box;
using exercises::Tree;
using exercises::Triangle;

Box along_the_axes(std::span<const Vec3> points) {
  Eigen::AlignedBox3d range;
  for (const Vec3& p : points) range.extend(p);
  return {range.center().cast<float>(), Eigen::Matrix3f::Identity(),
          (range.sizes() / 2 * (1 + 1e-6)).cast<float>()};
}

std::vector<Triangle> plate(const Mat3& rotation) {
  constexpr int n = 24;
  std::vector<Triangle> triangles;
  const auto at = [&](int i, int k) { return Vec3(rotation * Vec3(2.0 * i / n - 1, 2.0 * k / n - 1, 0)); };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return triangles;
}
std::vector<Triangle> ball(const Vec3& center, double radius) {
  constexpr int n = 24;
  std::vector<Triangle> triangles;
  const auto at = [&](int i, int k) {
    const double theta = std::numbers::pi * i / n, phi = std::numbers::pi * k / n;
    return Vec3(center + radius * Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                       std::cos(theta)));
  };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 2 * n; ++k) {
      if (i > 0) triangles.push_back({at(i, k), at(i + 1, k), at(i, k + 1)});
      if (i < n - 1) triangles.push_back({at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)});
    }
  return triangles;
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch02_ex04";
  const Mat3 slant = Eigen::AngleAxisd(0.7, Vec3(1, 2, 0.5).normalized()).toRotationMatrix();
  const double radius = 0.5;
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "pairs.csv", {{"boxes", ""}, {"gap", "m"}, {"pairs of nodes", ""}});
    for (const bool yours : {false, true}) {
      const exercises::Fit fit = yours ? exercises::fit_box : along_the_axes;
      const Tree below(plate(slant), fit);
      for (int k = 0; k <= 16; ++k) {
        const double gap = std::pow(10, -0.25 * k);
        const Tree above(ball((radius + gap) * slant.col(2), radius), fit);
        const std::int64_t pairs = exercises::node_pairs(below, above, 0.5 * gap);
        table.row({std::string(yours ? "yours" : "along x, y, z"), gap, pairs});
        if (k % 8 == 0)
          std::printf("%s, %g m apart: %ld pairs of nodes\n", yours ? "your boxes" : "along x, y, z", gap,
                      static_cast<long>(pairs));
      }
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch02_ex04_box.py %s\n", folder.string().c_str());
}
