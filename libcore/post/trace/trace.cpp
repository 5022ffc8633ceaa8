// Links from source cells to the objects that their blocks hit: how often and how hard.
#include "post/trace/trace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "base/numbers.hpp"
#include "post/percentile_bounds.hpp"

namespace talus {
namespace {

constexpr double cell_slack = 2e-3;  // a touch is within 1e-3 [m]

std::vector<Vec2> square_of(const PassageGrid& grid, int row, int col) {
  const Vec2 nw = grid.corner + grid.cell_size * Vec2(col, -row);
  const double s = grid.cell_size;
  return {nw, nw + Vec2(0, -s), nw + Vec2(s, -s), nw + Vec2(s, 0)};
}

std::uint32_t source_of(const PassageGrid& grid, const Vec3& rest) {
  const auto index = [](double value, int n) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(value), 0.0, n - 1.0));
  };
  return index((grid.corner.y() - rest.y()) / grid.cell_size, grid.n_rows) *
             static_cast<std::uint32_t>(grid.n_cols) +
         index((rest.x() - grid.corner.x()) / grid.cell_size, grid.n_cols);
}

void complete(TraceHit& hit, const TraceSums& sums, const RunFile& run) {
  const auto b = static_cast<std::size_t>(hit.block);
  hit.source = source_of(sums.sources, run.blocks.rest[b].position);
  hit.weight = weight_of(run, hit.block);
  hit.volume = run.blocks.volume[b];
  hit.run_weight = run.run_weight;
}

bool is_same(const RecordObject& a, const RecordObject& b) {
  if (a.name != b.name || std::abs(a.radius - b.radius) > 1e-9 || a.parts.size() != b.parts.size())
    return false;
  for (std::size_t p = 0; p < a.parts.size(); ++p) {
    if (a.parts[p].is_area != b.parts[p].is_area ||
        a.parts[p].points.size() != b.parts[p].points.size())
      return false;
    for (std::size_t i = 0; i < a.parts[p].points.size(); ++i)
      if ((a.parts[p].points[i] - b.parts[p].points[i]).norm() > 1e-6) return false;
  }
  return true;
}

struct Box {
  Vec2 low, high;
};

// Everything within `slack` of a part of an object.
Box box_of(const ObjectPart& part, double slack) {
  Box box{part.points[0], part.points[0]};
  for (const Vec2& p : part.points) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  box.low -= Vec2::Constant(slack);
  box.high += Vec2::Constant(slack);
  return box;
}

bool holds(const Box& box, const Vec2& p) {
  return (p.array() >= box.low.array()).all() && (p.array() <= box.high.array()).all();
}

// Cells of boxes around the parts of an object, by rows and columns.
template <class Visit>
void for_each_cell_near(const PassageGrid& grid, const RecordObject& object, Visit&& visit) {
  std::set<std::uint32_t> seen;
  for (const ObjectPart& part : object.parts) {
    const auto [low, high] = box_of(part, object.radius + cell_slack);
    const auto bound = [](double value, int n) {
      return static_cast<int>(std::clamp(std::floor(value), 0.0, n - 1.0));
    };
    const double s = grid.cell_size;
    for (int row = bound((grid.corner.y() - high.y()) / s, grid.n_rows);
         row <= bound((grid.corner.y() - low.y()) / s, grid.n_rows); ++row)
      for (int col = bound((low.x() - grid.corner.x()) / s, grid.n_cols);
           col <= bound((high.x() - grid.corner.x()) / s, grid.n_cols); ++col)
        if (seen.insert(static_cast<std::uint32_t>(row * grid.n_cols + col)).second)
          visit(row, col);
  }
}

}  // namespace

std::vector<std::uint32_t> cells_of(const PassageGrid& grid, const RecordObject& object) {
  std::vector<std::uint32_t> cells;
  for_each_cell_near(grid, object, [&](int row, int col) {
    if (gap_to(object, square_of(grid, row, col)) <= cell_slack)
      cells.push_back(static_cast<std::uint32_t>(row * grid.n_cols + col));
  });
  std::sort(cells.begin(), cells.end());
  return cells;
}

