// The broad phase: which bodies come near each other at all, in time that grows with log n for each that
// asks.
#pragma once

#include <span>
#include <vector>

#include "common/types.hpp"

namespace fc::world {

// An axis-aligned box, m, world.
struct Bounds {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();

  bool overlaps(const Bounds& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  void include(const Bounds& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
};

// A balanced binary tree of boxes, made afresh for each frame. When a body changes its course, its box is
// replaced and those above it grow: the tree becomes a little worse until the next frame, and stays right.
class BoundsTree {
 public:
  // O(n log n). boxes: one for each body.
  void build(std::span<const Bounds> boxes);
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

 private:
  static constexpr int kDeepest = 128;  // a balanced tree of n leaves has a depth of log2 n, rounded up
  struct Node {
    Bounds box;
    int body = -1;  // of a leaf
    int parent = -1, left = -1, right = -1;
  };
  int build_node(std::span<int> bodies, std::span<const Bounds> boxes, int parent);

  std::vector<Node> nodes_;
  std::vector<int> leaf_of_;  // of each body
  std::vector<int> order_;
};

}  // namespace fc::world
