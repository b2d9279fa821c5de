// What two shapes do to each other when they touch.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "common/scene.hpp"
#include "common/shape.hpp"

namespace fc {

// The scene's list of pairs, sorted to be looked up.
class PairRules {
 public:
  PairRules() = default;
  explicit PairRules(const Scene& scene) {
    for (const PairSpec& pair : scene.pairs)
      restitutions_.push_back({{pair.shape_a, pair.shape_b}, pair.restitution});
    std::sort(restitutions_.begin(), restitutions_.end());
  }

  // The list's value, or the larger of the two shapes' own. shape_a, shape_b: indices into the shapes.
  double restitution(const std::vector<Shape>& shapes, int shape_a, int shape_b) const {
    if (!restitutions_.empty()) {
      const std::pair<int, int> names = std::minmax(shape_a, shape_b);
      const auto found = std::lower_bound(restitutions_.begin(), restitutions_.end(), names,
                                          [](const Entry& e, const auto& key) { return e.first < key; });
      if (found != restitutions_.end() && found->first == names) return found->second;
    }
    return std::max(shapes[static_cast<std::size_t>(shape_a)].restitution,
                    shapes[static_cast<std::size_t>(shape_b)].restitution);
  }

 private:
  using Entry = std::pair<std::pair<int, int>, double>;
  std::vector<Entry> restitutions_;
};

}  // namespace fc
