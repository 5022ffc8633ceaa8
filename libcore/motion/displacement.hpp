// libcore/motion/displacement.hpp: public
// Displacement of a block's points by its 12 degrees of freedom, its mass and elastic matrices.
// paper: Zhang et al. 2018, Eq. (1)-(3); theory 1.2-1.5
//
// D = (u v w, r_x r_y r_z, e_x e_y e_z, g_yz g_zx g_xy): translation of the centroid [m], rotation
// [rad], normal strains and engineering shear strains [-]. Printed (2b), row 2, column 12 has
// (x - z0) / 2; right is (x - x0) / 2 (docs/theory/theory.md).
#pragma once

#include "base/types.hpp"

namespace talus {

using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Mat3x12 = Eigen::Matrix<double, 3, 12>;

/// Eq. (2b), T_i at `arm` = (x - x0, y - y0, z - z0) from the centroid [m].
[[nodiscard]] Mat3x12 displacement_matrix(const Vec3& arm);

/// Consistent mass matrix, the integral of rho T^T T in closed form (theory 1.4) [kg, kg m, kg m2].
/// `second` is the central second moment S in the axes of D [m5].
[[nodiscard]] Mat12 mass_matrix(double density, double volume, const Mat3& second);

/// Hooke's law for (e_x e_y e_z g_yz g_zx g_xy) -> (s_x s_y s_z t_yz t_zx t_xy) [Pa].
[[nodiscard]] Mat6 elastic_matrix(double young, double poisson);

/// The six strains as a symmetric tensor [-].
[[nodiscard]] inline Mat3 strain_tensor(const Vec6& e) {
  return (Mat3() << e[0], e[5] / 2, e[4] / 2, e[5] / 2, e[1], e[3] / 2, e[4] / 2, e[3] / 2, e[2])
      .finished();
}

/// Strain rows of T^T f: load of a force at `arm` on the six strains [N m].
[[nodiscard]] Eigen::Matrix<double, 6, 1> strain_load(const Vec3& arm, const Vec3& force);

}  // namespace talus
