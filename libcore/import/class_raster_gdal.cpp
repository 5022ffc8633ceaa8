#include "import/class_raster_gdal.hpp"

#include <gdal_priv.h>

#include <array>
#include <cmath>
#include <memory>

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
  const std::string crs = wkt_of(dataset->GetSpatialRef());
  if (!crs.empty() && !trn.crs_wkt.empty() && !same_crs(crs, trn.crs_wkt))
    throw InputError(
        {path},
        "the classes are in " + crs_name(crs) + ", the terrain is in " + crs_name(trn.crs_wkt),
        warp_command(CellKind::classes, "-t_srs " + crs_code(trn.crs_wkt), path, "classes.tif"));
  return dataset;
}

// Classes that lie beside the terrain would all read as unknown.
void check_ground_place(GDALDataset& dataset, const std::array<double, 6>& g,
                        const std::string& path, const Trn& trn) {
  const std::string own = wkt_of(dataset.GetSpatialRef());
  CrsExtent place{
      own.empty() ? trn.crs_wkt : own,
      {g[0], g[3] + dataset.GetRasterYSize() * g[5], g[0] + dataset.GetRasterXSize() * g[1], g[3]}};
  place.is_raster = true;
  (void)check_place(place, {path});
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
                       "the file is damaged or cut short: fetch it again");
    row = wanted;
  }

  [[nodiscard]] std::int32_t at(int col) const {
    const double v = value[col];
    if (known[col] == 0 || std::isnan(v)) return no_class;
    if (v != std::floor(v) || std::abs(v) > 2e9)
      throw InputError({path, 0, "row " + std::to_string(row) + ", column " + std::to_string(col)},
                       "the value is " + text(v) + ", expected a whole number that names a class");
    return static_cast<std::int32_t>(v);
  }
};

}  // namespace

std::vector<std::int32_t> read_cell_classes(const std::string& path, const Trn& trn) {
  const Dataset dataset = open_classes(path, trn);
  const std::array<double, 6> g = north_up_place(*dataset, path, CellKind::classes);
  check_ground_place(*dataset, g, path, trn);
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
          rows.at(static_cast<int>(east));
    }
  }
  return classes;
}

}  // namespace talus
