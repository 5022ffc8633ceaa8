// libcore/setup/fence_candidates.hpp
// Lines along which a fence may be built, uphill of an object.
// in:    terrain, the object in plan, the limits of ground for a fence
// out:   open lines with corners a post spacing apart: contours of the ground, or lines of equal
//        distance from the object
//
// A place is in the zone where its distance from the object lies between two limits and the ground
// is higher than at the nearest point of the object. Lines end where the zone does, where the
// ground is too steep to build on, and where the line itself climbs too much.
#pragma once

#include <vector>

#include "record/object_hits.hpp"
#include "terrain/trn.hpp"

namespace talus {

struct CandidateSettings {
  double nearest = 10, farthest = 150;  ///< distance from the object, in plan [m]
  double step = 5;                      ///< from line to line: in plan, or in height [m]
  bool by_contours = true;              ///< else by distance
  int most = 60;                        ///< more lines than this: the step grows
  double spacing = 10;                  ///< of the corners, at most [m]
  double least_length = 30;             ///< shorter lines are left out [m]
  double line_slope = 0.36;             ///< steepest along a line, tangent [-]
  double ground_slope = 1.2;            ///< steepest ground below a corner, tangent [-]
};

struct FenceCandidates {
  std::vector<std::vector<Vec2>> lines;  ///< corners, local [m]; from the lowest level up
  double step = 0;                       ///< that they have in the end [m]
  int n_in_zone = 0;                     ///< nodes of the search's grid that lie in the zone
  int n_too_short = 0, n_cut = 0;        ///< pieces left out; places where slopes cut a line
};
/// None where the zone is empty. The same lines for the same terrain and object.
[[nodiscard]] FenceCandidates fence_candidates(const Trn& trn, const RecordObject& object,
                                               const CandidateSettings& settings);

/// Points at equal distances along a line, no farther apart than `spacing`, both ends among them.
[[nodiscard]] std::vector<Vec2> evenly_spaced(const std::vector<Vec2>& line, double spacing);

}  // namespace talus
