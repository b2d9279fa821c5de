#include "ex04_lost_solutions.hpp"

#include <Eigen/QR>
#include <limits>
#include <vector>

#include "common/todo.hpp"

namespace fc::exercises {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Dantzig's method, short, plausible, often right. There are four mistakes in it. Engines have shipped all of
// them, in one form or another.
struct Method {
  const MatX& A;
  const VecX& b;
  const int n = static_cast<int>(b.size());
  const double zero_slope = 1e-6, zero_w = 1e-9;  // below these it is round-off
  VecX z = VecX::Zero(n), w = b;
  std::vector<char> in_basis = std::vector<char>(static_cast<std::size_t>(n), 0);

  char& in(int i) { return in_basis[static_cast<std::size_t>(i)]; }

  // How z changes while z_d grows by 1 and the basis keeps its w at 0.
  VecX direction(int d) {
    std::vector<int> basis;
    for (int i = 0; i < n; ++i)
      if (in(i)) basis.push_back(i);
    VecX dz = VecX::Zero(n);
    dz[d] = 1;
    if (!basis.empty()) {
      const MatX block = A(basis, basis);
      const VecX column = A(basis, d);
      dz(basis) = -block.colPivHouseholderQr().solve(column);
    }
    return dz;
  }

  struct Stop {
    int row = -1;  // -1: nothing stops the drive
    double step = kNever;
  };
  // Which row stops the drive of row d first?
  Stop first_stop(int d, const VecX& dz, const VecX& dw) {
    Stop stop;
    if (dw[d] > zero_slope) stop = {d, -w[d] / dw[d]};
    for (int i = 0; i < n; ++i) {
      if (i == d) continue;
      double step = kNever;
      if (in(i)) {
        if (dz[i] < -1e-9) step = z[i] / -dz[i];
      } else {
        if (dw[i] < -zero_slope) step = w[i] / -dw[i];
      }
      if (step <= stop.step) stop = {i, step};
    }
    return stop;
  }
};

}  // namespace

Driven drive_all(const MatX& A, const VecX& b, int most) {
  FC_TODO("3.4");  // delete this line, and begin

  Driven answer;
  Method method{A, b};
  for (int d = 0; d < method.n; ++d) {
    if (method.w[d] >= -method.zero_w) continue;  // it does not approach
    while (!method.in(d)) {
      const VecX dz = method.direction(d), dw = A * dz;
      const Method::Stop stop = method.first_stop(d, dz, dw);
      if (stop.row < 0) break;  // nothing can be done for this row
      if (answer.pivots == most) {
        answer.z = method.z;
        return answer;
      }
      method.z += stop.step * dz;
      method.w = A * method.z + b;
      ++answer.pivots;
      if (method.in(stop.row)) {
        method.z[stop.row] = 0;
        method.in(stop.row) = 0;
      } else {
        method.in(stop.row) = 1;
      }
    }
  }
  answer.status = lcp::Status::solved;
  answer.z = method.z.cwiseMax(0.0);
  return answer;
}

}  // namespace fc::exercises
