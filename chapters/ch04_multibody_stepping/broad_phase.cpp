#include "ch04_multibody_stepping/broad_phase.hpp"

#include <algorithm>
#include <numeric>

namespace fc::world {

void BoundsTree::build(std::span<const Bounds> boxes) {
  nodes_.clear();
  nodes_.reserve(2 * boxes.size());
  leaf_of_.resize(boxes.size());
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes.empty()) build_node(order_, boxes, -1);
}

// Splits the bodies into two halves at the median of their box centres, along the axis with the largest spread.
int BoundsTree::build_node(std::span<int> bodies, std::span<const Bounds> boxes, int parent) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({boxes[static_cast<std::size_t>(bodies[0])], -1, static_cast<int>(bodies.size()), parent});
  if (bodies.size() == 1) {
    nodes_.back().body = bodies[0];
    leaf_of_[static_cast<std::size_t>(bodies[0])] = index;
    return index;
  }
  const auto middle_of = [&](int body) -> Vec3 {
    const Bounds& box = boxes[static_cast<std::size_t>(body)];
    return box.low + box.high;
  };
  Bounds middles{middle_of(bodies[0]), middle_of(bodies[0])};
  Bounds box = nodes_.back().box;
  for (const int body : bodies) {
    const Vec3 middle = middle_of(body);
    middles.include({middle, middle});
    box.include(boxes[static_cast<std::size_t>(body)]);
  }
  int axis = 0;
  (middles.high - middles.low).maxCoeff(&axis);
  const auto half = bodies.size() / 2;
  // Ties are broken by body number, so that the tree is the same on every machine.
  std::nth_element(bodies.begin(), bodies.begin() + static_cast<std::ptrdiff_t>(half), bodies.end(),
                   [&](int x, int y) {
                     const double a = middle_of(x)[axis], b = middle_of(y)[axis];
                     return a != b ? a < b : x < y;
                   });
  const int left = build_node(bodies.first(half), boxes, index);
  const int right = build_node(bodies.subspan(half), boxes, index);
  Node& node = nodes_[static_cast<std::size_t>(index)];
  node.box = box;
  node.left = left;
  node.right = right;
  return index;
}

void BoundsTree::refit(std::span<const Bounds> boxes) {
  for (auto node = nodes_.rbegin(); node != nodes_.rend();
       ++node) {  // children are stored after their parents
    if (node->body >= 0) {
      node->box = boxes[static_cast<std::size_t>(node->body)];
    } else {
      node->box = nodes_[static_cast<std::size_t>(node->left)].box;
      node->box.include(nodes_[static_cast<std::size_t>(node->right)].box);
    }
  }
}

void BoundsTree::replace(int body, const Bounds& box) {
  int index = leaf_of_[static_cast<std::size_t>(body)];
  nodes_[static_cast<std::size_t>(index)].box = box;
  for (index = nodes_[static_cast<std::size_t>(index)].parent; index >= 0;
       index = nodes_[static_cast<std::size_t>(index)].parent) {
    nodes_[static_cast<std::size_t>(index)].box.include(box);
  }
}

}  // namespace fc::world
