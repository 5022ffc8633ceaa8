// libcore/terrain/mend_meetings.hpp: public
// Contours of different heights that meet because a map is drawn, generalised or put together with
// limited accuracy: moved apart within that accuracy.
// in:    contours that meet, a tolerance
// out:   contours that keep apart, all places with the action taken
// method: docs/tools/talus-tin.md, "Contours that meet"
#pragma once

#include <vector>

#include "terrain/contours.hpp"

namespace talus {

/// Where two contours of different heights meet.
struct Meeting {
  Vec2 place = Vec2::Zero();   ///< relative to the map's origin [m]
  int line_a = 0, line_b = 0;  ///< of the map's contours
  bool is_mended = false;      ///< false: some part of it would need more than the tolerance
};

/// A point of a contour that was moved to keep its line apart.
struct MovedPoint {
  int line = 0;
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< relative to the map's origin [m]
};

struct Mending {
  std::vector<Meeting> meetings;  ///< as they were found; by lines, then along them
  std::vector<MovedPoint> moved;  ///< by line; empty where a meeting was not mended
  double largest_move = 0;        ///< [m]
};

/// How well a map shows its contours [m]: nine in ten bends of the lines are farther than this off
/// the chord of the points beside them. Generalising to a tolerance leaves bends of about that
/// tolerance and more. 0 where there are fewer than 30 bends to judge by.
[[nodiscard]] double accuracy_of_lines(const Polylines& lines);

/// Moves points of contours that meet contours of other heights back to the side that the rest of
/// their line is on, a twentieth of the tolerance beyond the other line; each point by at most
/// `tolerance` in all. The map stays as it is where a meeting remains.
[[nodiscard]] Mending mend_meetings(double tolerance, ContourMap& map);

}  // namespace talus
