#include "ch04_multibody_stepping/theta_series.hpp"

#include <cmath>
#include <numbers>

namespace fc::world {

ThetaSeries::ThetaSeries(long double m, long double K, long double b, long double rest)
    : trigonometric_(m <= 0.5L), half_period_(static_cast<double>(2 * K)) {
  const long double period = trigonometric_ ? K : b + rest;
  const double per = static_cast<double>(std::numbers::pi_v<long double> / period);
  rate_ = per / 2;
  slip_ = trigonometric_ ? per / 2 : per / 2 * static_cast<double>(b / K);

  const double q = std::exp(-per * static_cast<double>(trigonometric_ ? b + rest : K));
  const double q2 = q * q, q4 = q2 * q2, q6 = q4 * q2;
  odd_ = {q2, q6, q6 * q6};
  even_ = {2 * q, 2 * q4, 2 * q4 * q4 * q};
  const double theta2 = 1 + odd_[0] + odd_[1] + odd_[2];  // at 0; its factor 2 q^(1/4) is left out everywhere
  const double theta3 = 1 + even_[0] + even_[1] + even_[2];
  const double theta4 = 1 - even_[0] + even_[1] - even_[2];
  if (trigonometric_) {  // sn = theta3/theta2 theta1(x)/theta4(x), and so on
    sn_ = theta3 / theta2;
    cn_ = theta4 / theta2;
    dn_ = theta4 / theta3;
    set_turn(q, std::exp(-per * static_cast<double>(b)), per * static_cast<double>(rest));
  } else {  // sn(u | m) = -i sn(iu | 1-m)/cn(iu | 1-m), and so on
    sn_ = theta3 / theta4;
    cn_ = theta2 / theta4;
    dn_ = theta2 / theta3;
    set_turn(q, per / 2 * static_cast<double>(rest));
  }
}

// Theta(u + i b), up to factors of constant phase, is exp(-i slip u) times the sum of turn_cosine[n] cos((2n+1) x) + i
// turn_sine[n] sin((2n+1) x). With h = exp(-pi b/K), g = exp(-pi (K' - b)/K) and q = g h, the coefficients are (-1)^n
// q^(n^2) h^n (1 -+ g^(2n+1)), where 1 - g is computed to all its digits.
void ThetaSeries::set_turn(double q, double h, double log_g) {
  const double g = std::exp(-log_g), one_less_g = -std::expm1(-log_g);
  double common = 1, step = -q * h, power = g, sum = 1;  // power: g^(2n+1), sum: 1 + g + ... + g^(2n)
  for (int n = 0; n < 4; ++n) {
    turn_cosine_[n] = common * one_less_g * sum;
    turn_sine_[n] = common * (1 + power);
    common *= step;
    step *= q * q;
    sum += power * (1 + g);
    power *= g * g;
  }
}

// For the other nome they are (-1)^n q^(n(n+1)) times the sine and the cosine of (2n+1) pi (K' - b)/(2K').
void ThetaSeries::set_turn(double q, double angle) {
  double common = 1, step = -q * q;
  for (int n = 0; n < 4; ++n) {
    turn_cosine_[n] = common * std::sin((2 * n + 1) * angle);
    turn_sine_[n] = common * std::cos((2 * n + 1) * angle);
    common *= step;
    step *= q * q;
  }
}

ThetaSeries::Values ThetaSeries::at(double u) const {
  const double halves = std::nearbyint(u / half_period_);
  u -= halves * half_period_;
  const double parity = std::floor(halves / 2) == halves / 2 ? 1 : -1;  // sn, cn change sign, dn does not

  // s, c: the sine and cosine, or the hyperbolic ones, of 1, 3, 5, 7 times x; even: the cosine of 2, 4, 6
  // times.
  const double x = rate_ * u;
  double s, c, sign;
  if (trigonometric_) {
    s = std::sin(x);
    c = std::cos(x);
    sign = -1;
  } else {
    s = std::sinh(x);
    c = std::sqrt(1 + s * s);
    sign = 1;
  }
  const double c2 = c * c + sign * s * s, s2 = 2 * s * c;
  double even = c2, even_sine = s2, alternate = 1;
  double theta1 = s, theta2 = c, theta3 = 1, theta4 = 1;
  double real = turn_cosine_[0] * c, imaginary = turn_sine_[0] * s;
  for (int n = 0; n < 3; ++n) {
    alternate = -alternate;
    const double next = s * c2 + c * s2;
    c = c * c2 + sign * s * s2;
    s = next;
    theta1 += alternate * odd_[n] * s;
    theta2 += odd_[n] * c;
    theta3 += even_[n] * even;
    theta4 += alternate * even_[n] * even;
    real += turn_cosine_[n + 1] * c;
    imaginary += turn_sine_[n + 1] * s;
    const double next_even = even * c2 + sign * even_sine * s2;
    even_sine = even_sine * c2 + even * s2;
    even = next_even;
  }
  const double over = trigonometric_ ? theta2 : theta4;
  return {parity * sn_ * theta1, parity * cn_ * over, dn_ * theta3, slip_ * u, real, imaginary};
}

}  // namespace fc::world
