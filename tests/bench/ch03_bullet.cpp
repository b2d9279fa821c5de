#include "tests/bench/ch03_bullet.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#include <BulletDynamics/MLCPSolvers/btDantzigLCP.h>
#include <BulletDynamics/MLCPSolvers/btLemkeAlgorithm.h>
#include <BulletDynamics/MLCPSolvers/btSolveProjectedGaussSeidel.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <vector>

namespace fc::bench {

struct BulletLcp::Memory {
  btDantzigScratchMemory scratch;
  std::vector<btScalar> A, x, b, w, lower, upper;
  btMatrixXu matrix;
  btVectorXu vector, solution, low, high;
  btAlignedObjectArray<int> no_dependency;
  btSolveProjectedGaussSeidel pgs;
};

BulletLcp::BulletLcp() : memory_(std::make_unique<Memory>()) {}
BulletLcp::~BulletLcp() = default;

bool BulletLcp::dantzig(const MatX& A, const VecX& b, VecX& z) {
  Memory& m = *memory_;
  const auto n = static_cast<std::size_t>(b.size());
  m.A.assign(A.data(), A.data() + A.size());  // symmetric: rows are columns
  m.b.resize(n);
  for (std::size_t i = 0; i < n; ++i) m.b[i] = -b[static_cast<Eigen::Index>(i)];  // its w is A x - b
  m.x.assign(n, 0.0);
  m.w.assign(n, 0.0);
  m.lower.assign(n, 0.0);
  m.upper.assign(n, BT_INFINITY);
  const bool said_solved =
      btSolveDantzigLCP(static_cast<int>(n), m.A.data(), m.x.data(), m.b.data(), m.w.data(), 0,
                        m.lower.data(), m.upper.data(), nullptr, m.scratch);
  z = Eigen::Map<const VecX>(m.x.data(), b.size());
  return said_solved;
}

namespace {

void copy(const MatX& A, const VecX& b, double sign, btMatrixXu& matrix, btVectorXu& vector) {
  const int n = static_cast<int>(b.size());
  matrix.resize(n, n);
  vector.resize(n);
  for (int i = 0; i < n; ++i) {
    vector[i] = sign * b[i];
    for (int j = 0; j < n; ++j) matrix.setElem(i, j, A(j, i));
  }
}

}  // namespace

bool BulletLcp::lemke(const MatX& A, const VecX& b, VecX& z) {
  Memory& m = *memory_;
  copy(A, b, 1, m.matrix, m.vector);
  btLemkeAlgorithm algorithm(m.matrix, m.vector);
  const btVectorXu w_and_z = algorithm.solve(1000);
  const int n = static_cast<int>(b.size());
  z.resize(n);
  for (int i = 0; i < n; ++i) z[i] = w_and_z[n + i];
  return algorithm.getInfo() == 0;
}

bool BulletLcp::pgs(const MatX& A, const VecX& b, VecX& z) {
  Memory& m = *memory_;
  const int n = static_cast<int>(b.size());
  copy(A, b, -1, m.matrix, m.vector);
  m.solution.resize(n);
  m.low.resize(n);
  m.high.resize(n);
  m.no_dependency.resize(n);
  double size = 0;
  for (int i = 0; i < n; ++i) {
    m.solution[i] = m.low[i] = 0;
    m.high[i] = BT_INFINITY;
    m.no_dependency[i] = -1;
    size = std::max(size, std::abs(b[i]) / A(i, i));
  }
  m.pgs.m_leastSquaresResidualThreshold = 1e-20 * size * size;
  const bool ran =
      m.pgs.solveMLCP(m.matrix, m.vector, m.solution, m.low, m.high, m.no_dependency, 10000, false);
  z.resize(n);
  for (int i = 0; i < n; ++i) z[i] = m.solution[i];
  return ran;
}

}  // namespace fc::bench
