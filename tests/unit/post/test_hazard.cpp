// Hazard classes from frequency, reach and intensity; recipes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/read_file.hpp"
#include "post/hazard/hazard_maps.hpp"
#include "post/hazard/risk.hpp"
#include "run_maker.hpp"

namespace {

using namespace talus;           // NOLINT: a test
using namespace talus::testing;  // NOLINT: a test

std::string shipped(const std::string& name = "switzerland_ti") {
  return read_file(std::string(TALUS_SOURCE_DIR) + "/share/hazard/" + name + ".toml");
}

Recipe swiss(const std::string& side = "a") {
  Recipe recipe = parse_recipe(shipped(), "switzerland_ti.toml");
  recipe.side = side == "b";
  return recipe;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string refusal_of_recipe(const std::string& text) {
  try {
    static_cast<void>(parse_recipe(text, "r.toml"));
  } catch (const InputError& error) {
    return std::string(error.what()) + " | " + error.hint();
  }
  return "accepted";
}

std::string refusal_of_site(const std::string& text) {
  try {
    static_cast<void>(hazard_classes(parse_site(text, "s.toml")));
  } catch (const InputError& error) {
    return std::string(error.what()) + " | " + error.hint();
  }
  return "accepted";
}

std::vector<EventRow> events_of(const std::vector<MapRow>& rows, const PassageGrid& grid,
                                const RunBlocks& blocks, const Recipe& recipe, const RunMember& run,
                                int index) {
  std::vector<EventRow> out;
  event_rows(rows, grid, blocks, recipe,
             {run, index, blocks_are_events(run.info, static_cast<int>(blocks.volume.size()))},
             [&out](const EventRow& row) { out.push_back(row); });
  return out;
}

// A class of `n` runs of single blocks from run `first` on.
HazardRuns runs_of(double frequency, int first, int n) {
  HazardRuns runs;
  runs.kind.name = "V" + std::to_string(first);
  runs.kind.frequency = {frequency, frequency, frequency};
  runs.first = first;
  runs.n = n;
  const std::vector<double> released(static_cast<std::size_t>(n), 1);
  runs.basis = share_basis(clusters_of_runs(released, 1));
  return runs;
}

// Runs of `n_rocks` each; rocks that moved as if they were alone.
std::vector<RunMember> members_of(int n_runs, int n_rocks, double weight, bool has_frequencies) {
  std::vector<RunMember> members(static_cast<std::size_t>(n_runs));
  for (int r = 0; r < n_runs; ++r) {
    members[r].file = "run_" + std::to_string(r) + ".h5";
    members[r].info.independent = true;
    members[r].info.weights_are_frequencies = has_frequencies;
    members[r].n_blocks = members[r].n_released = n_rocks;
    for (int rock = 0; rock < n_rocks; ++rock) members[r].weight += weight;
  }
  return members;
}

HazardClass class_named(const std::string& name, FrequencyKind kind, double frequency = 0) {
  HazardClass out;
  out.name = name;
  out.kind = kind;
  out.frequency = {frequency, frequency, frequency};
  return out;
}

std::string refusal_of_runs(const HazardClass& kind, const std::vector<RunMember>& members) {
  try {
    static_cast<void>(hazard_runs(kind, members, 0, 0));
  } catch (const InputError& error) {
    return std::string(error.what()) + " | " + error.hint();
  }
  return "accepted";
}

EventRow row(int run, float energy) { return {7, run, 0, energy, energy, 1}; }

// By the return periods of reaching the cell and of each break; 0: never.
std::string class_of_periods(const Recipe& recipe, const std::vector<double>& periods) {
  std::vector<double> rates;
  for (const double period : periods) rates.push_back(period > 0 ? 1 / period : 0);
  const int code = class_of(recipe, rates).code;
  for (const RecipeClass& c : recipe.classes)
    if (c.code == code) return c.name;
  return "none";
}

}  // namespace

TEST(Hazard, OfThreeVolumeClassesIsTheSumOfFrequencyTimesReach) {
  // P(reach), P(> 30 kJ), P(> 300 kJ) of 100 runs a class
  const std::vector<HazardRuns> classes{runs_of(0.10, 0, 100), runs_of(0.02, 100, 100),
                                        runs_of(0.004, 200, 100)};
  const int counts[3][3] = {{6, 2, 0}, {15, 12, 3}, {40, 39, 32}};
  std::vector<EventRow> rows;
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < counts[c][0]; ++i)
      rows.push_back(row(100 * c + i, i < counts[c][2] ? 400 : i < counts[c][1] ? 100 : 10));
  sort_events(rows);
  HazardRates at(classes);
  const std::vector<Rate> rates = at.above(rows, std::vector<double>{30, 300});
  ASSERT_EQ(rates.size(), 3u);
  const double lambda[3] = {0.010600, 0.005960, 0.001880}, period[3] = {94.3, 167.8, 531.9},
               in_50[3] = {0.4114, 0.2577, 0.0897};
  std::vector<double> values;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(rates[i].value, lambda[i], 1e-9);
    EXPECT_NEAR(1 / rates[i].value, period[i], 0.05);
    EXPECT_NEAR(1 - std::exp(-50 * rates[i].value), in_50[i], 5e-5);
    EXPECT_LT(rates[i].low, rates[i].value);
    EXPECT_GT(rates[i].high, rates[i].value);
    values.push_back(rates[i].value);
  }
  const Recipe recipe = swiss();
  EXPECT_EQ(intensity_at(recipe, values, 30), 0);
  EXPECT_EQ(intensity_at(recipe, values, 100), 1);
  EXPECT_EQ(intensity_at(recipe, values, 300), 2);
  EXPECT_EQ(class_of(recipe, values).number, 4);
  EXPECT_EQ(class_of(recipe, values).code, 2);      // 4a: yellow
  EXPECT_EQ(class_of(swiss("b"), values).code, 3);  // 4b: blue
}

