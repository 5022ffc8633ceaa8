// Writes a shaded picture of a terrain.
#include "io/hillshade_gdal.hpp"

#include <cpl_string.h>
#include <gdal_priv.h>
#include <gdal_utils.h>

#include <array>

#include "io/errors_gdal.hpp"
#include "io/raster_bands_gdal.hpp"

namespace talus {
namespace {

// A raster in memory over the elevations themselves; GDAL only reads it.
Dataset wrap(const Trn& trn) {
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("MEM");
  Dataset dataset(driver->Create("", trn.n_cols, trn.n_rows, 0, GDT_Float64, nullptr));
  std::array<char, 32> pointer{};
  CPLPrintPointer(pointer.data(), const_cast<double*>(trn.elevation.data()), pointer.size());
  CPLStringList words;
  words.SetNameValue("DATAPOINTER", pointer.data());
  dataset->AddBand(GDT_Float64, words.List());
  std::array<double, 6> transform = {0, trn.cell_size, 0, 0, 0, -trn.cell_size};
  dataset->SetGeoTransform(transform.data());
  dataset->GetRasterBand(1)->SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  return dataset;
}

Dataset shade(GDALDataset& elevation) {
  CPLStringList words;
  for (const char* word : {"-of", "MEM", "-compute_edges", "-multidirectional"})
    words.AddString(word);
  GDALDEMProcessingOptions* const options = GDALDEMProcessingOptionsNew(words.List(), nullptr);
  GDALDatasetH shaded = GDALDEMProcessing("", GDALDataset::ToHandle(&elevation), "hillshade",
                                          nullptr, options, nullptr);
  GDALDEMProcessingOptionsFree(options);
  return Dataset(GDALDataset::FromHandle(shaded));
}

// Pixels alone: with a place or a nodata value GDAL would put an .aux.xml beside the picture.
Dataset without_metadata(GDALDataset& shaded) {
  const int n_cols = shaded.GetRasterXSize(), n_rows = shaded.GetRasterYSize();
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("MEM");
  Dataset pixels(driver->Create("", n_cols, n_rows, 1, GDT_Byte, nullptr));
  std::vector<unsigned char> row(static_cast<std::size_t>(n_cols));
  for (int r = 0; r < n_rows; ++r)
    for (const GDALRWFlag flag : {GF_Read, GF_Write})
      if ((flag == GF_Read ? shaded : *pixels)
              .GetRasterBand(1)
              ->RasterIO(flag, 0, r, n_cols, 1, row.data(), n_cols, 1, GDT_Byte, 0, 0, nullptr) !=
          CE_None)
        return {};
  return pixels;
}

}  // namespace

void write_hillshade(const std::string& path, const Trn& trn) {
  register_gdal_drivers();
  const GdalErrors errors;
  const Dataset elevation = wrap(trn);
  const Dataset shaded = shade(*elevation);
  const Dataset pixels = shaded ? without_metadata(*shaded) : nullptr;
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("PNG");
  if (pixels && driver)
    Dataset(driver->CreateCopy(path.c_str(), pixels.get(), FALSE, nullptr, nullptr, nullptr));
  if (!pixels || !driver || errors.failed())
    throw InputError({path}, "the hillshade cannot be written: " + errors.failure());
}

}  // namespace talus
