// libcore/blocks/source.hpp
// The source: the area that fails, the surface that it fails on, and the mass between that and the
// ground.
// in:    the TRN, a polygon, a depth, a plane, a raster or an SLBL limit
// out:   the bed: the same TRN, its nodes inside the polygon lowered to the failure surface
// refs:  Jaboyedoff et al. 2004 (sloping local base level)
//
// The mass is what lies between the two TRNs. Both are linear on the same triangles, so the mass is
// a sum of prisms, the blocks lie on their bed without a gap, and at the rim the thickness runs out
// to zero within one cell: nothing has to be cut along the polygon.
#pragma once

#include <string>
#include <vector>

#include "blocks/joint_sets.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Closed rings, first point not repeated; a point in an odd number of rings is inside.
struct Area {
  std::vector<std::vector<Vec2>> rings;  ///< local x, y [m]
};

/// The area with corners that follow themselves in a ring (also as last and first) taken once.
[[nodiscard]] Area without_repeated_corners(Area area);

/// Inside or on the border.
[[nodiscard]] bool contains(const Area& area, const Vec2& point);
[[nodiscard]] double area_of(const Area& area);  ///< rings taken with even-odd sign [m2]
/// Throws InputError when a ring has fewer than three points or no area, or when rings cross
/// themselves or each other, saying where in map coordinates.
void check_area(const Area& area, const Vec3& origin, const Where& where);

enum class FailureSurface { vertical_depth, normal_depth, plane, raster, slbl };

struct SourceOptions {
  FailureSurface kind = FailureSurface::normal_depth;
  double depth = 0;                               ///< vertical or along the normal of the slope [m]
  double plane_dip = 0, plane_dip_direction = 0;  ///< [rad]
  Vec3 plane_point = Vec3::Zero();                ///< local [m]
  std::vector<double> raster;  ///< local elevation at each node of the TRN, NaN = unknown [m]
  double slbl_curvature = 0;   ///< C: a node goes down to the mean of its highest and
                               ///< lowest neighbour minus C [m]
  double slbl_max_depth = 0;   ///< 0 = none [m]
};

/// The mass between ground and bed.
struct SourceMass {
  Trn bed;                               ///< the TRN with the nodes of the source lowered
  std::vector<int> nodes;                ///< lowered nodes, ascending
  double volume = 0;                     ///< sum of the prisms, exact [m3]
  double polygon_area = 0;               ///< [m2]
  double max_depth = 0, mean_depth = 0;  ///< vertical, at the lowered nodes [m]
  double slbl_unsettled = 0;  ///< base level: how much deeper it would still go, 0 = settled [m]
  int n_above_ground = 0;     ///< nodes inside where the failure surface lies above the ground
};

/// Lowers the ground inside `area` to the failure surface.
///
/// Throws InputError: area outside the terrain or over nodata, smaller than a cell, surface above
/// the ground everywhere, raster without data there.
[[nodiscard]] SourceMass find_source(const Trn& ground, const Area& area,
                                     const SourceOptions& options, const Where& where);

/// Surface and volume of the mass between ground and bed.
[[nodiscard]] MassMeasure measure_mass(const Trn& ground, const Trn& bed);

/// Sum over the triangles of area times mean depth: exact for linear surfaces [m3].
[[nodiscard]] double prism_volume(const Trn& ground, const Trn& bed);

}  // namespace talus
