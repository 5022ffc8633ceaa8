// The table of map layers: names, classes, pages.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "base/random.hpp"
#include "post/maps/map_layers.hpp"
#include "post/maps/map_style.hpp"
#include "run_maker.hpp"

using namespace talus;
using namespace talus::testing;

namespace {

const PassageGrid grid{Vec2(0, 60), 2, 9, 11};

// Forty runs of one block that came over every cell, and a deposit in one of them.
struct MadeByHand {
  CellRows cells;
  DepositSums deposit;
  ShareBasis basis;
  MapSettings settings;

  [[nodiscard]] MapSources sources() const { return {cells, deposit, 2, basis, settings}; }
};

MadeByHand some_runs(int n_runs) {
  Random random(3, "layers");
  MadeByHand made;
  std::vector<std::vector<MapRow>> rows;
  const std::vector<double> weight{1};  // of the one block
  for (int run = 0; run < n_runs; ++run) {
    std::vector<Passage> passages;
    for (int cell = 0; cell < grid.n_rows * grid.n_cols; ++cell) {
      Passage p;
      p.cell = cell;
      const auto number = [&](double high) {
        return static_cast<float>(random.uniform(0.1, high));
      };
      p.largest = {number(30), number(4e5), number(5e5), number(4), number(6)};
      p.first_time = number(20);
      p.travel_angle = 0.6F;
      p.heading = 1;
      passages.push_back(p);
    }
    rows.push_back(map_rows(passages, grid, {grid, 1}, weight));
  }
  made.basis = share_basis(clusters_of_runs(std::vector<double>(n_runs, 1), 1));
  made.cells = group_by_cell(std::move(rows), static_cast<std::size_t>(grid.n_rows * grid.n_cols));
  if (n_runs > 0) made.deposit = {{{7, 1}}, {{7, 1}}, {{7, 12.5}}};
  return made;
}

std::string text_of(const char* path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

TEST(MapLayers, EachHasANameOfItsOwnWordsAndAscendingClasses) {
  std::set<std::string> names;
  for (const MapLayerKind& kind : map_layers()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    for (const char* words : {kind.name, kind.title, kind.caption, kind.unit, kind.group})
      EXPECT_NE(std::string(words), "") << kind.name;
    EXPECT_GE(kind.breaks.size(), 2U) << kind.name;
    EXPECT_TRUE(std::is_sorted(kind.breaks.begin(), kind.breaks.end())) << kind.name;
    EXPECT_EQ(std::adjacent_find(kind.breaks.begin(), kind.breaks.end()), kind.breaks.end());
  }
}

// The band that the style shows is the one that the row names, in the unit that the row says.
TEST(MapLayers, EachIsMadeAndDrawnAsItsRowSays) {
  const MadeByHand made = some_runs(70);  // enough for a 95th percentile
  for (const MapLayerKind& kind : map_layers()) {
    const MapLayer layer = make_layer(kind, made.sources());
    EXPECT_EQ(layer.name, kind.name);
    EXPECT_EQ(kind_of(layer).title, kind.title);
    const RasterStyle style = map_style(layer);
    const MapBand& shown = layer.bands.at(static_cast<std::size_t>(style.band) - 1);
    const std::string wanted =
        *kind.shown_band != 0 ? kind.shown_band : std::string(kind.name) + "_p95";
    EXPECT_EQ(shown.name, wanted);
    EXPECT_EQ(shown.unit, kind.unit) << kind.name;
    EXPECT_EQ(style.classes.size(), kind.breaks.size() + 1 + kind.zero_is_transparent);
  }
}

TEST(MapLayers, AreMadeOfNoPassageAtAll) {
  const MadeByHand made = some_runs(0);
  const MadeByHand full = some_runs(1);
  for (const MapLayerKind& kind : map_layers()) {
    const MapLayer layer = make_layer(kind, made.sources());
    EXPECT_TRUE(layer.cell.empty()) << kind.name;
    EXPECT_EQ(layer.bands.size(), make_layer(kind, full.sources()).bands.size()) << kind.name;
  }
}

TEST(MapLayers, OneAloneIsOfTheDeposit) {
  const auto& table = map_layers();
  EXPECT_EQ(std::count_if(table.begin(), table.end(),
                          [](const MapLayerKind& kind) { return !kind.is_of_passages; }),
            1);
  const MadeByHand made = some_runs(2);
  EXPECT_EQ(make_layer(deposit_kind(), made.sources()).cell, std::vector<std::uint32_t>{7});
}

// make has to know the maps of talus-maps, and pages have to define them.
TEST(MapLayers, AreThoseOfThePipelineAndOfThePages) {
  std::string rule = text_of(TALUS_SOURCE_DIR "/pipelines/products.mk");
  ASSERT_NE(rule.find("map_names :="), std::string::npos);
  rule = rule.substr(rule.find("map_names :=") + 12);
  rule = rule.substr(0, rule.find("\nmap_products"));
  std::istringstream words(rule);
  std::set<std::string> of_make, of_table;
  for (std::string word; words >> word;)
    if (word != "\\") of_make.insert(word);
  for (const MapLayerKind& kind : map_layers()) of_table.insert(kind.name);
  EXPECT_EQ(of_make, of_table);
  const std::string formats = text_of(TALUS_SOURCE_DIR "/docs/reference/formats.md"),
                    page = text_of(TALUS_SOURCE_DIR "/docs/tools/talus-maps.md");
  for (const std::string& name : of_table) {
    EXPECT_NE(formats.find("| `" + name), std::string::npos) << name;
    EXPECT_NE(page.find("`" + name + "`"), std::string::npos) << name;
  }
}
