// Shares of sources in the blocks that reach a cell.
#include <gtest/gtest.h>

#include "post/trace/trace.hpp"
#include "run_maker.hpp"

namespace {

using namespace talus;           // NOLINT: a test
using namespace talus::testing;  // NOLINT

RecordObject area(const std::string& name, double x0, double y0, double x1, double y1) {
  return {name, "", {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, true}}, 0};
}

// A run with a block at each of `sources`; `hit[b]`: the objects that block b hits.
RunFile run_of(const std::vector<Vec2>& sources, const std::vector<std::vector<int>>& hit,
               const std::vector<RecordObject>& objects) {
  RunFile run;
  run.objects = objects;
  std::vector<FrameBlock> at;
  for (const Vec2& p : sources) {
    add_box(run, {1, 1, 1}, {p.x(), p.y(), 100});
    at.push_back(standing({p.x() + 50, p.y(), 50}));
  }
  add_frame(run, 10, at);
  for (std::size_t b = 0; b < hit.size(); ++b)
    for (const int o : hit[b]) {
      ObjectHit row;
      row.block = static_cast<std::int32_t>(b);
      row.object = o;
      row.total_energy = 1e3 * (b + 1.0);
      row.time = 5 + b;
      row.top_height = 1;
      run.object_hits.push_back(row);
    }
  return run;
}

TraceSums sums_of(const std::vector<RunFile>& runs, const std::vector<RecordObject>& objects) {
  TraceSums sums;
  sums.objects = objects;
  sums.sources = {{0, 100}, 10, 10, 10};
  for (const RunFile& run : runs) add_run(sums, run, 0.05, false);
  finish(sums);
  return sums;
}

// Each run released equally much.
ShareBasis basis_of(const TraceSums& sums) {
  const auto n = static_cast<std::size_t>(sums.n_runs);
  return share_basis(clusters_of_runs(std::vector<double>(n, sums.n_released / sums.n_runs), 2));
}

}  // namespace

TEST(Trace, OfTwoSourcesThreeToOneHasSharesThreeToOne) {
  // three blocks from one cell and one from the other, all hit
  const std::vector<RecordObject> objects{area("house", 50, 0, 60, 100)};
  const std::vector<Vec2> sources{{5, 20}, {5, 20}, {5, 20}, {5, 80}};
  const std::vector<RunFile> runs(8, run_of(sources, {{0}, {0}, {0}, {0}}, objects));
  const TraceSums sums = sums_of(runs, objects);
  const std::vector<SourceLink> links = source_links(sums);
  ASSERT_EQ(links.size(), 2u);
  EXPECT_DOUBLE_EQ(links[0].share_of_hits, 0.75);
  EXPECT_DOUBLE_EQ(links[1].share_of_hits, 0.25);
  EXPECT_DOUBLE_EQ(links[0].p_hit, 1);
  const ShareBasis basis = basis_of(sums);
  const ObjectTrace trace = object_trace(sums, 0, basis, links);
  EXPECT_EQ(trace.n_runs_hit, 8);
  EXPECT_EQ(trace.n_hits, 32);
  EXPECT_EQ(trace.n_sources[0], 1);
  EXPECT_EQ(trace.n_sources[1], 2);
  EXPECT_EQ(trace.n_sources[2], 2);
  EXPECT_EQ(trace.first_arrival, 5);
  EXPECT_EQ(trace.method, "recorded");
  EXPECT_DOUBLE_EQ(trace.energy.largest, 4);
  EXPECT_DOUBLE_EQ(trace.deposited_a_run, 4);  // all four came to rest at x = 55
}

// Sixty hits have a p95 where they count alike; where one of them has nearly all the weight they
// are worth one hit. Source cells give the largest value then.
TEST(Trace, FewEffectiveHitsHaveNoP95) {
  const std::vector<RecordObject> objects{area("house", 50, 0, 60, 100)};
  const std::vector<Vec2> sources(60, Vec2(5, 20));
  const RunFile run = run_of(sources, std::vector<std::vector<int>>(60, {0}), objects);
  for (const double weight : {1.0, 1e-6}) {
    std::vector<RunFile> runs{run};
    runs[0].blocks.weight.assign(60, weight);
    runs[0].blocks.weight[7] = 1;
    const TraceSums sums = sums_of(runs, objects);
    const std::vector<SourceLink> links = source_links(sums);
    const ShareBasis basis = share_basis(clusters_of_runs({1 + 59 * weight}, 60));
    const ObjectTrace trace = object_trace(sums, 0, basis, links);
    EXPECT_EQ(std::isnan(trace.energy.p95), weight < 1);
    EXPECT_EQ(std::isnan(trace.top_height_p95), weight < 1);
    EXPECT_EQ(links[0].energy_p95, weight < 1 ? 60 : 57);
  }
}

