// 1.6, in its clear form: tries every face of the simplex.
#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "ch01_convex_advancement/clear/pieces.hpp"

namespace fc::ca::clear {
namespace {

using Edges = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3>;
using Weights = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;

}  // namespace

// ANCHOR: closest_point
// A face is a choice of corners. The bits of `face` say which.
ClosestPoint closest_point(std::span<const Vec3> simplex) {
  const int count = static_cast<int>(simplex.size());
  ClosestPoint best;
  double nearest = std::numeric_limits<double>::infinity();
  for (int face = 1; face < (1 << count); ++face) {
    std::vector<int> corner;
    for (int i = 0; i < count; ++i)
      if (face & (1 << i)) corner.push_back(i);
    // Its plane (line, point): first corner + sum of weight[k] * edge k. Which weights come closest to 0?
    const int edges = static_cast<int>(corner.size()) - 1;
    ClosestPoint candidate;
    candidate.weight[corner[0]] = 1;
    if (edges > 0) {
      Edges edge(3, edges);
      for (int k = 0; k < edges; ++k) edge.col(k) = simplex[corner[k + 1]] - simplex[corner[0]];
      const Eigen::ColPivHouseholderQR<Edges> qr(edge);
      if (qr.rank() < edges) continue;  // a flat face: its own faces hold every point of it
      const Weights weight = qr.solve(-simplex[corner[0]]);
      candidate.weight[corner[0]] = 1 - weight.sum();
      for (int k = 0; k < edges; ++k) candidate.weight[corner[k + 1]] = weight[k];
    }
    // Inside the face, or beyond one of its sides? Then a smaller face has the closest point.
    bool inside = true;
    for (const int i : corner) inside = inside && candidate.weight[i] > 0;
    if (!inside) continue;
    for (const int i : corner) candidate.point += candidate.weight[i] * simplex[i];
    if (candidate.point.norm() < nearest) {
      nearest = candidate.point.norm();
      best = candidate;
    }
  }
  return best;
}
// ANCHOR_END: closest_point

}  // namespace fc::ca::clear
