#include "common/exact_collinear.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace fc {
namespace {

// A sum held without rounding, as doubles whose digits do not overlap (Shewchuk, "Adaptive precision
// floating-point arithmetic", 1997, grow-expansion).
class ExactSum {
 public:
  void add(double value) {
    int kept = 0;
    for (int i = 0; i < size_; ++i) {
      const double sum = value + terms_[i];
      const double part = sum - value;
      const double error = (value - (sum - part)) + (terms_[i] - part);
      if (error != 0) terms_[kept++] = error;
      value = sum;
    }
    if (value != 0) terms_[kept++] = value;
    size_ = kept;
  }
  void add_product(double x, double y) {
    const double product = x * y;
    add(product);
    add(std::fma(x, y, -product));  // what the product's rounding lost, exactly
  }
  bool is_zero() const { return size_ == 0; }

 private:
  std::array<double, 12> terms_{};  // six products of two terms each
  int size_ = 0;
};

// Whether the plane points (a0, a1), (b0, b1), (c0, c1) lie on one line: (b - a) x (c - a) = 0, multiplied
// out.
bool collinear_2d(double a0, double a1, double b0, double b1, double c0, double c1) {
  const double left = (b0 - a0) * (c1 - a1), right = (b1 - a1) * (c0 - a0);
  // Eight roundings of relative size eps/2 at most go into left - right: beyond that the sign is certain.
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * (std::abs(left) + std::abs(right));
  if (std::abs(left - right) > rounding) return false;
  ExactSum sum;
  sum.add_product(b0, c1);
  sum.add_product(-b0, a1);
  sum.add_product(-a0, c1);
  sum.add_product(-b1, c0);
  sum.add_product(b1, a0);
  sum.add_product(a1, c0);
  return sum.is_zero();
}

}  // namespace

bool exactly_collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  // Three points of space are collinear when their shadows on all three coordinate planes are.
  return collinear_2d(a.x(), a.y(), b.x(), b.y(), c.x(), c.y()) &&
         collinear_2d(a.y(), a.z(), b.y(), b.z(), c.y(), c.z()) &&
         collinear_2d(a.z(), a.x(), b.z(), b.x(), c.z(), c.x());
}

}  // namespace fc
