#include "tools/frame/map_output.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "base/error.hpp"
#include "io/tags_gdal.hpp"

namespace talus {
namespace {

MapRaster raster_of(const MapFrame& frame, const MapLayer& layer) {
  MapRaster raster;
  raster.corner = frame.corner;
  raster.cell_size = frame.grid.cell_size;
  raster.n_rows = frame.grid.n_rows;
  raster.n_cols = frame.grid.n_cols;
  raster.crs_wkt = frame.crs_wkt;
  raster.is_codes = layer.is_codes;
  const float nodata = raster.nodata_value();
  for (const MapBand& band : layer.bands) {
    std::vector<float> value = on_grid(layer, band, frame.known.size(), nodata);
    for (std::size_t i = 0; i < value.size(); ++i)
      if (!frame.known[i] && value[i] == 0) value[i] = nodata;
    raster.bands.push_back(
        {band.name, band.unit, band.description, std::move(value), band.overview});
  }
  return raster;
}

PassageGrid part_of(const PassageGrid& grid, const CellWindow& w) {
  PassageGrid part = grid;
  part.corner += grid.cell_size * Vec2(w.col_begin, -w.row_begin);
  part.n_rows = w.row_end - w.row_begin;
  part.n_cols = w.col_end - w.col_begin;
  return part;
}

std::vector<float> part_of(const std::vector<float>& value, const PassageGrid& grid,
                           const CellWindow& w) {
  std::vector<float> part;
  for (int row = w.row_begin; row < w.row_end; ++row) {
    const auto first = value.begin() + static_cast<std::ptrdiff_t>(row) * grid.n_cols;
    part.insert(part.end(), first + w.col_begin, first + w.col_end);
  }
  return part;
}

CellWindow window_around(const PassageGrid& grid, const std::vector<std::uint32_t>& touched) {
  if (touched.empty()) return {0, grid.n_rows, 0, grid.n_cols};
  CellWindow w{grid.n_rows, 0, grid.n_cols, 0};
  for (const std::uint32_t cell : touched) {
    const int row = static_cast<int>(cell) / grid.n_cols,
              col = static_cast<int>(cell) % grid.n_cols;
    w = {std::min(w.row_begin, row), std::max(w.row_end, row + 1), std::min(w.col_begin, col),
         std::max(w.col_end, col + 1)};
  }
  const int margin = std::max({10, (w.row_end - w.row_begin) / 2, (w.col_end - w.col_begin) / 2});
  return {std::max(0, w.row_begin - margin), std::min(grid.n_rows, w.row_end + margin),
          std::max(0, w.col_begin - margin), std::min(grid.n_cols, w.col_end + margin)};
}

std::string text(const CellWindow& w, const PassageGrid& grid) {
  std::string words;
  for (const int number : {w.row_begin, w.row_end, w.col_begin, w.col_end})
    words += std::to_string(number) + " ";
  return words + "of " + std::to_string(grid.n_rows) + " " + std::to_string(grid.n_cols);
}

// Cells of the picture whose class is not certain; empty: it is not asked for.
std::vector<bool> uncertain_cells(const MapFrame& frame, const MapLayer* certain) {
  if (!certain) return {};
  const std::vector<float> all =
      on_grid(*certain, certain->bands[0], frame.known.size(), MapRaster::nodata_of_codes);
  std::vector<bool> uncertain;
  for (const float value : part_of(all, frame.grid, frame.drawn)) uncertain.push_back(value == 0);
  return uncertain;
}

}  // namespace

CellWindow window_of_map(const std::string& path, const PassageGrid& grid, const Where& where) {
  std::istringstream words(tag_of(path, "PICTURE_CELLS"));
  CellWindow w;
  int n_rows = 0, n_cols = 0;
  std::string of;
  words >> w.row_begin >> w.row_end >> w.col_begin >> w.col_end >> of >> n_rows >> n_cols;
  const bool is_inside = w.row_begin >= 0 && w.row_begin < w.row_end && w.row_end <= n_rows &&
                         w.col_begin >= 0 && w.col_begin < w.col_end && w.col_end <= n_cols;
  if (!words || !is_inside)
    throw InputError(where, path + " does not say which cells its picture shows",
                     "name a map that talus-maps --png wrote");
  if (n_rows != grid.n_rows || n_cols != grid.n_cols)
    throw InputError(where,
                     path + " has " + std::to_string(n_rows) + " x " + std::to_string(n_cols) +
                         " cells, these maps " + std::to_string(grid.n_rows) + " x " +
                         std::to_string(grid.n_cols),
                     "give both the same --cell-size-m");
  return w;
}

MapFrame map_frame(const Trn& trn, const PassageGrid& grid, bool png,
                   const std::vector<std::uint32_t>& touched,
                   const std::optional<CellWindow>& window) {
  const CellWindow drawn = window ? *window : window_around(grid, touched);
  return {grid.corner + trn.origin.head<2>(),
          grid,
          trn.crs_wkt,
          known_cells(trn, grid),
          png,
          drawn,
          png ? shading_of(trn, part_of(grid, drawn)) : Shading{}};
}

std::string write_map(Tool& tool, const MapFrame& frame, const std::string& path,
                      const MapLayer& layer, const RasterStyle& style, MapTags tags,
                      const std::vector<std::string>& creation_options, const MapLayer* certain) {
  MapRaster raster = raster_of(frame, layer);
  const std::size_t shown = static_cast<std::size_t>(style.band) - 1;
  tags.emplace_back("SHOWN_BAND", layer.bands[shown].name);
  if (frame.png) tags.emplace_back("PICTURE_CELLS", text(frame.drawn, frame.grid));
  if (layer.is_codes && layer.bands.size() == 1)  // what a GeoTIFF may have
    for (const StyleClass& c : style.classes)
      raster.colours.emplace_back(static_cast<int>(c.upper), c.colour);
  raster.tags = std::move(tags);
  write_map_raster(tool.stage(path), raster, creation_options);
  const auto beside = [&path](const char* extension) {
    return std::filesystem::path(path).replace_extension(extension).string();
  };
  tool.write_text(beside(".qml"), raster_qml(style));
  if (frame.png)
    write_png(tool.stage(beside(".png")),
              map_picture(frame.shading, part_of(frame.grid, frame.drawn),
                          part_of(raster.bands[shown].value, frame.grid, frame.drawn),
                          raster.nodata_value(), style, uncertain_cells(frame, certain)));
  return layer.bands[shown].name;
}

}  // namespace talus
