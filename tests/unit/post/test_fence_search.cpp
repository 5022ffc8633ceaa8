// Search of the cheapest fence: crossings, stretches, costs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "post/fence_search/paths.hpp"
#include "post/fence_search/search.hpp"
#include "run_maker.hpp"

namespace {

using namespace talus;           // NOLINT: a test
using namespace talus::testing;  // NOLINT

constexpr double energy_a_metre = 4711.71;  // of a block of 2,600 kg on 30 degrees, phi = 20 [J/m]

// A code without factors: the energy and height that are needed are those of the blocks.
DesignCode plain_code() {
  DesignCode code;
  code.formula = DesignFormula::onr;
  code.factor = {{"energy_percentile", 0.99}, {"height_percentile", 0.95}, {"gamma_energy_cc1", 1},
                 {"gamma_energy_cc2", 1},     {"gamma_energy_cc3", 1},     {"gamma_height_cc1", 1},
                 {"gamma_height_cc2", 1},     {"gamma_height_cc3", 1},     {"f_min_m", 0},
                 {"f_min_share_of_block", 0}, {"deflection_factor", 1}};
  return code;
}

SearchSettings plain_settings(double price_of_class) {
  SearchSettings settings;
  settings.share = 1;
  settings.heights = {4};
  settings.capacities = {100e3, 250e3, 500e3, 1000e3};
  for (int k = 0; k < 4; ++k) settings.prices_per_m.push_back(1 + price_of_class * k);
  settings.spacing = 2.5;
  settings.min_fields = 1;
  settings.end_fields = 0;
  settings.two_fences = false;
  return settings;
}

// A line across a slope that falls to +x, at x = s, from y = 0 to 300.
SearchLine line_at(double s) {
  SearchLine line;
  line.name = "s" + std::to_string(static_cast<int>(s));
  line.side = 1;
  for (int k = 0; k <= 120; ++k) {
    line.fence.post.emplace_back(s, 2.5 * k, 100 - 0.5 * s);
    line.fence.chainage.push_back(2.5 * k);
  }
  return line;
}

struct Slope {
  SearchRuns runs;
  std::vector<SearchLine> lines;
  Trn trn = plane_trn(0.5, 5, 81, 81);
};

Slope scene_of(const std::vector<double>& places) {
  Slope scene;
  for (const double s : places) scene.lines.push_back(line_at(s));
  return scene;
}

// A run whose blocks cross line l at `chainage[l]` [m] each with `energy[l]` [J] and come to the
// object.
void add_run(Slope& scene, const std::vector<std::vector<double>>& chainage,
             const std::vector<double>& energy, double volume = 1, double time_apart = 10) {
  const std::size_t n = chainage[0].size();
  SearchRuns& runs = scene.runs;
  for (std::size_t l = 0; l < scene.lines.size(); ++l)
    for (std::size_t b = 0; b < n; ++b) {
      SearchHit hit;
      hit.arrival.run = runs.n_runs;
      hit.arrival.block = static_cast<int>(b);
      hit.arrival.time = time_apart * static_cast<double>(b) + static_cast<double>(l) / 100;
      hit.arrival.chainage = chainage[l][b];
      hit.arrival.translation = energy[l];
      hit.arrival.speed = 10;
      hit.arrival.top = 1;
      hit.arrival.volume = volume;
      hit.block = runs.n_blocks + static_cast<int>(b);
      hit.matters = true;
      scene.lines[l].hits.push_back(hit);
    }
  for (int b = 0; b < static_cast<int>(n); ++b)
    runs.on_object.push_back({{runs.n_runs, b, 1}, runs.n_blocks + b});
  runs.n_blocks += static_cast<int>(n);
  ++runs.n_runs;
  runs.density = 2600;
  runs.mean_block_size = 1;
  runs.basis = share_basis(clusters_of_runs(std::vector<double>(runs.n_runs, 2), 2));
}

FenceSearchResult searched(const Slope& scene, const SearchSettings& settings) {
  return search_fences(scene.runs, scene.lines, plain_code(), settings, scene.trn);
}

// Blocks that come through a gully: at a line s the hits lie within 10 + 0.5 |s - 60| metres.
Slope gully() {
  std::vector<double> places;
  for (double s = 5; s <= 110; s += 5) places.push_back(s);
  Slope scene = scene_of(places);
  for (int r = 0; r < 12; ++r) {
    std::vector<std::vector<double>> chainage;
    std::vector<double> energy;
    for (const double s : places) {
      const double half = 0.5 * (10 + 0.5 * std::abs(s - 60));
      chainage.push_back({100 - half, 100 + half});
      energy.push_back(energy_a_metre * s);
    }
    add_run(scene, chainage, energy, 0.1);
  }
  return scene;
}

double place_of(const Slope& scene, const FenceOption& option) {
  return scene.lines[option.parts[0].placed.line].fence.post[0].x();
}

// Cost of the cheapest fence that fulfils the request, on the line at s.
double cost_at(const Slope& scene, const SearchSettings& settings, double s) {
  const Slope alone = [&] {
    Slope out = scene;
    std::erase_if(out.lines, [&](const SearchLine& line) { return line.fence.post[0].x() != s; });
    return out;
  }();
  const FenceSearchResult found = searched(alone, settings);
  return found.proposals.empty() ? std::nan("") : found.proposals[0].cost;
}

}  // namespace