TEST(Hazard, ClassesAreThoseOfTheSwissMatrix) {
  const Recipe a = swiss(), b = swiss("b");
  EXPECT_EQ(class_of_periods(a, {29, 400, 0}), "blue");
  EXPECT_EQ(class_of_periods(a, {31, 400, 0}), "yellow");
  EXPECT_EQ(class_of_periods(a, {99, 299, 0}), "yellow");
  EXPECT_EQ(class_of_periods(a, {50, 50, 301}), "blue");
  EXPECT_EQ(class_of_periods(a, {299, 299, 299}), "red");
  EXPECT_EQ(class_of_periods(a, {301, 301, 301}), "residual");
  EXPECT_EQ(class_of_periods(a, {20, 29, 500}), "blue");
  EXPECT_EQ(class_of_periods(b, {20, 29, 500}), "red");
  EXPECT_EQ(class_of_periods(a, {20, 90, 250}), "red");
  EXPECT_EQ(class_of_periods(a, {0, 0, 0}), "none");
  EXPECT_EQ(class_of_periods(a, {30, 0, 0}), "blue");  // the period itself belongs to the class
}

// Whatever its energy: TEK17 counts any rock.
TEST(Hazard, ClassesOfNorwayAreByTheProbabilityOfReachAlone) {
  const Recipe recipe = parse_recipe(shipped("norway_tek17"), "n.toml");
  EXPECT_EQ(class_of_periods(recipe, {99}), "above_S1");
  EXPECT_EQ(class_of_periods(recipe, {100}), "above_S1");
  EXPECT_EQ(class_of_periods(recipe, {101}), "above_S2");
  EXPECT_EQ(class_of_periods(recipe, {1000}), "above_S2");
  EXPECT_EQ(class_of_periods(recipe, {4999}), "above_S3");
  EXPECT_EQ(class_of_periods(recipe, {5001}), "none");
  EXPECT_EQ(intensity_words(recipe, 0), "reached");
  EXPECT_EQ(mark_words(recipe), "v; width_m m; class o");
}

// 10 % in 50 years: -50 / ln 0.9 = 474.56 years; 0.5 %: -50 / ln 0.995 = 9975.
TEST(Hazard, ProbabilitiesInYearsAreReturnPeriods) {
  const Recipe recipe = parse_recipe(shipped("british_columbia"), "b.toml");
  ASSERT_EQ(recipe.return_periods.size(), 2u);
  EXPECT_NEAR(recipe.return_periods[0], 474.56, 0.005);
  EXPECT_NEAR(recipe.return_periods[1], 9975, 0.5);
  EXPECT_EQ(period_name(recipe.return_periods[0]), "475");
  EXPECT_EQ(class_of_periods(recipe, {474}), "above_permit");
  EXPECT_EQ(class_of_periods(recipe, {475}), "above_subdivision");
  EXPECT_EQ(class_of_periods(recipe, {9974}), "above_subdivision");
  EXPECT_EQ(class_of_periods(recipe, {9976}), "none");
  HazardSources sources{{runs_of(0.1, 0, 10)}, recipe, true};
  for (const MapLayer& layer : hazard_layers(sources, {row(0, 1)}))
    EXPECT_EQ(layer.name.find('.'), std::string::npos) << layer.name;
}

TEST(Hazard, ClassesByVolumeAreThoseOfTheirMatrix) {
  const Recipe recipe = parse_recipe(
      "name = 'volumes'\nedition = '1'\nreturn_period_a = [100]\n"
      "matrix = [['low'], ['low'], ['high']]\n"
      "[[source]]\nof = ['return_period_a', 'matrix', 'intensity', 'class']\n"
      "document = 'a test'\npage = '1'\nmark = 'o'\n"
      "[intensity]\nby = 'block_volume_m3'\nbreaks = [0.25, 1]\nnames = ['a', 'b', 'c']\n"
      "[class.low]\ncode = 1\nrgb = [1, 1, 1]\nlabel = 'low'\n"
      "[class.high]\ncode = 2\nrgb = [2, 2, 2]\nlabel = 'high'\n",
      "v.toml");
  EXPECT_EQ(class_of_periods(recipe, {20, 60, 90}), "high");
  EXPECT_EQ(class_of_periods(recipe, {20, 60, 110}), "low");
  EXPECT_EQ(class_of_periods(recipe, {110, 0, 0}), "none");
  RunBlocks blocks;
  blocks.volume = {0.5};
  std::vector<MapRow> rows(1);
  rows[0].largest.total_energy = 9e6F;
  EXPECT_EQ(events_of(rows, {}, blocks, recipe, {}, 0)[0].intensity, 0.5F);
}

// Half of the time there; 0.006, 0.003 and 0.001 hits a year of the three intensities:
// 0.5 (0.006 0.05 + 0.003 0.3 + 0.001 1) = 0.0011, of which 1 - exp(-0.0011) is the chance.
TEST(Hazard, RiskIsPresenceTimesHitsTimesVulnerability) {
  Recipe recipe = parse_recipe(shipped("new_zealand_christchurch"), "z.toml");
  ASSERT_TRUE(is_of_risk(recipe));
  ObjectSettings object;
  object.presence = 0.5;
  object.persons_per_day = 4;
  object.vulnerability = {0.05, 0.3, 1};
  const std::vector<Rate> rates{{0.01, 0.005, 0.02}, {0.004, 0.002, 0.008}, {0.001, 0.0005, 0.002}};
  const ObjectRisk risk = risk_of(recipe, object, rates);
  EXPECT_NEAR(risk.individual.value, 0.00109939522, 1e-11);
  EXPECT_NEAR(risk.individual.low, 0.00054984877, 1e-11);
  EXPECT_NEAR(risk.individual.high, 0.00219758177, 1e-11);
  EXPECT_NEAR(risk.deaths, 0.0044, 1e-15);
  EXPECT_EQ(recipe.classes[risk.kind].name, "intolerable");
  EXPECT_TRUE(risk.is_certain);
  object.vulnerability = {0.5};  // one hit in 5,000 years: 0.5 0.5 / 5000 = 5e-5
  const ObjectRisk rare = risk_of(recipe, object, std::vector<Rate>{{2e-4, 1e-4, 6e-4}});
  EXPECT_NEAR(rare.individual.value, 4.999875e-5, 1e-10);
  EXPECT_EQ(recipe.classes[rare.kind].name, "below");
  EXPECT_FALSE(rare.is_certain);                   // 1.5e-4 at the upper bound
  const double exact = -std::log1p(-1e-4) / 0.25;  // "one in 10,000 or more" is intolerable
  EXPECT_EQ(
      recipe.classes[risk_of(recipe, object, std::vector<Rate>{{exact * (1 + 1e-9), 0, 1}}).kind]
          .name,
      "intolerable");
  HazardSources sources{{runs_of(0.1, 0, 10)}, recipe, true};
  for (const MapLayer& layer : hazard_layers(sources, {row(0, 1)}))
    EXPECT_TRUE(layer.name.find("class") == std::string::npos && layer.name != "intensity");
}

