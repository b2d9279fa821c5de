// The matrix of bodies beside a dense one: whatever the links, and with the order of elimination of the last time.
#include "ch06_friction/body_matrix.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

namespace {

using fc::MatX;
using fc::VecX;
using Mat6 = fc::friction::BodyMatrix::Mat6;

// Pushes between bodies of unit masses, as J'J + I.
void expect_solves(fc::friction::BodyMatrix& matrix, int bodies,
                   const std::vector<std::pair<int, int>>& links, std::mt19937& engine) {
  std::normal_distribution<double> some;
  const auto random = [&] { return Mat6(Mat6::NullaryExpr([&] { return some(engine); })); };
  MatX dense = MatX::Identity(6 * bodies, 6 * bodies);
  matrix.start(bodies, links);
  for (int i = 0; i < bodies; ++i) matrix.add(i, i, Mat6::Identity());
  for (const auto& [i, j] : links) {
    const Mat6 a = random(), b = random();
    matrix.add(i, i, a.transpose() * a);
    matrix.add(j, j, b.transpose() * b);
    matrix.add(i, j, a.transpose() * b);
    dense.block<6, 6>(6 * i, 6 * i) += a.transpose() * a;
    dense.block<6, 6>(6 * j, 6 * j) += b.transpose() * b;
    dense.block<6, 6>(6 * i, 6 * j) += a.transpose() * b;
    dense.block<6, 6>(6 * j, 6 * i) += b.transpose() * a;
  }
  matrix.factor();
  const VecX b = VecX::NullaryExpr(6 * bodies, [&] { return some(engine); });
  EXPECT_LE((dense * matrix.solve(b) - b).norm(), 1e-9 * b.norm()) << bodies << " bodies";
}

TEST(BodyMatrix, SolvesAsADenseOne) {
  std::mt19937 engine(1);
  fc::friction::BodyMatrix matrix;
  expect_solves(matrix, 1, {}, engine);
  expect_solves(matrix, 3, {{2, 0}}, engine);
  for (const int bodies : {2, 7, 40}) {
    std::vector<std::pair<int, int>> links;
    for (int k = 0; k < 3 * bodies; ++k) {
      const int i = static_cast<int>(engine() % static_cast<unsigned>(bodies)),
                j = static_cast<int>(engine() % static_cast<unsigned>(bodies));
      if (i != j) links.emplace_back(i, j);  // some twice, and either way
    }
    expect_solves(matrix, bodies, links, engine);
    expect_solves(matrix, bodies, links, engine);
  }
}

}  // namespace
