#include "ch06_friction/slip_equation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fc::friction {
namespace {

// Newton's method takes about five steps. Halving the bracket takes at most as many steps as a double has bits.
constexpr int kRootSteps = 200;
constexpr int kHalvings = 48;  // of a stretch of t: they only separate roots

using Polynomial = std::array<double, 5>;  // coefficients of 1, t, t², t³, t⁴

Polynomial times(const Polynomial& p, const Polynomial& q) {
  Polynomial product{};
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; i + j < 5; ++j) product[i + j] += p[i] * q[j];
  return product;
}

Polynomial sum(double a, const Polynomial& p, double b, const Polynomial& q) {
  Polynomial result{};
  for (std::size_t i = 0; i < 5; ++i) result[i] = a * p[i] + b * q[i];
  return result;
}

double value(const Polynomial& p, double t) {
  return p[0] + t * (p[1] + t * (p[2] + t * (p[3] + t * p[4])));
}

// Where p changes its sign in (0, 1), ascending, at most four: between two neighbouring roots of its derivative,
// hence of the derivative's derivative ..., a polynomial is monotone.
int sign_changes(const Polynomial& p, int degree, std::array<double, 4>& roots) {
  if (degree == 0) return 0;
  const Polynomial derivative{p[1], 2 * p[2], 3 * p[3], 4 * p[4], 0};
  std::array<double, 4> turns{};
  const int pieces = sign_changes(derivative, degree - 1, turns) + 1;
  int count = 0;
  double low = 0;
  for (int k = 0; k < pieces; ++k) {
    const double end = k + 1 < pieces ? turns[static_cast<std::size_t>(k)] : 1.0;
    double high = end;
    const bool positive = value(p, low) > 0;
    if (positive != (value(p, high) > 0)) {
      for (int h = 0; h < kHalvings; ++h) {
        const double middle = 0.5 * (low + high);
        ((value(p, middle) > 0) == positive ? low : high) = middle;
      }
      roots[static_cast<std::size_t>(count++)] = 0.5 * (low + high);
    }
    low = end;
  }
  return count;
}

}  // namespace

double SlipEquation::excess(double alpha) const {
  const Vec2 y = tangent(alpha);
  return y.norm() - mu * normal(y);
}

// There |r_T| <= |d̂|/α, and r_N >= free - |c||d̂|/α.
double SlipEquation::beyond_all_roots() const {
  return 2 * d.norm() * (1 + mu * c.norm()) / (mu * free);
}

// f(low) > 0 >= f(high). Newton's method on µ r_N/|r_T| - 1, which is nearly a straight line in α (Moré and Sorensen
// 1983, for the radius of a trust region); where a step leaves the bracket, the bracket is halved.
// ANCHOR: root
double SlipEquation::root_between(double low, double high) const {
  double alpha = high;
  for (int step = 0; step < kRootSteps; ++step) {
    const Vec2 y = tangent(alpha), slope = -y.cwiseQuotient((delta.array() + alpha).matrix());
    const double size = y.norm(), bound = mu * normal(y);
    (bound < size ? low : high) = alpha;
    const double rise = -mu * c.dot(slope) - bound * y.dot(slope) / (size * size);
    double next = alpha - (bound - size) / rise;
    if (!(next > low && next < high)) {
      if (std::abs(next - alpha) <= 4 * std::numeric_limits<double>::epsilon() * alpha) return alpha;
      next = high > 4 * low ? std::max(std::sqrt(low * high), 1e-3 * high) : 0.5 * (low + high);
      if (!(next > low && next < high)) return high;
    }
    if (std::abs(next - alpha) <= std::numeric_limits<double>::epsilon() * alpha) return next;
    alpha = next;
  }
  return alpha;
}
// ANCHOR_END: root

// Where f may have several roots, it is searched piece by piece. With t = α/(α + τ) and L_i = δ_i (1-t) + τ t, the
// equation f = 0, multiplied by its conjugate and the denominators, is a quartic:
//   (1-t)² |(d̂₁L₂, d̂₂L₁)|² = µ² (free L₁L₂ + (1-t)(c₁d̂₁L₂ + c₂d̂₂L₁))².
// Between two neighbouring turning points the quartic has at most one root, so that f changes its sign there at most
// once.
double SlipEquation::least_root(bool one_root) const {
  const double most = beyond_all_roots();
  if (!std::isfinite(most)) return most;
  if (one_root || (c[0] * d[0] <= 0 && c[1] * d[1] <= 0))
    return root_between(0, most);  // f falls, or is convex
  const double tau = delta[1] > 0 ? delta[1] : most;
  const Polynomial down{1, -1}, L1{delta[0], tau - delta[0]}, L2{delta[1], tau - delta[1]};
  const Polynomial y1 = times({d[0]}, times(down, L2)), y2 = times({d[1]}, times(down, L1));
  const Polynomial bound = sum(mu * free, times(L1, L2), mu, sum(c[0], y1, c[1], y2));
  const Polynomial quartic = sum(1, sum(1, times(y1, y1), 1, times(y2, y2)), -1, times(bound, bound));
  std::array<double, 4> turns{};
  const int count = sign_changes({quartic[1], 2 * quartic[2], 3 * quartic[3], 4 * quartic[4], 0}, 3, turns);
  double low = 0;
  for (int k = 0; k < count; ++k) {
    const double t = turns[static_cast<std::size_t>(k)], alpha = tau * t / (1 - t);
    if (!(alpha > low && alpha < most)) continue;
    if (excess(alpha) <= 0) return root_between(low, alpha);
    low = alpha;
  }
  return root_between(low, most);
}

}  // namespace fc::friction
