#include "map_output.hpp"

#include <filesystem>

namespace talus {
namespace {

MapRaster raster_of(const MapFrame& frame, const MapLayer& layer) {
  MapRaster raster;
  raster.corner = frame.corner;
  raster.cell_size = frame.grid.cell_size;
  raster.n_rows = frame.grid.n_rows;
  raster.n_cols = frame.grid.n_cols;
  raster.crs_wkt = frame.crs_wkt;
  for (const MapBand& band : layer.bands) {
    std::vector<float> value = on_grid(layer, band, frame.known.size(), MapRaster::nodata);
    for (std::size_t i = 0; i < value.size(); ++i)
      if (!frame.known[i] && value[i] == 0) value[i] = MapRaster::nodata;
    raster.bands.push_back({band.name, band.unit, band.description, std::move(value)});
  }
  return raster;
}

}  // namespace

MapFrame map_frame(const Trn& trn, const PassageGrid& grid, bool png) {
  return {grid.corner + trn.origin.head<2>(),     grid, trn.crs_wkt, known_cells(trn, grid), png,
          png ? shading_of(trn, grid) : Shading{}};
}

std::string write_map(Tool& tool, const MapFrame& frame, const std::string& path,
                      const MapLayer& layer, const RasterStyle& style, MapTags tags,
                      const std::vector<std::string>& creation_options) {
  MapRaster raster = raster_of(frame, layer);
  const std::size_t shown = static_cast<std::size_t>(style.band) - 1;
  tags.emplace_back("SHOWN_BAND", layer.bands[shown].name);
  raster.tags = std::move(tags);
  write_map_raster(tool.stage(path), raster, creation_options);
  const auto beside = [&path](const char* extension) {
    return std::filesystem::path(path).replace_extension(extension).string();
  };
  tool.write_text(beside(".qml"), raster_qml(style));
  if (frame.png)
    write_png(tool.stage(beside(".png")),
              map_picture(frame.shading, frame.grid, raster.bands[shown].value, MapRaster::nodata,
                          style));
  return layer.bands[shown].name;
}

}  // namespace talus
