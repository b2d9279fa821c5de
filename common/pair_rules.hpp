// What two shapes do to each other when they touch.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/scene.hpp"
#include "common/shape.hpp"

namespace fc {

// The scene's list of pairs, sorted to be looked up. shape_a, shape_b: indices into the shapes.
class PairRules {
 public:
  PairRules() = default;
  explicit PairRules(const Scene& scene) : pairs_(scene.pairs) {
    std::sort(pairs_.begin(), pairs_.end(),
              [](const PairSpec& p, const PairSpec& q) { return names(p) < names(q); });
  }

  // The list's value, or the larger of the two shapes' own.
  double restitution(const std::vector<Shape>& shapes, int shape_a, int shape_b) const {
    if (const PairSpec* pair = find(shape_a, shape_b); pair != nullptr && pair->restitution)
      return *pair->restitution;
    return std::max(shapes[static_cast<std::size_t>(shape_a)].restitution,
                    shapes[static_cast<std::size_t>(shape_b)].restitution);
  }

  // The list's value, or the geometric mean of the two shapes' own. Exact where the two are equal.
  double friction(const std::vector<Shape>& shapes, int shape_a, int shape_b) const {
    if (const PairSpec* pair = find(shape_a, shape_b); pair != nullptr && pair->friction)
      return *pair->friction;
    const double a = shapes[static_cast<std::size_t>(shape_a)].friction,
                 b = shapes[static_cast<std::size_t>(shape_b)].friction;
    return a == b ? a : std::sqrt(a * b);
  }

 private:
  static std::pair<int, int> names(const PairSpec& pair) { return {pair.shape_a, pair.shape_b}; }
  const PairSpec* find(int shape_a, int shape_b) const {
    const std::pair<int, int> key = std::minmax(shape_a, shape_b);
    const auto found =
        std::lower_bound(pairs_.begin(), pairs_.end(), key,
                         [](const PairSpec& pair, const auto& wanted) { return names(pair) < wanted; });
    return found != pairs_.end() && names(*found) == key ? &*found : nullptr;
  }

  std::vector<PairSpec> pairs_;
};

}  // namespace fc
