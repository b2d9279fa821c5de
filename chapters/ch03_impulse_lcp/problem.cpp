#include "ch03_impulse_lcp/problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace fc::lcp {
namespace {

// Like std::max, but a NaN on either side stays.
double nan_max(double a, double b) {
  return std::isnan(a) || a >= b ? a : b;
}

// The middle one of w_i and of z_i's distances from its two bounds, in w's unit: by that much complementarity
// is violated. Without an upper bound that is min(s z, w).
double violation(double scale, double z, double w, double low, double high) {
  const double above = scale > 0 ? scale * (z - low) : 0.0;
  const double below = scale > 0 ? scale * (z - high) : 0.0;
  if (std::isnan(z) || std::isnan(w)) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(std::max(std::min(above, w), std::min(std::max(above, w), below)));
}

// residual() of these measures.
template <class Measures>
double ratio(const Measures& m) {
  if (m.violation == 0) return 0;
  return std::isinf(m.violation) ? m.violation : m.violation / nan_max(m.b_size, m.az_size);
}

template <class Measures>
bool small_enough(const Measures& m, Eigen::Index n) {
  const double rounding = 8 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * m.az_size;
  // An overflow makes a measure infinite; the answer is then "no".
  return m.in_bounds && rounding <= 1e-3 * m.b_size && m.violation <= 1e-6 * m.b_size + rounding;
}

// For certifies_no_solution(), with rows scaled to a diagonal of 1: the size of z relative to b that no
// solution has; and what counts as b'y < 0.
constexpr double kHugeImpulse = 1e8;
constexpr double kCertificateGap = 1e-9;

// If |A||z| exceeds this many times |b|, digits cancel in A z + b, and the sum is taken in extended
// precision.
constexpr double kCancels = 16;

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
  // 0 times a number that is not finite is NaN; unlike a test of every entry, this sum is computed several
  // entries at a time.
  if ((A.array() * 0.0).sum() != 0)
    throw std::invalid_argument("LCP: the matrix has an entry that is not finite");
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
  // Four rows at a time: their entries of a column are neighbours in memory.
  const Eigen::Index n = b.size();
  VecX w(n);
  for (Eigen::Index i = 0; i < n; i += 4) {
    const Eigen::Index rows = std::min<Eigen::Index>(4, n - i);
    long double sum[4] = {0, 0, 0, 0};
    for (Eigen::Index r = 0; r < rows; ++r) sum[r] = b[i + r];
    for (Eigen::Index j = 0; j < n; ++j) {
      if (z[j] == 0) continue;
      const double* const column = A.data() + j * n + i;
      const long double zj = z[j];
      if (rows == 4) {
        for (int r = 0; r < 4; ++r) sum[r] += column[r] * zj;
      } else {
        for (Eigen::Index r = 0; r < rows; ++r) sum[r] += column[r] * zj;
      }
    }
    for (Eigen::Index r = 0; r < rows; ++r) w[i + r] = static_cast<double>(sum[r]);
  }
  return w;
}

bool certifies_no_solution(const Lcp& problem, const VecX& y) {
  return no_solution_certificate(problem, y).size() > 0;
}

VecX no_solution_certificate(const Lcp& problem, const VecX& y) {
  const Eigen::Index n = problem.size();
  VecX scale(n), clean = VecX::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    scale[i] = problem.A(i, i) > 0 ? std::sqrt(problem.A(i, i)) : 1.0;
    if (y[i] > 0 ? std::isinf(problem.high(i)) : std::isinf(problem.low(i))) clean[i] = y[i];
  }
  const double size = clean.cwiseProduct(scale).lpNorm<1>();
  if (!(size > 0)) return {};
  clean /= size;
  const VecX Ay = (problem.A.transpose() * clean).cwiseQuotient(scale);
  const double largest = problem.boxed() ? Ay.lpNorm<Eigen::Infinity>() : Ay.maxCoeff();
  const double gap = -problem.b.dot(clean), b_size = problem.b.cwiseQuotient(scale).lpNorm<Eigen::Infinity>();
  // 0 <= y'w = (A'y)'z - gap needs a z with sum z >= gap / largest.
  const bool proves = gap > kCertificateGap * problem.b.cwiseAbs().dot(clean.cwiseAbs()) &&
                      largest * kHugeImpulse * b_size <= gap;
  return proves ? clean : VecX();
}

