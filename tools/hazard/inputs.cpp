// Reads the inputs of talus-hazard: runs by class, the recipe, the passages.
#include "tools/hazard/inputs.hpp"

#include <algorithm>
#include <limits>

#include "base/text.hpp"
#include "post/reduce.hpp"

namespace talus {
namespace {

const RunParts only_passages{.crossings = false,
                             .checkpoint = false,
                             .objects = false,
                             .only_last_frame = true,
                             .only_faults = true,
                             .words = false,
                             .trees = false};

bool is_in(const MapTile& tile, std::uint32_t cell) {
  return cell >= tile.first && cell < tile.end;
}

// The cells of the passages that rows in a tile may be of.
MapTile wider(const MapTile& tile, int beside, const PassageGrid& grid) {
  const std::uint64_t margin =
      static_cast<std::uint64_t>(beside) * (static_cast<std::uint64_t>(grid.n_cols) + 1);
  const std::uint64_t first = tile.first, end = tile.end + margin;
  return {static_cast<std::uint32_t>(first - std::min(first, margin)),
          static_cast<std::uint32_t>(std::min<std::uint64_t>(end, MapTile{}.end))};
}

// Tiles of a part within a tile of the map, each with at most `most` passages, or a single cell.
std::vector<MapTile> tiles_of_part(const PartFile& file, const MapTile& tile, std::size_t n_cells,
                                   std::uint64_t most) {
  std::vector<std::uint32_t> rows_of_cell(n_cells, 0);
  for (std::size_t i = 0; i < file.cell.size(); ++i)
    rows_of_cell[static_cast<std::size_t>(file.cell[i])] =
        static_cast<std::uint32_t>(file.begin[i + 1] - file.begin[i]);
  std::vector<MapTile> tiles;
  for (const MapTile& own : tiles_of(rows_of_cell, most)) {
    const MapTile both = {std::max(own.first, tile.first), std::min(own.end, tile.end)};
    if (both.first < both.end) tiles.push_back(both);
  }
  return tiles;
}

bool is_of_rocks(const HazardSources& sources, int run) {
  const auto of = std::find_if(
      sources.classes.begin(), sources.classes.end(),
      [run](const HazardRuns& runs) { return run >= runs.first && run < runs.first + runs.n; });
  return of != sources.classes.end() && of->kind.of_rocks;
}

// Rows in a tile, of the parts from `first_part` on. A rock's passages are evaluated together: they
// are read of the cells around as well.
void take_rows_of_parts(const RunInputs& runs, std::size_t first_part, const HazardInputs& inputs,
                        const MapTile& tile, std::uint64_t most, const TakeEvent& take) {
  const MapGrid& map = inputs.map;
  const Recipe& recipe = inputs.sources.recipe;
  const std::size_t n_cells = static_cast<std::size_t>(map.grid.n_rows) * map.grid.n_cols;
  for (std::size_t p = first_part; p < runs.parts().size(); ++p) {
    const PartInput& part = runs.parts()[p];
    const Part& content = part.file.part;
    const auto blocks_of = [&](std::size_t r) -> const RunBlocks& {
      return content.blocks[static_cast<std::size_t>(content.blocks_of_run[r])];
    };
    const auto source_of = [&](std::size_t r) -> EventSource {
      const int index = part.member[r];
      return {runs.members[static_cast<std::size_t>(index)], index,
              is_of_rocks(inputs.sources, index)};
    };
    int beside = 0;
    for (std::size_t r = 0; r < part.member.size(); ++r)
      if (part.member[r] >= 0)
        beside =
            std::max(beside, cells_beside(map.grid, blocks_of(r), recipe, source_of(r).of_rocks));
    for (const MapTile& own : tiles_of_part(part.file, tile, n_cells, most)) {
      const MapTile around = wider(own, beside, map.grid);
      const auto take_own = [&](const EventRow& row) {
        if (is_in(own, row.cell)) take(row);
      };
      for_each_strip(part.file, 1, around, std::numeric_limits<std::uint64_t>::max(),
                     [&](const std::vector<std::vector<Passage>>& by_run) {
                       for (std::size_t r = 0; r < by_run.size(); ++r)
                         if (part.member[r] >= 0 && !by_run[r].empty())
                           event_rows(
                               map_rows(by_run[r], content.grid, map, blocks_of(r).weight, around),
                               map.grid, blocks_of(r), recipe, source_of(r), take_own);
                     });
    }
  }
}

// Rows in a tile, of all runs once more, each as its class counts it.
void take_rows(RunInputs& runs, const HazardInputs& inputs, const MapTile& tile, std::uint64_t most,
               const TakeEvent& take) {
  const Recipe& recipe = inputs.sources.recipe;
  const PassageGrid& grid = inputs.map.grid;
  const auto take_own = [&](const EventRow& row) {
    if (is_in(tile, row.cell)) take(row);
  };
  runs.read_again(only_passages, [&](RunFile& run, int index) {
    const EventSource of{runs.members[static_cast<std::size_t>(index)], index,
                         is_of_rocks(inputs.sources, index)};
    const MapTile around = wider(tile, cells_beside(grid, run.blocks, recipe, of.of_rocks), grid);
    event_rows(map_rows(run.passages, run.grid, inputs.map, run.blocks.weight, around), grid,
               run.blocks, recipe, of, take_own);
  });
  take_rows_of_parts(runs, 0, inputs, tile, most, take_own);
}

// Whether some runs of a class have one block, which is an event of its own, and others masses.
bool is_mixed(const HazardRuns& runs, const std::vector<RunMember>& members) {
  return std::any_of(members.begin() + runs.first, members.begin() + runs.first + runs.n,
                     [&runs](const RunMember& run) {
                       return blocks_are_events(run.info, run.n_released) != runs.kind.of_rocks;
                     });
}

}  // namespace

HazardInputs read_hazard_inputs(RunInputs& runs, const std::vector<HazardClass>& classes,
                                const Recipe& recipe, std::uint64_t most_rows) {
  HazardInputs out;
  out.sources.recipe = recipe;
  out.sources.has_frequencies = !classes.empty();
  const auto count = [&](const EventRow& row) {
    ++out.rows_of_cell[row.cell];
    if (++out.n_rows <= most_rows)
      out.rows.push_back(row);
    else if (!out.rows.empty())
      std::vector<EventRow>().swap(out.rows);
  };
  for (const RunSet& set : runs.of_classes(classes)) {
    const HazardClass kind = class_at(classes, out.sources.classes.size());
    const int first = static_cast<int>(runs.members.size());
    const std::size_t first_part = runs.parts().size();
    runs.read(set, "class." + kind.name, only_passages, [&](RunFile& run, int index) {
      const RunMember& member = runs.members[static_cast<std::size_t>(index)];
      if (run.grid.n_rows == 0)
        throw InputError({where_of(member)}, "holds no passages",
                         "set [output] passages = true and run talus-dda again");
      if (out.rows_of_cell.empty()) {
        out.map = map_grid(run.grid, 0, "");
        out.rows_of_cell.assign(static_cast<std::size_t>(out.map.grid.n_rows) * out.map.grid.n_cols,
                                0);
      }
      event_rows(map_rows(run.passages, run.grid, out.map, run.blocks.weight), out.map.grid,
                 run.blocks, recipe,
                 {member, index, blocks_are_events(member.info, member.n_released)}, count);
    });
    out.sources.classes.push_back(hazard_runs(kind, runs.members, first, runs.last_failed_share()));
    take_rows_of_parts(runs, first_part, out, {}, most_rows, count);
  }
  const std::vector<HazardRuns>& of = out.sources.classes;
  if (std::none_of(of.begin(), of.end(),
                   [&](const HazardRuns& one) { return is_mixed(one, runs.members); }))
    return out;
  out.rows.clear();
  out.n_rows = 0;
  std::fill(out.rows_of_cell.begin(), out.rows_of_cell.end(), 0);
  take_rows(runs, out, {}, most_rows, count);
  return out;
}

std::vector<MapLayer> read_hazard_layers(RunInputs& runs, HazardInputs& inputs,
                                         std::uint64_t most_rows) {
  if (inputs.n_rows <= most_rows) {
    sort_events(inputs.rows);
    return hazard_layers(inputs.sources, inputs.rows);
  }
  std::vector<MapLayer> layers;
  for (const MapTile& tile : tiles_of(inputs.rows_of_cell, most_rows)) {
    std::vector<EventRow> rows;
    take_rows(runs, inputs, tile, most_rows, [&rows](const EventRow& row) { rows.push_back(row); });
    sort_events(rows);
    std::vector<MapLayer> of_tile = hazard_layers(inputs.sources, rows);
    if (layers.empty())
      layers = std::move(of_tile);
    else
      for (std::size_t i = 0; i < layers.size(); ++i) append(layers[i], of_tile[i]);
  }
  return layers;
}

}  // namespace talus
