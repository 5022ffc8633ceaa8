// Writes layers of cells as every tool does: raster, style and pages.
#include "tools/frame/map_output.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "base/error.hpp"
#include "base/text.hpp"
#include "io/crs_gdal.hpp"
#include "io/polygons_gdal.hpp"
#include "io/tags_gdal.hpp"
#include "post/maps/map_drawing.hpp"
#include "tools/frame/tool.hpp"

namespace talus {
namespace {

// Of cells that are looked up in `frame` and `layer` when they are written.
MapRaster raster_of(const MapFrame& frame, const MapLayer& layer) {
  MapRaster raster;
  raster.corner = frame.corner;
  raster.cell_size = frame.grid.cell_size;
  raster.n_rows = frame.grid.n_rows;
  raster.n_cols = frame.grid.n_cols;
  raster.crs_wkt = frame.crs_wkt;
  raster.is_codes = layer.is_codes;
  for (const MapBand& band : layer.bands)
    raster.bands.push_back({band.name, band.unit, band.description, band.overview});
  raster.values = [&frame, &layer, nodata = raster.nodata_value()](std::size_t b) {
    std::vector<float> value = on_grid(layer, layer.bands[b], frame.known.size(), nodata);
    for (std::size_t i = 0; i < value.size(); ++i)
      if (!frame.known[i] && value[i] == 0) value[i] = nodata;
    return value;
  };
  return raster;
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
  const int margin = std::max({5, (w.row_end - w.row_begin) / 4, (w.col_end - w.col_begin) / 4});
  return {std::max(0, w.row_begin - margin), std::min(grid.n_rows, w.row_end + margin),
          std::max(0, w.col_begin - margin), std::min(grid.n_cols, w.col_end + margin)};
}

std::string window_text(const CellWindow& w, const PassageGrid& grid) {
  std::string words;
  for (const int number : {w.row_begin, w.row_end, w.col_begin, w.col_end})
    words += std::to_string(number) + " ";
  return words + "of " + std::to_string(grid.n_rows) + " " + std::to_string(grid.n_cols);
}

// Cells whose class is not certain; empty: it is not asked for.
std::vector<bool> uncertain_cells(const MapFrame& frame, const MapLayer* certain) {
  if (!certain) return {};
  std::vector<bool> uncertain;
  for (const float value :
       on_grid(*certain, certain->bands[0], frame.known.size(), MapRaster::nodata_of_codes))
    uncertain.push_back(value == 0);
  return uncertain;
}

PageSize size_of(const PageOptions& pages) { return pages.has("a3") ? PageSize::a3 : PageSize::a4; }

MapView view_of(const PageLayout& layout, const PassageGrid& grid, const CellWindow& w) {
  const Vec2 north_west = grid.corner + grid.cell_size * Vec2(w.col_begin, -w.row_begin),
             south_east = grid.corner + grid.cell_size * Vec2(w.col_end, -w.row_end);
  return view_of(layout, {north_west.x(), south_east.y()}, {south_east.x(), north_west.y()});
}

std::string tag(const MapTags& tags, const std::string& name) {
  for (const auto& [key, value] : tags)
    if (key == name) return value;
  return "";
}

std::string run_words(const MapTags& tags) {
  const std::string n = tag(tags, "N_RUNS");
  return n + (n == "1" ? " run" : " runs");
}

// Runs, model and limits: facts that a reader of one page alone must know.
std::vector<std::string> words_of(const MapFrame& frame, const MapTags& tags) {
  const std::string cases = tag(tags, "CASES"), health = tag(tags, "HEALTH");
  return {"Runs: " + run_words(tags) + (cases.empty() ? "" : " of the cases " + cases) + ", set " +
              tag(tags, "RUN_SET") + "; " + health + ". Map " + tag(tags, "RUN_ID") + ".",
          "Model: three-dimensional discontinuous deformation analysis of blocks on a terrain of "
          "triangles (DDA)" +
              (frame.law.empty() ? "" : ", law \"" + frame.law + "\"") + ", Talus " +
              tag(tags, "VERSION") + "; cells of " + text(frame.grid.cell_size, 4) + " m.",
          "Coordinates: " + crs_name(frame.crs_wkt) + "; north is that of the grid.",
          "Computed for the source, joints, ground and friction that were assumed, no forecast: an "
          "expert has to judge it before anything is decided by it."};
}

MapPage page_of(const MapFrame& frame, const RasterStyle& style, const MapTags& tags) {
  MapPage page;
  page.size = size_of(frame.pages);
  page.title = style.heading;
  const std::string measure = tag(tags, "MEASURE");
  page.subtitle = "Site " + tag(tags, "SITE") + ", " +
                  (measure.empty() ? "" : "measure " + measure + ", ") + run_words(tags);
  page.words = words_of(frame, tags);
  page.cells.style = style;
  page.cells.grid = frame.grid;
  page.origin = frame.corner - frame.grid.corner;
  return page;
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
                     "name a map that talus-maps --pages wrote");
  if (n_rows != grid.n_rows || n_cols != grid.n_cols)
    throw InputError(where,
                     path + " has " + std::to_string(n_rows) + " x " + std::to_string(n_cols) +
                         " cells, these maps " + std::to_string(grid.n_rows) + " x " +
                         std::to_string(grid.n_cols),
                     "give both the same --cell-size-m");
  return w;
}

void add_pages_option(Tool& tool, PageOptions& pages) {
  tool.option("--pages", pages.words,
              "a page of each map beside it: png, pdf or png,pdf; of the size A3 with ,a3")
      .check([](const std::string& words) -> std::string {
        const PageOptions given{words};
        std::string rest = "," + words;
        for (const char* word : {",png", ",pdf", ",a3"})
          if (const std::size_t at = rest.find(word); at != std::string::npos)
            rest.erase(at, std::string(word).size());
        if (rest.empty() && (given.has("png") || given.has("pdf"))) return {};
        return words +
               " is not a list of pages, expected png, pdf or png,pdf, with ,a3 for that size";
      });
}

MapFrame map_frame(RunInputs& runs, const PassageGrid& grid, const PageOptions& pages,
                   const std::vector<std::uint32_t>& touched,
                   const std::optional<CellWindow>& window) {
  const Trn& trn = runs.trn();
  MapFrame frame;
  frame.corner = grid.corner + trn.origin.head<2>();
  frame.grid = grid;
  frame.crs_wkt = trn.crs_wkt;
  frame.known = known_cells(trn, grid);
  frame.pages = pages;
  frame.drawn = window ? *window : window_around(grid, touched);
  if (pages.words.empty()) return frame;
  require_page_memory();
  require_font();
  const PageLayout layout = layout_of(size_of(pages));
  frame.ground = map_ground(trn, layout, view_of(layout, grid, frame.drawn));
  frame.places = runs.places();
  if (runs.members.empty()) return frame;
  const RunInfo& info = runs.members[0].info;
  frame.places.source =
      rim_of(frame.places.source, source_gap(info.independent, frame.ground.view.scale));
  frame.law = info.law;
  return frame;
}

std::string write_map(Tool& tool, const MapFrame& frame, const std::string& path,
                      const MapLayer& layer, const RasterStyle& style, MapTags tags,
                      const MapLayer* certain) {
  MapRaster raster = raster_of(frame, layer);
  const std::size_t shown = static_cast<std::size_t>(style.band) - 1;
  tags.emplace_back("SHOWN_BAND", layer.bands[shown].name);
  if (!frame.pages.words.empty())
    tags.emplace_back("PICTURE_CELLS", window_text(frame.drawn, frame.grid));
  if (layer.is_codes && layer.bands.size() == 1)  // as a GeoTIFF allows
    for (const StyleClass& c : style.classes)
      raster.colours.emplace_back(static_cast<int>(c.upper), c.colour);
  raster.tags = std::move(tags);
  write_map_raster(tool.stage(path), raster);
  const auto beside = [&path](const char* extension) {
    return std::filesystem::path(path).replace_extension(extension).string();
  };
  tool.write_text(beside(".qml"), raster_qml(style));
  if (frame.pages.words.empty()) return layer.bands[shown].name;
  MapPage page = page_of(frame, style, raster.tags);
  page.cells.nodata = raster.nodata_value();
  page.cells.value = raster.values(shown);
  page.cells.uncertain = uncertain_cells(frame, certain);
  const Drawing drawing = page_drawing(page, frame.ground, frame.places);
  if (frame.pages.has("png")) tool.write_text(beside(".png"), png_of(drawing));
  if (frame.pages.has("pdf")) tool.write_text(beside(".pdf"), pdf_of(drawing));
  return layer.bands[shown].name;
}

}  // namespace talus
