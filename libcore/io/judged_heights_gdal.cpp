// Digest of heights that a tool has judged, in the metadata of a terrain file.
#include "io/judged_heights_gdal.hpp"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <vector>

#include "io/errors_gdal.hpp"
#include "io/raster_bands_gdal.hpp"

namespace talus {
namespace {

constexpr int rows_at_once = 256;

std::string tag_in(GDALDataset& dataset, const char* name) {
  const char* const value = dataset.GetMetadataItem(name);
  return value != nullptr ? value : "";
}

// Whether the numbers in the file are heights in metres, as write_trn() writes them.
bool are_plain_heights(GDALDataset& dataset) {
  if (dataset.GetRasterCount() != 1) return false;
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  int has_nodata = 0;
  const double nodata = band.GetNoDataValue(&has_nodata);
  return band.GetRasterDataType() == GDT_Float64 && band.GetScale() == 1 && band.GetOffset() == 0 &&
         has_nodata != 0 && nodata == terrain_nodata;
}

// Empty where the raster cannot be read.
std::string digest_of(GDALDataset& dataset) {
  std::array<double, 6> transform{};
  const int n_rows = dataset.GetRasterYSize(), n_cols = dataset.GetRasterXSize();
  if (dataset.GetGeoTransform(transform.data()) != CE_None) return {};
  HeightsDigest digest(n_rows, n_cols, transform[1]);
  std::vector<double> rows;
  for (int row = 0; row < n_rows; row += rows_at_once) {
    const int n = std::min(rows_at_once, n_rows - row);
    rows.resize(static_cast<std::size_t>(n) * static_cast<std::size_t>(n_cols));
    if (dataset.GetRasterBand(1)->RasterIO(GF_Read, 0, row, n_cols, n, rows.data(), n_cols, n,
                                           GDT_Float64, 0, 0, nullptr) != CE_None)
      return {};
    digest.add(rows.data(), rows.size());
  }
  return digest.hex();
}

bool has_own_digest(GDALDataset& dataset) {
  const std::string judged = tag_in(dataset, judged_tag);
  if (judged.empty() || !are_plain_heights(dataset)) return false;
  const GdalErrors quiet;
  return digest_of(dataset) == judged;
}

}  // namespace

HeightsDigest::HeightsDigest(int n_rows, int n_cols, double cell_size) {
  const std::array<double, 3> lattice = {static_cast<double>(n_rows), static_cast<double>(n_cols),
                                         cell_size};
  hash_.add(lattice.data(), sizeof lattice);
}

void HeightsDigest::add(const double* stored, std::size_t n) {
  hash_.add(stored, n * sizeof *stored);
}

std::string HeightsDigest::hex() { return hash_.hex(); }

bool were_heights_judged(const std::string& path) { return has_own_digest(*open_raster(path)); }

std::string tag_of_judged(const std::string& path, const char* name) {
  const Dataset dataset = open_raster(path);
  const std::string value = tag_in(*dataset, name);
  return !value.empty() && has_own_digest(*dataset) ? value : std::string();
}

std::string accepted_doubts(const std::string& path) { return tag_of_judged(path, accepted_tag); }

}  // namespace talus
