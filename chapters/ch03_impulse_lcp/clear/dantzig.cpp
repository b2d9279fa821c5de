#include "ch03_impulse_lcp/clear/dantzig.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace fc::lcp::clear {
namespace {

// ANCHOR: dantzig
// A sum below this share of the sizes of its terms is round-off, and counts as 0.
constexpr double kZero = 1e-11;
// Below this Schur complement (the diagonal of A is 1) a row depends on the basis.
constexpr double kRank = 1e-13;
// Two steps that differ by less than this share are a tie.
constexpr double kTie = 1e-9;

// x with A_CC x = r_C for the rows C of the basis, and 0 elsewhere.
VecX solve_basis(const MatX& A, const std::vector<int>& basis, const VecX& r) {
  VecX x = VecX::Zero(r.size());
  if (!basis.empty()) x(basis) = MatX(A(basis, basis)).colPivHouseholderQr().solve(VecX(r(basis)));
  return x;
}

}  // namespace

LcpResult dantzig(const MatX& A_given, const VecX& b_given, int limit) {
  const int n = static_cast<int>(b_given.size());
  if (limit == 0) limit = 100 + 50 * n;

  // Give each row a unit of its own, in which the diagonal of A is 1: then the rows can be compared.
  const VecX unit = A_given.diagonal().unaryExpr([](double a) { return a > 0 ? 1 / std::sqrt(a) : 1.0; });
  const MatX A = unit.asDiagonal() * A_given * unit.asDiagonal(), sizes = A.cwiseAbs();
  const VecX b = unit.cwiseProduct(b_given);

  std::vector<int> basis;
  std::vector<char> in(static_cast<std::size_t>(n), 0);  // whether a row is in the basis
  VecX z = VecX::Zero(n), w = b;
  LcpResult result;
  const auto finish = [&](Status status) {
    result.z = unit.cwiseProduct(z.cwiseMax(0.0));
    result.w = evaluate(A_given, b_given, result.z);
    result.status = status;
    return result;
  };
  const auto raise = [&](int i) { return VecX(VecX::Unit(n, i) - solve_basis(A, basis, A.col(i))); };
  const auto independent = [&](int i) { return A.row(i).dot(raise(i)) > kRank; };
  const auto approaches = [&](int i) {
    return w[i] < -kZero * (sizes.row(i).dot(z) + b.lpNorm<Eigen::Infinity>());
  };

  // Take the rows in turn, and repeat those that round-off has moved.
  for (int d = 0, done = 0; done < n; d = (d + 1) % n, ++done) {
    while (!in[d] && approaches(d)) {
      done = 0;
      // Raise z_d by 1; the basis changes so that its w stay 0.
      const VecX dz = raise(d);
      const VecX dw = A * dz, dw_size = sizes * dz.cwiseAbs();

      // Which row stops the drive first? On a tie d, or else the one that moves fastest.
      int stop = -1;
      double step = 0, fastest = 0;
      const auto offer = [&](int i, double length, double speed) {
        const bool tie = stop >= 0 && std::abs(length - step) <= kTie * std::max(step, length);
        if (stop >= 0 && (tie ? speed <= fastest : length > step)) return;
        stop = i, step = length, fastest = i == d ? std::numeric_limits<double>::infinity() : speed;
      };
      if (dw[d] > kZero * dw_size[d]) offer(d, -w[d] / dw[d], dw[d]);
      for (int i = 0; i < n; ++i) {
        if (i == d) continue;
        if (in[i] && dz[i] < -kZero * dz.lpNorm<Eigen::Infinity>()) offer(i, z[i] / -dz[i], -dz[i]);
        // A row that approaches waits for its turn, and stops nothing.
        if (!in[i] && !approaches(i) && dw[i] < -kZero * dw_size[i] && independent(i))
          offer(i, std::max(w[i], 0.0) / -dw[i], -dw[i]);
      }

      // No row does: then dz is the certificate, if it is not round-off.
      if (stop < 0) {
        result.certificate = no_solution_certificate({A_given, b_given}, unit.cwiseProduct(dz));
        return finish(result.certificate.size() > 0 ? Status::no_solution : Status::limit);
      }
      if (result.pivots == limit) return finish(Status::limit);
      ++result.pivots;

      // Go there, and exchange the row.
      z += step * dz;
      if (in[stop])
        z[stop] = 0, std::erase(basis, stop);
      else
        basis.push_back(stop);
      in[stop] = !in[stop];
      w = A * z + b;
    }
  }
  z -= solve_basis(A, basis, A * z + b);  // what round-off has left of w in the basis
  finish(Status::solved);
  if (!acceptable({A_given, b_given}, result.z, result.w)) result.status = Status::limit;
  return result;
}
// ANCHOR_END: dantzig

}  // namespace fc::lcp::clear
