// Reads the inputs of talus-hazard: runs by class, the recipe, the passages.
#include "tools/hazard/inputs.hpp"

#include <algorithm>

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

using TakeRows = std::function<void(const std::vector<MapRow>&, const RunBlocks&, int)>;

// Rows of the parts from `first_part` on, over a tile of the map.
void take_rows_of_parts(const RunInputs& runs, std::size_t first_part, const MapGrid& map,
                        const MapTile& tile, std::uint64_t most, const TakeRows& take) {
  for (std::size_t p = first_part; p < runs.parts().size(); ++p) {
    const PartInput& part = runs.parts()[p];
    const Part& content = part.file.part;
    for_each_strip(part.file, map.factor, tile, most, [&](const auto& by_run) {
      for (std::size_t r = 0; r < by_run.size(); ++r)
        if (part.member[r] >= 0 && !by_run[r].empty()) {
          const RunBlocks& blocks =
              content.blocks[static_cast<std::size_t>(content.blocks_of_run[r])];
          take(map_rows(by_run[r], content.grid, map, blocks.weight, tile), blocks, part.member[r]);
        }
    });
  }
}

// The passages that rows in a tile may be of.
MapTile wider(const MapTile& tile, const HazardInputs& inputs) {
  const std::uint64_t margin = static_cast<std::uint64_t>(inputs.beside) *
                               (static_cast<std::uint64_t>(inputs.map.grid.n_cols) + 1);
  const std::uint64_t first = tile.first, end = tile.end + margin;
  return {static_cast<std::uint32_t>(first - std::min(first, margin)),
          static_cast<std::uint32_t>(std::min<std::uint64_t>(end, MapTile{}.end))};
}

}  // namespace

HazardInputs read_hazard_inputs(RunInputs& runs, const std::vector<HazardClass>& classes,
                                const Recipe& recipe, std::uint64_t most_rows) {
  HazardInputs out;
  out.sources.recipe = recipe;
  out.sources.has_frequencies = !classes.empty();
  const auto count = [&](const std::vector<MapRow>& from, const RunBlocks& blocks, int index) {
    const RunMember& member = runs.members[static_cast<std::size_t>(index)];
    out.beside = std::max(out.beside, cells_beside(out.map.grid, blocks, recipe, member));
    event_rows(from, out.map.grid, blocks, recipe, member, index, [&](const EventRow& row) {
      ++out.rows_of_cell[row.cell];
      if (++out.n_rows <= most_rows) out.rows.push_back(row);
    });
    if (out.n_rows > most_rows) std::vector<EventRow>().swap(out.rows);
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
      count(map_rows(run.passages, run.grid, out.map, run.blocks.weight), run.blocks, index);
    });
    take_rows_of_parts(runs, first_part, out.map, {}, most_rows, count);
    out.sources.classes.push_back(hazard_runs(kind, runs.members, first, runs.last_failed_share()));
  }
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
    const auto add = [&](const std::vector<MapRow>& from, const RunBlocks& blocks, int run) {
      event_rows(from, inputs.map.grid, blocks, inputs.sources.recipe,
                 runs.members[static_cast<std::size_t>(run)], run, [&](const EventRow& row) {
                   if (row.cell >= tile.first && row.cell < tile.end) rows.push_back(row);
                 });
    };
    const MapTile around = wider(tile, inputs);
    runs.read_again(only_passages, [&](RunFile& run, int index) {
      add(map_rows(run.passages, run.grid, inputs.map, run.blocks.weight, around), run.blocks,
          index);
    });
    take_rows_of_parts(runs, 0, inputs.map, around, most_rows, add);
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
