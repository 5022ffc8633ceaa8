// The rasters of a stand: setup/forest_section.hpp.
#include <cmath>
#include <optional>

#include "base/text.hpp"
#include "setup/forest_section.hpp"
#include "setup/value_raster_gdal.hpp"

namespace talus {
namespace {

using std::size_t;

std::optional<ValueRaster> read_beside(const ForestSection& s, const char* key,
                                       const std::string& file, const MapBox& box,
                                       const ValueRaster& number) {
  if (file.empty()) return std::nullopt;
  ValueRaster raster = read_values({s.log, s.site, s.trn, s.name()}, key, file, box);
  check_same_cells(raster, number);
  return raster;
}

// Value of a cell, or of the section's key where that raster is missing or unknown.
double value_at(const std::optional<ValueRaster>& raster, size_t cell, double otherwise, double low,
                double high, const char* expected) {
  if (!raster) return otherwise;
  const double value = raster->value[cell];
  if (std::isnan(value)) return otherwise;
  if (!(value >= low && value <= high))
    raster->refuse(cell, text(value), std::string("expected ") + expected);
  return value;
}

}  // namespace

std::vector<StockedCell> cells_of_rasters(const ForestSection& s, const MapBox& box) {
  const ForestSettings& f = s.forest;
  const std::optional<ValueRaster> number =
      read_values({s.log, s.site, s.trn, s.name()}, "nrtrees_raster", f.nrtrees_raster, box);
  const auto mean = read_beside(s, "dbhmean_raster", f.dbhmean_raster, box, *number);
  const auto deviation = read_beside(s, "dbhstd_raster", f.dbhstd_raster, box, *number);
  const auto conifers =
      read_beside(s, "conif_percent_raster", f.conif_percent_raster, box, *number);
  std::vector<StockedCell> cells;
  for (size_t k = 0; k < number->value.size(); ++k) {
    Stocking trees;
    trees.stems_per_ha = value_at(number, k, 0, 0, 1e5, "0 to 100000 stems on a hectare");
    if (trees.stems_per_ha == 0) continue;
    trees.dbh_mean = value_at(mean, k, f.dbh_mean_cm, 0, 1000, "centimetres, 0 to 1000") / 100;
    trees.dbh_std = value_at(deviation, k, f.dbh_std_cm, 0, 1000, "centimetres, 0 to 1000") / 100;
    trees.conifer_share =
        value_at(conifers, k, 100 * f.conifer_share, 0, 100, "0 to 100 per cent") / 100;
    if (trees.dbh_mean == 0)
      mean->refuse(k, "0 where nrtrees_raster has trees",
                   "stems without a diameter hold nothing: set nrtrees to 0 there");
    const double side = number->frame.cell_size;
    StandCell cell = stand_cell_at(number->centre_of(k), side);
    cell.low = number->centre_of(k) - Vec2::Constant(side / 2);
    cells.push_back({cell, trees});
  }
  return cells;
}

}  // namespace talus