TEST(FenceSearch, TheShortestStretchHoldsTheShareOfElevenEqualHits) {
  std::vector<double> place, weight(11, 1.0);
  for (int k = 0; k < 11; ++k) place.push_back(4 * k);
  const double share[] = {1, 0.9, 0.8, 0.5}, length[] = {40, 36, 32, 20};
  for (int i = 0; i < 4; ++i) {
    const auto found = shortest_stretch(place, weight, share[i] * 11);
    ASSERT_TRUE(found);
    EXPECT_DOUBLE_EQ(found->to - found->from, length[i]) << share[i];
  }
  EXPECT_FALSE(shortest_stretch(place, weight, 11.5));
}

TEST(FenceSearch, TheShortestStretchGoesByWeights) {
  const auto found = shortest_stretch({0, 1, 2, 10, 11}, {1, 1, 1, 2, 5}, 7);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->from, 10);
  EXPECT_EQ(found->to, 11);
}

TEST(FenceSearch, OnAPlaneTheCheapestStandsNearestToTheSource) {
  // classes end where the energy of the slide does: 21.22, 53.06, 106.1, 212.2 m
  const SearchSettings settings = plain_settings(0.2);
  const double ends[] = {21.22, 53.06, 106.1, 212.2};
  for (int k = 0; k < 4; ++k)
    for (const double beyond : {-0.05, 0.05}) {
      Slope scene = scene_of({ends[k] + beyond});
      for (int r = 0; r < 12; ++r)
        add_run(scene, {{100, 120}}, {energy_a_metre * (ends[k] + beyond)}, 0.1);
      const FenceSearchResult found = searched(scene, settings);
      if (k == 3 && beyond > 0) {
        EXPECT_TRUE(found.proposals.empty());
        continue;
      }
      ASSERT_FALSE(found.proposals.empty());
      EXPECT_EQ(found.proposals[0].parts[0].placed.kind, k + (beyond > 0)) << ends[k] + beyond;
    }
  std::vector<double> places, energy;
  std::vector<std::vector<double>> chainage;
  for (double s = 15; s <= 100; s += 5) {
    places.push_back(s);
    energy.push_back(energy_a_metre * s);
    chainage.push_back({100, 120});
  }
  Slope scene = scene_of(places);
  for (int r = 0; r < 12; ++r) add_run(scene, chainage, energy, 0.1);
  const FenceSearchResult found = searched(scene, settings);
  ASSERT_FALSE(found.proposals.empty());
  EXPECT_EQ(place_of(scene, found.proposals[0]), 15);
}

