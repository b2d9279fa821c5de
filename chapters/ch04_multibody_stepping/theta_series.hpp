// Jacobi's elliptic functions of one parameter, and the phase of his Theta function, by theta series.
#pragma once

#include <array>

namespace fc::world {

// sn, cn and dn of u with parameter m, and the phase of Theta(u + i b | m) for a fixed b. They describe
// the motion of a free body. K is the quarter period, K' that of 1 - m, and 0 < b < K'.
//
// The series are in the powers q, q^4, q^9 of the nome q = exp(-pi K'/K). For m > 1/2 the nome exp(-pi K/K') is used,
// at an imaginary argument (Jacobi's transformation): hyperbolic sines instead of sines. So the nome is at most
// exp(-pi) = 0.043, its 16th power is below eps, and four terms are enough for every m and u.
class ThetaSeries {
 public:
  struct Values {
    double sn, cn, dn;       // all three times the same positive factor, which drops out of a direction
    double angle;            // The phase of Theta(u + i b) is, up to a constant that does not depend on u,
    double real, imaginary;  // that of the number real + i imaginary, less this angle (rad).
  };

  ThetaSeries() = default;
  // From m and the integrals K, b, and K' - b (infinite if m = 0), each given to all its digits.
  ThetaSeries(long double m, long double K, long double b, long double rest);

  Values at(double u) const;

 private:
  void set_turn(double q, double h, double log_g);
  void set_turn(double q, double angle);

  bool trigonometric_ = true;
  double half_period_ = 1;                             // 2K
  double rate_ = 0, slip_ = 0;                         // of the series' own argument and of the angle, per u
  double sn_ = 0, cn_ = 0, dn_ = 0;                    // factors of the theta functions' quotients
  std::array<double, 3> odd_{}, even_{};               // coefficients of the theta functions,
  std::array<double, 4> turn_cosine_{}, turn_sine_{};  // and of Theta(u + i b)
};

}  // namespace fc::world
