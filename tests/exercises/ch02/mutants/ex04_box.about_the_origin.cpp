// Caught by: Ex04Box.ItDoesNotMatterWhereTheOriginIs
// The principal axes of how the points spread about the origin.
#include "ex04_box.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace fc::exercises {
namespace {

Vec3 half_along(const Mat3& axes, std::span<const Vec3> points) {
  Eigen::AlignedBox3d range;
  for (const Vec3& p : points) range.extend(axes.transpose() * p);
  return range.sizes() / 2;
}
double surface_along(const Mat3& axes, std::span<const Vec3> points) {
  const Vec3 h = half_along(axes, points);
  return h[0] * h[1] + h[1] * h[2] + h[2] * h[0];
}

Mat3 principal_axes(std::span<const Vec3> points) {
  Vec3 mean = Vec3::Zero();

  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors();
}

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
  const Mat3 none = Mat3::Identity(), principal = principal_axes(points);
  Mat3 best = none;
  for (const Mat3& start : {none, principal}) {
    const Mat3 axes = start;
    if (surface_along(axes, points) < surface_along(best, points)) best = axes;
  }
  return rounded(best, points);
}

}  // namespace fc::exercises