TEST(FenceSearch, InAGullyTheNarrowestPlaceIsTheBestWhereClassesCostLittle) {
  const Slope scene = gully();
  const SearchSettings settings = plain_settings(0.2);
  const FenceSearchResult found = searched(scene, settings);
  ASSERT_GE(found.proposals.size(), 3u);
  EXPECT_EQ(place_of(scene, found.proposals[0]), 60);
  EXPECT_NEAR(found.proposals[0].cost, 14.0, 1e-9);
  EXPECT_NEAR(found.proposals[1].cost, 17.5, 1e-9);
  EXPECT_NEAR(found.proposals[2].cost, 17.5, 1e-9);
  EXPECT_EQ(std::abs(place_of(scene, found.proposals[1]) - 60), 5);
  EXPECT_EQ(std::abs(place_of(scene, found.proposals[2]) - 60), 5);
  EXPECT_NEAR(cost_at(scene, settings, 50), 18.0, 1e-9);
}

TEST(FenceSearch, InAGullyTheLightestClassIsTheBestWhereClassesCostMuch) {
  const Slope scene = gully();
  const SearchSettings settings = plain_settings(2.0);
  const FenceSearchResult found = searched(scene, settings);
  ASSERT_GE(found.proposals.size(), 2u);
  EXPECT_EQ(place_of(scene, found.proposals[0]), 20);
  EXPECT_EQ(found.proposals[0].capacity, 100e3);
  EXPECT_NEAR(found.proposals[0].cost, 30.0, 1e-9);
  EXPECT_EQ(place_of(scene, found.proposals[1]), 15);
  EXPECT_NEAR(found.proposals[1].cost, 32.5, 1e-9);
  EXPECT_NEAR(cost_at(scene, settings, 50), 45.0, 1e-9);
}

TEST(FenceSearch, OfTwoGulliesTwoFencesBeatOne) {
  Slope scene = scene_of({40, 60});
  for (int r = 0; r < 12; ++r)
    add_run(scene, {{100, 110, 200, 210}, {100, 110, 200, 210}},
            {energy_a_metre * 40, energy_a_metre * 60}, 0.1);
  SearchSettings settings = plain_settings(0.2);
  const FenceSearchResult one = searched(scene, settings);
  ASSERT_FALSE(one.proposals.empty());
  EXPECT_NEAR(one.proposals[0].length, 110, 1e-9);
  settings.two_fences = true;
  const FenceSearchResult two = searched(scene, settings);
  ASSERT_FALSE(two.proposals.empty());
  EXPECT_EQ(two.proposals[0].parts.size(), 2u);
  EXPECT_NEAR(two.proposals[0].length, 20, 1e-9);
  EXPECT_LT(two.proposals[0].cost, one.proposals[0].cost);
  EXPECT_EQ(two.proposals[0].stopped, 1);
}

TEST(FenceSearch, WithoutHitsNoFenceIsTheBest) {
  Slope scene = scene_of({40});
  for (int r = 0; r < 12; ++r) add_run(scene, {{}}, {0});
  const FenceSearchResult found = searched(scene, plain_settings(0.2));
  EXPECT_TRUE(found.front.empty());
  EXPECT_TRUE(found.proposals.empty());
  EXPECT_TRUE(found.nearest.parts.empty());
}

