// libcore/blocks/failure_plane.hpp: public
// The plane that a mass can leave on: of a joint set that dips out of the slope, laid so that it
// comes out of the ground (daylights) along the foot of the source.
//
// in:    the TRN, the polygon of the source, the mean planes of the joint sets, the friction angle
// out:   for each set the largest mass that is free at its foot, or why there is none
//
// The foot is where the polygon's outline faces the motion. A point of it lets the mass out when
// the plane is not below the ground there: else the ground before the mass is a step that holds it.
#pragma once

#include <string>
#include <vector>

#include "blocks/bed_equilibrium.hpp"
#include "blocks/joint_sets.hpp"
#include "blocks/source.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Share of the foot along which a plane has to daylight; on the rest the mass meets a step.
inline constexpr double least_free_foot = 0.9;
/// Share of the nodes in the polygon that must have rock above the plane.
inline constexpr double least_covered = 0.1;
/// How far a set may dip beside the fall line of the slope [deg].
inline constexpr double widest_lateral_deg = 30;
/// The foot is where the outward normal of the outline and the motion have at least this product.
inline constexpr double least_facing = 0.3;

/// A point of the foot as a family of parallel planes sees it.
struct FootPoint {
  Vec2 place = Vec2::Zero();  ///< on the outline [m]
  double ground = 0;  ///< highest ground there and up to three cells ahead in the motion [m]
  double level = 0;   ///< height at local x = y = 0 of the plane that just clears it [m]
  double weight = 0;  ///< length of outline across the motion [m]
};

/// The foot of the area for planes of one attitude, by ascending level, sampled every half cell.
/// Points over unknown ground are left out.
[[nodiscard]] std::vector<FootPoint> find_foot(const Trn& ground, const Area& area,
                                               const Attitude& plane);

struct PlaneAtFoot {
  double free_share = 0;               ///< of the foot where the plane is not below the ground
  double largest_step = 0;             ///< of the ground above the plane on the rest [m]
  double exit_low = 0, exit_high = 0;  ///< where the plane comes out within the area, local z [m]
};
[[nodiscard]] PlaneAtFoot plane_at_foot(const Trn& ground, const Area& area, const Attitude& plane,
                                        const Vec3& point);

/// The step of rock ahead of a mass at a point of its foot, whatever its failure surface.
struct FootStep {
  Vec2 place = Vec2::Zero();  ///< on the outline [m]
  double height = 0;          ///< of the ground ahead above the bed where rock ends, 0 or more [m]
  double weight = 0;          ///< length of outline across the motion [m]
};
/// The foot for a motion along `azimuth` [rad].
[[nodiscard]] std::vector<FootStep> steps_at_foot(const Trn& ground, const Trn& bed,
                                                  const Area& area, double azimuth);

/// The mass between ground and bed inside the area, a column a triangle; as weight its mean depth
/// [m], since the triangles have one area. `friction`: tangent, of all.
[[nodiscard]] std::vector<BedColumn> bed_columns(const Trn& ground, const Trn& bed,
                                                 const Area& area, double friction);

/// Share of the mass between ground and bed, inside the area, over bed that rises in the direction
/// `azimuth` [rad].
[[nodiscard]] double share_over_rising_bed(const Trn& ground, const Trn& bed, const Area& area,
                                           double azimuth);

/// Dip and dip direction of the mean plane of the ground in the area: by its mean gradient.
[[nodiscard]] Attitude mean_slope(const Trn& ground, const Area& area);

/// The plane of a joint set.
struct FailurePlane {
  std::string set;
  Attitude attitude;
  double lateral = 0;         ///< dip direction off that of the slope, 0 to pi [rad]
  double apparent_slope = 0;  ///< dip of the slope along the dip direction of the set [rad]
  std::string why_not;        ///< why no mass can leave on it; empty when one can
  Vec3 point =
      Vec3::Zero();         ///< of the foot, that it passes through; from here on where it has one
  double level_spread = 0;  ///< highest less lowest level of the foot [m]
  PlaneAtFoot foot;
  double volume = 0;                     ///< of the mass; 0: no plane comes out [m3]
  double mean_depth = 0, max_depth = 0;  ///< vertical [m]
  double rising_share = 0;  ///< share of the mass over bed that rises against the motion
};

/// Failure planes that the joint sets of a source offer.
struct FailurePlanes {
  Attitude slope;                    ///< mean plane of the ground in the area
  double friction = 0;               ///< of the ground below the mass [rad]
  std::vector<FailurePlane> planes;  ///< one a set, in their order
  int best = -1;                     ///< the one with the largest mass; -1: none
};

/// The plane of each set with the largest mass that daylights along `least_free_foot` of the foot.
/// A set offers one when it dips out of the slope within `widest_lateral_deg` of the fall line,
/// less steeply than the slope and more steeply than `friction` [rad]. With `wanted` not empty only
/// the set of that name is `best`.
///
/// Throws InputError as find_source does for areas that cannot be used.
[[nodiscard]] FailurePlanes find_failure_planes(const Trn& ground, const Area& area,
                                                const std::vector<JointSet>& sets, double friction,
                                                const std::string& wanted, const Where& where);

/// The lowest plane of an attitude that daylights along a share of the foot, and its mass.
struct PlaneAtShare {
  double share = 0;  ///< of the foot, asked for
  Vec3 point = Vec3::Zero();
  double volume = 0, mean_depth = 0;  ///< 0 where no rock is left above it [m3], [m]
};
/// For each share: the less of the foot is free, the more rock lies above the plane, and on the
/// higher a step it leans.
[[nodiscard]] std::vector<PlaneAtShare> planes_by_share(const Trn& ground, const Area& area,
                                                        const Attitude& plane,
                                                        const std::vector<double>& shares,
                                                        const Where& where);

/// find_source options of a plane.
[[nodiscard]] SourceOptions source_on_plane(const Attitude& plane, const Vec3& point);

/// Joint sets for a slope whose joints have not been measured: one that dips out of it, two
/// thirds of the path from friction to slope, a rear and a lateral one, spaced for about `n_blocks`
/// blocks. Empty when the slope is not at least `least_room_deg` steeper than friction, or its foot
/// is too uneven for a plane to daylight.
inline constexpr double least_room_deg = 6;
[[nodiscard]] std::vector<JointSet> assumed_joint_sets(const Trn& ground, const Area& area,
                                                       double friction, int n_blocks,
                                                       const Where& where);

}  // namespace talus
