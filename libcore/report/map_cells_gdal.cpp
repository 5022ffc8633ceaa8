// Rasters of maps as pictures of a page: PNG and values.
#include "report/map_cells_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <ogr_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <sstream>

#include "base/error.hpp"
#include "base/text.hpp"
#include "io/errors_gdal.hpp"
#include "io/tags_gdal.hpp"
#include "report/map_legend.hpp"

namespace talus {
namespace {

using Dataset = std::unique_ptr<GDALDataset>;

std::string deflated(const std::vector<float>& values) {
  std::size_t size = 0;
  void* const bytes = CPLZLibDeflate(values.data(), 4 * values.size(), 9, nullptr, 0, &size);
  std::string out(static_cast<const char*>(bytes), size);
  CPLFree(bytes);
  return out;
}

float three_digits(float value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 2);
  return static_cast<float>(std::round(value / unit) * unit);
}

// The cells of a band in the view; NaN where there is no data.
struct Window {
  PassageGrid grid;
  std::vector<float> value;
  bool holds_bytes = false;
};

Window window_of(const std::string& path, int band_number, const MapView& view,
                 const Vec2& origin) {
  register_gdal_drivers();
  const GdalErrors errors;
  const Dataset file(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  std::array<double, 6> place{};
  if (!file || file->GetRasterCount() < band_number ||
      file->GetGeoTransform(place.data()) != CE_None)
    throw InputError({path}, "cannot be read as a map: " + errors.failure(), "make the maps again");
  GDALRasterBand* const band = file->GetRasterBand(band_number);
  Window out;
  PassageGrid& cells = out.grid;
  cells.cell_size = place[1];
  const Vec2 corner = Vec2(place[0], place[3]) - origin;
  const auto limited = [&](double metres, int n) {
    return static_cast<int>(std::clamp(metres / cells.cell_size, 0.0, 1.0 * n));
  };
  const int n_cols = file->GetRasterXSize(), n_rows = file->GetRasterYSize();
  const int col = limited(view.low.x() - corner.x(), n_cols),
            row = limited(corner.y() - view.high.y(), n_rows);
  cells.n_cols = std::min(n_cols, limited(view.high.x() - corner.x(), n_cols) + 1) - col;
  cells.n_rows = std::min(n_rows, limited(corner.y() - view.low.y(), n_rows) + 1) - row;
  if (cells.n_cols <= 0 || cells.n_rows <= 0) return {};
  cells.corner = corner + cells.cell_size * Vec2(col, -row);
  out.value.resize(static_cast<std::size_t>(cells.n_cols) * cells.n_rows);
  if (band->RasterIO(GF_Read, col, row, cells.n_cols, cells.n_rows, out.value.data(), cells.n_cols,
                     cells.n_rows, GDT_Float32, 0, 0, nullptr) != CE_None)
    throw InputError({path}, "cannot be read: " + errors.failure(), "make the maps again");
  const auto nodata = static_cast<float>(band->GetNoDataValue());
  for (float& v : out.value)
    if (v == nodata) v = std::nanf("");
  out.holds_bytes = band->GetRasterDataType() == GDT_Byte;
  return out;
}

}  // namespace

std::optional<std::pair<Vec2, Vec2>> cells_on_pages(const std::string& path) {
  register_gdal_drivers();
  const GdalErrors errors;
  std::istringstream words(tag_of(path, "PICTURE_CELLS"));
  int row_begin = 0, row_end = 0, col_begin = 0, col_end = 0;
  words >> row_begin >> row_end >> col_begin >> col_end;
  const Dataset file(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  std::array<double, 6> place{};
  if (!words || !file || file->GetGeoTransform(place.data()) != CE_None) return {};
  const Vec2 corner(place[0], place[3]);
  return std::pair{Vec2(corner + place[1] * Vec2(col_begin, -row_end)),
                   Vec2(corner + place[1] * Vec2(col_end, -row_begin))};
}

CellPicture read_cell_picture(const std::string& path, const std::string& qml, const MapView& view,
                              const Vec2& origin) {
  const RasterStyle style = style_of(qml);
  Window window = window_of(path, style.band, view, origin);
  CellPicture out;
  out.cells = {window.grid, std::move(window.value), std::nanf(""), {}, style};
  if (window.holds_bytes)
    for (const StyleClass& c : style.classes)
      out.labels.emplace_back(static_cast<int>(c.upper), c.label);
  constexpr std::size_t most_values = 250'000;
  std::vector<float> shown;
  for (const float v : out.cells.value) shown.push_back(three_digits(v));
  if (!shown.empty() && shown.size() <= most_values) out.values = deflated(shown);
  return out;
}

void hatch_classes(MapCells& cells, const std::string& certain, const std::vector<int>& weak,
                   const MapView& view, const Vec2& origin) {
  for (StyleClass& c : cells.style.classes)
    c.is_hatched |= std::find(weak.begin(), weak.end(), static_cast<int>(c.upper)) != weak.end();
  for (const float v : window_of(certain, 1, view, origin).value) cells.uncertain.push_back(v == 0);
}

}  // namespace talus