TEST(FenceSearch, FiveBlocksAtOncePassAFieldThatHoldsEachOfThem) {
  Slope scene = scene_of({40});
  for (int r = 0; r < 12; ++r)
    add_run(scene, {{100, 100.1, 100.2, 100.3, 100.4}}, {200e3}, 0.1, 0.1);
  PlacedFence placed{0, 100, 102.5, 1, 4, 500e3, 2};
  const FieldLoads loads = field_loads(scene.lines[0], placed, 1);
  EXPECT_DOUBLE_EQ(loads.single, 200e3);
  EXPECT_DOUBLE_EQ(loads.second, 1000e3);
  EXPECT_DOUBLE_EQ(loads.run, 1000e3);
  const ScreenOutcome single = follow(scene.runs, scene.lines, {placed}, false);
  EXPECT_EQ(single.stopped, 1);
  EXPECT_TRUE(single.hit.empty());
  const ScreenOutcome sum = follow(scene.runs, scene.lines, {placed});
  EXPECT_DOUBLE_EQ(sum.stopped, 0.4);  // the third block breaks the field
  EXPECT_EQ(sum.hit.size(), 36u);
  const FenceOption option =
      option_of(scene.runs, scene.lines, {placed}, plain_code(), plain_settings(0.2), scene.trn);
  EXPECT_NE(std::find(option.faults.begin(), option.faults.end(), SearchFault::energy),
            option.faults.end());
  EXPECT_EQ(governs(option), "energies within a second");
  // far apart in time the same blocks only add up until the end of the run
  Slope apart = scene_of({40});
  for (int r = 0; r < 12; ++r) add_run(apart, {{100, 100.1, 100.2, 100.3, 100.4}}, {200e3}, 0.1, 5);
  EXPECT_DOUBLE_EQ(field_loads(apart.lines[0], placed, 1).second, 200e3);
  EXPECT_DOUBLE_EQ(field_loads(apart.lines[0], placed, 1).run, 1000e3);
}

// The same blocks as rocks that fall one by one: each finds the field whole and alone.
TEST(FenceSearch, RocksThatFallOneByOneDoNotAddUp) {
  Slope scene = scene_of({40});
  for (int r = 0; r < 12; ++r)
    add_run(scene, {{100, 100.1, 100.2, 100.3, 100.4}}, {200e3}, 0.1, 0.1);
  for (SearchHit& hit : scene.lines[0].hits) hit.arrival.world = hit.arrival.block;
  sort_hits(scene.lines[0]);
  PlacedFence placed{0, 100, 102.5, 1, 4, 500e3, 2};
  const FieldLoads loads = field_loads(scene.lines[0], placed, 1);
  EXPECT_DOUBLE_EQ(loads.single, 200e3);
  EXPECT_DOUBLE_EQ(loads.second, 200e3);
  EXPECT_DOUBLE_EQ(loads.run, 200e3);
  EXPECT_EQ(follow(scene.runs, scene.lines, {placed}).stopped, 1);
}

TEST(FenceSearch, WhatTheUpperRowMissesGoesOnToTheLowerOne) {
  // fast blocks first, then high ones that only the lower row stops
  Slope scene = scene_of({40, 60});
  for (int r = 0; r < 12; ++r) add_run(scene, {{100, 101}, {100, 101}}, {150e3, 200e3}, 0.1);
  for (SearchHit& hit : scene.lines[0].hits)
    if (hit.arrival.block == 1) hit.arrival.top = 9;
  const PlacedFence upper{0, 95, 105, 4, 4, 250e3, 1}, lower{1, 95, 105, 4, 4, 250e3, 1};
  EXPECT_DOUBLE_EQ(follow(scene.runs, scene.lines, {upper}).stopped, 0.5);
  const ScreenOutcome both = follow(scene.runs, scene.lines, {upper, lower});
  EXPECT_EQ(both.stopped, 1);
  EXPECT_DOUBLE_EQ(both.retained[0], 0.1);  // one block each
  EXPECT_DOUBLE_EQ(both.retained[1], 0.1);
}

TEST(FenceSearch, MoreRockThanThereIsRoomForIsNotHeldByAnyFence) {
  // on a slope of 0.5, 4 m high and 20 m long: 4 * 4 / 0.5 / 2 * 20 = 320 m3
  Slope scene = scene_of({40});
  for (int r = 0; r < 12; ++r) add_run(scene, {{100, 120}}, {1e3}, 130);
  const FenceSearchResult found = searched(scene, plain_settings(0.2));
  EXPECT_TRUE(found.proposals.empty());
  ASSERT_FALSE(found.nearest.parts.empty());
  EXPECT_EQ(found.nearest.faults, std::vector<SearchFault>{SearchFault::storage});
  EXPECT_NEAR(found.nearest.parts[0].storage, 320, 20);
  EXPECT_DOUBLE_EQ(found.nearest.parts[0].retained, 1.3 * 260);
}

