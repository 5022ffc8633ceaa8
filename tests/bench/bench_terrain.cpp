// tests/bench/bench_terrain.cpp
// Cost of the terrain: lookups on the paper's two grids (2,240 and 516,652 triangles), setting
// up the large one, candidate cells, traversal, and gridding a TIN of a million points.
#include <benchmark/benchmark.h>

#include <cmath>

#include "base/random.hpp"
#include "terrain/grid_tin.hpp"
#include "terrain/trn_flags.hpp"
#include "terrain/trn_pyramid.hpp"
#include "terrain/trn_walk.hpp"

namespace {

using talus::Trn;
using talus::Vec2;
using talus::Vec3;

double height(double x, double y) {
  return 0.6 * x + 20 * std::sin(0.011 * x) * std::cos(0.017 * y) + std::sin(0.31 * x + 0.23 * y);
}

Trn rough_trn(int n_rows, int n_cols) {
  Trn trn;
  trn.n_rows = n_rows;
  trn.n_cols = n_cols;
  trn.cell_size = 5;
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_cols; ++c) trn.elevation.push_back(height(5 * c, -5 * r));
  return trn;
}

Trn trn_with(std::int64_t n_triangles) {
  return n_triangles == 2'240 ? rough_trn(29, 41) : rough_trn(455, 570);
}

// Points over a square of `side` cells about the middle of the grid: the vertices of a rock mass.
std::vector<Vec2> points_about_the_middle(const Trn& trn, double side) {
  talus::Random random(1, "points");
  const Vec2 middle(0.5 * (trn.n_cols - 1) * trn.cell_size,
                    -0.5 * (trn.n_rows - 1) * trn.cell_size);
  std::vector<Vec2> points;
  for (int i = 0; i < 4096; ++i)
    points.push_back(middle + trn.cell_size * Vec2(random.uniform(-side / 2, side / 2),
                                                   random.uniform(-side / 2, side / 2)));
  return points;
}

void plane_at_a_point(benchmark::State& state) {
  const Trn trn = trn_with(state.range(0));
  const std::vector<Vec2> points = points_about_the_middle(trn, 20);
  for (auto _ : state)
    for (const Vec2& p : points) {
      const talus::TrianglePlane plane =
          talus::triangle_plane(trn, talus::triangle_at(trn, p.x(), p.y()));
      benchmark::DoNotOptimize(plane.normal.dot(Vec3(p.x(), p.y(), 0) - plane.point));
    }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
}
BENCHMARK(plane_at_a_point)->Arg(2'240)->Arg(516'652);

void elevation_at_a_point(benchmark::State& state) {
  const Trn trn = trn_with(state.range(0));
  const std::vector<Vec2> points = points_about_the_middle(trn, 20);
  for (auto _ : state)
    for (const Vec2& p : points) benchmark::DoNotOptimize(talus::elevation_at(trn, p.x(), p.y()));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
}
BENCHMARK(elevation_at_a_point)->Arg(2'240)->Arg(516'652);

void candidate_cells(benchmark::State& state) {
  const Trn trn = trn_with(state.range(0));
  const talus::TrnPyramid pyramid = talus::build_pyramid(trn);
  const std::vector<Vec2> points = points_about_the_middle(trn, 20);
  for (auto _ : state)
    for (const Vec2& p : points) {
      const Vec3 low(p.x(), p.y(), height(p.x(), p.y()));
      benchmark::DoNotOptimize(
          talus::find_near_cells(trn, pyramid, low, low + Vec3(5, 5, 5), 0.1).ground.high);
    }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
}
BENCHMARK(candidate_cells)->Arg(2'240)->Arg(516'652);

void cells_of_a_segment(benchmark::State& state) {
  const Trn trn = trn_with(state.range(0));
  const std::vector<Vec2> points = points_about_the_middle(trn, 20);
  std::int64_t n_cells = 0;
  for (auto _ : state)
    for (std::size_t i = 1; i < points.size(); ++i)
      talus::walk_cells(trn, points[i - 1], points[i], [&](const talus::CellPart& part) {
        benchmark::DoNotOptimize(part.t_out);
        ++n_cells;
      });
  state.SetItemsProcessed(n_cells);
}
BENCHMARK(cells_of_a_segment)->Arg(2'240)->Arg(516'652);

void set_up(benchmark::State& state) {
  const Trn trn = trn_with(516'652);
  std::size_t bytes = trn.elevation.size() * sizeof(double);
  for (auto _ : state) {
    const std::vector<std::uint8_t> flags = talus::ground_flags(trn);
    const talus::TrnPyramid pyramid = talus::build_pyramid(trn);
    bytes = trn.elevation.size() * sizeof(double) + flags.size();
    for (const auto& level : pyramid.levels)
      bytes += level.tiles.size() * sizeof(talus::ElevationRange);
    benchmark::DoNotOptimize(flags.data());
  }
  state.counters["MB"] = static_cast<double>(bytes) / 1e6;
}
BENCHMARK(set_up)->Unit(benchmark::kMillisecond);

// A lattice of moved points, a million of them, 2 million triangles, 9 million nodes.
talus::Tin large_tin() {
  talus::Random random(2, "tin");
  constexpr int n = 1000;
  talus::Tin tin;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double x = 15 * (c + random.uniform(-0.24, 0.24));
      const double y = 15 * (r + random.uniform(-0.24, 0.24));
      tin.points.emplace_back(x, y, height(x, y));
    }
  for (int r = 0; r + 1 < n; ++r)
    for (int c = 0; c + 1 < n; ++c) {
      const int sw = r * n + c;
      tin.triangles.push_back({sw, sw + 1, sw + n + 1});
      tin.triangles.push_back({sw, sw + n + 1, sw + n});
    }
  return tin;
}

void nine_million_nodes_from_a_tin(benchmark::State& state) {
  const talus::Tin tin = large_tin();
  const talus::GridFrame frame = talus::frame_inside({0, 0, 14'999, 14'999}, 5);
  for (auto _ : state) benchmark::DoNotOptimize(talus::grid_tin(tin, frame).data());
  state.counters["nodes"] = static_cast<double>(frame.n_rows) * frame.n_cols;
}
BENCHMARK(nine_million_nodes_from_a_tin)->Unit(benchmark::kMillisecond);

}  // namespace
