// Reads rasters of values that a section of the site file names.
#include "setup/value_raster_gdal.hpp"

#include <algorithm>
#include <cmath>

#include "base/sha256.hpp"
#include "base/text.hpp"
#include "import/dem_gdal.hpp"
#include "import/site_rasters_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/raster_commands.hpp"
#include "setup/vector_inputs_gdal.hpp"

namespace talus {

using std::size_t;

Vec2 ValueRaster::centre_of(size_t cell) const {
  const int row = static_cast<int>(cell) / frame.n_cols,
            col = static_cast<int>(cell) % frame.n_cols;
  return {frame.x(col), frame.y(row)};
}

void ValueRaster::refuse(size_t cell, const std::string& finding, const std::string& hint) const {
  const Vec2 at = centre_of(cell);
  throw InputError(
      {path}, key + " is " + finding + " at " + text(at.x(), 9) + ", " + text(at.y(), 9), hint);
}

ValueRaster read_values(const ValueRasterContext& of, const char* key, const std::string& file,
                        const MapBox& box) {
  const std::string path = resolved(of.site, file);
  read_data(of.log, of.section + "." + key, path);
  DemOptions options;
  options.crs_may_be_missing = true;
  options.has_heights = false;
  const DemFile raster(path, options);
  check_raster_system(raster.crs_wkt(), of.ground.crs_wkt, CellKind::values, path);
  const GridFrame& whole = raster.frame();
  ValueRaster out{key, path, whole, {}};
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
  of.log.content_read(of.section + "." + key, hash.hex());
  return out;
}

std::vector<double> read_at_nodes(InputLog& log, const Site& site, const Trn& ground,
                                  const std::string& role, const std::string& file,
                                  bool has_elevations) {
  const std::string path = resolved(site, file);
  read_data(log, role, path);
  DemOptions options;
  options.crs_may_be_missing = true;
  const DemFile raster(path, options);
  check_raster_system(raster.crs_wkt(), ground.crs_wkt, CellKind::heights, path);
  if (has_elevations) {
    const std::string assumed = assumed_heights(raster.crs_wkt(), ground.crs_wkt);
    if (!assumed.empty()) log.info(path + " and the terrain: both are " + assumed);
    if (!same_heights(raster.crs_wkt(), ground.crs_wkt))
      throw InputError({path},
                       "the heights are in " + crs_name(height_crs(raster.crs_wkt())) +
                           ", those of the terrain in " + crs_name(height_crs(ground.crs_wkt)),
                       "bring both to one system of heights first");
  }
  return read_dem(raster, frame_of(ground));
}

namespace {

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

}  // namespace

void check_same_cells(const ValueRaster& raster, const ValueRaster& first) {
  if (has_same_cells(raster.frame, first.frame)) return;
  throw InputError({raster.path}, raster.key + " has other cells than " + first.key,
                   "bring it to them: " + warp_command(CellKind::values, on_cells(first.frame),
                                                       raster.path, "same.tif"));
}

}  // namespace talus
