// Bullet's solvers of dense LCPs, in double precision, behind plain arrays: other files do not include its headers.
#pragma once

#include <memory>

#include "common/types.hpp"

namespace fc::bench {

// Each keeps its memory from problem to problem, as an engine would. z: n, as left by the solver; false if it
// says that it failed. What a solver destroys of its input is copied within the call.
class BulletLcp {
 public:
  BulletLcp();
  ~BulletLcp();
  bool dantzig(const MatX& A, const VecX& b, VecX& z);  // btSolveDantzigLCP
  bool lemke(const MatX& A, const VecX& b,
             VecX& z);  // btLemkeAlgorithm, at most 1000 pivots, its solver's own limit
  // btSolveProjectedGaussSeidel, at most 10,000 sweeps, until the squared updates of a sweep sum up to less
  // than (1e-10 max|z|)^2.
  bool pgs(const MatX& A, const VecX& b, VecX& z);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace fc::bench