TEST(Hazard, RiskNeedsToKnowWhoIsThere) {
  const Recipe recipe = parse_recipe(shipped("new_zealand_christchurch"), "z.toml");
  const auto said = [&](const std::string& text, const Recipe& by) {
    try {
      const Site site = parse_site(text, "s.toml");
      check_exposure(site, by, hazard_classes(site));
    } catch (const InputError& error) {
      return std::string(error.what()) + " | " + error.hint();
    }
    return std::string("accepted");
  };
  const auto expect = [&](const std::string& text, const std::string& words) {
    const std::string answer = said(text, recipe);
    EXPECT_NE(answer.find(words), std::string::npos) << answer;
    EXPECT_EQ(said(text, swiss()), "accepted");
  };
  const std::string rate = "[hazard.class.V1]\nfrequency_per_a = 1\n",
                    house = "[object.house]\nposition_m = [0, 0]\nradius_m = 5\n",
                    rest = "presence = 0.7\npersons_per_day = 4\n";
  expect(rate, "is of risk, and the site has no object");
  expect(house + rest + "vulnerability = [0.5]\n", "add [hazard.class.NAME]");
  expect(rate + house, "s.toml:3: object.house");
  expect(rate + house, "the object has no presence");
  expect(rate + house + rest, "no vulnerability | give the probability of death");
  expect(rate + house + "presence = 1\nvulnerability = [0.5]\n", "no persons_per_day");
  expect(rate + house + rest + "vulnerability = [0.5, 1]\n",
         "vulnerability has 2 numbers, recipe New Zealand");
  EXPECT_EQ(said(rate + house + rest + "vulnerability = [0.5]\n", recipe), "accepted");
  Recipe by_energy = recipe;
  by_energy.breaks = {30};
  by_energy.intensities = {"weak", "strong"};
  EXPECT_NE(said(rate + house + rest + "vulnerability = [0.5, 0.1]\n", by_energy)
                .find("falls with the intensity"),
            std::string::npos);
}

TEST(Hazard, EnergiesOfReturnPeriodsAreCumulatedFromAbove) {
  const std::vector<std::pair<float, double>> events = {
      {12, 0.002}, {45, 0.004}, {80, 0.001}, {310, 0.0008}, {900, 0.0002}, {1500, 0.00005}};
  std::vector<HazardRuns> classes;
  std::vector<EventRow> rows;
  for (std::size_t i = 0; i < events.size(); ++i) {
    classes.push_back(runs_of(events[i].second, static_cast<int>(i), 1));
    rows.push_back(row(static_cast<int>(i), events[i].first));
  }
  HazardRates at(classes);
  const std::vector<double> below{11.9, 44.9, 79.9, 309.9, 899.9, 1499.9},
      cumulated{0.00805, 0.00605, 0.00205, 0.00105, 0.00025, 0.00005};
  const std::vector<Rate> rates = at.above(rows, below);
  for (std::size_t i = 0; i < cumulated.size(); ++i)
    EXPECT_NEAR(rates[i + 1].value, cumulated[i], 1e-12);
  const std::vector<Rate> energy = at.energies(rows, std::vector<double>{100, 300, 1000, 5000});
  EXPECT_TRUE(std::isnan(energy[0].value));
  EXPECT_EQ(energy[1].value, 45);
  EXPECT_EQ(energy[2].value, 310);
  EXPECT_EQ(energy[3].value, 900);
}

TEST(Hazard, OfASingleFailureHasAProbabilityAndAnEquivalentRate) {
  EXPECT_NEAR(equivalent_rate(0.1 * 0.02, 50), 4.004e-5, 5e-9);
  EXPECT_NEAR(1 / equivalent_rate(0.1 * 0.02, 50), 24975, 1);
  EXPECT_NEAR(equivalent_rate(0.1 * 0.3, 50), 6.092e-4, 5e-8);
  HazardRuns runs = runs_of(0, 0, 10);
  runs.kind.kind = FrequencyKind::of_failure;
  runs.kind.probability = 0.1;
  runs.kind.years = 50;
  EXPECT_NEAR(1 / rate_of(runs, 3).value, 1642, 1);
  HazardSources sources{{runs}, swiss(), true};
  const std::vector<MapLayer> layers = hazard_layers(sources, {row(0, 1), row(1, 1), row(2, 1)});
  ASSERT_GT(layers.size(), 1u);
  EXPECT_EQ(layers[1].name, "probability");  // and no return period
  EXPECT_NEAR(layers[1].bands[0].value[0], 0.03, 1e-7);
  for (const MapLayer& layer : layers)
    EXPECT_EQ(layer.name.find("return_period"), std::string::npos);
}

TEST(Hazard, OfAMassCountsRunsNotBlocks) {
  // 12 of 40 runs with blocks above 300 kJ, each of 50 blocks: T 667 a, 440 to 1,107 a.
  std::vector<HazardRuns> classes{runs_of(1.0 / 200, 0, 40)};
  classes[0].basis = share_basis(clusters_of_runs(std::vector<double>(40, 50), 50));
  std::vector<EventRow> rows;
  for (int run = 0; run < 12; ++run)
    for (int block = 0; block < 3; ++block) rows.push_back(row(run, 350));
  HazardRates at(classes);
  const Rate rate = at.above(rows, std::vector<double>{300})[1];
  EXPECT_NEAR(rate.value, 0.0015, 1e-12);
  EXPECT_NEAR(1 / rate.value, 667, 0.5);
  EXPECT_NEAR(rate.low * 200, 0.1807, 5e-5);
  EXPECT_NEAR(rate.high * 200, 0.4543, 5e-5);
  EXPECT_NEAR(1 / rate.high, 440, 0.5);
  EXPECT_NEAR(1 / rate.low, 1107, 1);
  EXPECT_NEAR(at.passages_above(rows, {})[0], 36.0 / 40 / 200, 1e-12);
}

