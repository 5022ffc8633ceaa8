// Reads rasters of a site: classes of ground, stands, failure surfaces.
#include "import/site_rasters_gdal.hpp"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "base/text.hpp"
#include "import/crs_place_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/errors_gdal.hpp"
#include "io/raster_bands_gdal.hpp"

namespace talus {
namespace {

using std::size_t;

Dataset open_classes(const std::string& path, const Trn& trn) {
  Dataset dataset = open_raster(path);
  check_one_band(*dataset, path);
  check_raster_system(wkt_of(dataset->GetSpatialRef()), trn.crs_wkt, CellKind::classes, path);
  return dataset;
}

// Classes that lie beside the terrain would all read as unknown.
void check_ground_place(GDALDataset& dataset, const std::array<double, 6>& g,
                        const std::string& path, const Trn& trn, std::vector<Doubt>& doubts) {
  const std::string own = wkt_of(dataset.GetSpatialRef());
  CrsExtent place{
      own.empty() ? trn.crs_wkt : own,
      {g[0], g[3] + dataset.GetRasterYSize() * g[5], g[0] + dataset.GetRasterXSize() * g[1], g[3]}};
  place.is_raster = true;
  check_place(place, {path}, doubts);
}

/// One row of pixels at a time, as the terrain's rows come to them.
struct PixelRows {
  std::string path;
  GDALRasterBand& band;
  int row = -1;
  std::vector<double> value;
  std::vector<unsigned char> known;

  void read(int wanted) {
    if (wanted == row) return;
    const GdalErrors errors;
    const int n = band.GetXSize();
    value.resize(n);
    known.assign(n, 255);
    CPLErr status =
        band.RasterIO(GF_Read, 0, wanted, n, 1, value.data(), n, 1, GDT_Float64, 0, 0, nullptr);
    if (status == CE_None && band.GetMaskFlags() != GMF_ALL_VALID)
      status = band.GetMaskBand()->RasterIO(GF_Read, 0, wanted, n, 1, known.data(), n, 1, GDT_Byte,
                                            0, 0, nullptr);
    if (status != CE_None || errors.failed())
      throw InputError({path},
                       "reading row " + std::to_string(wanted) + " failed: " + errors.failure(),
                       way_to_read(path, "the file is damaged or cut short: fetch it again"));
    const double scale = band.GetScale(), offset = band.GetOffset();
    for (double& v : value) v = v * scale + offset;
    row = wanted;
  }

  [[nodiscard]] bool is_known(int col) const { return known[col] != 0 && !std::isnan(value[col]); }

  [[nodiscard]] std::int32_t class_at(int col) const {
    const double v = value[col];
    if (!is_known(col)) return no_class;
    if (v != std::floor(v) || std::abs(v) > 2e9)
      throw InputError({path, 0, "row " + std::to_string(row) + ", column " + std::to_string(col)},
                       "the value is " + text(v) + ", expected a whole number that names a class");
    return static_cast<std::int32_t>(v);
  }
};

}  // namespace

void check_raster_system(const std::string& raster, const std::string& terrain, CellKind kind,
                         const std::string& path) {
  if (raster.empty() || terrain.empty() || same_crs(raster, terrain)) return;
  throw InputError(
      {path}, "the raster is in " + crs_name(raster) + ", the terrain is in " + crs_name(terrain),
      "a raster is never reprojected silently: " +
          warp_command(
              kind,
              (kind == CellKind::heights ? "-novshift -t_srs " : "-t_srs ") + crs_code(terrain),
              path, "in_system.tif"));
}

std::vector<std::int32_t> read_cell_classes(const std::string& path, const Trn& trn,
                                            std::vector<Doubt>& doubts) {
  const Dataset dataset = open_classes(path, trn);
  const std::array<double, 6> g = north_up_place(*dataset, path, CellKind::classes);
  check_ground_place(*dataset, g, path, trn, doubts);
  PixelRows rows{path, *dataset->GetRasterBand(1), -1, {}, {}};
  const int n_rows = trn.n_rows - 1, n_cols = trn.n_cols - 1;
  std::vector<std::int32_t> classes(static_cast<size_t>(n_rows) * static_cast<size_t>(n_cols),
                                    no_class);
  const Vec2 corner = trn.origin.head<2>() + trn.node0;
  for (int r = 0; r < n_rows; ++r) {
    const double south = std::floor((corner.y() - (r + 0.5) * trn.cell_size - g[3]) / g[5]);
    if (!(south >= 0 && south < dataset->GetRasterYSize())) continue;
    rows.read(static_cast<int>(south));
    for (int c = 0; c < n_cols; ++c) {
      const double east = std::floor((corner.x() + (c + 0.5) * trn.cell_size - g[0]) / g[1]);
      if (!(east >= 0 && east < dataset->GetRasterXSize())) continue;
      classes[static_cast<size_t>(r) * static_cast<size_t>(n_cols) + static_cast<size_t>(c)] =
          rows.class_at(static_cast<int>(east));
    }
  }
  return classes;
}

LayerReading look_at_raster(const std::string& role, const std::string& path) {
  const Dataset dataset = open_raster(path);
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  const int n_rows = band.GetYSize(), n_cols = band.GetXSize();
  std::array<double, 6> g{};
  dataset->GetGeoTransform(g.data());
  LayerReading found;
  found.role = role;
  found.file = path;
  found.noun = "row";
  found.n_parts = n_rows;
  const std::string crs = wkt_of(dataset->GetSpatialRef());
  int has_unknown = 0;
  const double unknown = band.GetNoDataValue(&has_unknown);
  found.decisions = {
      {"form", "used where it is", "it is not copied"},
      {"system", crs_name(crs), crs.empty() ? "the file says none" : "the file says it"},
      {"cells",
       std::to_string(n_cols) + " x " + std::to_string(n_rows) + " of " + text(g[1]) + " m",
       "the file says it"},
      {"unknown value", has_unknown != 0 ? text(unknown) : "none", "the file says it"}};
  // blocks of a file are read whole: so many rows that no more than the wanted cells are
  constexpr double most_cells = 4e6;
  int n_block_cols = 0, n_block_rows = 0;
  band.GetBlockSize(&n_block_cols, &n_block_rows);
  const double share = most_cells / n_cols / n_rows;
  const int step = share >= 1 ? 1 : static_cast<int>(std::ceil(std::max(1, n_block_rows) / share));
  PixelRows rows{path, band, -1, {}, {}};
  std::vector<double> values;
  for (int row = std::min(step, n_rows) / 2; row < n_rows; row += step) {
    rows.read(row);
    for (int col = 0; col < n_cols; ++col)
      if (rows.is_known(col)) values.push_back(rows.value[col]);
  }
  if (!values.empty()) found.magnitudes = {magnitude_of("value", std::move(values))};
  return found;
}

}  // namespace talus