TEST(FenceSearch, NoOptionOfTheFrontBeatsAnother) {
  const FenceSearchResult found = searched(gully(), plain_settings(0.2));
  for (const FenceOption& a : found.front)
    for (const FenceOption& b : found.front) EXPECT_FALSE(beats(a, b));
  const std::vector<FenceOption> curve = cost_curve(found.front);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    EXPECT_GE(curve[i].cost, curve[i - 1].cost);
    EXPECT_GT(curve[i].stopped, curve[i - 1].stopped);
  }
}

TEST(FenceSearch, EndFieldsLieBesideWhatIsStoppedAndTheFenceOnItsLine) {
  const SearchLine line = line_at(40);  // 300 m
  const auto placed = place_fence(line, 0, {100, 112}, 10, 3, 1);
  ASSERT_TRUE(placed);
  EXPECT_DOUBLE_EQ(placed->from, 90);
  EXPECT_DOUBLE_EQ(placed->to, 122);
  EXPECT_EQ(placed->n_fields, 4);
  EXPECT_FALSE(place_fence(line, 0, {5, 50}, 10, 3, 1));  // the line begins too near
  const auto shifted = place_fence(line, 0, {1, 2}, 10, 3, 0);
  ASSERT_TRUE(shifted);
  EXPECT_DOUBLE_EQ(shifted->from, 0);
  EXPECT_DOUBLE_EQ(shifted->to, 30);
}

TEST(FenceSearch, AStretchIsSoughtWhereEndFieldsHaveRoom) {
  // the two nearest hits lie at the end of the line
  Slope scene = scene_of({40});
  for (int r = 0; r < 12; ++r) add_run(scene, {{2, 3, 100, 105}}, {50e3}, 0.1);
  SearchSettings settings = plain_settings(0.2);
  settings.share = 0.5;
  settings.spacing = 10;
  settings.end_fields = 1;
  const FenceSearchResult found = searched(scene, settings);
  ASSERT_FALSE(found.proposals.empty());
  EXPECT_DOUBLE_EQ(found.proposals[0].parts[0].placed.from, 90);
  EXPECT_DOUBLE_EQ(found.proposals[0].stopped, 0.5);
}

TEST(FenceSearch, SharesThatChanceTellsApartDoNotAgree) {
  EXPECT_TRUE(shares_agree(0.03, wilson_interval(0.03, 100), 0.07, wilson_interval(0.07, 100)));
  EXPECT_FALSE(shares_agree(0.03, wilson_interval(0.03, 100), 0.20, wilson_interval(0.20, 100)));
  EXPECT_TRUE(shares_agree(0, wilson_interval(0, 100), 0, wilson_interval(0, 100)));
}

TEST(FencePaths, GiveTheCrossingsOfLinesThatNobodyWatched) {
  RunFile run;
  add_box(run, {1, 1, 1}, {0, 20, 100});
  for (int k = 0; k <= 20; ++k) {  // 10 m/s along x, at 3 m above the line's base
    FrameBlock at = standing({static_cast<double>(k), 20, 3});
    at.velocity = {10, 0, 0};
    add_frame(run, 0.1 * k, {at});
  }
  std::vector<BlockPath> paths;
  add_paths(paths, run, 0, 0, {1.5}, {{{{10.5, 10}, {10.5, 30}}}, 4});
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_LT(paths[0].points.size(), 21u);  // near the line alone
  const SearchLine line = line_of_paths(paths, {{10.5, 10, 0}, {10.5, 20, 0}, {10.5, 30, 0}}, 1);
  ASSERT_EQ(line.hits.size(), 1u);
  const FenceArrival& at = line.hits[0].arrival;
  EXPECT_NEAR(at.time, 1.05, 1e-12);
  EXPECT_NEAR(at.chainage, 10, 1e-9);
  EXPECT_NEAR(at.energy(), 0.5 * 2000 * 100, 1e-6);
  EXPECT_NEAR(at.top, 3.5, 1e-6);
  EXPECT_NEAR(at.bottom, 2.5, 1e-6);
  EXPECT_EQ(at.direction, -1);
  EXPECT_TRUE(line.hits[0].matters);
  const SearchLine late = line_of_paths(paths, {{10.5, 40, 0}, {10.5, 50, 0}}, 1);
  EXPECT_TRUE(late.hits.empty());
}

