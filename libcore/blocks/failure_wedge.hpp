// libcore/blocks/failure_wedge.hpp: public
// The wedge that a mass can leave on: two planes of two joint sets, along their line, laid so that
// they come out of the ground along the foot of the source.
// in:    the TRN, the polygon of the source, the mean planes of the joint sets, the friction angle
// out:   for each pair of sets the largest wedge that is free at its foot, or why there is none
//
// The bed is the higher of the two planes. A point of the foot lets the mass out when one of them
// is not below the ground there.
#pragma once

#include <string>
#include <vector>

#include "blocks/failure_plane.hpp"
#include "blocks/kinematics.hpp"

namespace talus {

/// Of the mass in plan, that each plane of a wedge must carry; below it is a mass on one plane.
inline constexpr double least_flank = 0.05;

struct FailureWedge {
  std::string first, second;  ///< sets
  Attitude first_plane, second_plane;
  Wedge line;           ///< with the friction of the ground on both planes
  std::string why_not;  ///< why no mass can leave on it; empty when one can
  Vec3 first_point = Vec3::Zero(), second_point = Vec3::Zero();  ///< from here on where it is laid
  double free_share = 0;                                         ///< of the foot [-]
  double largest_step = 0;                                       ///< on the rest [m]
  double volume = 0;                                             ///< of the mass; 0: none [m3]
  double mean_depth = 0, max_depth = 0;                          ///< vertical [m]
};

/// For each pair of sets, in their order. `friction` [rad].
[[nodiscard]] std::vector<FailureWedge> find_failure_wedges(const Trn& ground, const Area& area,
                                                            const std::vector<JointSet>& sets,
                                                            double friction, const Where& where);

/// Index of the wedge with the largest mass; with `wanted` ("first + second") not empty of that
/// pair alone. -1: none.
[[nodiscard]] int best_wedge(const std::vector<FailureWedge>& wedges, const std::string& wanted);

/// "first + second"
[[nodiscard]] std::string pair_name(const FailureWedge& wedge);

/// find_source options of a wedge.
[[nodiscard]] SourceOptions source_on_wedge(const FailureWedge& wedge);

}  // namespace talus
