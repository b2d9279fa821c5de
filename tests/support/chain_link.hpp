// A link of a chain as a mesh: for tests and benchmarks.
#pragma once

#include <filesystem>
#include <fstream>
#include <numbers>
#include <utility>
#include <vector>

#include "common/types.hpp"

namespace fc_test {

// A tube of 0.1 m about two half circles of 0.4 m and two sides of 0.5 m, in the x-y plane. Two of them that are turned against
// each other by a quarter about x, 1.1 m apart, touch in one point. `arc`: pieces of a half circle, even; `around`: of the tube.
inline void write_chain_link(const std::filesystem::path& file, int arc, int around) {
  std::vector<std::pair<fc::Vec3, fc::Vec3>>
      line;  // the tube's middle, and the direction away from the link's
  for (const double side : {1.0, -1.0})
    for (int i = 0; i <= arc; ++i) {
      const double angle = std::numbers::pi * (static_cast<double>(i) / arc - 0.5);
      const fc::Vec3 out = side * fc::Vec3(std::cos(angle), std::sin(angle), 0);
      line.push_back({0.25 * side * fc::Vec3::UnitX() + 0.4 * out, out});
    }
  std::ofstream out(file);
  out.precision(17);
  for (const auto& [middle, away] : line)
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      const fc::Vec3 p = middle + 0.1 * (std::cos(angle) * away + std::sin(angle) * fc::Vec3::UnitZ());
      out << "v " << p.x() << " " << p.y() << " " << p.z() << "\n";
    }
  const int rings = static_cast<int>(line.size());
  const auto vertex = [&](int ring, int k) { return 1 + ring % rings * around + k % around; };
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < around; ++k) {
      const int a = vertex(ring, k), b = vertex(ring + 1, k), c = vertex(ring + 1, k + 1),
                d = vertex(ring, k + 1);
      out << "f " << a << " " << b << " " << c << "\nf " << a << " " << c << " " << d << "\n";
    }
}

}  // namespace fc_test