TEST(Hazard, RaisesCellsOfAMassAndLeavesOutliersTheirEnergy) {
  const Recipe recipe = swiss();
  RunBlocks blocks;
  blocks.volume = {60, 60, 1};
  std::vector<MapRow> rows(4);
  const float times[4] = {10, 12.5F, 20, 5};
  const int cells[4] = {3, 3, 3, 4}, of[4] = {0, 1, 2, 2};
  for (int i = 0; i < 4; ++i) {
    rows[i].cell = static_cast<std::uint32_t>(cells[i]);
    rows[i].block = of[i];
    rows[i].first_time = times[i];
    rows[i].largest.total_energy = 5e3F;
  }
  RunMember run;
  PassageGrid grid;
  grid.cell_size = 10;
  grid.n_rows = grid.n_cols = 9;
  const std::vector<EventRow> made = events_of(rows, grid, blocks, recipe, run, 0);
  EXPECT_GT(made[0].intensity, 300);
  EXPECT_GT(made[1].intensity, 300);
  EXPECT_EQ(made[2].intensity, 5);  // 7.5 s behind the first two
  EXPECT_EQ(made[3].intensity, 5);
  EXPECT_EQ(made[0].energy, 5);
  run.info.independent = true;  // none of them was there when another came
  EXPECT_EQ(events_of(rows, grid, blocks, recipe, run, 0)[0].intensity, 5);
  run.info.independent = false;
  blocks.volume = {30, 30, 1};  // no mass
  EXPECT_EQ(events_of(rows, grid, blocks, recipe, run, 0)[0].intensity, 5);
}

// Rows of rocks of 1 m3, as wide as a sphere, that run straight over a map of 120 x 120 m, 0.5 m
// beside each other.
constexpr double size_of_rock = 1.2407;  // [m]
std::vector<MapRow> rows_of_parallel_rocks(const PassageGrid& grid, double heading) {
  std::vector<MapRow> rows;
  for (int rock = 0; rock <= 320; ++rock) {
    std::set<std::uint32_t> cells;
    for (double s = -85; s < 85; s += 0.2)
      for (const double edge : {-0.5, 0.0, 0.5}) {
        const double d = 0.5 * (rock - 160) + edge * size_of_rock;
        const int col = static_cast<int>(
            std::floor((60.1 + s * std::cos(heading) - d * std::sin(heading)) / grid.cell_size));
        const int row = static_cast<int>(
            std::floor((60.1 - s * std::sin(heading) - d * std::cos(heading)) / grid.cell_size));
        if (row >= 0 && row < grid.n_rows && col >= 0 && col < grid.n_cols)
          cells.insert(static_cast<std::uint32_t>(row * grid.n_cols + col));
      }
    for (const std::uint32_t cell : cells) {
      MapRow made;
      made.cell = cell;
      made.block = rock;
      made.heading = static_cast<float>(heading);
      rows.push_back(made);
    }
  }
  return rows;
}

// Two rocks a metre. As many hit what is 15 m wide, on any cells; of single cells they hit more
// the larger the cells are.
TEST(Hazard, HowOftenRocksHitDoesNotDependOnTheCells) {
  Recipe recipe = swiss();
  recipe.width = 15;
  const double wanted = 2 * (recipe.width + size_of_rock);
  RunMember run;
  run.info.independent = true;
  RunBlocks blocks;
  blocks.volume.assign(321, 1);
  for (const double cell_size : {1.0, 2.5, 5.0})
    for (const double heading : {0.0, 0.35, 0.7853981633974483, 2.2, -1.5707963267948966}) {
      PassageGrid grid;
      grid.cell_size = cell_size;
      grid.n_rows = grid.n_cols = static_cast<int>(120 / cell_size);
      std::map<std::uint32_t, double> hits;
      for (const EventRow& row :
           events_of(rows_of_parallel_rocks(grid, heading), grid, blocks, recipe, run, 0))
        hits[row.cell] += row.weight;
      double sum = 0;
      int n = 0;
      for (const auto& [cell, n_rocks] : hits) {
        const double row = static_cast<int>(cell) / grid.n_cols + 0.5;
        const double col = static_cast<int>(cell) % grid.n_cols + 0.5;
        if (std::hypot(row * cell_size - 60, col * cell_size - 60) > 40) continue;
        EXPECT_NEAR(n_rocks, wanted, 0.05 * wanted) << cell_size << " " << heading;
        sum += n_rocks;
        ++n;
      }
      EXPECT_NEAR(sum / n, wanted, 0.02 * wanted) << cell_size << " " << heading;
    }
}

TEST(Hazard, AMassIsAsWideAsItIsAndARockAtRestIsInItsCell) {
  const Recipe recipe = swiss();
  PassageGrid grid;
  grid.cell_size = 2;
  grid.n_rows = grid.n_cols = 9;
  RunBlocks blocks, block;
  blocks.volume = {1, 1};
  block.volume = {1};
  std::vector<MapRow> rows(1);
  rows[0].cell = 40;
  RunMember run;
  run.n_blocks = run.n_released = 2;
  EXPECT_EQ(events_of(rows, grid, blocks, recipe, run, 0).size(), 1U);
  const auto cells_of = [&](const RunBlocks& of) {
    std::vector<std::uint32_t> cells;
    for (const EventRow& row : events_of(rows, grid, of, recipe, run, 0)) cells.push_back(row.cell);
    return cells;
  };
  const std::vector<std::uint32_t> across_east = {13, 22, 31, 40, 49, 58, 67};
  EXPECT_EQ(cells_of(block), across_east);
  run.info.independent = true;
  EXPECT_EQ(cells_of(blocks), across_east);
  EXPECT_GE(cells_beside(grid, blocks, recipe, true), 2);
  EXPECT_EQ(cells_beside(grid, blocks, recipe, false), 0);
  rows[0].heading = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(events_of(rows, grid, blocks, recipe, run, 0).size(), 1U);
}

