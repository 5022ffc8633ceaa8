// libcore/post/runout/mobility.hpp: public
// Where an event lies among the published relations of volume, fall height and run-out.
// in:    share/mobility.csv: the relations with their sources; V, H, L of events
// out:   a table, and a chart of H/L against V
#pragma once

#include <string>
#include <vector>

#include "base/csv.hpp"
#include "draw/chart.hpp"

namespace talus {

enum class MobilityKind { hl_power, length, angle };

/// One row of the data file. V in m3, H and L in m:
/// hl_power: log10(H/L) = a + b log10 V, the lower 95 % line less by `lower`;
/// length: log10 L = a + b log10(V / 1e6) + c log10 H, and d more on confined paths;
/// angle: atan(H/L) = a degrees. sd: residual standard deviation of the left side.
struct MobilityRelation {
  std::string id, group, path;
  MobilityKind kind = MobilityKind::hl_power;
  double a = 0, b = 0, c = 0, d = 0;  ///< NaN where the kind has none
  double lower = 0;                   ///< NaN: no lower line
  double n = 0, sd = 0;               ///< NaN: not known
  bool from_memory = false;           ///< mark m: to be checked before it is relied on
  std::string source;
};
/// Throws InputError with the line for an unknown kind or a missing coefficient.
[[nodiscard]] std::vector<MobilityRelation> mobility_relations(const CsvTable& table);

struct MobilityEvent {
  std::string name;
  double volume = 0;      ///< V [m3]
  double height = 0;      ///< H [m]
  double length = 0;      ///< L [m]
  bool confined = false;  ///< laterally
};

/// An event beside one relation; NaN where it says nothing.
struct MobilityRow {
  double length = 0;        ///< that the relation expects for V and H [m]
  double length_upper = 0;  ///< on its lower 95 % line of H/L [m]
  double ratio = 0;         ///< event's L over the expected one [-]
  double exceedance = 0;    ///< P(L > event's L), from the residual standard deviation [-]
};
[[nodiscard]] MobilityRow compare(const MobilityRelation& relation, const MobilityEvent& event);

/// H/L against V, both logarithmic: a relation for rockfalls, one for slides with a band down to
/// its lower 95 % line, one for rock avalanches, none from memory; the events as points.
[[nodiscard]] Chart mobility_chart(const std::vector<MobilityRelation>& relations,
                                   const std::vector<MobilityEvent>& events);

}  // namespace talus
