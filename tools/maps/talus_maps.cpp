// tools/maps/talus_maps.cpp
// Hazard maps from the passages of one or many runs. Page: docs/tools/talus-maps.md
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include "base/memory.hpp"
#include "base/text.hpp"
#include "post/maps/compare.hpp"
#include "post/maps/map_layers.hpp"
#include "post/maps/map_style.hpp"
#include "post/moved.hpp"
#include "post/reduce.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/fault_json.hpp"
#include "tools/frame/map_output.hpp"
#include "tools/frame/run_inputs.hpp"
#include "tools/frame/tool.hpp"

namespace {

using talus::Json;
using talus::MapLayer;
using talus::RunFile;
using talus::Tool;

struct Options {
  std::string folder, window_of;
  std::vector<std::string> compared;
  double cell_size_m = std::numeric_limits<double>::quiet_NaN();
  talus::MapSettings settings;
  talus::PageOptions pages;
  double half_width = 0.05;
  const Tool* tool = nullptr;

  // Rows that may be held: each twice while they are sorted.
  [[nodiscard]] std::uint64_t most_rows() const {
    constexpr double usual_mb = 2000;
    const double memory_mb = tool->memory_mb() > 0 ? tool->memory_mb() : usual_mb;
    return static_cast<std::uint64_t>(memory_mb * 1e6 / (2 * sizeof(talus::MapRow)));
  }
};

void declare(Tool& tool, Options& o) {
  tool.output_folder("-o,--out", o.folder, "folder for the maps").required();
  tool.option("--cell-size-m", o.cell_size_m,
              "cell of the maps, a whole multiple of the recorded one [m]; nan: as recorded")
      .check(talus::number_between(0, 1e6, true));
  tool.option("--min-passages", o.settings.min_passages,
              "passages that a percentile needs; 0: 5, 29, 59, 299 for p50, p90, p95, p99")
      .between(0, 1000000000);
  talus::add_pages_option(tool, o.pages);
  tool.input("--window-of", o.window_of, "map of the same cells: pages show what its pages show");
  o.tool = &tool;
  tool.option("--half-width", o.half_width,
              "wanted of the interval of reach_probability: says how many runs to add")
      .check(talus::number_between(1e-4, 0.5));
  tool.inputs(
      "--compare", o.compared,
      "runs, parts or their folder to compare with: compare.tif holds what the others have more");
  tool.footer("Example:\n  talus-maps runs --trn slope.tif -o maps --pages png");
}

/// Data of the runs for the maps.
struct Gathered {
  talus::MapGrid map;
  talus::ShareBasis basis;
  talus::DepositSums deposit;
  std::vector<std::uint32_t> rows_of_cell;  // of the map
  std::uint64_t n_rows = 0;
  std::vector<std::vector<talus::MapRow>> rows;  // of each run; empty when they are too many
  std::vector<std::vector<double>> weight;       // of the blocks of each run; empty: 1 each
  talus::RunsToAdd to_add;  // for the half width that is wanted; known when layers are made
};

// Behind the rows of the same run that came before.
void add_rows(std::vector<std::vector<talus::MapRow>>& all, std::vector<talus::MapRow> rows,
              std::size_t member) {
  if (all.size() <= member) all.resize(member + 1);
  if (all[member].empty())
    all[member] = std::move(rows);
  else
    all[member].insert(all[member].end(), rows.begin(), rows.end());
}

// One of the two ensembles among the inputs.
struct RunRange {
  int first = 0;               // of RunInputs::members; the rows' run counts from here
  std::size_t first_part = 0;  // of RunInputs::parts()
};

// The rows of the parts over a tile of the map: `take` gets those of a run, by its place.
void take_rows_of_parts(const talus::RunInputs& runs, const RunRange& range,
                        const talus::MapGrid& map, const std::vector<std::vector<double>>& weight,
                        const talus::MapTile& tile, std::uint64_t most,
                        const std::function<void(std::vector<talus::MapRow>, int)>& take) {
  for (std::size_t p = range.first_part; p < runs.parts().size(); ++p) {
    const talus::PartInput& part = runs.parts()[p];
    talus::for_each_strip(part.file, map.factor, tile, most, [&](const auto& by_run) {
      for (std::size_t r = 0; r < by_run.size(); ++r)
        if (const int run = part.member[r] - range.first; run >= 0 && !by_run[r].empty())
          take(talus::map_rows(by_run[r], part.file.part.grid, map, weight[run], tile), run);
    });
  }
}

// All that does not grow with the number of runs, and the rows as long as they are few enough.
Gathered gather(talus::RunInputs& runs, const talus::RunSet& set, const std::string& role,
                const Options& o) {
  Gathered out;
  const RunRange range{static_cast<int>(runs.members.size()), runs.parts().size()};
  const talus::RunParts parts{.crossings = false,
                              .checkpoint = false,
                              .only_last_frame = true,
                              .only_faults = true,
                              .words = false};
  const auto count = [&](std::vector<talus::MapRow> rows, std::size_t member) {
    for (const talus::MapRow& row : rows) ++out.rows_of_cell[row.cell];
    out.n_rows += rows.size();
    if (out.n_rows > o.most_rows())
      std::vector<std::vector<talus::MapRow>>().swap(out.rows);
    else
      add_rows(out.rows, std::move(rows), member);
  };
  runs.read(
      set, role, parts,
      [&](RunFile& run, int index) {
        if (run.grid.n_rows == 0)
          throw talus::InputError({runs.members[index].file}, "holds no passages",
                                  "set [output] passages = true and run talus-dda again");
        if (index == range.first) {
          out.map = talus::map_grid(run.grid, o.cell_size_m, "--cell-size-m");
          out.rows_of_cell.assign(
              static_cast<std::size_t>(out.map.grid.n_rows) * out.map.grid.n_cols, 0);
        }
        count(talus::map_rows(run.passages, run.grid, out.map, talus::weights_of(run)),
              index - range.first);
        out.weight.push_back(talus::weights_of(run));
        talus::add_deposit(out.deposit, out.map.grid, run, runs.rest_speed_m_s, talus::moved_m);
      },
      range.first == 0 ? talus::RunSettings::of_their_own : talus::RunSettings::on_another_ground);
  take_rows_of_parts(runs, range, out.map, out.weight, {}, o.most_rows(),
                     [&](auto rows, int run) { count(std::move(rows), run); });
  out.basis = talus::share_basis(
      talus::clusters_of(std::span(runs.members).subspan(static_cast<std::size_t>(range.first))),
      runs.last_failed_share());
  return out;
}

// All layers of a tile; those that are not of passages only with the first one. `progress` is told
// the share of the layers that are made.
void add_tile(const talus::MapSources& sources, const talus::ProgressFunction& progress,
              std::vector<MapLayer>& layers) {
  const std::vector<talus::MapLayerKind>& kinds = talus::map_layers();
  const bool is_first = layers.empty();
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    progress(static_cast<double>(i) / static_cast<double>(kinds.size()));
    if (is_first)
      layers.push_back(talus::make_layer(kinds[i], sources));
    else if (kinds[i].is_of_passages)
      talus::append(layers[i], talus::make_layer(kinds[i], sources));
  }
}

