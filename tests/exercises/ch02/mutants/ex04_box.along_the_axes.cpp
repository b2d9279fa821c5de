// Caught by: Ex04Box.TellsTwoPlatesApartAtOnce
// The box along x, y, z.
#include "ex04_box.hpp"

#include <cmath>
#include <limits>

namespace fc::exercises {
namespace {

float float_above(double x) {
  const float nearest = static_cast<float>(x);
  return nearest >= x ? nearest : std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

Box rounded(Mat3 axes, std::span<const Vec3> points) {
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  Box box;
  for (int k = 0; k < 3; ++k) box.axes.col(k) = nearest_floats(axes.col(k));
  const Mat3 as_it_stands = box.axes.cast<double>();
  const Mat3 coordinates = as_it_stands.inverse();
  Eigen::AlignedBox3d range;
  for (const Vec3& p : points) range.extend(coordinates * p);
  box.center = nearest_floats(as_it_stands * range.center());
  const Vec3 center = box.center.cast<double>();
  Vec3 half = Vec3::Zero();
  for (const Vec3& p : points) half = half.cwiseMax((coordinates * (p - center)).cwiseAbs());
  for (int k = 0; k < 3; ++k) box.half[k] = float_above(half[k]);
  return box;
}

}  // namespace

Box fit_box(std::span<const Vec3> points) {
  return rounded(Mat3::Identity(), points);
}

}  // namespace fc::exercises
