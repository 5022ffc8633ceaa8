// libcore/blocks/limit_equilibrium.hpp: public
// Factors of safety by limit equilibrium: formulas to hold a computed factor against.
// in:    a mass that slides as one body on a plane or in a wedge; or a row of columns
// out:   what tan(friction) and cohesion may be divided by
// refs:  Hoek and Bray 1981, chapters 7 and 8; Goodman and Bray 1976
#pragma once

#include <vector>

#include "blocks/removability.hpp"

namespace talus {

/// A mass on one plane, or on the two of a wedge.
struct SlidingMass {
  double weight = 0;              ///< [N]
  Vec3 water = Vec3::Zero();      ///< uplift on the planes and thrust in tension cracks [N]
  std::vector<RestPlane> planes;  ///< cohesion times area [N]
};

/// Its factor of safety under a pseudo-static acceleration, of gravity. On one plane of dip d,
/// with uplift U, thrust V and a coefficient k down the dip
///
///     F = (c A + (W (cos d - k sin d) - U - V sin d) tan phi) / (W (sin d + k cos d) + V cos d)
[[nodiscard]] double sliding_factor(const SlidingMass& mass, const Vec3& seismic = Vec3::Zero());

/// Coefficient along `azimuth` [rad] from which the factor is below 1; 0: it is without; at most 2.
[[nodiscard]] double critical_seismic(const SlidingMass& mass, double azimuth);

/// Columns in a row that lean out of a slope, at right angles to a base that may rise in steps.
struct ColumnRow {
  double base_dip = 0;         ///< of the base, out of the slope [rad]
  double width = 1;            ///< of a column along its base [m]
  double step = 0;             ///< of the base from one column to the next, along the columns [m]
  std::vector<double> height;  ///< along the columns, from the toe up [m]
};

/// Factor for a friction (tangent) on bases and sides alike. Each column slides or topples onto the
/// next and pushes it where the two touch highest; the row fails when the toe does not hold. 0: no
/// friction up to 45 degrees holds it.
[[nodiscard]] double toppling_factor(const ColumnRow& row, double friction);

}  // namespace talus