// Tile by tile, each from its own reading of the runs where there is more than one.
std::vector<MapLayer> layers_of(Tool& tool, talus::RunInputs& runs, Gathered& g, const Options& o) {
  const talus::RunParts only_passages{
      .frames = false, .crossings = false, .health = false, .checkpoint = false, .words = false};
  std::vector<MapLayer> layers;
  const std::vector<talus::MapTile> tiles = g.n_rows > o.most_rows()
                                                ? talus::tiles_of(g.rows_of_cell, o.most_rows())
                                                : std::vector<talus::MapTile>{{}};
  for (const talus::MapTile& tile : tiles) {
    if (g.rows.empty()) {
      runs.read_again(only_passages, [&](RunFile& run, int member) {
        add_rows(g.rows,
                 talus::map_rows(run.passages, run.grid, g.map, talus::weights_of(run), tile),
                 member);
      });
      take_rows_of_parts(runs, {}, g.map, g.weight, tile, o.most_rows(),
                         [&](auto rows, int member) { add_rows(g.rows, std::move(rows), member); });
    }
    const talus::CellRows cells = talus::group_by_cell(std::move(g.rows), g.rows_of_cell.size());
    g.rows.clear();
    const talus::RunsToAdd here = talus::runs_to_add(cells, g.basis, o.half_width);
    g.to_add = {std::max(g.to_add.n, here.n), g.to_add.help && here.help};
    add_tile({cells, g.deposit, g.map.grid.cell_size, g.basis, o.settings}, tool.progress(),
             layers);
  }
  return layers;
}

