// libcore/setup/observed.hpp: public
// Observations on a slope, in local coordinates.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "blocks/area.hpp"

namespace talus {

/// A boulder that came to rest, or a scar that one left.
struct ObservedPoint {
  Vec2 place = Vec2::Zero();  ///< local x, y [m]
  /// Of a boulder its volume [m3], of a scar its height above the ground [m]; NaN: not known.
  double size = std::numeric_limits<double>::quiet_NaN();
  /// Of a boulder, where it started, local x, y [m]; NaN: not known. In an event of all or none.
  Vec2 start = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  std::string date;  ///< as the layer has it, of dates YYYY-MM-DD; empty: not known
};

[[nodiscard]] inline bool has_start(const ObservedPoint& point) { return point.start.allFinite(); }

/// Traces of one event, or of one test.
struct ObservedEvent {
  std::string name;
  std::vector<ObservedPoint> boulders, scars;
  Area outline;              ///< of the deposit; no rings: not known
  std::vector<int> polygon;  ///< that a ring of the outline is of         (n_rings)
};

}  // namespace talus