// A run of weight 1.5 whose three blocks hit, one of 0.5 whose one block does, of four each: by
// hand (1.5 x 3 + 0.5 x 1) / 2 = 2.5 hits a run, 2.5 / 4 of the blocks and of the volume.
TEST(Trace, RunsCountByTheirWeights) {
  const std::vector<RecordObject> objects{area("house", 50, 0, 60, 100)};
  const std::vector<Vec2> sources(4, Vec2(5, 20));
  std::vector<RunFile> runs{run_of(sources, {{0}, {0}, {0}, {}}, objects),
                            run_of(sources, {{}, {}, {}, {0}}, objects)};
  runs[0].run_weight = 1.5;
  runs[1].run_weight = 0.5;
  TraceSums sums = sums_of(runs, objects);
  const ShareBasis basis = share_basis(clusters_of_runs({6, 2}, 4, {}, {1.5, 0.5}));
  ObjectTrace trace = object_trace(sums, 0, basis, source_links(sums));
  EXPECT_DOUBLE_EQ(trace.hits_a_run, 2.5);
  EXPECT_DOUBLE_EQ(trace.weight_share, 0.625);
  EXPECT_DOUBLE_EQ(trace.volume_share, 0.625);
  EXPECT_DOUBLE_EQ(trace.deposited_a_run, 4);
  EXPECT_DOUBLE_EQ(trace.run_share, 1);
  runs[1].object_hits.clear();
  sums = sums_of(runs, objects);
  trace = object_trace(sums, 0, basis, source_links(sums));
  EXPECT_EQ(trace.n_runs_hit, 1);
  EXPECT_DOUBLE_EQ(trace.run_share, 0.75);
}

TEST(Trace, AddsUpToWhatWasReleased) {
  const std::vector<RecordObject> objects{area("a", 50, 0, 60, 50), area("b", 70, 0, 80, 50)};
  const std::vector<Vec2> sources{{5, 5}, {5, 5}, {25, 45}, {25, 45}, {25, 45}};
  const std::vector<std::vector<int>> hit{{0}, {0, 1}, {}, {1}, {}};
  const TraceSums sums = sums_of(std::vector<RunFile>(3, run_of(sources, hit, objects)), objects);
  const std::vector<SourceLink> links = source_links(sums);
  double n_links = 0, n_released = 0, n_none = 0;
  std::vector<double> shares(2, 0);
  for (const SourceLink& link : links) {
    n_links += link.n_hits;
    shares[static_cast<std::size_t>(link.object)] += link.share_of_hits;
  }
  for (const auto& [cell, source] : sums.source) {
    n_released += source.n;
    n_none += source.n_none;
    double of_cell = source.n_none;
    for (const SourceLink& link : links) of_cell += link.source == cell ? link.n_hits : 0;
    EXPECT_GE(of_cell, source.n);
    if (source.n == 9) {  // no block of this cell hits two
      EXPECT_EQ(of_cell, source.n);
    }
  }
  EXPECT_EQ(n_links, static_cast<double>(sums.hits.size()));
  EXPECT_NEAR(shares[0], 1, 1e-12);
  EXPECT_NEAR(shares[1], 1, 1e-12);
  EXPECT_EQ(n_released, 15);
  EXPECT_EQ(n_none, 6);
}

TEST(Trace, CellsOfAnObjectHoldEveryPlaceOnIt) {
  const PassageGrid grid{{0, 100}, 10, 10, 10};
  EXPECT_EQ(cells_of(grid, area("on the lines", 20, 50, 40, 60)).size(), 12u);  // neighbours touch
  EXPECT_EQ(cells_of(grid, area("within", 22, 52, 38, 58)).size(), 2u);
  const RecordObject road{"road", "", {{{{5, 5}, {95, 5}}, false}}, 4};
  EXPECT_EQ(cells_of(grid, road).size(), 10u);
  const RecordObject mast{"mast", "", {{{{55, 55}}, false}}, 5.5};
  EXPECT_EQ(cells_of(grid, mast).size(), 5u);
}

TEST(Trace, ByCellsJoinsTheCellsOfAnObject) {
  const std::vector<RecordObject> objects{area("house", 22, 52, 38, 58)};
  const PassageGrid grid{{0, 100}, 10, 10, 10};
  RunFile run = run_of({{5, 55}, {5, 95}}, {}, {});
  const auto passage = [](int block, int cell, float energy, float time) {
    Passage row;
    row.block = block;
    row.cell = cell;
    row.largest.total_energy = energy;
    row.first_time = time;
    return row;
  };
  // block 0 through both cells of the house (row 4, columns 2 and 3), block 1 beside it
  const std::vector<Passage> passages{passage(0, 42, 3e3F, 4), passage(0, 43, 5e3F, 5),
                                      passage(1, 4, 9e3F, 3)};
  TraceSums sums;
  sums.objects = objects;
  sums.sources = grid;
  add_run(sums, run, 0.05, false);
  CellHits hits;
  add_cell_hits(hits, object_cells(grid, objects), passages, grid);
  add_hits(sums, run, 0, hits, false);
  finish(sums);
  ASSERT_EQ(sums.hits.size(), 1u);
  EXPECT_EQ(sums.hits[0].energy, 5e3);
  EXPECT_EQ(sums.hits[0].time, 4);
  const ObjectTrace trace = object_trace(sums, 0, basis_of(sums), source_links(sums));
  EXPECT_EQ(trace.method, "by_cells");
}
