// Demo of exercise 2.2: where your steps begin while an arm swings round to a post. Writes miss.csv.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex02_misses_again.hpp"

namespace {

using namespace fc;

// Cubes of 1 m about these places, one convex piece each.
hulls::HullModel cubes(const std::vector<Vec3>& places) {
  Shape shape;
  shape.kind = Shape::Kind::mesh;
  constexpr std::array<int, 3> sides[] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                          {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const Vec3& place : places) {
    const int first = static_cast<int>(shape.core.vertices.size());
    for (int k = 0; k < 8; ++k)
      shape.core.vertices.push_back(place + Vec3((k & 1) - 0.5, (k >> 1 & 1) - 0.5, (k >> 2) - 0.5));
    for (const auto& [i, j, k] : sides) shape.core.triangles.push_back({first + i, first + j, first + k});
  }
  return hulls::build_hull_model(hulls::build_model(shape));
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch02_ex02";
  const double interval = 1.5, tolerance = 1e-6;
  // An arm of cubes, whose hub stays near another one; and a post in the way of its tip.
  const hulls::HullModel arm = cubes({{0, 0, 0}, {4, 0, 0}}), post = cubes({{0, 0, 1.2}, {0, 4, 0}});
  RigidBody turning;
  turning.spin = {0, 0, 2};
  const ca::Motion motion_a(turning), motion_b{RigidBody{}};
  try {
    const exercises::FirstContact answer =
        exercises::first_contact(arm, motion_a, post, motion_b, interval, tolerance, 1000);
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "miss.csv", {{"what", ""}, {"t", "s"}, {"gap", "m"}});
    const auto row = [&](const char* what, double t, int first) {  // the gap of the leaves, from `first` on
      const ca::PairPose pose(motion_a, motion_b, t);
      double gap = std::numeric_limits<double>::infinity();
      for (const hulls::HullNode& x : arm.tree.nodes)
        for (const hulls::HullNode& y : post.tree.nodes)
          if (x.leaf() && y.leaf() && (first == 0 || (x.center.norm() > 1 && y.center.norm() > 2)))
            gap = std::min(gap, ca::distance(arm.convex(x), post.convex(y), pose, {}).upper);
      table.row({std::string(what), t, gap});
    };
    for (int k = 0; k <= 300; ++k) row("gap of the bodies", interval * k / 300, 0);
    for (int k = 0; k <= 300; ++k) row("gap of the tips", interval * k / 300, 1);
    for (const double t : answer.visited) row("where you looked", t, 1);
    table.close();
    std::printf("%s at %.6f s, after looking %zu times, at %ld pairs of nodes\n", ca::name_of(answer.status),
                answer.toc, answer.visited.size(), static_cast<long>(answer.node_pairs));
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch02_ex02_misses_again.py %s\n", folder.string().c_str());
}
