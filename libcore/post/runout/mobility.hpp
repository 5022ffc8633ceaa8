// libcore/post/runout/mobility.hpp: public
// Where an event lies among the published relations of volume, fall height and run-out.
// in:    share/mobility.csv: the relations with their sources; V, H, L of events
// out:   a table, percentiles in the published scatter, and a chart of H/L against V
#pragma once

#include <string>
#include <vector>

#include "base/csv.hpp"
#include "draw/chart.hpp"
#include "post/runout/runout_runs.hpp"

namespace talus {

enum class MobilityKind { hl_power, length, angle };

/// One row of the data file. V in m3, H and L in m:
/// hl_power: log10(H/L) = a + b log10 V, the lower 95 % line less by `lower`;
/// length: log10 L = a + b log10(V / 1e6) + c log10 H, and d more on confined paths;
/// angle: atan(H/L) = a degrees. sd: residual standard deviation of the left side; where a source
/// gives the lower line alone, that of a normal scatter of which 5 % lie below it.
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
  double left_share = 1;  ///< of the released mass, that left its source [-]
  bool is_cut = false;    ///< more than a twentieth left the terrain, or still moved at the end
};
/// Those of `some` runs in which a mass moved: V is the volume that moved, H and L are those of 95
/// % of it, straight, since the relations are of masses and not of single blocks.
[[nodiscard]] std::vector<MobilityEvent> mobility_events(const std::vector<RunoutRun>& runs,
                                                         const std::vector<int>& some,
                                                         bool confined);

/// An event beside one relation; NaN where it says nothing.
struct MobilityRow {
  double length = 0;        ///< that the relation expects for V and H [m]
  double length_upper = 0;  ///< on its lower 95 % line of H/L [m]
  double ratio = 0;         ///< event's L over the expected one [-]
  double percentile = 0;    ///< share of such events that go no farther [%]
};
/// No percentile where most of the mass (least_moved) stayed in its source.
[[nodiscard]] MobilityRow compare(const MobilityRelation& relation, const MobilityEvent& event);

/// Percentiles of L in the scatter of the relations of the chart that are dry; medians over events,
/// NaN where none has one [%].
struct MobilityPercentiles {
  double left_share = 0;  ///< of the released mass, that left its source [-]
  double rockfalls = 0, rock_avalanches = 0;
  bool at_least = false;  ///< an event is cut: it goes farther
};
[[nodiscard]] MobilityPercentiles percentiles_of(const std::vector<MobilityRelation>& relations,
                                                 const std::vector<MobilityEvent>& events);

/// "percentile of L95 among published events of its volume: rockfalls 32, rock avalanches 4", or
/// that most of the mass stayed.
[[nodiscard]] std::string text(const MobilityPercentiles& percentiles);

/// A line of that: of all runs, or of each case; "" where no mass moved.
[[nodiscard]] std::string mobility_text(const std::vector<RunoutRun>& runs,
                                        const std::vector<MobilityRelation>& relations,
                                        bool confined);

/// H/L against V, both logarithmic: a relation for rockfalls, one for slides with a band down to
/// its lower 95 % line, one for rock avalanches, none from memory; the events as points.
[[nodiscard]] Chart mobility_chart(const std::vector<MobilityRelation>& relations,
                                   const std::vector<MobilityEvent>& events);

}  // namespace talus