int watched_as(const RunFile& run, const RecordObject& object) {
  for (std::size_t o = 0; o < run.objects.size(); ++o)
    if (is_same(run.objects[o], object)) return static_cast<int>(o);
  return -1;
}

std::vector<RecordObject> as_watched(const RunFile& run, const std::vector<RecordObject>& objects) {
  std::vector<RecordObject> out;
  for (const RecordObject& object : objects) {
    const int watched = watched_as(run, object);
    out.push_back(watched < 0 ? object : run.objects[static_cast<std::size_t>(watched)]);
  }
  return out;
}

ObjectCells object_cells(const PassageGrid& grid, const std::vector<RecordObject>& objects) {
  ObjectCells all;
  for (std::size_t o = 0; o < objects.size(); ++o)
    for (const std::uint32_t cell : cells_of(grid, objects[o]))
      all.emplace_back(cell, static_cast<std::int32_t>(o));
  std::sort(all.begin(), all.end());
  return all;
}

void add_cell_hits(CellHits& hits, const ObjectCells& cells, const std::vector<Passage>& passages,
                   const PassageGrid& grid) {
  for (const Passage& row : passages) {
    const auto cell = static_cast<std::uint32_t>(row.cell);
    for (auto on = std::lower_bound(cells.begin(), cells.end(), std::pair{cell, 0});
         on != cells.end() && on->first == cell; ++on) {
      TraceHit hit;
      hit.object = on->second;
      hit.block = row.block;
      hit.time = row.first_time;
      hit.energy = hit.largest_energy = row.largest.total_energy;
      hit.top_height = row.largest.top_height;
      hit.place = grid.corner + grid.cell_size * Vec2(row.cell % grid.n_cols + 0.5,
                                                      -(row.cell / grid.n_cols) - 0.5);
      const auto [at, is_new] = hits.try_emplace({hit.object, hit.block}, hit);
      if (is_new) continue;
      TraceHit& known = at->second;
      if (std::tie(hit.time, hit.place.x(), hit.place.y()) <
          std::tie(known.time, known.place.x(), known.place.y())) {
        known.time = hit.time;
        known.place = hit.place;
      }
      known.energy = known.largest_energy = std::max(known.energy, hit.energy);
      known.top_height = std::fmax(known.top_height, hit.top_height);
    }
  }
}

void add_run(TraceSums& sums, const RunFile& run, double rest_speed, bool by_cells) {
  const auto index = static_cast<std::int32_t>(sums.n_runs);
  sums.n_recorded.resize(sums.objects.size(), 0);
  sums.deposited.resize(sums.objects.size(), 0);
  const std::vector<RecordObject> objects = as_watched(run, sums.objects);
  std::vector<std::pair<Box, std::size_t>> boxes;  // of the parts; an object
  for (std::size_t o = 0; o < objects.size(); ++o)
    for (const ObjectPart& part : objects[o].parts)
      boxes.emplace_back(box_of(part, objects[o].radius), o);
  for (int b = 0; b < n_blocks(run); ++b) {
    const auto i = static_cast<std::size_t>(b);
    TraceSource& source = sums.source[source_of(sums.sources, run.blocks.rest[i].position)];
    const double weight = weight_of(run, b);
    ++source.n;
    source.weight += weight;
    source.volume += run.run_weight * run.blocks.volume[i];
    ++sums.n_released;
    sums.volume_released += run.run_weight * run.blocks.volume[i];
    if (fate_of(run, b, rest_speed) != Fate::deposited) continue;
    const Vec2 end = frame_block(run, n_frames(run.frames) - 1, b).position.head<2>();
    if ((end - run.blocks.rest[i].position.head<2>()).norm() <= 0.1) continue;
    std::size_t last = sums.objects.size();  // an object counts once
    for (const auto& [box, o] : boxes)
      if (o != last && holds(box, end) && gap_to(objects[o], end) <= 0) {
        sums.deposited[o] += run.run_weight * run.blocks.volume[i];
        last = o;
      }
  }
  ++sums.n_runs;
  if (by_cells) return;
  std::vector<std::vector<std::size_t>> asked(run.objects.size());  // for each watched object
  for (std::size_t o = 0; o < sums.objects.size(); ++o)
    if (const int watched = watched_as(run, sums.objects[o]); watched >= 0) {
      ++sums.n_recorded[o];
      asked[static_cast<std::size_t>(watched)].push_back(o);
    }
  for (const ObjectHit& row : run.object_hits)
    for (const std::size_t o : asked[static_cast<std::size_t>(row.object)]) {
      TraceHit hit;
      hit.run = index;
      hit.object = static_cast<std::int32_t>(o);
      hit.block = row.block;
      hit.time = row.time;
      hit.energy = row.total_energy;
      hit.largest_energy = row.largest_total_energy;
      hit.top_height = row.top_height;
      hit.place = row.position.head<2>();
      complete(hit, sums, run);
      sums.hits.push_back(hit);
    }
}

