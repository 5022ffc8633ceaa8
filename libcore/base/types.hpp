// libcore/base/types.hpp: public
// The vector and matrix types of the whole library.
#pragma once

#include <Eigen/Core>

namespace talus {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Vec6 = Eigen::Matrix<double, 6, 1>;

}  // namespace talus
