// The table of the layers of a hazard map: quantity, classes, words and place in the project.
#include "post/maps/map_layers.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace talus {
namespace {

template <MapQuantity quantity>
MapLayer of_quantity(const MapLayerKind& kind, const MapSources& from) {
  return quantity_layer(kind.name, from.cells, quantity, from.basis, from.settings);
}
MapLayer of_reach(const MapLayerKind& /*kind*/, const MapSources& from) {
  return reach_layer(from.cells, from.cell_size, from.basis);
}
MapLayer of_exceedance(const MapLayerKind& /*kind*/, const MapSources& from) {
  return exceedance_layer(from.cells, from.basis);
}
MapLayer of_deposit(const MapLayerKind& /*kind*/, const MapSources& from) {
  return deposit_layer(from.deposit, from.cell_size, from.basis);
}
MapLayer of_arrival(const MapLayerKind& /*kind*/, const MapSources& from) {
  return arrival_layer(from.cells);
}
MapLayer of_energy_line(const MapLayerKind& /*kind*/, const MapSources& from) {
  return energy_line_layer(from.cells);
}

std::vector<MapLayerKind> made_table() {
  const std::vector<double> energy = {1, 10, 30, 100, 300, 1000, 3000, 10000, 30000, 100000},
                            height = {0.5, 1, 2, 3, 4, 5, 7, 10},
                            share = {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 0.8};
  return {
      {.name = "velocity",
       .title = "Speed",
       .heading = "Speed of the blocks",
       .caption = "largest speed of a block's centroid while it was over the cell",
       .unit = "m/s",
       .shown_band = "",
       .ramp = Ramp::speed,
       .breaks = {1, 2.5, 5, 10, 15, 20, 30},
       .zero_is_transparent = true,
       .group = "Hazard",
       .is_visible = true,
       .is_of_passages = true,
       .make = of_quantity<MapQuantity::speed>},
      {.name = "ke_total",
       .title = "Energy",
       .heading = "Kinetic energy of a block, with its rotation",
       .caption = "translation and rotation of one block at the same moment",
       .unit = "kJ",
       .shown_band = "",
       .ramp = Ramp::energy,
       .breaks = energy,
       .zero_is_transparent = true,
       .group = "Hazard",
       .is_visible = false,
       .is_of_passages = true,
       .make = of_quantity<MapQuantity::total_energy>},
      {.name = "ke_translational",
       .title = "Energy of translation",
       .heading = "Kinetic energy of a block, of its translation alone",
       .caption = "m v&sup2;/2 of one block, what barrier classes are tested with",
       .unit = "kJ",
       .shown_band = "",
       .ramp = Ramp::energy,
       .breaks = energy,
       .zero_is_transparent = true,
       .group = "Hazard",
       .is_visible = false,
       .is_of_passages = true,
       .make = of_quantity<MapQuantity::translational_energy>},
      {.name = "pass_height_top",
       .title = "Bounce height, top",
       .heading = "Height of passage: highest corner of a block above the ground",
       .caption = "highest corner of a block above the ground: a fence has to be taller",
       .unit = "m",
       .shown_band = "",
       .ramp = Ramp::height,
       .breaks = height,
       .zero_is_transparent = false,
       .group = "Hazard",
       .is_visible = false,
       .is_of_passages = true,
       .make = of_quantity<MapQuantity::top_height>},
      {.name = "pass_height_centroid",
       .title = "Bounce height, centroid",
       .heading = "Height of passage: centroid of a block above the ground",
       .caption = "centroid of a block above the ground",
       .unit = "m",
       .shown_band = "",
       .ramp = Ramp::height,
       .breaks = height,
       .zero_is_transparent = false,
       .group = "Hazard",
       .is_visible = false,
       .is_of_passages = true,
       .make = of_quantity<MapQuantity::centroid_height>},
      {.name = "reach",
       .title = "Reach",
       .heading = "Probability of reach",
       .caption = "blocks that crossed the cell over all released blocks",
       .unit = "1",
       .shown_band = "reach_probability",
       .ramp = Ramp::probability,
       .breaks = share,
       .zero_is_transparent = true,
       .group = "Hazard",
       .is_visible = false,
       .is_of_passages = true,
       .make = of_reach},
      {.name = "exceedance",
       .title = "Exceedance",
       .heading = "Share of the blocks with more than 300 kJ",
       .caption = "share of blocks above 30 and 300 kJ over the cell",
       .unit = "1",
       .shown_band = "p_exceed_300kJ",
       .ramp = Ramp::probability,
       .breaks = share,
       .zero_is_transparent = true,
       .group = "Hazard",
       .is_visible = false,
       .is_of_passages = true,
       .make = of_exceedance},
      {.name = "deposit",
       .title = "Deposit",
       .heading = "Deposit: thickness of the rock that moved and came to rest",
       .caption = "blocks that moved more than 1 m and came to rest: their thickness over the cell",
       .unit = "m",
       .shown_band = "deposit_thickness",
       .ramp = Ramp::thickness,
       .breaks = {0.25, 0.5, 1, 2, 4, 8, 16},
       .zero_is_transparent = true,
       .group = "Hazard",
       .is_visible = false,
       .is_of_passages = false,
       .make = of_deposit},
      {.name = "arrival",
       .title = "First arrival",
       .heading = "Time of the first arrival",
       .caption = "earliest time at which a block came over the cell",
       .unit = "s",
       .shown_band = "first_arrival",
       .ramp = Ramp::time,
       .breaks = {1, 2, 5, 10, 20, 30, 60},
       .zero_is_transparent = false,
       .group = "Hazard",
       .is_visible = false,
       .is_of_passages = true,
       .make = of_arrival},
      {.name = "energy_line",
       .title = "Energy line",
       .heading = "Energy line: smallest angle from the start of a block",
       .caption = "smallest angle from a block's start to the cell along its path",
       .unit = "deg",
       .shown_band = "energy_line_angle",
       .ramp = Ramp::angle,
       .breaks = {20, 25, 28, 30, 32, 35, 40, 45},
       .zero_is_transparent = false,
       .group = "Hazard",
       .is_visible = false,
       .is_of_passages = true,
       .make = of_energy_line},
  };
}

}  // namespace

const std::vector<MapLayerKind>& map_layers() {
  static const std::vector<MapLayerKind> table = made_table();
  return table;
}

const MapLayerKind& kind_of(const MapLayer& layer) {
  const auto& table = map_layers();
  const auto at = std::find_if(table.begin(), table.end(), [&layer](const MapLayerKind& kind) {
    return kind.name == layer.name;
  });
  TALUS_ASSERT(at != table.end());
  return *at;
}

const MapLayerKind& deposit_kind() {
  const auto& table = map_layers();
  return *std::find_if(table.begin(), table.end(),
                       [](const MapLayerKind& kind) { return !kind.is_of_passages; });
}

MapLayer make_layer(const MapLayerKind& kind, const MapSources& sources) {
  MapLayer layer = kind.make(kind, sources);
  layer.name = kind.name;
  return layer;
}

}  // namespace talus