// Cells that a block came over, ascending.
const std::vector<std::uint32_t>& touched_cells(const std::vector<MapLayer>& layers) {
  return std::find_if(layers.begin(), layers.end(),
                      [](const MapLayer& layer) { return talus::kind_of(layer).is_of_passages; })
      ->cell;
}

// Difference of the first runs from those of --compare. Both are held at once.
MapLayer comparison_of(talus::RunInputs& runs, const Gathered& a, const Options& o) {
  const std::size_t n = runs.members.size();
  Gathered b = gather(runs, runs.set_of(o.compared, "compare"), "runs_compared", o);
  if (a.n_rows + b.n_rows > o.most_rows())
    throw talus::InputError({"", 0, "--compare"},
                            "needs memory for all " + std::to_string(a.n_rows + b.n_rows) +
                                " rows of passages of both sets of runs",
                            "give more --memory-mb, or coarser cells (--cell-size-m)");
  const talus::CellRows cells_a = talus::group_by_cell(a.rows, a.rows_of_cell.size()),
                        cells_b = talus::group_by_cell(std::move(b.rows), b.rows_of_cell.size());
  const std::span members(runs.members);
  talus::RunPairs pairs = talus::pairs_of(members.subspan(n), members.first(n));
  const auto n_pairs = static_cast<std::size_t>(pairs.n_runs);
  if (n_pairs != n || n_pairs != members.size() - n) pairs = {};
  return talus::comparison_layer({cells_b, b.basis}, {cells_a, a.basis}, pairs);
}

// "net4 minus the site as it is"; runs of one measure cannot be told apart by its name.
talus::ChangeWords comparison_words(const talus::RunMember& run, const talus::RunMember& compared) {
  const auto name = [](const talus::RunMember& of) {
    return of.measure.empty() ? "the site as it is" : of.measure;
  };
  const std::string minus = run.measure == compared.measure
                                ? "these runs minus those compared with"
                                : name(run) + " minus " + name(compared);
  return {"Change of the probability of reach", minus + ", share of the blocks"};
}

// Tags of a map of differences: those of the runs that are compared too.
talus::MapTags comparison_tags(const talus::RunInputs& runs, std::size_t n_first,
                               talus::MapTags tags, const std::string& difference) {
  tags.emplace_back("DIFFERENCE", difference);
  const std::vector<talus::RunMember> compared(
      runs.members.begin() + static_cast<std::ptrdiff_t>(n_first), runs.members.end());
  for (const auto& [name, value] : talus::tags_of(compared))
    if (name == "N_RUNS" || name == "DENOMINATOR" || name == "HEALTH")
      tags.emplace_back(name + "_COMPARED", value);
  return tags;
}

// Tags of every map.
talus::MapTags tags_of_maps(Tool& tool, const Options& o, const talus::RunInputs& runs,
                            const std::vector<talus::RunMember>& members, const Gathered& gathered,
                            const std::string& remark) {
  talus::MapTags tags = talus::tags_of(members, runs.left_out);
  tags.insert(tags.begin(), {{"RUN_ID", tool.run_id()}, {"RUN_SET", runs.run_set()}});
  if (!remark.empty()) tags.emplace_back("REMARK", remark);
  if (runs.n_missing > 0) tags.emplace_back("N_MISSING", std::to_string(runs.n_missing));
  tags.emplace_back("REACH_UPPER_BOUND_ELSEWHERE",
                    talus::text(talus::reach_bound_elsewhere(gathered.basis), 6));
  tags.emplace_back("RUNS_TO_ADD", std::to_string(gathered.to_add.n) + " for a half width of " +
                                       talus::text(o.half_width) +
                                       " where reach_probability is above " +
                                       talus::text(talus::least_reach) +
                                       (gathered.to_add.help ? "" : "; in some cells none help"));
  return tags;
}

std::string file_of_layer(const Options& o, const std::string& name) {
  return (std::filesystem::path(o.folder) / (name + ".tif")).string();
}

