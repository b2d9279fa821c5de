// The factory's matrices that do not come from contacts: random ones of prescribed condition, rank and
// symmetry, Hilbert's, and those with bounds.
#include <Eigen/QR>
#include <cmath>
#include <numeric>

#include "ch03_impulse_lcp/problem_factory_parts.hpp"

namespace fc::lcp::detail {
namespace {

// Rounds entries to whole multiples of 2^-36 times the largest one's power of two: few enough bits that the
// sums of A z are exact. Moves an eigenvalue by at most n 2^-37 of the largest entry, typically by sqrt(n)
// 2^-37.
void round_entries(MatX& A) {
  const double unit = std::exp2(std::ceil(std::log2(A.cwiseAbs().maxCoeff())) - 36);
  for (double& x : A.reshaped()) x = std::round(x / unit) * unit;
}

// Q D Q', eigenvalues from 1 down to 1 / condition, their logarithms evenly spaced; exactly symmetric.
MatX conditioned(Eigen::Index n, double condition, Random& random) {
  MatX G(n, n);
  for (double& x : G.reshaped()) x = random.normal();
  const MatX Q = Eigen::HouseholderQR<MatX>(G).householderQ();
  VecX root(n);
  for (Eigen::Index i = 0; i < n; ++i)
    root[i] = std::pow(condition, -0.5 * static_cast<double>(i) / static_cast<double>(n - 1));
  const MatX half = Q * root.asDiagonal();
  MatX A = half * half.transpose();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < i; ++j) A(j, i) = A(i, j);
  return A;
}

// 1 / (i + j - 1); up to n = 12 times the least common multiple of all denominators, which makes it whole.
MatX hilbert(Eigen::Index n) {
  std::int64_t multiple = 1;
  if (n <= 12)
    for (std::int64_t k = 2; k < 2 * n; ++k) multiple = std::lcm(multiple, k);
  MatX A(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      A(i, j) = static_cast<double>(multiple) / static_cast<double>(i + j + 1);
  return A;
}

// A skew matrix as large as the off-diagonal part of whole_gram(2n, n).
MatX skew(Eigen::Index n, Random& random) {
  const int most = static_cast<int>(3 * std::sqrt(2.0 * static_cast<double>(n)));
  MatX K = MatX::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      K(i, j) = random.whole(-most, most);
      K(j, i) = -K(i, j);
    }
  return K;
}

// The diagonal grows like the root of n: otherwise the inverse of a random triangular matrix grows
// exponentially (Viswanath and Trefethen 1998), and no digit of z would be left.
MatX triangular(Eigen::Index n, Random& random) {
  const int root = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(n))));
  MatX A = MatX::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) A(i, j) = random.whole(-2, 2);
    A(i, i) = root + random.whole(0, 3);
  }
  return A;
}

void set_spd(KnownProblem& p, Eigen::Index n, double condition, Random& random) {
  p.A = conditioned(n, condition, random);
  p.condition = condition;
  p.exact = condition <= 1e8;  // at 1e12 rounding the entries would swallow the small eigenvalues
  if (p.exact) round_entries(p.A);
}

}  // namespace

KnownProblem random_problem(Family family, Eigen::Index n, Random& random) {
  KnownProblem p;
  p.rank = n;
  Eigen::Index active = n / 2, degenerate = 0;
  if (family == Family::random_spd) p.A = whole_gram(2 * n, n, random);
  if (family == Family::spd_1e4) set_spd(p, n, 1e4, random);
  if (family == Family::spd_1e8) set_spd(p, n, 1e8, random);
  if (family == Family::spd_1e12) set_spd(p, n, 1e12, random);
  if (family == Family::all_active) {
    p.A = whole_gram(2 * n, n, random);
    active = n;
  }
  if (family == Family::degenerate) {
    p.A = whole_gram(2 * n, n, random);
    active = degenerate = n / 3;
  }
  if (family == Family::rank_deficient) {
    p.A = whole_gram(n / 2, n, random);
    p.rank = n / 2;
    p.p_matrix = false;
  }
  if (family == Family::graded) {
    const MatX A = whole_gram(2 * n, n, random);
    VecX d(n);
    for (Eigen::Index i = 0; i < n; ++i)
      d[i] = std::exp2(-std::round(20 * static_cast<double>(i) / static_cast<double>(n - 1)));
    p.A = d.asDiagonal() * A * d.asDiagonal();
  }
  if (family == Family::hilbert) {
    p.A = hilbert(n);
    p.exact = p.p_matrix = n <= 12;
    if (n > 12) p.rank = 0;  // of the rounded matrix: round-off decides
  }
  if (family == Family::positive_definite) {
    p.A = whole_gram(2 * n, n, random) + skew(n, random);
    p.symmetric = false;
  }
  if (family == Family::triangular) {
    p.A = triangular(n, random);
    p.symmetric = p.semidefinite = false;
  }
  plant(p, active, degenerate, random);
  return p;
}

KnownProblem bounded_problem(Family family, Eigen::Index n, Random& random) {
  const bool deficient = family == Family::boxed_deficient;
  KnownProblem p;
  p.A = whole_gram(deficient ? n / 2 : 2 * n, n, random);
  p.rank = deficient ? n / 2 : n;
  p.p_matrix = !deficient;
  const VecX scale = natural_scale(p.A);
  std::vector<int> kinds(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i] = static_cast<int>(i % 4);
  random.shuffle(kinds);
  p.lower = p.upper = p.z = p.w = VecX::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int kind = kinds[static_cast<std::size_t>(i)];
    p.lower[i] = -random.eighths() / scale[i];
    p.upper[i] = random.eighths() / scale[i];
    const double w = random.eighths() * scale[i];
    if (kind == 0) p.z[i] = (random.whole(0, 1) == 0 ? p.lower[i] : p.upper[i]) * 0.5;
    if (kind == 1) p.z[i] = p.lower[i], p.w[i] = w;
    if (kind == 2) p.z[i] = p.upper[i], p.w[i] = -w;
    if (kind == 3) {
      p.z[i] = (random.whole(0, 1) == 0 ? p.lower[i] : p.upper[i]) * 2;
      p.upper[i] = std::numeric_limits<double>::infinity();
      p.lower[i] = -p.upper[i];
    }
  }
  set_b(p);
  return p;
}

}  // namespace fc::lcp::detail
