// The broad phase: which bodies can come near each other. One query takes O(log n).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "common/types.hpp"

namespace fc::world {

// An axis-aligned box, m, world.
struct Bounds {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();

  bool overlaps(const Bounds& other) const {  // without a branch for each axis
    return static_cast<bool>(int(low.x() <= other.high.x()) & int(other.low.x() <= high.x()) &
                             int(low.y() <= other.high.y()) & int(other.low.y() <= high.y()) &
                             int(low.z() <= other.high.z()) & int(other.low.z() <= high.z()));
  }
  void include(const Bounds& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
};

// A balanced binary tree of boxes. When a body gets a new motion within a frame, its box is replaced and the boxes
// above it grow. At the next frame all boxes are recomputed, bottom up. The tree's structure is rebuilt only now and
// then: as bodies move it becomes a little less efficient, but stays correct.
class BoundsTree {
 public:
  // O(n log n). boxes: one for each body.
  void build(std::span<const Bounds> boxes);
  // O(n). The same bodies with other boxes, in the same tree.
  void refit(std::span<const Bounds> boxes);
  int size() const { return static_cast<int>(leaf_of_.size()); }  // bodies
  // O(log n).
  void replace(int body, const Bounds& box);
  // Calls visit(body) for each body whose box overlaps, the body itself included, in no particular order.
  template <class Visit>
  void overlapping(const Bounds& box, Visit&& visit) const {
    if (nodes_.empty()) return;
    int waiting[kDeepest], count = 0;
    waiting[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[static_cast<std::size_t>(waiting[--count])];
      if (!node.box.overlaps(box)) continue;
      if (node.body >= 0) {
        visit(node.body);
        continue;
      }
      waiting[count++] = node.left;
      waiting[count++] = node.right;
    }
  }

  // Calls visit(a, b) once for each pair of bodies whose boxes overlap, in no particular order: the tree
  // against itself.
  template <class Visit>
  void overlapping_pairs(Visit&& visit) const {
    if (nodes_.empty()) return;
    std::vector<std::pair<int, int>> waiting = {{0, 0}};
    while (!waiting.empty()) {
      const auto [i, j] = waiting.back();
      waiting.pop_back();
      const Node &x = nodes_[static_cast<std::size_t>(i)], &y = nodes_[static_cast<std::size_t>(j)];
      if (i == j) {
        if (x.body >= 0) continue;
        waiting.insert(waiting.end(), {{x.left, x.left}, {x.right, x.right}, {x.left, x.right}});
        continue;
      }
      if (!x.box.overlaps(y.box)) continue;
      if (x.body >= 0 && y.body >= 0) {
        visit(x.body, y.body);
      } else if (y.body >= 0 || (x.body < 0 && x.count >= y.count)) {  // open the larger one
        waiting.insert(waiting.end(), {{x.left, j}, {x.right, j}});
      } else {
        waiting.insert(waiting.end(), {{i, y.left}, {i, y.right}});
      }
    }
  }

 private:
  static constexpr int kDeepest = 128;  // a balanced tree of n leaves has a depth of log2 n, rounded up
  struct Node {
    Bounds box;
    int body = -1;  // of a leaf
    int count = 1;  // bodies below
    int parent = -1, left = -1, right = -1;
  };
  int build_node(std::span<int> bodies, std::span<const Bounds> boxes, int parent);

  std::vector<Node> nodes_;
  std::vector<int> leaf_of_;  // of each body
  std::vector<int> order_;
};

}  // namespace fc::world
