// Free rotation by integrating the equations of motion: slow, and with nothing in common with the closed
// form.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace fc::test {

// The angular momentum and the world's axes are constant, so that seen from the body each obeys x' = x cross w, with
// w_i = L_i / I_i. Taylor series of order 30 in steps of a quarter radian: a step is exact to rounding.
template <class Real>
struct EulerIntegrator {
  using Vec = Eigen::Matrix<Real, 3, 1>;
  using Mat = Eigen::Matrix<Real, 3, 3>;

  // All in principal axes: `rotation` turns them into world axes.
  EulerIntegrator(const Vec& moments, const Mat& rotation, const Vec& spin_world)
      : moments_(moments), still_{Vec(), rotation.row(0), rotation.row(1), rotation.row(2)} {
    still_[0] = moments.cwiseProduct(rotation.transpose() * spin_world);
  }

  Vec spin() const { return still_[0].cwiseQuotient(moments_); }  // rad/s, principal axes
  Mat rotation() const {
    Mat m;
    for (int i = 0; i < 3; ++i) m.row(i) = still_[i + 1].transpose();
    return m;
  }
  Vec spin_world() const { return rotation() * spin(); }

  void run(Real duration) {
    const Real direction = duration < 0 ? -1 : 1;
    for (Real left = duration * direction; left > 0;) {
      const Vec w = spin();
      const double rate = std::sqrt(static_cast<double>(w.dot(w)));
      const Real h = std::min(left, Real(0.25 / rate));
      step(direction * h);
      left -= h;
    }
  }

 private:
  void step(Real h) {
    constexpr int order = 30;
    std::array<std::array<Vec, order + 1>, 4> x;  // coefficients of t^k
    std::array<Vec, order> w;
    for (int j = 0; j < 4; ++j) x[j][0] = still_[j];
    for (int k = 0; k < order; ++k) {
      w[k] = x[0][k].cwiseQuotient(moments_);
      for (auto& series : x) {
        Vec sum = Vec::Zero();
        for (int i = 0; i <= k; ++i) sum += series[i].cross(w[k - i]);
        series[k + 1] = sum / Real(k + 1);
      }
    }
    for (int j = 0; j < 4; ++j) {
      still_[j] = x[j][order];
      for (int k = order - 1; k >= 0; --k) still_[j] = x[j][k] + h * still_[j];
    }
  }

  Vec moments_;               // kg m^2
  std::array<Vec, 4> still_;  // L, and the world's x, y, z, in principal axes
};

}  // namespace fc::test
