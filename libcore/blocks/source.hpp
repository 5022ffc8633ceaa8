// libcore/blocks/source.hpp: public
// The source: the area that fails, the surface that it fails on, and the mass between that and the
// ground.
// in:    the TRN, a polygon, a depth, a plane, a raster or an SLBL limit
// out:   the bed: the same TRN, lowered to the failure surface below all of the polygon
// refs:  Jaboyedoff et al. 2004 (sloping local base level)
//
// The mass lies between the two TRNs inside the polygon, whose sides are its vertical
// walls. Both are linear on the same triangles, so it is a sum of prisms, and the blocks lie on
// their bed without a gap. Outside of the polygon the bed comes back to the ground within a cell.
#pragma once

#include <string>
#include <vector>

#include "blocks/area.hpp"
#include "blocks/joint_sets.hpp"
#include "terrain/trn.hpp"

namespace talus {

enum class FailureSurface { vertical_depth, normal_depth, plane, raster, slbl };

/// A plane by its attitude and a point.
struct SurfacePlane {
  double dip = 0, dip_direction = 0;  ///< [rad]
  Vec3 point = Vec3::Zero();          ///< local [m]
};

struct SourceOptions {
  FailureSurface kind = FailureSurface::normal_depth;
  double depth = 0;                               ///< vertical or along the normal of the slope [m]
  double plane_dip = 0, plane_dip_direction = 0;  ///< [rad]
  Vec3 plane_point = Vec3::Zero();                ///< local [m]
  std::vector<SurfacePlane> more_planes;  ///< of a wedge: the surface is the highest of all planes
  std::vector<double> raster;  ///< local elevation at each node of the TRN, NaN = unknown [m]
  double slbl_curvature = 0;   ///< C: a node goes down to the mean of its highest and
                               ///< lowest neighbour minus C [m]
  double slbl_max_depth = 0;   ///< 0 = none [m]
};

/// The mass between ground and bed inside the polygon.
struct SourceMass {
  Trn bed;                               ///< the TRN with the nodes of the source lowered
  std::vector<int> nodes;                ///< lowered nodes, ascending
  double volume = 0;                     ///< sum of the prisms, exact [m3]
  double polygon_area = 0;               ///< [m2]
  double area = 0;                       ///< of the mass in plan [m2]
  double max_depth = 0, mean_depth = 0;  ///< vertical, over the area of the mass [m]
  double slbl_unsettled = 0;  ///< base level: how much deeper it would still go, 0 = settled [m]
  int n_above_ground = 0;     ///< nodes inside where the failure surface lies above the ground
  int n_extended = 0;         ///< nodes beside the polygon that the failure raster was extended to
};

/// Lowers the ground to the failure surface at the corners of all triangles that `area` overlaps.
/// The sloping local base level comes back to the ground at the first nodes outside of it. A raster
/// without data at a corner outside is extended there: the depth of the nearest node that has data.
///
/// Throws InputError: area outside the terrain or near nodata, smaller than a cell, surface above
/// the ground everywhere, raster without data in the area.
[[nodiscard]] SourceMass find_source(const Trn& ground, const Area& area,
                                     const SourceOptions& options, const Where& where);

/// The mass over another bed, which is not above the ground; counts of find_source() are kept.
/// Throws InputError where nothing lies over it.
[[nodiscard]] SourceMass mass_over(const Trn& ground, const Area& area, SourceMass mass, Trn bed,
                                   const Where& where);

/// Surface and volume of the mass between ground and bed inside `area`.
[[nodiscard]] MassMeasure measure_mass(const Trn& ground, const Trn& bed, const Area& area);

/// Of all that lies between ground and bed, without an outline: sum over the triangles of area
/// times mean depth, exact for linear surfaces [m3].
[[nodiscard]] double prism_volume(const Trn& ground, const Trn& bed);

}  // namespace talus