TEST(Hazard, OfWeightsIsTheSumOfTheBlocksFrequencies) {
  // 0.5 a year released a run
  const std::vector<HazardClass> kinds{class_named("V1", FrequencyKind::of_weights)};
  const std::vector<HazardRuns> classes{
      hazard_runs(kinds[0], members_of(20, 50, 0.01, true), 0, 0)};
  std::vector<EventRow> rows;
  for (int run = 0; run < 10; ++run)
    for (const float energy : {20.0F, 40.0F})
      rows.push_back({7, run, energy > 30 ? 1 : 0, energy, energy, 0.01});
  sort_events(rows);
  HazardRates at(classes);
  const std::vector<Rate> rates = at.above(rows, std::vector<double>{30});
  EXPECT_NEAR(rates[0].value, 0.01, 1e-8);  // 2 blocks of 0.01 in half of the runs
  EXPECT_NEAR(rates[1].value, 0.005, 1e-8);
  EXPECT_LT(rates[0].low, rates[0].value);
  const std::vector<Rate> energy = at.energies(rows, std::vector<double>{100, 200, 210, 99});
  EXPECT_EQ(energy[0].value, 20);
  EXPECT_EQ(energy[1].value, 40);
  EXPECT_EQ(energy[2].value, 40);
  EXPECT_TRUE(std::isnan(energy[3].value));
}

// Twenty runs of rocks of which every fourth crosses the cell: the class says how many rocks it
// sheds, the release points how many each of them.
TEST(Hazard, OfSingleRocksCountsRocksHoweverManyARunHas) {
  const auto rates_of = [](const HazardClass& kind, int n_rocks, double weight) {
    const std::vector<HazardRuns> classes{
        hazard_runs(kind, members_of(20, n_rocks, weight, weight != 1), 0, 0)};
    std::vector<EventRow> rows;
    for (int run = 0; run < 20; ++run)
      for (int rock = 0; rock < n_rocks / 4; ++rock)
        rows.push_back({7, run, rock, rock % 2 == 0 ? 20.0F : 40.0F, 0, weight});
    sort_events(rows);
    HazardRates at(classes);
    const Rate rate = at.above(rows, {})[0], share = at.shares_above(rows, {}, 0)[0];
    const std::vector<Rate> energy = at.energies(rows, std::vector<double>{20, 10, 9});
    return std::vector<double>{rate.value,      rate.low,
                               rate.high,       share.value,
                               share.high,      at.passages_above(rows, {})[0],
                               energy[0].value, energy[1].value,
                               energy[2].value, largest_rate_elsewhere(classes)};
  };
  const HazardClass all = class_named("V1", FrequencyKind::of_events, 0.4);
  const std::vector<double> few = rates_of(all, 8, 1), many = rates_of(all, 80, 1);
  EXPECT_NEAR(few[0], 0.1, 1e-12);
  EXPECT_NEAR(few[3], 0.25, 1e-12);
  EXPECT_NEAR(few[5], 0.1, 1e-12);
  EXPECT_EQ(few[6], 40);
  EXPECT_EQ(few[7], 20);
  EXPECT_TRUE(std::isnan(few[8]));
  for (std::size_t i : {0U, 3U, 5U, 6U, 7U}) EXPECT_NEAR(many[i], few[i], 1e-12) << i;
  const HazardClass points = class_named("V1", FrequencyKind::of_weights);
  const std::vector<double> each = rates_of(points, 8, 0.4 / 8);
  EXPECT_TRUE(std::isnan(each[8]));
  for (std::size_t i = 0; i < each.size(); ++i) {
    if (i == 8) continue;
    EXPECT_EQ(static_cast<float>(each[i]), static_cast<float>(few[i])) << i;
  }
}

// Rocks with more than 30 kJ are some of those that come; and a rock that all but missed is no
// rock.
TEST(Hazard, BoundsOfRocksDoNotContradictEachOther) {
  const std::vector<HazardRuns> classes{hazard_runs(
      class_named("V1", FrequencyKind::of_events, 0.4), members_of(20, 80, 1, false), 0, 0)};
  const double elsewhere = largest_rate_elsewhere(classes);
  HazardRates at(classes);
  std::vector<EventRow> rows;
  for (int run = 0; run < 6; ++run) rows.push_back({7, run, 3 * run, 20, 20, 1});
  const std::vector<Rate> hit = at.above(rows, std::vector<double>{30});
  EXPECT_LT(hit[0].high, elsewhere);
  EXPECT_EQ(hit[1].value, 0);
  EXPECT_LE(hit[1].high, hit[0].high);
  EXPECT_LE(hit[1].low, hit[0].low);
  rows = {{7, 0, 0, 20, 20, 1e-6}};
  const Rate missed = at.above(rows, {})[0];
  EXPECT_GT(missed.value, 0);
  EXPECT_EQ(missed.high, elsewhere);
}

