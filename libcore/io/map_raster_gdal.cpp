// Writes results as cloud-optimised GeoTIFF.
#include "io/map_raster_gdal.hpp"

#include <cpl_string.h>
#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/printable.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

using OwnedDataset = std::unique_ptr<GDALDataset>;

constexpr int tile_size = 512;  // of the COG driver: smaller rasters have no overviews

void write_cells(GDALRasterBand& band, const std::vector<float>& value) {
  const int n_cols = band.GetXSize(), n_rows = band.GetYSize();
  if (band.RasterIO(GF_Write, 0, 0, n_cols, n_rows, const_cast<float*>(value.data()), n_cols,
                    n_rows, GDT_Float32, 0, 0, nullptr) != CE_None)
    CPLError(CE_Failure, CPLE_FileIO, "a band cannot be filled");
}

// Smallest, largest, mean and standard deviation, kept in the file for styles and legends.
void set_statistics(GDALRasterBand& band, const std::vector<float>& value, float nodata) {
  double low = INFINITY, high = -INFINITY, sum = 0, sum_sq = 0, n = 0;
  for (const float v : value) {
    if (v == nodata) continue;
    low = std::min<double>(low, v);
    high = std::max<double>(high, v);
    sum += v;
    sum_sq += static_cast<double>(v) * v;
    ++n;
  }
  if (n == 0) return;
  const double mean = sum / n;
  band.SetStatistics(low, high, mean, std::sqrt(std::max(0.0, sum_sq / n - mean * mean)));
}

// Tiles no larger than a small raster: the part of a tile beyond its edge is compressed as well.
int tile_size_of(const MapRaster& raster) {
  constexpr int step = 16;  // tiles are whole multiples of it
  const int longest = std::max(raster.n_cols, raster.n_rows);
  return std::min(tile_size, (longest + step - 1) / step * step);
}

// A compressed file in memory, as the source of the COG: band after band goes through it.
OwnedDataset create_source(const std::string& path, const MapRaster& raster) {
  constexpr double n_floats = 4;  // a band, its overviews, and tiles that are being written
  require_memory(
      n_floats * sizeof(float) * raster.n_cols * raster.n_rows, {},
      "maps of " + std::to_string(raster.n_cols) + " x " + std::to_string(raster.n_rows) + " cells",
      "make the cells larger");
  CPLStringList options;
  const std::string tile = std::to_string(tile_size_of(raster));
  for (const auto& [name, value] : {std::pair<const char*, std::string>{"TILED", "YES"},
                                    {"BLOCKXSIZE", tile},
                                    {"BLOCKYSIZE", tile},
                                    {"INTERLEAVE", "BAND"},
                                    {"COMPRESS", "DEFLATE"},
                                    {"ZLEVEL", "1"},
                                    {"BIGTIFF", "IF_SAFER"},
                                    {"SPARSE_OK", "TRUE"}})
    options.SetNameValue(name, value.c_str());
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  return OwnedDataset(driver->Create(path.c_str(), raster.n_cols, raster.n_rows,
                                     static_cast<int>(raster.bands.size()),
                                     raster.is_codes ? GDT_Byte : GDT_Float32, options.List()));
}

void describe(GDALDataset& dataset, const MapRaster& raster) {
  std::array<double, 6> transform = {raster.corner.x(), raster.cell_size, 0, raster.corner.y(), 0,
                                     -raster.cell_size};
  dataset.SetGeoTransform(transform.data());
  if (!raster.crs_wkt.empty()) dataset.SetProjection(raster.crs_wkt.c_str());
  dataset.SetMetadataItem("AREA_OR_POINT", "Area");
  for (const auto& [key, value] : raster.tags)
    dataset.SetMetadataItem(key.c_str(), printable(value).c_str());
  for (std::size_t b = 0; b < raster.bands.size(); ++b) {
    const MapRasterBand& from = raster.bands[b];
    GDALRasterBand& band = *dataset.GetRasterBand(static_cast<int>(b) + 1);
    band.SetNoDataValue(raster.nodata_value());
    band.SetDescription(from.name.c_str());
    band.SetUnitType(from.unit.c_str());
    band.SetMetadataItem("long_name", from.long_name.c_str());
    if (b == 0 && !raster.colours.empty()) {
      GDALColorTable table;
      for (const auto& [code, c] : raster.colours) {
        const GDALColorEntry entry{c[0], c[1], c[2], c[3]};
        table.SetColorEntry(code, &entry);
      }
      band.SetColorTable(&table);
    }
  }
}

void make_overviews(GDALDataset& dataset, const MapRaster& raster) {
  std::vector<int> factors;
  for (int factor = 2; std::max(raster.n_cols, raster.n_rows) * 2 / factor > tile_size; factor *= 2)
    factors.push_back(factor);
  if (factors.empty()) return;
  dataset.BuildOverviews("NONE", static_cast<int>(factors.size()), factors.data(), 0, nullptr,
                         nullptr, nullptr);
}

void write_band(GDALRasterBand& band, const MapRaster& raster, std::size_t b) {
  const std::vector<float> value = raster.values(b);
  write_cells(band, value);
  set_statistics(band, value, raster.nodata_value());
  for (int i = 0; i < band.GetOverviewCount(); ++i) {
    GDALRasterBand& overview = *band.GetOverview(i);
    write_cells(overview,
                overview_of(value, raster.n_rows, raster.n_cols, overview.GetYSize(),
                            overview.GetXSize(), raster.nodata_value(), raster.bands[b].overview));
  }
}

CPLStringList cog_options(const MapRaster& raster) {
  CPLStringList options;
  options.SetNameValue("BLOCKSIZE", std::to_string(tile_size_of(raster)).c_str());
  options.SetNameValue("COMPRESS", "DEFLATE");
  options.SetNameValue("PREDICTOR", "YES");
  options.SetNameValue("OVERVIEWS", "FORCE_USE_EXISTING");
  options.SetNameValue("NUM_THREADS", "1");
  return options;
}

}  // namespace

void write_map_raster(const std::string& path, const MapRaster& raster) {
  register_gdal_drivers();
  const CPLStringList options = cog_options(raster);
  const std::string source_path = "/vsimem/" + path + ".source.tif";
  const GdalErrors errors;
  OwnedDataset source = create_source(source_path, raster), written;
  if (source) {
    describe(*source, raster);
    make_overviews(*source, raster);
    for (std::size_t b = 0; b < raster.bands.size(); ++b)
      write_band(*source->GetRasterBand(static_cast<int>(b) + 1), raster, b);
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("COG");
    written.reset(
        driver->CreateCopy(path.c_str(), source.get(), FALSE, options.List(), nullptr, nullptr));
  }
  const bool is_written = written != nullptr;
  written.reset();  // the last bytes are written here
  source.reset();
  VSIUnlink(source_path.c_str());
  errors.check_written(path, is_written);
}

}  // namespace talus