void add_hits(TraceSums& sums, const RunFile& run, int run_index, const CellHits& hits,
              bool by_cells) {
  for (const auto& [key, found] : hits) {
    const auto o = static_cast<std::size_t>(key.first);
    if (!by_cells && watched_as(run, sums.objects[o]) >= 0) continue;
    TraceHit hit = found;
    hit.run = run_index;
    complete(hit, sums, run);
    sums.hits.push_back(hit);
  }
}

void finish(TraceSums& sums) {
  std::sort(sums.hits.begin(), sums.hits.end(), [](const TraceHit& a, const TraceHit& b) {
    return std::tie(a.object, a.run, a.block) < std::tie(b.object, b.run, b.block);
  });
  std::set<std::pair<std::int32_t, std::int32_t>> any;  // run, block
  std::map<std::uint32_t, double> n_any;
  for (const TraceHit& hit : sums.hits)
    if (any.insert({hit.run, hit.block}).second) ++n_any[hit.source];
  for (auto& [cell, source] : sums.source) source.n_none = source.n - n_any[cell];
}

std::span<const TraceHit> hits_of(const TraceSums& sums, int object) {
  return std::ranges::equal_range(sums.hits, object, {}, &TraceHit::object);
}

namespace {

// Of sorted values; NaN: they are too few for it.
double p95_of(const std::vector<WeightedValue>& values) {
  return !values.empty() && is_enough(effective_size(values), 0.95)
             ? weighted_percentile(values, 0.95)
             : no_value;
}

// Of the hits of one object.
TracePercentiles percentiles_of(std::vector<TraceHit> hits, const ShareBasis& basis) {
  TracePercentiles out{no_value, no_value, no_value, no_value};
  if (hits.empty()) return out;
  std::sort(hits.begin(), hits.end(), [](const TraceHit& a, const TraceHit& b) {
    return std::tie(a.energy, a.run, a.block) < std::tie(b.energy, b.run, b.block);
  });
  std::vector<WeightedValue> values;
  std::vector<BlockWeight> blocks;
  for (const TraceHit& hit : hits) {
    values.push_back({hit.energy / 1e3, hit.weight});
    blocks.push_back({hit.run, hit.block, hit.weight});
  }
  PercentileBounds bounds{basis.clusters, 200};
  const BoundPlaces places = upper_bound_places(bounds, blocks);
  out.p50 = weighted_percentile(values, 0.5);
  out.p95 = p95_of(values);
  if (places[place_of_p95] >= 0)
    out.p95_high = values[static_cast<std::size_t>(places[place_of_p95])].value;
  out.largest = values.back().value;
  return out;
}

// Fewest sources with at least a share of the hits; `descending` shares.
int n_behind(const std::vector<double>& descending, double share) {
  double sum = 0;
  int n = 0;
  for (const double part : descending) {
    if (sum >= share - 1e-12) break;
    sum += part;
    ++n;
  }
  return n;
}

}  // namespace