TEST(Hazard, OfSingleRocksAsksOneQuestionOnce) {
  const HazardClass given = class_named("V1", FrequencyKind::of_events, 0.28),
                    asked = class_named("V1", FrequencyKind::of_weights);
  EXPECT_EQ(refusal_of_runs(given, members_of(3, 28, 1, false)), "accepted");
  EXPECT_EQ(refusal_of_runs(asked, members_of(3, 28, 0.01, true)), "accepted");
  const std::string both = refusal_of_runs(given, members_of(3, 28, 0.01, true));
  EXPECT_NE(both.find("run_0.h5: hazard.class.V1"), std::string::npos) << both;
  EXPECT_NE(both.find("without one of its own"), std::string::npos) << both;
  HazardClass failure = given;
  failure.kind = FrequencyKind::of_failure;
  EXPECT_NE(refusal_of_runs(failure, members_of(3, 28, 0.01, true)), "accepted");
  // once a year at each point is a frequency, and pieces of blocks have weights that are none
  EXPECT_EQ(refusal_of_runs(asked, members_of(3, 28, 1, true)), "accepted");
  EXPECT_NE(
      refusal_of_runs(asked, members_of(3, 28, 0.5, false)).find("blocks are not frequencies"),
      std::string::npos);
  std::vector<RunMember> mixed = members_of(3, 28, 1, false);
  mixed[1].info.independent = false;
  EXPECT_NE(refusal_of_runs(given, mixed).find("run_1.h5"), std::string::npos);
  mixed[1].n_released = 1;  // alone in any case
  EXPECT_EQ(refusal_of_runs(given, mixed), "accepted");

  const std::string release = "[rockfall.cliff]\nfrequency_per_a = 0.01\n";
  EXPECT_NE(refusal_of_site("[hazard.class.V1]\nfrequency_per_a = 0.28\n" + release)
                .find("[rockfall.cliff] has frequency_per_a"),
            std::string::npos);
  EXPECT_NE(refusal_of_site("[hazard.class.V1]\nevents = 3\nobserved_a = 10\n"
                            "[rockfall.cliff]\nfrequency_per_m2_a = 0.01\n")
                .find("[rockfall.cliff] has frequency_per_m2_a"),
            std::string::npos);
  EXPECT_EQ(refusal_of_site("[hazard.class.V1]\n" + release), "accepted");
  EXPECT_EQ(
      refusal_of_site("[hazard.class.V1]\n[hazard.class.V5]\nfrequency_per_a = 0.28\n" + release),
      "accepted");  // which runs are of which release the runs say
  EXPECT_NE(
      refusal_of_site("[hazard.class.frozen]\n[hazard.class.thawed]\n" + release)
          .find("hazard.class.thawed: takes the frequencies of [rockfall.*], class frozen takes "
                "them too"),
      std::string::npos);
}

// One block is alone however its run was computed.
TEST(Hazard, AClassOfSingleBlocksIsOfRocks) {
  const HazardClass kind = class_named("V1", FrequencyKind::of_events);
  std::vector<RunMember> members = members_of(20, 1, 1, false);
  for (RunMember& member : members) member.info.independent = false;
  EXPECT_TRUE(hazard_runs(kind, members, 0, 0).kind.of_rocks);
  members[7].n_blocks = 2;  // pieces of one rock
  EXPECT_TRUE(hazard_runs(kind, members, 0, 0).kind.of_rocks);
  members[7].n_released = 2;
  EXPECT_FALSE(hazard_runs(kind, members, 0, 0).kind.of_rocks);
}

// Runs of five rock masses are five samples: too few for bounds, where they hit and elsewhere.
TEST(Hazard, FewRockMassesHaveNoBoundElsewhere) {
  const HazardClass kind = class_named("V1", FrequencyKind::of_events);
  for (const int n_masses : {5, 10}) {
    std::vector<RunMember> members = members_of(50, 4, 1, false);
    for (int r = 0; r < 50; ++r) {
      members[r].info.independent = false;
      members[r].info.terrain_digest = "before the slide";
      members[r].info.blocks_hash = std::to_string(r % n_masses);
    }
    const HazardRuns runs = hazard_runs(kind, members, 0, 0);
    EXPECT_EQ(std::isnan(largest_rate_elsewhere({&runs, 1})), n_masses < 10);
  }
}

// A case that counts three times as much does so in the share of runs and in that of rocks.
TEST(Hazard, OfWeighedRunsGoesByTheirWeights) {
  for (const bool alone : {false, true}) {
    std::vector<RunMember> members = members_of(20, 4, 1, false);
    for (int r = 0; r < 20; ++r) {
      members[r].info.independent = alone;
      members[r].run_weight = r < 10 ? 1.5 : 0.5;
      members[r].weight *= members[r].run_weight;
    }
    const std::vector<HazardRuns> classes{
        hazard_runs(class_named("V1", FrequencyKind::of_events, 1), members, 0, 0)};
    std::vector<EventRow> rows;
    for (int run = 0; run < 10; ++run)
      for (int rock = 0; rock < 4; ++rock) rows.push_back({7, run, rock, 20, 20, 1.5});
    HazardRates at(classes);
    EXPECT_NEAR(at.above(rows, {})[0].value, 0.75, 1e-12);
  }
}

TEST(Hazard, IsBoundedWhereNoRunCame) {
  const std::vector<HazardRuns> ten{runs_of(1, 0, 10)}, hundred{runs_of(1, 0, 100)};
  EXPECT_NEAR(largest_rate_elsewhere(ten), 0.277533, 1e-6);
  EXPECT_NEAR(largest_rate_elsewhere(hundred), 0.036993, 1e-6);
}

// 40 runs over 20 rock masses: as many trials as masses, however the rate is asked for.
TEST(Hazard, OfRunsOfRockMassesCountsTheMasses) {
  HazardRuns runs = runs_of(0.5, 0, 40);
  std::vector<int> unit;
  for (int run = 0; run < 40; ++run) unit.push_back(run % 20);
  runs.basis = share_basis(clusters_of_runs(std::vector<double>(40, 1), 1, unit));
  const std::vector<HazardRuns> classes{runs};
  EXPECT_NEAR(largest_rate_elsewhere(classes), 0.5 * wilson_interval(0, 20).high, 1e-12);
  std::vector<EventRow> rows;  // five masses, both runs of each
  for (int run = 0; run < 40; ++run)
    if (run % 20 < 5) rows.push_back(row(run, 40));
  sort_events(rows);
  HazardRates at(classes);
  const Rate rate = at.above(rows, {})[0];
  std::vector<BlockWeight> hit;
  for (const EventRow& r : rows) hit.push_back({r.run, 0, 1});
  const Interval wanted = run_share_interval(runs.basis, hit);
  EXPECT_NEAR(rate.value, 0.125, 1e-12);
  EXPECT_NEAR(rate.low, 0.5 * wanted.low, 1e-12);
  EXPECT_NEAR(rate.high, 0.5 * wanted.high, 1e-12);
  const Rate as_runs = rate_of(runs_of(0.5, 0, 40), 10);
  EXPECT_LT(rate.low, as_runs.low);
  EXPECT_GT(rate.high, as_runs.high);
  EXPECT_NEAR(at.shares_above(rows, {}, 0)[0].high, wanted.high, 1e-12);
  const std::vector<Rate> energy = at.energies(rows, std::vector<double>{9, 7});
  EXPECT_EQ(energy[0].value, 40);  // 0.125 a year: once in 8
  EXPECT_TRUE(std::isnan(energy[1].value));
  EXPECT_EQ(energy[1].high, 40);  // as often as the upper bound allows
}