// The maps as files: an entry each, and whether a style shows largest values.
struct WrittenMaps {
  Json files = Json::array();
  bool shows_maximum = false;
};

WrittenMaps write_layers(Tool& tool, const Options& o, const talus::MapFrame& frame,
                         const std::vector<MapLayer>& layers, const std::string& remark,
                         const talus::MapTags& tags) {
  WrittenMaps written;
  const talus::ProgressFunction progress = tool.progress();
  for (const MapLayer& layer : layers) {
    progress(static_cast<double>(written.files.size()) / static_cast<double>(layers.size()));
    const std::string path = file_of_layer(o, layer.name);
    const std::string shown =
        talus::write_map(tool, frame, path, layer, talus::map_style(layer, remark), tags);
    written.shows_maximum = written.shows_maximum || shown == layer.name + "_max";
    Json bands = Json::array();
    for (const auto& band : layer.bands) bands.push_back(band.name);
    written.files.push_back({{"file", path}, {"shown_band", shown}, {"bands", bands}});
  }
  return written;
}

void run_tool(Tool& tool, Options& o, talus::RunInputs& runs) {
  talus::limit_memory(0);  // --memory-mb is for rows alone; the rest needs the free memory
  (void)runs.trn();        // read first: a wrong one is refused before long work
  Gathered gathered = gather(runs, runs.runs(), "runs", o);
  const std::vector<talus::RunMember> members = runs.members;
  std::optional<MapLayer> comparison;
  if (!o.compared.empty()) comparison = comparison_of(runs, gathered, o);
  const std::uint64_t n_rows = gathered.n_rows;
  const talus::PassageGrid grid = gathered.map.grid;
  const auto layers = layers_of(tool, runs, gathered, o);
  const std::vector<std::uint32_t>& touched = touched_cells(layers);
  if (n_rows == 0) tool.warn("no block passed any cell: the maps are empty");
  runs.warn_of_ends();

  const std::string remark = runs.remark();
  const talus::MapTags tags = tags_of_maps(tool, o, runs, members, gathered, remark);
  std::optional<talus::CellWindow> window;
  if (!o.window_of.empty())
    window = talus::window_of_map(o.window_of, grid, {"", 0, "--window-of"});
  const talus::MapFrame frame = talus::map_frame(runs, grid, o.pages, touched, window);
  WrittenMaps written = write_layers(tool, o, frame, layers, remark, tags);
  if (comparison) {
    const std::string path = file_of_layer(o, "compare");
    const talus::ChangeWords words = comparison_words(members[0], runs.members[members.size()]);
    talus::write_map(
        tool, frame, path, *comparison,
        talus::change_style(*comparison, words, remark, {0.01, 0.02, 0.05, 0.1, 0.2, 0.5}),
        comparison_tags(runs, members.size(), tags, words.legend));
    written.files.push_back({{"file", path}, {"shown_band", comparison->bands[0].name}});
  }
  if (written.shows_maximum && n_rows > 0)
    tool.warn("cells with too few passages for a 95th percentile: styles show the maximum");
  tool.metric("passages", static_cast<double>(n_rows), "1");
  tool.metric("cells_touched", static_cast<double>(touched.size()), "1");
  Json result = {{"run_id", tool.run_id()},
                 {"n_runs", members.size()},
                 {"intervals_over", talus::text(gathered.basis.clusters)},
                 {"n_passages", n_rows},
                 {"n_cells_touched", touched.size()},
                 {"cell_size_m", grid.cell_size},
                 {"runs_to_add", gathered.to_add.n},
                 {"half_width", o.half_width},
                 {"layers", written.files}};
  talus::add_faults(result, talus::faults_of(runs.members, runs.left_out));
  tool.result(result, std::to_string(layers.size()) + " maps of " + std::to_string(members.size()) +
                          (members.size() == 1 ? " run" : " runs") + ", " + std::to_string(n_rows) +
                          " passages over " + std::to_string(touched.size()) + " cells of " +
                          talus::text(grid.cell_size, 4) + " m, intervals over " +
                          talus::text(gathered.basis.clusters) + ", in " + o.folder);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Tool tool("talus-maps", "Hazard maps from the passages of one or many runs.");
  talus::RunInputs runs(tool);
  declare(tool, options);
  return tool.run(argc, argv, [&] { run_tool(tool, options, runs); });
}