ObjectTrace object_trace(const TraceSums& sums, int object, const ShareBasis& basis,
                         const std::vector<SourceLink>& links) {
  ObjectTrace out;
  const std::span<const TraceHit> hits = hits_of(sums, object);
  std::vector<BlockWeight> blocks;
  std::vector<WeightedValue> heights;
  double weight = 0, volume = 0, hits_weighed = 0;
  out.first_arrival = hits.empty() ? no_value : std::numeric_limits<double>::infinity();
  for (const TraceHit& hit : hits) {
    if (blocks.empty() || blocks.back().run != hit.run) ++out.n_runs_hit;
    blocks.push_back({hit.run, hit.block, hit.weight});
    weight += hit.weight;
    volume += hit.run_weight * hit.volume;
    hits_weighed += hit.run_weight;
    out.first_arrival = std::min(out.first_arrival, hit.time);
    if (!std::isnan(hit.top_height)) heights.push_back({hit.top_height, hit.weight});
  }
  const double n = sums.n_runs;
  out.n_hits = static_cast<int>(hits.size());
  out.run_share = share_of_runs(basis, blocks);
  out.run_share_interval = run_share_interval(basis, blocks);
  out.hits_a_run = hits_weighed / n;
  out.weight_share = std::min(1.0, weight / basis.over.whole);
  out.weight_share_interval = share_interval(basis, blocks, out.weight_share);
  out.volume_share = volume / sums.volume_released;
  out.energy = percentiles_of({hits.begin(), hits.end()}, basis);
  sort_values(heights);
  out.top_height_p95 = p95_of(heights);
  const auto o = static_cast<std::size_t>(object);
  out.deposited_a_run = sums.deposited[o] / n;
  out.method = sums.n_recorded[o] == sums.n_runs ? "recorded"
               : sums.n_recorded[o] == 0         ? "by_cells"
                                                 : "both";
  std::vector<double> shares;
  for (const SourceLink& link : std::ranges::equal_range(links, object, {}, &SourceLink::object))
    shares.push_back(link.share_of_hits);
  out.n_sources = {n_behind(shares, 0.5), n_behind(shares, 0.9), static_cast<int>(shares.size())};
  return out;
}

std::vector<SourceLink> source_links(const TraceSums& sums) {
  std::map<std::pair<std::int32_t, std::uint32_t>, std::vector<const TraceHit*>> by;
  std::vector<double> weight_of_object(sums.objects.size(), 0);
  for (const TraceHit& hit : sums.hits) {
    by[{hit.object, hit.source}].push_back(&hit);
    weight_of_object[static_cast<std::size_t>(hit.object)] += hit.weight;
  }
  std::vector<SourceLink> links;
  for (const auto& [key, hits] : by) {
    SourceLink link;
    link.object = key.first;
    link.source = key.second;
    link.n_hits = static_cast<int>(hits.size());
    double weight = 0;
    std::vector<WeightedValue> energies;
    for (const TraceHit* hit : hits) {
      weight += hit->weight;
      link.place += hit->place / static_cast<double>(hits.size());
      energies.push_back({hit->energy / 1e3, hit->weight});
    }
    link.p_hit = std::min(1.0, weight / sums.source.at(key.second).weight);
    link.share_of_hits = weight / weight_of_object[static_cast<std::size_t>(key.first)];
    sort_values(energies);
    const double p95 = p95_of(energies);
    link.energy_p95 = std::isnan(p95) ? energies.back().value : p95;
    links.push_back(link);
  }
  std::stable_sort(links.begin(), links.end(), [](const SourceLink& a, const SourceLink& b) {
    return a.object != b.object ? a.object < b.object : a.share_of_hits > b.share_of_hits;
  });
  return links;
}

Vec2 place_of_source(const TraceSums& sums, std::uint32_t source) {
  const auto n_cols = static_cast<std::uint32_t>(sums.sources.n_cols);
  return sums.sources.corner +
         sums.sources.cell_size * Vec2(source % n_cols + 0.5, -1.0 * (source / n_cols) - 0.5);
}

}  // namespace talus
