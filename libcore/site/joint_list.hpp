// libcore/site/joint_list.hpp: public
// Measured orientations as point clouds and stereonets write them: columns by name, or pairs of dip
// direction and dip.
// in:    the text of a list
// out:   upward unit poles, azimuths as written in the list; a remark on what was taken
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"

namespace talus {

struct OrientationList {
  std::vector<Vec3> poles;   ///< upward; azimuths from the list's own north  (n_orientations)
  std::string taken_from;    ///< "columns Dip dir., Dip; 8 other columns passed over"
  bool is_computed = false;  ///< from normals or beside them: azimuths from a grid's north
};

/// Columns are found by their names: dip and dip direction, strike and dip (right-hand rule unless
/// the name says left), trend and plunge of the pole, or the normal; a column Quantity repeats.
/// Without names each line is dip direction, dip. Angles are numbers, in degrees or in the unit of
/// the name: "Dip [gon]"; [grad] is refused, which is a degree in German and a gon in English.
///
/// Throws InputError with the line: text, other numbers of columns, angles out of their range.
[[nodiscard]] OrientationList read_orientations(const std::string& text, const std::string& file);

/// Whether all of three or more planes dip by less than a right angle in radians, and in directions
/// of less than a circle in radians, though some are not level.
[[nodiscard]] bool may_be_radians(const OrientationList& list);

/// The pole of dip direction, dip in degrees. Throws InputError when an angle is out of its range.
[[nodiscard]] Vec3 checked_pole(double direction_deg, double dip_deg, const Where& where);

}  // namespace talus
