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
using Bytes = std::vector<GByte>;

// Pixels of `n_bands` bytes, one behind the other.
std::string png_of(int n_rows, int n_cols, int n_bands, Bytes pixels) {
  const GdalErrors errors;
  GDALDriverManager& drivers = *GetGDALDriverManager();
  const Dataset picture(
      drivers.GetDriverByName("MEM")->Create("", n_cols, n_rows, n_bands, GDT_Byte, nullptr));
  const std::string path = "/vsimem/talus_cells.png";
  GDALDriver* const driver = drivers.GetDriverByName("PNG");
  if (driver && picture &&
      picture->RasterIO(GF_Write, 0, 0, n_cols, n_rows, pixels.data(), n_cols, n_rows, GDT_Byte,
                        n_bands, nullptr, n_bands, static_cast<GSpacing>(n_bands) * n_cols, 1,
                        nullptr) == CE_None)
    Dataset(driver->CreateCopy(path.c_str(), picture.get(), FALSE, nullptr, nullptr, nullptr));
  vsi_l_offset size = 0;
  GByte* const bytes = VSIGetMemFileBuffer(path.c_str(), &size, TRUE);
  if (bytes == nullptr) throw InputError({}, "a map cannot be drawn as PNG: " + errors.failure());
  std::string png(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  CPLFree(bytes);
  return png;
}

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
  CellPicture cells;  // corner, size and numbers
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
  CellPicture& cells = out.cells;
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

std::string shading_png(const Shading& shading) {
  register_gdal_drivers();
  Bytes grey;
  for (const float b : shading.brightness)  // the last bits are not seen, and cost most
    grey.push_back(static_cast<GByte>((std::isnan(b) ? 255 : std::lround(b)) | 3));
  return png_of(shading.n_rows, shading.n_cols, 1, std::move(grey));
}

std::vector<std::vector<Vec2>> rim_of(const std::vector<std::vector<Vec2>>& footprints) {
  const GdalErrors errors;
  OGRMultiPolygon pieces;
  for (const std::vector<Vec2>& footprint : footprints) {
    OGRLinearRing ring;
    for (const Vec2& p : footprint) ring.addPoint(p.x(), p.y());
    ring.closeRings();
    OGRPolygon piece;
    piece.addRing(&ring);
    pieces.addGeometry(&piece);
  }
  constexpr double half_gap = 0.1, seen = 0.02;
  constexpr int quadrant = 4;  // pieces of a round corner, which the way back takes off again
  using Shape = std::unique_ptr<OGRGeometry>;
  const Shape wide(pieces.Buffer(half_gap, quadrant));
  const Shape narrow(wide ? wide->Buffer(-half_gap, quadrant) : nullptr);
  const Shape rim(narrow ? narrow->SimplifyPreserveTopology(seen) : nullptr);
  if (!rim) return {};
  std::vector<std::vector<Vec2>> rings;
  const auto add = [&rings](const OGRPolygon& polygon) {
    for (const OGRLinearRing* ring : polygon) {
      rings.emplace_back();
      for (int i = 0; i + 1 < ring->getNumPoints(); ++i)
        rings.back().emplace_back(ring->getX(i), ring->getY(i));
    }
  };
  if (wkbFlatten(rim->getGeometryType()) == wkbPolygon)
    add(*rim->toPolygon());
  else if (wkbFlatten(rim->getGeometryType()) == wkbMultiPolygon)
    for (const OGRPolygon* polygon : *rim->toMultiPolygon()) add(*polygon);
  return rings;
}

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
  CellPicture out = std::move(window.cells);
  if (window.value.empty()) return out;
  Bytes colours;
  for (float& v : window.value) {
    const Colour colour = colour_of(style, v);
    colours.insert(colours.end(), colour.begin(), colour.end());
    v = three_digits(v);
  }
  out.png = png_of(out.n_rows, out.n_cols, 4, std::move(colours));
  if (window.holds_bytes)
    for (const StyleClass& c : style.classes)
      out.labels.emplace_back(static_cast<int>(c.upper), c.label);
  constexpr std::size_t most_values = 250'000;
  if (window.value.size() <= most_values) out.values = deflated(window.value);
  return out;
}

void hatch_classes(CellPicture& picture, const std::string& classes, const std::string& certain,
                   const std::vector<int>& weak, const MapView& view, const Vec2& origin) {
  const Window code = window_of(classes, 1, view, origin),
               sure = window_of(certain, 1, view, origin);
  const auto is_code_weak = [&weak](float v) {
    return std::any_of(weak.begin(), weak.end(), [v](int c) { return v == static_cast<float>(c); });
  };
  for (const float v : code.value) picture.weak.push_back(is_code_weak(v));
  for (const float v : sure.value) picture.unsure.push_back(v == 0);
}

}  // namespace talus
