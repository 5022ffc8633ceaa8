// GDALContourGenerateEx on a raster in memory, whose pixels have their centres at the samples.
#include <gdal_alg.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "io/errors_gdal.hpp"
#include "io/level_lines.hpp"
#include "io/raster_bands_gdal.hpp"

namespace talus {
namespace {

Dataset raster_of(const SampledField& field) {
  Dataset raster(GetGDALDriverManager()->GetDriverByName("MEM")->Create(
      "", field.n_cols, field.n_rows, 1, GDT_Float64, nullptr));
  const double half = field.spacing / 2, down = field.north * field.spacing;
  std::array<double, 6> place = {
      field.corner.x() - half, field.spacing, 0, field.corner.y() - down / 2, 0, down};
  if (raster) raster->SetGeoTransform(place.data());
  if (!raster ||
      raster->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, field.n_cols, field.n_rows,
                                         const_cast<double*>(field.value.data()), field.n_cols,
                                         field.n_rows, GDT_Float64, 0, 0, nullptr) != CE_None)
    return nullptr;
  return raster;
}

// Whether a point lies between two known samples; GDAL continues for half a spacing behind the
// last.
bool is_known(const SampledField& field, const Vec2& p) {
  constexpr double rounding = 1e-5;
  const Vec2 at = (p - field.corner).cwiseProduct(Vec2(1, field.north)) / field.spacing;
  const int left = static_cast<int>(std::floor(at.x() + rounding)),
            right = static_cast<int>(std::ceil(at.x() - rounding)),
            first = static_cast<int>(std::floor(at.y() + rounding)),
            last = static_cast<int>(std::ceil(at.y() - rounding));
  if (left < 0 || first < 0 || right >= field.n_cols || last >= field.n_rows) return false;
  const auto value = [&field](int row, int col) {
    return field.value[static_cast<std::size_t>(row) * field.n_cols + col];
  };
  return !std::isnan(value(first, left) + value(last, right)) && (left == right || first == last);
}

}  // namespace

std::vector<LevelLine> level_lines(const SampledField& field, const std::vector<double>& levels) {
  if (levels.empty() || field.value.empty()) return {};
  register_gdal_drivers();
  const GdalErrors errors;
  const Dataset raster = raster_of(field);
  const Dataset lines(
      GetGDALDriverManager()->GetDriverByName("Memory")->Create("", 0, 0, 0, GDT_Unknown, nullptr));
  OGRLayer* const layer = lines ? lines->CreateLayer("lines", nullptr, wkbLineString) : nullptr;
  OGRFieldDefn level("level", OFTReal);
  std::string options = "FIXED_LEVELS=";
  for (const double value : levels) options += (value == levels[0] ? "" : ",") + text(value);
  std::array<char*, 3> given = {options.data(), const_cast<char*>("ELEV_FIELD=0"), nullptr};
  if (!raster || !layer || layer->CreateField(&level) != OGRERR_NONE ||
      GDALContourGenerateEx(raster->GetRasterBand(1), layer, given.data(), nullptr, nullptr) !=
          CE_None)
    throw InputError({}, "contours cannot be drawn: " + errors.failure());
  std::vector<LevelLine> out;
  for (const auto& feature : layer) {
    out.push_back({feature->GetFieldAsDouble(0), {}});
    std::vector<Vec2>& points = out.back().points;
    for (const OGRPoint& p : *feature->GetGeometryRef()->toLineString())
      if (const Vec2 at(p.getX(), p.getY()); is_known(field, at)) points.push_back(at);
    if (points.size() < 2) out.pop_back();
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const LevelLine& a, const LevelLine& b) { return a.level < b.level; });
  return out;
}

}  // namespace talus
