// libcore/post/maps/map_layers.hpp: public
// The layers of a hazard map: one row each, of one table. Whether talus-maps makes it, the classes
// in which it is drawn, the text of the report below it and its place in the QGIS project are read
// from here; the name of a layer is written nowhere else.
#pragma once

#include <string>
#include <vector>

#include "post/deposit.hpp"
#include "post/maps/maps.hpp"
#include "post/maps/ramp.hpp"

namespace talus {

/// Sources of the layers. Passages may be those of one tile of the map.
struct MapSources {
  const CellRows& cells;       ///< passages by cell
  const DepositSums& deposit;  ///< where blocks came to rest
  double cell_size;            ///< [m]
  const ShareBasis& basis;     ///< of the runs
  const MapSettings& settings;
};

struct MapLayerKind {
  const char* name;            ///< of the file, without extension, and in QGIS
  const char* title;           ///< of the picture in the report
  const char* heading;         ///< of the page
  const char* caption;         ///< below the picture, HTML; the unit is added
  const char* unit;            ///< of the band that is shown
  const char* shown_band;      ///< empty: percentile or maximum, see map_style()
  Ramp ramp;                   ///< its colours
  std::vector<double> breaks;  ///< upper ends of the classes, ascending; one more lies above
  bool zero_is_transparent;
  const char* group;    ///< in the layer tree of QGIS
  bool is_visible;      ///< when the project is opened
  bool is_of_passages;  ///< may be made tile by tile; else once, of the deposit
  MapLayer (*make)(const MapLayerKind&, const MapSources&);
};

/// All layers, in the order of talus-maps, the report and the QGIS project.
[[nodiscard]] const std::vector<MapLayerKind>& map_layers();

/// The row of a layer that was made from the table.
[[nodiscard]] const MapLayerKind& kind_of(const MapLayer& layer);

/// The row of the deposit of blocks at rest: the one layer that is not made of passages.
[[nodiscard]] const MapLayerKind& deposit_kind();

/// The layer of a row, with its name.
[[nodiscard]] MapLayer make_layer(const MapLayerKind& kind, const MapSources& sources);

}  // namespace talus
