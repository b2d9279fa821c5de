#include "ch03_impulse_lcp/problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace fc::lcp {
namespace {

// What residual() and acceptable() share.
struct Measures {
  double violation;  // max_i |min(s_i z_i, w_i)|
  double b_size;     // max_i |b_i|
  double az_size;    // max_i (|A||z|)_i
};

// Like std::max, but a NaN on either side stays.
double nan_max(double a, double b) {
  return std::isnan(a) || a >= b ? a : b;
}

// z_i's distance from its bounds, in w's unit, and w_i: what the middle of the three leaves is what
// complementarity misses. Without an upper bound that is min(s z, w).
double violation(double scale, double z, double w, double low, double high) {
  const double above = scale > 0 ? scale * (z - low) : 0.0;
  const double below = scale > 0 ? scale * (z - high) : 0.0;
  if (std::isnan(z) || std::isnan(w)) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(std::max(std::min(above, w), std::min(std::max(above, w), below)));
}

Measures measure(const Lcp& problem, const VecX& z, const VecX& w) {
  const MatX& A = problem.A;
  const VecX& b = problem.b;
  Measures m{0, 0, 0};
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    double scale = 0, az = 0;
    for (Eigen::Index j = 0; j < b.size(); ++j) {
      scale = std::max(scale, std::abs(A(i, j)));
      az += std::abs(A(i, j)) * std::abs(z[j]);
    }
    m.violation = nan_max(m.violation, violation(scale, z[i], w[i], problem.low(i), problem.high(i)));
    m.b_size = nan_max(m.b_size, std::abs(b[i]));
    m.az_size = nan_max(m.az_size, az);
  }
  return m;
}

}  // namespace

const char* name(Status status) {
  switch (status) {
    case Status::solved:
      return "solved";
    case Status::no_solution:
      return "no_solution";
    case Status::ray:
      return "ray";
    case Status::limit:
      return "limit";
    case Status::unsuited:
      return "unsuited";
  }
  return "limit";
}

void check_arguments(const Lcp& problem) {
  const MatX& A = problem.A;
  const VecX& b = problem.b;
  if (A.rows() != A.cols() || A.rows() != b.size()) {
    throw std::invalid_argument("LCP: the matrix is " + std::to_string(A.rows()) + " by " +
                                std::to_string(A.cols()) + ", the vector has " + std::to_string(b.size()) +
                                " entries; n by n and n are needed");
  }
  if (!A.allFinite()) throw std::invalid_argument("LCP: the matrix has an entry that is not finite");
  if (!b.allFinite()) throw std::invalid_argument("LCP: the vector has an entry that is not finite");
  for (const VecX* bound : {problem.lower, problem.upper}) {
    if (bound != nullptr && bound->size() != b.size()) {
      throw std::invalid_argument("LCP: " + std::to_string(bound->size()) + " bounds for " +
                                  std::to_string(b.size()) + " rows; as many are needed");
    }
  }
  if (!problem.boxed()) return;
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    const double low = problem.low(i), high = problem.high(i);
    if (!(low <= 0 && high >= 0 && low < high)) {
      throw std::invalid_argument("LCP: row " + std::to_string(i) + " has the bounds " + std::to_string(low) +
                                  " and " + std::to_string(high) +
                                  "; lower <= 0 <= upper and lower < upper are needed");
    }
  }
}

VecX evaluate(const MatX& A, const VecX& b, const VecX& z) {
  VecX w(b.size());
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    long double sum = b[i];
    for (Eigen::Index j = 0; j < b.size(); ++j) sum += static_cast<long double>(A(i, j)) * z[j];
    w[i] = static_cast<double>(sum);
  }
  return w;
}

double residual(const Lcp& problem, const VecX& z, const VecX& w) {
  const Measures m = measure(problem, z, w);
  if (m.violation == 0) return 0;
  const double size = nan_max(m.b_size, m.az_size);
  return std::isinf(m.violation) ? m.violation : m.violation / size;
}

bool acceptable(const Lcp& problem, const VecX& z, const VecX& w) {
  const MatX& A = problem.A;
  const VecX& b = problem.b;
  const Eigen::Index n = b.size();
  if (A.rows() != n || A.cols() != n || z.size() != n || w.size() != n) return false;
  if (!A.allFinite() || !b.allFinite() || !z.allFinite() || !w.allFinite()) return false;
  if (n == 0) return true;

  const Measures m = measure(problem, z, w);
  const double rounding = 8 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * m.az_size;
  // An overflow makes a measure infinite; written so that the answer is then "no".
  if (!(rounding <= 1e-3 * m.b_size)) return false;
  if (!(m.violation <= 1e-6 * m.b_size + rounding)) return false;

  const VecX again = evaluate(A, b, z);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double low = problem.low(i), high = problem.high(i);
    if (!(z[i] >= low && z[i] <= high)) return false;
    if (A.row(i).isZero(0) && ((w[i] > 0 && z[i] != low) || (w[i] < 0 && z[i] != high))) return false;
    // Stated in the header: the round-off of the products, and of b itself, which is one more term of the
    // sum.
    const double sum_rounding = rounding + 8 * std::numeric_limits<double>::epsilon() * std::abs(b[i]);
    if (!(std::abs(w[i] - again[i]) <= sum_rounding)) return false;
  }
  return true;
}

}  // namespace fc::lcp
