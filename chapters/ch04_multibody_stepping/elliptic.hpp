// Elliptic integrals, to nearly all digits of long double. They are computed once per motion, never per pose.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fc::world {

// Carlson's symmetric integral of the first kind,
//   R_F(x, y, z) = 1/2 * integral from 0 to infinity of dt / sqrt((t + x)(t + y)(t + z)),
// for x, y, z >= 0 of which at most one is 0. Each duplication leaves the value as it is and brings the
// arguments four times as close together; when they almost agree, five terms of a series finish. The
// incomplete integral of the first kind is F = sin(phi) R_F(cos^2(phi), 1 - m sin^2(phi), 1).
// Carlson, "Computing Elliptic Integrals by Duplication" (1979).
inline long double carlson_rf(long double x, long double y, long double z) {
  constexpr long double close = 1e-3L;  // the series' error is close^6 / 4096
  while (true) {
    const long double mean = (x + y + z) / 3;
    const long double dx = 1 - x / mean, dy = 1 - y / mean, dz = -dx - dy;
    if (std::max({std::abs(dx), std::abs(dy), std::abs(dz)}) < close) {
      const long double e2 = dx * dy - dz * dz, e3 = dx * dy * dz;
      return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44) / std::sqrt(mean);
    }
    const long double rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z);
    const long double shift = rx * (ry + rz) + ry * rz;
    x = (x + shift) / 4;
    y = (y + shift) / 4;
    z = (z + shift) / 4;
  }
}

// Bulirsch's general complete integral, for k > 0 (the complementary modulus), p > 0,
//   integral from 0 to pi/2 of (a cos^2 + b sin^2) / ((cos^2 + p sin^2) sqrt(cos^2 + k^2 sin^2)),
// by Bartky's form of the arithmetic-geometric mean. For a, b >= 0 it only adds positive numbers. With
// p = a = b = 1 it is K. Bulirsch, "Numerical Calculation of Elliptic Integrals and Elliptic Functions III"
// (1969).
inline long double complete_integral(long double k, long double p, long double a, long double b) {
  const long double close = std::sqrt(std::numeric_limits<long double>::epsilon()) / 4;
  p = std::sqrt(p);
  b /= p;
  long double mean = 1, product = k;
  while (true) {
    const long double ratio = product / p, old_a = a, old_mean = mean;
    a += b / p;
    b = 2 * (b + old_a * ratio);
    p += ratio;
    mean += k;
    if (std::abs(old_mean - k) <= close * old_mean) break;
    k = 2 * std::sqrt(product);
    product = k * mean;
  }
  return std::numbers::pi_v<long double> / 2 * (b + a * mean) / (mean * (mean + p));
}

}  // namespace fc::world
