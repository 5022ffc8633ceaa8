// Writes and reads the terrain file (GeoTIFF).
#include "io/trn_file_gdal.hpp"

#include <cpl_string.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "io/burnt_dams_gdal.hpp"
#include "io/errors_gdal.hpp"
#include "io/judged_heights_gdal.hpp"
#include "io/raster_bands_gdal.hpp"
#include "terrain/grid_frame.hpp"

namespace talus {
namespace {

constexpr int rows_at_once = 256;

struct ElevationSums {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double sum = 0, sum_sq = 0;
  double n = 0;
};

// Map elevations of some rows with nodata in place of NaN; adds the known ones to `sums`.
std::vector<double> rows_to_write(const Trn& trn, int row, int n_rows, ElevationSums& sums) {
  const double* z = trn.elevation.data() + node_index(trn, row, 0);
  const std::size_t n = static_cast<std::size_t>(n_rows) * static_cast<std::size_t>(trn.n_cols);
  std::vector<double> rows(n, terrain_nodata);
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isnan(z[i])) continue;
    rows[i] = z[i] + trn.origin.z();
    sums.low = std::min(sums.low, rows[i]);
    sums.high = std::max(sums.high, rows[i]);
    sums.sum += rows[i];
    sums.sum_sq += rows[i] * rows[i];
    sums.n += 1;
  }
  return rows;
}

Dataset create_geotiff(const std::string& path, const Trn& trn) {
  register_gdal_drivers();
  CPLStringList words;
  for (const char* word :
       {"TILED=YES", "COMPRESS=DEFLATE", "PREDICTOR=3", "ZLEVEL=1", "BIGTIFF=IF_SAFER"})
    words.AddString(word);
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  return Dataset(
      driver->Create(path.c_str(), trn.n_cols, trn.n_rows, 1, GDT_Float64, words.List()));
}

void describe(GDALDataset& dataset, const Trn& trn, const TrnFileOptions& options) {
  const GridFrame frame = frame_of(trn);
  const double half = 0.5 * frame.cell_size;
  std::array<double, 6> transform = {frame.x(0) - half, frame.cell_size, 0, frame.y(0) + half, 0,
                                     -frame.cell_size};
  dataset.SetMetadataItem(GDALMD_AREA_OR_POINT, GDALMD_AOP_POINT);
  dataset.SetGeoTransform(transform.data());
  OGRSpatialReference srs;
  if (!trn.crs_wkt.empty() && srs.importFromWkt(trn.crs_wkt.c_str()) == OGRERR_NONE)
    dataset.SetSpatialRef(&srs);
  for (const auto& [name, value] : options.tags)
    dataset.SetMetadataItem(name.c_str(), printable(value).c_str());
  if (!options.accepted_doubts.empty())
    dataset.SetMetadataItem(accepted_tag, options.accepted_doubts.c_str());
  if (const std::string dams = dams_text(trn); !dams.empty())
    dataset.SetMetadataItem(dams_tag, dams.c_str());
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  band.SetNoDataValue(terrain_nodata);
  band.SetDescription("elevation of the TRN's nodes");
  band.SetUnitType("m");
}

}  // namespace

void write_trn(const std::string& path, const Trn& trn, const TrnFileOptions& options) {
  const GdalErrors errors;
  Dataset dataset = create_geotiff(path, trn);
  CPLErr status = dataset ? CE_None : CE_Failure;
  if (dataset) describe(*dataset, trn, options);
  ElevationSums sums;
  HeightsDigest digest(trn.n_rows, trn.n_cols, trn.cell_size);
  for (int row = 0; row < trn.n_rows && status == CE_None; row += rows_at_once) {
    const int n_rows = std::min(rows_at_once, trn.n_rows - row);
    std::vector<double> rows = rows_to_write(trn, row, n_rows, sums);
    digest.add(rows.data(), rows.size());
    status = dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, row, trn.n_cols, n_rows, rows.data(),
                                                 trn.n_cols, n_rows, GDT_Float64, 0, 0, nullptr);
  }
  if (dataset) dataset->SetMetadataItem(judged_tag, digest.hex().c_str());
  if (dataset && sums.n > 0) {
    const double mean = sums.sum / sums.n;
    dataset->GetRasterBand(1)->SetStatistics(
        sums.low, sums.high, mean, std::sqrt(std::max(0.0, sums.sum_sq / sums.n - mean * mean)));
  }
  dataset.reset();  // the last bytes are written here
  errors.check_written(path, status == CE_None);
}

}  // namespace talus