// Column by column, as A lies in memory.
void Verifier::sum_rows(const Lcp& problem, const VecX& z) {
  const Eigen::Index n = problem.size();
  for (VecX* v : {&scale_, &products_, &w_}) {
    if (v->size() < n) v->resize(n);
  }
  double *const scale = scale_.data(), *const products = products_.data(), *const w = w_.data();
  std::fill(scale, scale + n, 0.0);
  std::fill(products, products + n, 0.0);
  std::copy(problem.b.data(), problem.b.data() + n, w);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double* const column = problem.A.data() + j * n;
    const double zj = z[j], size = std::abs(zj);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double a = std::abs(column[i]);
      scale[i] = scale[i] < a ? a : scale[i];
      products[i] += a * size;
      w[i] += column[i] * zj;
    }
  }
}

Verifier::Measures Verifier::measure(const Lcp& problem, const VecX& z, const VecX& w) const {
  Measures m;
  for (Eigen::Index i = 0; i < problem.size(); ++i) {
    const double low = problem.low(i), high = problem.high(i);
    m.violation = nan_max(m.violation, violation(scale_[i], z[i], w[i], low, high));
    m.b_size = nan_max(m.b_size, std::abs(problem.b[i]));
    m.az_size = nan_max(m.az_size, products_[i]);
    if (!(z[i] >= low && z[i] <= high)) m.in_bounds = false;
    if (scale_[i] == 0 && ((w[i] > 0 && z[i] != low) || (w[i] < 0 && z[i] != high))) m.in_bounds = false;
  }
  return m;
}

Verdict Verifier::judge(const Lcp& problem, const VecX& z, VecX& w) {
  sum_rows(problem, z);
  const Eigen::Index n = problem.size();
  const bool cancels =
      n > 0 && !(products_.head(n).maxCoeff() <= kCancels * problem.b.lpNorm<Eigen::Infinity>());
  if (cancels) {
    w = evaluate(problem.A, problem.b, z);
  } else {
    w = w_.head(n);
  }
  const Measures m = measure(problem, z, w);
  const double error = m.violation == 0 ? 0.0 : m.violation / m.b_size;
  return {ratio(m), error, small_enough(m, n)};
}

double residual(const Lcp& problem, const VecX& z, const VecX& w) {
  Verifier verifier;
  verifier.sum_rows(problem, z);
  return ratio(verifier.measure(problem, z, w));
}

bool acceptable(const Lcp& problem, const VecX& z, const VecX& w) {
  const MatX& A = problem.A;
  const VecX& b = problem.b;
  const Eigen::Index n = b.size();
  if (A.rows() != n || A.cols() != n || z.size() != n || w.size() != n) return false;
  if (!A.allFinite() || !b.allFinite() || !z.allFinite() || !w.allFinite()) return false;
  if (n == 0) return true;

  Verifier verifier;
  verifier.sum_rows(problem, z);
  const Verifier::Measures m = verifier.measure(problem, z, w);
  if (!small_enough(m, n)) return false;
  const VecX again = evaluate(A, b, z);
  const double rounding = 8 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * m.az_size;
  for (Eigen::Index i = 0; i < n; ++i) {
    // Stated in the header: the round-off of the products, and of b itself, which is one more term of the
    // sum.
    const double sum_rounding = rounding + 8 * std::numeric_limits<double>::epsilon() * std::abs(b[i]);
    if (!(std::abs(w[i] - again[i]) <= sum_rounding)) return false;
  }
  return true;
}

}  // namespace fc::lcp
