#include "ch04_multibody_stepping/principal_inertia.hpp"

#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <stdexcept>
#include <string>

namespace fc::world {

namespace {

std::string text(const Vec3& v) {
  return fmt::format("({}, {}, {})", v.x(), v.y(), v.z());
}

}  // namespace

PrincipalInertia::PrincipalInertia(const Mat3& inertia) {
  using LongMat = Eigen::Matrix<long double, 3, 3>;  // a small moment beside large ones keeps its digits
  const auto tensor = [&](const char* what) {
    return fmt::format("the inertia tensor with rows {}, {}, {} kg m^2 is not {}", text(inertia.row(0)),
                       text(inertia.row(1)), text(inertia.row(2)), what);
  };
  if (!inertia.allFinite()) throw std::invalid_argument(tensor("finite"));
  const double largest = inertia.cwiseAbs().maxCoeff();
  if (!((inertia - inertia.transpose()).cwiseAbs().maxCoeff() <= 1e-12 * largest))
    throw std::invalid_argument(tensor("symmetric"));
  const LongMat matrix = inertia.cast<long double>();
  const Eigen::SelfAdjointEigenSolver<LongMat> solver((matrix + matrix.transpose()) / 2);
  moments = solver.eigenvalues().cast<double>();
  axes = solver.eigenvectors().cast<double>();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  const auto values = [&] { return "the principal moments of inertia " + text(moments) + " kg m^2 are "; };
  if (!(moments[0] > 0)) throw std::invalid_argument(values() + "not all positive");
  if (moments[2] - moments[1] > moments[0] + 1e-9 * moments[2])
    throw std::invalid_argument(values() + "those of no mass: the largest exceeds the sum of the others");
}

}  // namespace fc::world