TEST(Hazard, ClassesAreCertainOnlyWhereBothBoundsAgree) {
  const Recipe recipe = swiss();
  const auto certain = [&](double frequency, int n, int n_hit) {
    HazardSources sources{{runs_of(frequency, 0, n)}, recipe, true};
    std::vector<EventRow> rows;
    for (int run = 0; run < n_hit; ++run) rows.push_back(row(run, 500));
    const std::vector<MapLayer> layers = hazard_layers(sources, rows);
    EXPECT_EQ(layers.back().name, certainty_layer);
    return layers.back().bands[0].value[0] == 1;
  };
  EXPECT_TRUE(certain(0.1, 1000, 900));  // once in 11 years, red at both ends
  EXPECT_FALSE(certain(0.01, 40, 12));   // 333 years, 220 to 553: red or residual
}

TEST(Hazard, FrequenciesOfCountedEventsAreJeffreys) {
  // quantiles of Gamma(1/2, 1) are z^2 / 2 of the normal law, of Gamma(1, 1) -ln(1 - p)
  EXPECT_NEAR(gamma_quantile(0.5, 0.95), 1.959963985 * 1.959963985 / 2, 1e-8);
  EXPECT_NEAR(gamma_quantile(1, 0.05), -std::log(0.95), 1e-11);
  EXPECT_NEAR(gamma_quantile(3.5, 0.5), 6.345811195521515 / 2, 1e-8);  // chi squared of 7
  const Rate rate = rate_of_events(3, 150);
  EXPECT_NEAR(rate.value, 3.5 / 150, 1e-15);
  EXPECT_NEAR(rate.low, 2.16734990929806 / 2 / 150, 1e-9);   // chi squared of 7, 5 %
  EXPECT_NEAR(rate.high, 14.0671404493402 / 2 / 150, 1e-9);  // 95 %
  EXPECT_GT(rate_of_events(0, 100).value, 0);
}

TEST(Hazard, SectionsOfTheSiteSayEachClassOnce) {
  const Site site = parse_site(
      "[hazard.class.V1]\nevents = 3\nobserved_a = 150\n"
      "[hazard.class.V5]\nfrequency_per_a = 0.004\n",
      "s.toml");
  const std::vector<HazardClass> classes = hazard_classes(site);
  ASSERT_EQ(classes.size(), 2u);
  EXPECT_EQ(classes[0].name, "V1");
  EXPECT_NEAR(classes[0].frequency.value, 3.5 / 150, 1e-12);
  EXPECT_EQ(classes[1].frequency.low, 0.004);
  Site changed = site;
  override_value(changed, "hazard.class.V5.frequency_per_a", "0.01");
  EXPECT_EQ(changed.hazard_classes[1].frequency_per_a, 0.01);
  EXPECT_TRUE(hazard_classes(parse_site("[hazard]\n", "s.toml")).empty());

  EXPECT_NE(refusal_of_site("[hazard.class.V1]\n").find("has no frequency"), std::string::npos);
  EXPECT_NE(refusal_of_site("[hazard.class.V1]\nevents = 3\n").find("events without observed_a"),
            std::string::npos);
  EXPECT_NE(refusal_of_site("[hazard.class.V1]\nfrequency_per_a = 1\nevents = 2\nobserved_a = 9\n")
                .find("more than one frequency"),
            std::string::npos);
  const std::string once = "failure_probability = 0.1\nin_years = 50\n";
  EXPECT_EQ(refusal_of_site("[hazard.class.A]\n" + once), "accepted");
  EXPECT_NE(refusal_of_site("[hazard.class.A]\n" + once + "[hazard.class.B]\nfrequency_per_a = 1\n")
                .find("hazard.class.B: fails again, class A does not"),
            std::string::npos);
  EXPECT_NE(refusal_of_site("[hazard.class.A]\n" + once +
                            "[hazard.class.B]\nfailure_probability = 0.1\nin_years = 30\n")
                .find("within 30 years"),
            std::string::npos);
  EXPECT_NE(refusal_of_site("[hazard.class.V1]\nfrequncy_per_a = 1\n")
                .find("did you mean frequency_per_a?"),
            std::string::npos);
}

TEST(Recipe, HolesAreRefusedWithTheirPlace) {
  const std::string whole = shipped();
  EXPECT_EQ(refusal_of_recipe(whole), "accepted");
  const auto expect = [&](const std::string& from, const std::string& to,
                          const std::string& words) {
    const std::string said = refusal_of_recipe(replaced(whole, from, to));
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("r.toml:"), std::string::npos) << said;
  };
  expect("[\"red\", \"red\", \"red\"]", "[\"red\", \"red\"]", "has 2 entries, expected 3");
  expect(", [\"red\", \"red\", \"red\"]]", "]", "has 2 entries, expected 3");
  expect("[\"red\", \"red\", \"red\"]", "[\"red\", \"\", \"red\"]", "has a cell without a class");
  expect("[\"red\", \"red\", \"red\"]", "[\"red\", \"green\", \"red\"]", "names class \"green\"");
  expect("breaks = [30, 300]", "breaks = [300, 30]", "does not ascend");
  expect("breaks = [30, 300]", "breaks = [30]", "has 3 entries, expected 2");
  expect("return_period_a = [30, 100, 300]\n", "", "return_period_a");
  expect("beyond = \"residual\"", "beyond = \"rest\"", "names class \"rest\"");
  expect("code = 4", "code = 3", "has the code of class");
  expect("code = 4", "code = 400", "expected 1 to 254");
  expect("intensity = \"strong\"", "intensity = \"mighty\"", "none of intensity.names");
  expect("split = \"a\"", "split = \"c\"", "expected a or b");
  expect("mark = \"v\"", "makr = \"v\"", "is not a key of a recipe");
  expect("mark = \"v\"", "mark = \"x\"", "v: read in the document");
  expect("\"matrix\", \"class\"]", "\"class\"]", "matrix: has no source");
  expect("of = [\"mass\"]", "of = [\"risk\"]", "which is not part of this recipe");
  expect("of = [\"mass\"]", "of = [\"class\"]", "has \"class\" twice");
  expect("page = ", "pgae = ", "known: of, document, page, mark");
  expect("label = \"low hazard\"", "", "class.yellow.label");
}

