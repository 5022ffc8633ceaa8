// tools/talus_maps.cpp
// Hazard maps from the passages of one or many runs. Page: docs/tools/talus-maps.md
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "base/text.hpp"
#include "io/map_raster_gdal.hpp"
#include "post/deposit.hpp"
#include "post/map_picture.hpp"
#include "post/map_style.hpp"
#include "post/maps.hpp"
#include "run_inputs.hpp"

namespace {

using talus::Json;
using talus::MapLayer;
using talus::RunFile;
using talus::Tool;

struct Options {
  std::string folder;
  double cell_size_m = std::numeric_limits<double>::quiet_NaN();
  talus::MapSettings settings;
  bool png = false;
  std::vector<std::string> creation_options;
};

void declare(Tool& tool, Options& o) {
  tool.output_folder("-o,--out", o.folder, "folder for the maps")->required();
  tool.option("--cell-size-m", o.cell_size_m,
              "cell of the maps, a whole multiple of the recorded one [m]; nan: as recorded");
  tool.option("--min-passages", o.settings.min_passages,
              "passages that a percentile needs; 0: 5, 29, 59, 299 for p50, p90, p95, p99")
      ->check(CLI::Range(0, 1000000000));
  tool.option("--resamples", o.settings.n_resamples, "resamples of the bootstrap over runs")
      ->check(CLI::Range(20, 10000));
  tool.option("--seed", o.settings.seed, "of the bootstrap");
  tool.flag("--png", o.png,
            "a picture of each map over hillshade beside it, around the passed cells");
  tool.option("--co", o.creation_options, "creation option of the COGs, NAME=VALUE");
  tool.footer("Example:\n  talus-maps run_1.h5 run_2.h5 --trn slope.tif -o maps --png");
}

/// What the runs give to the maps.
struct Gathered {
  std::vector<std::vector<talus::MapRow>> rows;  // of each run
  talus::Released released;
  talus::DepositSums deposit;
  talus::MapGrid map;
};

// Runs are read in the order of the command line and used in the order of their ids.
Gathered gather(talus::RunInputs& runs, const Options& o) {
  Gathered out;
  std::vector<std::vector<talus::MapRow>> rows;
  std::vector<talus::DepositSums> deposits;
  runs.read({true, true, false, true, false}, [&](RunFile& run, int index) {
    if (run.grid.n_rows == 0)
      throw talus::InputError({runs.members[index].file}, "holds no passages",
                              "set [output] passages = true and run talus-dda again");
    if (index == 0) out.map = talus::map_grid(run.grid, o.cell_size_m, "--cell-size-m");
    rows.push_back(talus::map_rows(run.passages, run.grid, out.map, run.blocks.weight));
    deposits.emplace_back();
    talus::add_deposit(deposits.back(), out.map.grid, run, runs.rest_speed_m_s);
  });
  for (const int i : talus::order_by_id(runs.members)) {
    out.rows.push_back(std::move(rows[i]));
    out.released.weight.push_back(runs.members[i].weight);
    out.released.n_blocks.push_back(runs.members[i].n_blocks);
    talus::add(out.deposit, deposits[i]);
  }
  return out;
}

std::vector<MapLayer> layers_of(const talus::CellRows& cells, const Gathered& g,
                                const talus::MapSettings& settings) {
  const double cell_size = g.map.grid.cell_size;
  std::vector<MapLayer> layers{talus::reach_layer(cells, cell_size, g.released, settings)};
  for (const talus::MapQuantity quantity : talus::map_quantities)
    layers.push_back(talus::quantity_layer(cells, quantity, g.released, settings));
  layers.push_back(talus::exceedance_layer(cells, g.released));
  layers.push_back(talus::deposit_layer(g.deposit, cell_size, g.released));
  layers.push_back(talus::arrival_layer(cells));
  layers.push_back(talus::energy_line_layer(cells));
  return layers;
}

bool has_percentiles(const MapLayer& layer) {
  for (const talus::MapBand& band : layer.bands)
    if (band.name == layer.name + "_p95")
      for (const float value : band.value)
        if (!std::isnan(value)) return true;
  return false;
}

talus::MapRaster raster_of(const MapLayer& layer, const talus::PassageGrid& grid,
                           const talus::Trn& trn, const std::vector<bool>& known) {
  talus::MapRaster raster;
  raster.corner = grid.corner + trn.origin.head<2>();
  raster.cell_size = grid.cell_size;
  raster.n_rows = grid.n_rows;
  raster.n_cols = grid.n_cols;
  raster.crs_wkt = trn.crs_wkt;
  for (const talus::MapBand& band : layer.bands) {
    raster.bands.push_back({band.name, band.unit, band.description,
                            talus::on_grid(layer, band, known.size(), talus::MapRaster::nodata)});
    for (std::size_t i = 0; i < known.size(); ++i)
      if (!known[i] && raster.bands.back().value[i] == 0)
        raster.bands.back().value[i] = talus::MapRaster::nodata;
  }
  return raster;
}

/// Part of a map that is drawn: rows and columns, the last ones excluded.
struct PictureWindow {
  int row_begin = 0, row_end = 0, col_begin = 0, col_end = 0;
};

// The cells that anything passed and half as much again on each side: on a large terrain the slide
// would else be a dot.
PictureWindow picture_window(const talus::CellRows& cells, const talus::PassageGrid& grid) {
  if (cells.cell.empty()) return {0, grid.n_rows, 0, grid.n_cols};
  PictureWindow w{grid.n_rows, 0, grid.n_cols, 0};
  for (const auto cell : cells.cell) {
    const int row = static_cast<int>(cell) / grid.n_cols,
              col = static_cast<int>(cell) % grid.n_cols;
    w = {std::min(w.row_begin, row), std::max(w.row_end, row + 1), std::min(w.col_begin, col),
         std::max(w.col_end, col + 1)};
  }
  const int margin = std::max({10, (w.row_end - w.row_begin) / 2, (w.col_end - w.col_begin) / 2});
  return {std::max(0, w.row_begin - margin), std::min(grid.n_rows, w.row_end + margin),
          std::max(0, w.col_begin - margin), std::min(grid.n_cols, w.col_end + margin)};
}

talus::Picture picture_of(const talus::Trn& trn, const talus::MapRaster& raster,
                          const PictureWindow& w, const talus::RasterStyle& style) {
  const talus::Vec2 corner = raster.corner - trn.origin.head<2>() +
                             raster.cell_size * talus::Vec2(w.col_begin, -w.row_begin);
  const talus::PassageGrid grid{corner, raster.cell_size, w.row_end - w.row_begin,
                                w.col_end - w.col_begin};
  std::vector<float> value;
  for (int row = w.row_begin; row < w.row_end; ++row) {
    const auto first = raster.bands[style.band - 1].value.begin() +
                       static_cast<std::ptrdiff_t>(row) * raster.n_cols;
    value.insert(value.end(), first + w.col_begin, first + w.col_end);
  }
  return talus::map_picture(trn, grid, value, talus::MapRaster::nodata, style);
}

Json write_layer(Tool& tool, const Options& o, const MapLayer& layer, talus::MapRaster raster,
                 const talus::Trn& trn, const PictureWindow& window, const std::string& remark) {
  const std::string base = (std::filesystem::path(o.folder) / layer.name).string();
  const talus::RasterStyle style = talus::map_style(layer, remark);
  raster.tags.emplace_back("SHOWN_BAND", layer.bands[style.band - 1].name);
  talus::write_map_raster(tool.stage(base + ".tif"), raster, o.creation_options);
  tool.write_text(base + ".qml", talus::raster_qml(style));
  if (o.png) talus::write_png(tool.stage(base + ".png"), picture_of(trn, raster, window, style));
  Json bands = Json::array();
  for (const auto& band : layer.bands) bands.push_back(band.name);
  return {{"file", base + ".tif"}, {"shown_band", raster.tags.back().second}, {"bands", bands}};
}

void run_tool(Tool& tool, Options& o, talus::RunInputs& runs) {
  const talus::Trn& trn = runs.trn();
  Gathered gathered = gather(runs, o);
  std::size_t n_rows = 0;
  for (const auto& rows : gathered.rows) n_rows += rows.size();
  const talus::PassageGrid grid = gathered.map.grid;
  const auto n_cells = static_cast<std::size_t>(grid.n_rows) * grid.n_cols;
  const talus::CellRows cells = talus::group_by_cell(std::move(gathered.rows), n_cells);
  if (n_rows == 0) tool.warn("no block passed any cell: the maps are empty");

  auto tags = talus::tags_of(runs.members);
  tags.insert(tags.begin(), {"RUN_ID", tool.run_id()});
  const std::string remark = runs.remark();
  const std::vector<bool> known = talus::known_cells(trn, grid);
  const PictureWindow window = picture_window(cells, grid);
  Json files = Json::array();
  const auto layers = layers_of(cells, gathered, o.settings);
  if (n_rows > 0 && !has_percentiles(layers[1]))
    tool.warn("no cell has the passages that a 95th percentile needs: styles show the maximum");
  for (const MapLayer& layer : layers) {
    talus::MapRaster raster = raster_of(layer, grid, trn, known);
    raster.tags = tags;
    if (!remark.empty()) raster.tags.emplace_back("REMARK", remark);
    files.push_back(write_layer(tool, o, layer, std::move(raster), trn, window, remark));
  }
  tool.metric("passages", static_cast<double>(n_rows), "1");
  tool.metric("cells_touched", static_cast<double>(cells.cell.size()), "1");
  tool.result({{"run_id", tool.run_id()},
               {"n_runs", runs.members.size()},
               {"n_passages", n_rows},
               {"n_cells_touched", cells.cell.size()},
               {"cell_size_m", grid.cell_size},
               {"layers", files}},
              std::to_string(layers.size()) + " maps of " + std::to_string(runs.members.size()) +
                  (runs.members.size() == 1 ? " run" : " runs") + ", " + std::to_string(n_rows) +
                  " passages over " + std::to_string(cells.cell.size()) + " cells of " +
                  talus::text(grid.cell_size) + " m, in " + o.folder);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Tool tool("talus-maps", "Hazard maps from the passages of one or many runs.");
  talus::RunInputs runs(tool);
  declare(tool, options);
  return tool.run(argc, argv, [&] { run_tool(tool, options, runs); });
}
