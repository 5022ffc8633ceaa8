// The rasters of a stand: setup/forest_section.hpp.
#include <cmath>
#include <optional>

#include "base/sha256.hpp"
#include "base/text.hpp"
#include "import/dem_gdal.hpp"
#include "import/site_rasters_gdal.hpp"
#include "io/raster_commands.hpp"
#include "setup/forest_section.hpp"
#include "setup/vector_inputs_gdal.hpp"

namespace talus {
namespace {

using std::size_t;

/// A raster over the cells that a box meets.
struct StandRaster {
  std::string key, path;
  GridFrame frame;  ///< of cell centres
  std::vector<double> value;

  [[noreturn]] void refuse(size_t cell, const std::string& finding, const std::string& hint) const {
    const int row = static_cast<int>(cell) / frame.n_cols,
              col = static_cast<int>(cell) % frame.n_cols;
    throw InputError(
        {path},
        key + " is " + finding + " at " + text(frame.x(col), 9) + ", " + text(frame.y(row), 9),
        hint);
  }
};

StandRaster read_raster(const ForestSection& s, const char* key, const std::string& file,
                        const MapBox& box) {
  const std::string path = resolved(s.site, file);
  read_data(s.log, s.name() + "." + key, path);
  DemOptions options;
  options.crs_may_be_missing = true;
  options.has_heights = false;
  const DemFile raster(path, options);
  check_raster_system(raster.crs_wkt(), s.trn.crs_wkt, CellKind::values, path);
  const GridFrame& whole = raster.frame();
  StandRaster out{key, path, whole, {}};
  // a cell reaches half its side beyond its centre
  const double half = whole.cell_size / 2;
  const auto first = [&](double way, int n) {
    return std::min(n, std::max(0, static_cast<int>(std::ceil((way - half) / whole.cell_size))));
  };
  const auto last = [&](double way, int n) {
    return std::max(-1,
                    std::min(n - 1, static_cast<int>(std::floor((way + half) / whole.cell_size))));
  };
  const int col = first(box.low.x() - whole.x(0), whole.n_cols),
            row = first(whole.y(0) - box.high.y(), whole.n_rows);
  out.frame.n_cols = last(box.high.x() - whole.x(0), whole.n_cols) - col + 1;
  out.frame.n_rows = last(whole.y(0) - box.low.y(), whole.n_rows) - row + 1;
  out.frame.north_west = Vec2(whole.x(col), whole.y(row));
  if (out.frame.empty())
    throw InputError({path}, std::string(key) + " lies outside the terrain",
                     "the terrain reaches from " + text(box.low.x(), 9) + ", " +
                         text(box.low.y(), 9) + " to " + text(box.high.x(), 9) + ", " +
                         text(box.high.y(), 9));
  check_size(out.frame, path);
  out.value.resize(static_cast<size_t>(out.frame.n_rows) * static_cast<size_t>(out.frame.n_cols));
  raster.read(row, out.frame.n_rows, col, out.frame.n_cols, out.value.data());
  Sha256 hash;
  hash.add(out.value.data(), out.value.size() * sizeof out.value[0]);
  s.log.content_read(s.name() + "." + key, hash.hex());
  return out;
}

// The words of gdalwarp that give a raster these cells.
std::string on_cells(const GridFrame& frame) {
  const double half = frame.cell_size / 2;
  const Vec2 corner = frame.north_west + Vec2(-half, half);
  return "-tr " + text(frame.cell_size) + " " + text(frame.cell_size) + " -te " + text(corner.x()) +
         " " + text(corner.y() - frame.n_rows * frame.cell_size) + " " +
         text(corner.x() + frame.n_cols * frame.cell_size) + " " + text(corner.y());
}

bool has_same_cells(const GridFrame& a, const GridFrame& b) {
  return a.n_rows == b.n_rows && a.n_cols == b.n_cols && a.cell_size == b.cell_size &&
         (a.north_west - b.north_west).norm() < 1e-6 * a.cell_size;
}

std::optional<StandRaster> read_beside(const ForestSection& s, const char* key,
                                       const std::string& file, const MapBox& box,
                                       const GridFrame& frame) {
  if (file.empty()) return std::nullopt;
  StandRaster raster = read_raster(s, key, file, box);
  if (!has_same_cells(raster.frame, frame))
    throw InputError({raster.path}, std::string(key) + " has other cells than nrtrees_raster",
                     "bring it to them: " +
                         warp_command(CellKind::values, on_cells(frame), raster.path, "same.tif"));
  return raster;
}

// Value of a cell, or of the section's key where there is no such raster or nothing known.
double value_at(const std::optional<StandRaster>& raster, size_t cell, double otherwise, double low,
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
  const std::optional<StandRaster> number = read_raster(s, "nrtrees_raster", f.nrtrees_raster, box);
  const GridFrame& frame = number->frame;
  const auto mean = read_beside(s, "dbhmean_raster", f.dbhmean_raster, box, frame);
  const auto deviation = read_beside(s, "dbhstd_raster", f.dbhstd_raster, box, frame);
  const auto conifers = read_beside(s, "conif_percent_raster", f.conif_percent_raster, box, frame);
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
    const auto row = static_cast<int>(k) / frame.n_cols, col = static_cast<int>(k) % frame.n_cols;
    const Vec2 centre(frame.x(col), frame.y(row));
    StandCell cell = stand_cell_at(centre, frame.cell_size);
    cell.low = centre - Vec2::Constant(frame.cell_size / 2);
    cells.push_back({cell, trees});
  }
  return cells;
}

}  // namespace talus