// A stronger or more frequent event has no lower class; on both sides of the split.
TEST(Recipe, UpsideDownIsRefused) {
  const std::string whole = shipped();
  const auto expect = [&](const std::string& from, const std::string& to,
                          const std::string& words) {
    const std::string said = refusal_of_recipe(replaced(whole, from, to));
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("r.toml:"), std::string::npos) << said;
  };
  expect("[\"blue\", \"yellow\", \"yellow\"]", "[\"red\", \"red\", \"red\"]",
         "gives \"blue\" to medium in 30 years, and the row before gives \"red\" to weak");
  expect("[\"red\", \"red\", \"red\"]", "[\"none\", \"none\", \"none\"]",
         "gives \"none\" to strong in 30 years");
  expect("[\"blue\", \"yellow\", \"yellow\"]", "[\"yellow\", \"yellow\", \"blue\"]",
         "gives \"blue\" in 300 years, and \"yellow\" in 100");
  expect("\"yellow|blue\"", "\"yellow|red\"", "gives \"red\" in 300 years, and \"blue\" in 100");
  expect("beyond = \"residual\"", "beyond = \"blue\"", "the matrix gives \"yellow\"");
  expect("alone_s = 3", "alone_s = -1", "mass.alone_s: is not above 0");
  expect("alone_s = 3", "alone_s = 0", "is not above 0");
  expect("[6, 5, 4]", "[6, 5, -4]", "has -4, expected a whole number");
  expect("[6, 5, 4]", "[6, 5.5, 4]", "has 5.5, expected a whole number");
  expect("hatched = true", "hatched = \"yes\"", "is neither true nor false");
  expect("\"weak\", \"medium\"", "\"weak\", \"weak\"", "has \"weak\" twice");
  expect("return_period_a = [30, 100, 300]", "return_period_a = [-30, 100, 300]",
         "does not ascend from above 0");
}

// Numbers of another unit, names that lead nowhere, colours that say nothing.
TEST(Recipe, WhatMakesNoSenseIsRefused) {
  const auto expect_of = [](const std::string& name, const std::string& from, const std::string& to,
                            const std::string& words) {
    const std::string said = refusal_of_recipe(replaced(shipped(name), from, to));
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("r.toml:"), std::string::npos) << said;
  };
  const auto swiss = [&](const std::string& from, const std::string& to, const std::string& words) {
    expect_of("switzerland_ti", from, to, words);
  };
  swiss("breaks = [30, 300]", "breaks = [30000, 300000]", "energies are in kJ: 30000 J are 30");
  swiss("\"total_energy_kj\"\nbreaks = [30, 300]", "\"block_volume_m3\"\nbreaks = [1000, 2000]",
        "volumes are in m3");
  swiss("return_period_a = [30, 100, 300]", "return_period_a = [0, 100, 300]", "from above 0");
  swiss("return_period_a = [30, 100, 300]", "return_period_a = [0.001, 0.01, 0.1]",
        "write probability");
  swiss("return_period_a = [30, 100, 300]", "return_period_a = [99.6, 100.4, 300]",
        "has 100 years twice");
  swiss("return_period_a = [30, 100, 300]",
        "return_period_a = [30, 100, 300]\nprobability = [0.1]\nin_years = 50",
        "return_period_a: means nothing beside probability");
  swiss("rgb = [255, 93, 81]", "rgb = [255, 93]", "has 2 entries, expected 3");
  swiss("rgb = [255, 93, 81]", "rgb = [1.0, 0.4, 0.3]", "expected whole numbers");
  swiss("rgb = [255, 93, 81]", "rgb = [300, 0, 0]", "has 300");
  swiss("rgb = [255, 93, 81]", "rgb = \"red\"", "is not a list");
  swiss("rgb = [255, 93, 81]", "rgb = [85, 142, 213]", "looks like class blue");
  swiss("hatched = true", "", "looks like class residual");
  swiss("beyond = \"residual\"", "", "class.residual: is given to nothing");
  const auto bc = [&](const std::string& from, const std::string& to, const std::string& words) {
    expect_of("british_columbia", from, to, words);
  };
  bc("[0.1, 0.005]", "[10, 0.5]", "10 % is 0.1");
  bc("[0.1, 0.005]", "[0.005, 0.1]", "what comes most often first");
  bc("in_years = 50", "in_years = 0", "is not above 0");
  bc("in_years = 50\n", "", "in_years: is missing");
  bc("in_years = 50", "in_years = 50\nsplit = \"b\"", "no cell of the matrix has two");
  const auto nz = [&](const std::string& from, const std::string& to, const std::string& words) {
    expect_of("new_zealand_christchurch", from, to, words);
  };
  nz("[1e-4]", "[10000]", "one in 10,000 a year is 1e-4");
  nz("[1e-4]", "[1e-4, 1e-5]", "does not ascend");
  nz("[1e-4]", "[1e-5, 1e-4]", "has 2 entries, expected 3");
  nz("[\"below\", \"intolerable\"]", "[\"intolerable\", \"below\"]", "whose code is not lower");
  nz("[\"below\", \"intolerable\"]", "[\"none\", \"intolerable\"]", "each object has a class");
  nz("edition", "return_period_a = [30]\nedition", "means nothing beside risk");
  nz("[risk]",
     "[intensity]\nby = \"translational_energy_kj\"\nbreaks = [30]\nnames = [\"a\", \"b\"]\n[risk]",
     "energy with spin alone");
}

TEST(Recipe, SmoothingTakesTheMostOfTheNeighbours) {
  // a single cell disappears, a straight border stays where it is
  std::vector<int> codes(25, no_class);
  codes[12] = 4;
  EXPECT_EQ(smoothed_classes(codes, 5, 5, 1)[12], no_class);
  for (int row = 0; row < 5; ++row)
    for (int col = 0; col < 5; ++col)
      codes[static_cast<std::size_t>(row) * 5 + col] = col < 2 ? 4 : 2;
  EXPECT_EQ(smoothed_classes(codes, 5, 5, 3), codes);
}