namespace {

// A fence at x = 80, from y = 15 to 55, refined for blocks that come along x at these y, ever
// faster: the farther up (smaller x) the cheaper. The light class is enough up to 78.5 m.
RefinedFence refined_for(const std::vector<double>& places, double share, int end_fields) {
  const int n = static_cast<int>(places.size());
  RunFile run;
  for (const double y : places) add_box(run, {0.5, 0.5, 0.5}, {0, y, 100});
  for (int k = 0; k <= 60; ++k) {
    std::vector<FrameBlock> at;
    for (const double y : places) {
      const double x = 50 + k;
      at.push_back(standing({x, y, 100 - 0.5 * x + 0.5}));
      at.back().velocity = {std::sqrt(2 * energy_a_metre * x / 250), 0, 0};
    }
    add_frame(run, 0.1 * k, at);
  }
  Slope scene;
  SearchRuns& runs = scene.runs;
  std::vector<BlockPath> paths;
  for (int r = 0; r < 12; ++r) {
    add_paths(paths, run, r, n * r, std::vector<double>(places.size(), 9),
              {{{{80, 0}, {80, 80}}}, 20});
    for (int b = 0; b < n; ++b) runs.on_object.push_back({{r, b, 1}, n * r + b});
  }
  runs.n_runs = 12;
  runs.n_blocks = 12 * n;
  runs.density = 2000;
  runs.mean_block_size = 0.5;
  runs.basis = share_basis(clusters_of_runs(std::vector<double>(12, n), 2));
  SearchSettings settings = plain_settings(0.2);
  settings.capacities = {370e3, 500e3};
  settings.prices_per_m = {1, 2};
  settings.spacing = 10;
  settings.share = share;
  settings.end_fields = end_fields;
  Fence start;
  for (int k = 0; k <= 4; ++k) {
    start.post.emplace_back(80, 15 + 10.0 * k, 60);
    start.chainage.push_back(10.0 * k);
  }
  RefineLimits limits;
  limits.farthest = 8;
  return refine(runs, paths, start, 1, plain_code(), settings, scene.trn, limits);
}

}  // namespace

TEST(FencePaths, ARefinedFenceIsMovedToWhereBlocksComeWithLess) {
  const RefinedFence refined = refined_for({30, 40}, 1, 0);
  EXPECT_TRUE(refined.option.faults.empty());
  EXPECT_GT(refined.n_moves, 0);
  EXPECT_EQ(refined.option.capacity, 370e3);
  EXPECT_LE(refined.option.length, 20.5);  // fields that nothing meets are taken away
}

TEST(FencePaths, BlocksBeyondTheShareDoNotKeepAFenceFromBeingRefined) {
  // a third of the blocks meets an end field; without it the share is held all the same
  const RefinedFence refined = refined_for({20, 30, 40}, 0.6, 1);
  EXPECT_TRUE(refined.option.faults.empty());
  EXPECT_EQ(refined.option.capacity, 370e3);
  EXPECT_GE(refined.option.stopped, 0.6);
  // where it is not, nothing is moved
  EXPECT_EQ(refined_for({20, 30, 40}, 0.9, 1).n_moves, 0);
}
