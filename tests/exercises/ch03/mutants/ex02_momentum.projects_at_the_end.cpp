// Caught by: Ex02Momentum.ManySeparateAndSomePush
// Solves the linear system, and cuts what pulls.
#include "ex02_momentum.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {

double largest_eigenvalue(Products& A, int products) {
  const Eigen::Index n = A.size();
  if (n == 0) return 0;
  // Begin with no symmetry that the scene could have: what is orthogonal to the wanted vector stays so. The
  // golden ratio's multiples, modulo 1, look random and need no seed.
  VecX z(n);
  for (Eigen::Index i = 0; i < n; ++i) z[i] = std::fmod(0.6180339887 * static_cast<double>(i + 1), 1.0) - 0.4;
  z.normalize();
  double largest = 0;
  for (int k = 0; k < products; ++k) {
    const VecX w = A.times(z);
    largest = std::max(largest, z.dot(w));  // Rayleigh's quotient is never above the largest eigenvalue
    const double length = w.norm();
    if (length == 0) break;
    z = w / length;
  }
  return largest;
}

VecX momentum_gradients(Products& A, const VecX& b, double largest, int products) {
  const double step = 0.98 / largest;  // `largest` may be 2 % too small
  VecX z = VecX::Zero(b.size()), ahead = z;
  double t = 1;
  for (int k = 0; k < products; ++k) {
    const VecX gradient = A.times(ahead) + b;
    const VecX next = ahead - step * gradient;
    const VecX move = next - z;
    // The momentum carries us uphill: it has served, and begins anew.
    if (gradient.dot(move) > 0) t = 1;
    const double t_next = (1 + std::sqrt(1 + 4 * t * t)) / 2;
    ahead = next + (t - 1) / t_next * move;
    t = t_next;
    z = next;
  }
  return z.cwiseMax(0.0);
}

}  // namespace fc::exercises
