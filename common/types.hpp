// The linear algebra types that every file of the project uses.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace fc {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;
using VecX = Eigen::VectorXd;
using MatX = Eigen::MatrixXd;

// A rigid placement: x_world = rotation * x_body + position.
struct Pose {
  Mat3 rotation = Mat3::Identity();
  Vec3 position = Vec3::Zero();  // metres, world

  Vec3 operator*(const Vec3& x_body) const { return rotation * x_body + position; }
};

}  // namespace fc
