// Statistics across and along a line that was drawn after the runs.
#include "post/profile/line_result.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/numbers.hpp"
#include "post/statistics.hpp"

namespace talus {
namespace {

Envelope envelope_of(std::vector<WeightedValue> values) {
  std::erase_if(values, [](const WeightedValue& v) { return std::isnan(v.value); });
  if (values.empty()) return {no_value, no_value, no_value};
  sort_values(values);
  Envelope out{weighted_percentile(values, 0.5), no_value, values.back().value};
  if (is_enough(effective_size(values), 0.95)) out.p95 = weighted_percentile(values, 0.95);
  return out;
}

Envelope envelope_of(const std::vector<CellValue>& values, double CellValue::*quantity) {
  std::vector<WeightedValue> out;
  out.reserve(values.size());
  for (const CellValue& value : values) out.push_back({value.*quantity, value.weight});
  return envelope_of(std::move(out));
}

// By the runs' weights, of the runs that have passages.
double share_of_runs(const LineSums& sums, const ShareBasis& basis,
                     const std::vector<CellValue>& values) {
  std::set<int> runs;
  for (const CellValue& value : values) runs.insert(value.run);
  double hit = 0, all = 0;
  for (int r = 0; r < n_runs(sums); ++r) {
    if (!sums.has_passages[r]) continue;
    all += basis.clusters.run_weight[r];
    if (runs.count(r) > 0) hit += basis.clusters.run_weight[r];
  }
  return all > 0 ? hit / all : no_value;
}

// The cell under a station; that of the line's part which ends there at the last one.
const LineCell* cell_at(const LineSums& sums, double chainage) {
  const auto after =
      std::upper_bound(sums.cells.begin(), sums.cells.end(), chainage,
                       [](double value, const LineCell& cell) { return value < cell.from; });
  return after == sums.cells.begin() ? nullptr : &*(after - 1);
}

}  // namespace

std::vector<double> bin_limits(double line_length, double length) {
  if (std::isnan(length)) {
    const double least = line_length / 25, power = std::pow(10, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
      length = factor * power;
      if (length >= least) break;
    }
  }
  std::vector<double> limits{0};
  // a rest shorter than a thousandth of a bin is rounding
  for (int i = 1; i * length < line_length - 1e-3 * length; ++i) limits.push_back(i * length);
  limits.push_back(line_length);
  return limits;
}

AcrossSummary across_summary(const LineSums& sums, const ShareBasis& basis, double from,
                             double to) {
  AcrossSummary out;
  out.from = from;
  out.to = to;
  const bool is_last = to >= sums.line.chainage.back();
  std::vector<FenceArrival> arrivals;
  std::vector<BlockWeight> blocks;
  double mass = 0, weight_of_runs = 0, weight = 0;
  out.first_arrival = no_value;
  for (const LineCrossing& crossing : sums.crossings) {
    const FenceArrival& at = crossing.at;
    if (at.chainage < from || (at.chainage >= to && !is_last)) continue;
    arrivals.push_back(at);
    out.n_runs_hit += blocks.empty() || blocks.back().run != at.run;
    blocks.push_back({at.run, at.block, at.weight});
    weight += at.weight;
    mass += crossing.run_weight * crossing.mass;
    weight_of_runs += crossing.run_weight;
    out.first_arrival = std::fmin(out.first_arrival, at.time);
  }
  out.blocks = summarise(arrivals, basis.clusters);
  out.share_of_runs = talus::share_of_runs(basis, blocks);
  out.interval_of_runs = run_share_interval(basis, blocks);
  out.a_run = weight_of_runs / basis.runs.whole;
  out.share_of_blocks = std::min(1.0, weight / basis.over.whole);
  out.interval_of_blocks = blocks.empty() ? interval_of_none_or_all(basis, false)
                                          : share_interval(basis, blocks, out.share_of_blocks);
  out.mass_a_run = mass / basis.runs.whole;
  out.share_of_mass =
      std::min(1.0, mass / std::accumulate(sums.mass.begin(), sums.mass.end(), 0.0));
  return out;
}

std::vector<StationSummary> station_summaries(const LineSums& sums, const ShareBasis& basis) {
  std::vector<StationSummary> out;
  for (std::size_t i = 0; i < sums.line.points.size(); ++i) {
    StationSummary station;
    station.chainage = sums.line.chainage[i];
    station.place = sums.line.points[i];
    static const std::vector<CellValue> nothing;
    const LineCell* cell = cell_at(sums, station.chainage);
    const auto found = cell == nullptr ? sums.values.end() : sums.values.find(cell->cell);
    const std::vector<CellValue>& values = found == sums.values.end() ? nothing : found->second;
    station.n_blocks = static_cast<int>(values.size());
    station.share_of_runs = share_of_runs(sums, basis, values);
    station.energy = envelope_of(values, &CellValue::energy);
    station.speed = envelope_of(values, &CellValue::speed);
    station.top = envelope_of(values, &CellValue::top);
    out.push_back(station);
  }
  return out;
}

EnergyChange energy_change(const LineSums& sums) {
  std::vector<WeightedValue> values;
  for (const LineCrossing& crossing : sums.crossings)
    if (!crossing.by_cells && crossing.at.energy() > 0)
      values.push_back({crossing.energy_change / crossing.at.energy(), 1});
  sort_values(values);
  return {weighted_percentile(values, 0.5), weighted_percentile(values, 0.95)};
}

std::string method_text(const LineSums& sums) {
  if (sums.n_by_cells == 0) return "frames";
  return sums.n_by_frames == 0 ? "cells" : "frames and cells";
}

}  // namespace talus
