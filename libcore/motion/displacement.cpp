// Displacement of a block's points by its 12 degrees of freedom; mass and elastic matrices.
#include "motion/displacement.hpp"

namespace talus {

Mat3x12 displacement_matrix(const Vec3& arm) {
  const double x = arm.x(), y = arm.y(), z = arm.z();
  Mat3x12 T;
  // clang-format off
  T << 1, 0, 0,   0,  z, -y,  x, 0, 0,      0, z / 2, y / 2,
       0, 1, 0,  -z,  0,  x,  0, y, 0,  z / 2,     0, x / 2,
       0, 0, 1,   y, -x,  0,  0, 0, z,  y / 2, x / 2,     0;
  // clang-format on
  return T;
}

Mat12 mass_matrix(double density, double volume, const Mat3& second) {
  const double xx = second(0, 0), yy = second(1, 1), zz = second(2, 2);
  const double xy = second(0, 1), xz = second(0, 2), yz = second(1, 2);
  Eigen::Matrix<double, 9, 9> Q;
  // clang-format off
  Q << yy + zz,     -xy,     -xz,   0, -yz,  yz, (yy - zz) / 2,        xy / 2,       -xz / 2,
           -xy, xx + zz,     -yz,  xz,   0, -xz,       -xy / 2, (zz - xx) / 2,        yz / 2,
           -xz,     -yz, xx + yy, -xy,  xy,   0,        xz / 2,       -yz / 2, (xx - yy) / 2,
             0,      xz,     -xy,  xx,   0,   0,             0,        xz / 2,        xy / 2,
           -yz,       0,      xy,   0,  yy,   0,        yz / 2,             0,        xy / 2,
            yz,     -xz,       0,   0,   0,  zz,        yz / 2,        xz / 2,             0,
      (yy-zz)/2,  -xy / 2,  xz / 2,  0, yz/2, yz/2, (yy + zz) / 4,     xy / 4,        xz / 4,
         xy / 2, (zz-xx)/2, -yz / 2, xz/2, 0, xz/2,        xy / 4, (zz + xx) / 4,     yz / 4,
        -xz / 2,  yz / 2, (xx-yy)/2, xy/2, xy/2, 0,        xz / 4,        yz / 4, (xx + yy) / 4;
  // clang-format on
  Mat12 M = Mat12::Zero();
  M.topLeftCorner<3, 3>() = density * volume * Mat3::Identity();
  M.bottomRightCorner<9, 9>() = density * Q;
  return M;
}

Mat6 elastic_matrix(double young, double poisson) {
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  const double shear = young / (2 * (1 + poisson));
  Mat6 C = Mat6::Zero();
  C.topLeftCorner<3, 3>().setConstant(lambda);
  C.topLeftCorner<3, 3>().diagonal().array() += 2 * shear;
  C.bottomRightCorner<3, 3>().diagonal().setConstant(shear);
  return C;
}

Eigen::Matrix<double, 6, 1> strain_load(const Vec3& arm, const Vec3& force) {
  Eigen::Matrix<double, 6, 1> load;
  load << arm.x() * force.x(), arm.y() * force.y(), arm.z() * force.z(),
      (arm.z() * force.y() + arm.y() * force.z()) / 2,
      (arm.z() * force.x() + arm.x() * force.z()) / 2,
      (arm.y() * force.x() + arm.x() * force.y()) / 2;
  return load;
}

}  // namespace talus
