// libcore/motion/pose.hpp: public
// Where a body is: its centroid and the rotation from body axes to local axes.
#pragma once

#include <Eigen/Geometry>

#include "base/types.hpp"

namespace talus {

using Quat = Eigen::Quaterniond;

/// A body point X lies at position + attitude * X.
struct Pose {
  Vec3 position = Vec3::Zero();      ///< centroid, relative to the origin [m]
  Quat attitude = Quat::Identity();  ///< unit quaternion, body to local axes
};

[[nodiscard]] inline Vec3 place(const Pose& pose, const Vec3& body_point) {
  return pose.position + pose.attitude * body_point;
}

}  // namespace talus
