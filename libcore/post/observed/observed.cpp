// Observed boulders, scars and outlines beside the computed ones, with a score.
#include "post/observed/observed.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "base/random.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "post/deposit.hpp"
#include "post/moved.hpp"

namespace talus {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr int n_drawn = 500;  // samples drawn again
constexpr double z_95 = 1.959963984540054;

// --- samples -------------------------------------------------------------------------------------

using Values = std::vector<WeightedValue>;

double weight_of(const Values& values) {
  double sum = 0;
  for (const WeightedValue& v : values) sum += v.weight;
  return sum;
}

double mean_of(const Values& values) {
  double sum = 0;
  for (const WeightedValue& v : values) sum += v.weight * v.value;
  return sum / weight_of(values);
}

double deviation_of(const Values& values) {
  const double mean = mean_of(values);
  double sum = 0;
  for (const WeightedValue& v : values) sum += v.weight * (v.value - mean) * (v.value - mean);
  return std::sqrt(sum / weight_of(values));
}

// Values drawn again from a sample, by their weights.
class Drawing {
 public:
  Drawing(const Values& values, Random& random) : values_(values), random_(random) {
    for (const WeightedValue& v : values)
      upto_.push_back((upto_.empty() ? 0 : upto_.back()) + v.weight);
  }
  Values draw(std::size_t n) {
    Values out;
    for (std::size_t i = 0; i < n; ++i) {
      const double at = random_.uniform() * upto_.back();
      const auto place = std::upper_bound(upto_.begin(), upto_.end() - 1, at) - upto_.begin();
      out.push_back({values_[static_cast<std::size_t>(place)].value, 1});
    }
    sort_values(out);
    return out;
  }

 private:
  const Values& values_;
  std::vector<double> upto_;
  Random& random_;
};

// Of a number of the sample, by drawing it again; none of fewer points than bound their median.
Interval bootstrap_interval(const Values& values, const std::function<double(const Values&)>& of) {
  if (static_cast<int>(values.size()) < points_needed(0.5)) return {nan_value, nan_value};
  Random random(1, "observed");
  Drawing drawing(values, random);
  std::vector<double> drawn;
  for (int k = 0; k < n_drawn; ++k) drawn.push_back(of(drawing.draw(values.size())));
  return {percentile(drawn, 0.025), percentile(drawn, 0.975)};
}

Compared compared(const Values& observed, const Values& computed,
                  const std::function<double(const Values&)>& of) {
  return {of(observed), bootstrap_interval(observed, of), of(computed)};
}

// Of the mean of n values that are evenly between 0 and 1.
Interval even_shares(std::size_t n) {
  if (n == 0) return {nan_value, nan_value};
  const double off = std::min(0.5, z_95 / std::sqrt(12.0 * static_cast<double>(n)));
  return {0.5 - off, 0.5 + off};
}

// --- shares over clusters ------------------------------------------------------------------------

// The counted blocks differ from those released: blocks of a mass that stayed, or did not pass.
template <class Counted>
ShareBasis basis_of(const ShareBasis& released, const std::vector<Counted>& counted) {
  Clusters clusters = released.clusters;
  std::fill(clusters.weight.begin(), clusters.weight.end(), 0);
  std::fill(clusters.n_blocks.begin(), clusters.n_blocks.end(), 0);
  for (const Counted& one : counted) {
    const auto c = static_cast<std::size_t>(cluster_of(clusters, one.run, one.block));
    clusters.weight[c] += one.weight;
    ++clusters.n_blocks[c];
  }
  ShareBasis basis = share_basis(std::move(clusters), released.failed_share);
  const auto& n_blocks = basis.clusters.n_blocks;
  basis.over.n =
      static_cast<int>(n_blocks.size() - std::count(n_blocks.begin(), n_blocks.end(), 0));
  basis.bounded = basis.single_blocks || basis.over.n >= least_clusters;
  return basis;
}

// Of those counted the share for which `holds`; `basis`: of these.
template <class Counted, class Test>
ComputedShare share_of(const ShareBasis& basis, const std::vector<Counted>& counted,
                       const Test& holds) {
  std::vector<BlockWeight> part;
  double sum = 0;
  for (const Counted& one : counted)
    if (holds(one)) {
      part.push_back({one.run, one.block, one.weight});
      sum += one.weight;
    }
  ComputedShare out;
  if (!(basis.over.whole > 0)) return out;
  out.share = std::min(1.0, sum / basis.over.whole);
  out.interval = share_interval(basis, part, out.share);
  return out;
}

// --- cells ---------------------------------------------------------------------------------------

// -1: outside of the grid
int cell_at(const PassageGrid& grid, const Vec2& place) {
  if (grid.n_rows == 0) return -1;
  const double col = std::floor((place.x() - grid.corner.x()) / grid.cell_size),
               row = std::floor((grid.corner.y() - place.y()) / grid.cell_size);
  if (!(col >= 0 && col < grid.n_cols && row >= 0 && row < grid.n_rows)) return -1;
  return static_cast<int>(row) * grid.n_cols + static_cast<int>(col);
}

bool is_reached(const Computed& computed, int cell) {
  return cell >= 0 && computed.is_passed[static_cast<std::size_t>(cell)] != 0;
}

Vec2 middle_of(const PassageGrid& grid, int cell) {
  const int row = cell / grid.n_cols, col = cell % grid.n_cols;
  return grid.corner + grid.cell_size * Vec2(col + 0.5, -(row + 0.5));
}

}  // namespace

// --- what was computed ---------------------------------------------------------------------------

void add_blocks(Computed& computed, const RunFile& run, int index, double rest_speed) {
  for (int b = 0; b < n_blocks(run); ++b) {
    const Vec3 start = run.blocks.rest[b].position, end = last_pose(run, b).position;
    if (!run.info.independent && (end - start).norm() <= moved_m) continue;
    const Fate fate = fate_of(run, b, rest_speed);
    computed.blocks.push_back({index, b, talus::weight_of(run, b), start.head<2>(), end.head<2>(),
                               run.blocks.volume[b], fate == Fate::deposited,
                               fate == Fate::left_domain});
  }
}

void add_passages(Computed& computed, const std::vector<ObservedEvent>& events, const RunFile& run,
                  int index, const std::vector<Passage>& passages) {
  computed.grid = run.grid;
  computed.is_passed.resize(static_cast<std::size_t>(run.grid.n_rows) * run.grid.n_cols, 0);
  computed.passes.resize(events.size());
  std::vector<std::vector<int>> cells;  // of each event's scars
  for (std::size_t e = 0; e < events.size(); ++e) {
    computed.passes[e].resize(events[e].scars.size());
    cells.emplace_back();
    for (const ObservedPoint& scar : events[e].scars)
      cells.back().push_back(cell_at(run.grid, scar.place));
  }
  for (const Passage& passage : passages) {
    computed.is_passed[static_cast<std::size_t>(passage.cell)] = 1;
    const double height = passage.largest.centroid_height;
    if (std::isnan(height)) continue;
    for (std::size_t e = 0; e < cells.size(); ++e)
      for (std::size_t s = 0; s < cells[e].size(); ++s)
        if (cells[e][s] == passage.cell)
          computed.passes[e][s].push_back(
              {index, passage.block, talus::weight_of(run, passage.block), height});
  }
}

void finish(Computed& computed) {
  for (auto& of_event : computed.passes)
    for (std::vector<ScarPass>& passes : of_event)
      std::stable_sort(passes.begin(), passes.end(), [](const ScarPass& a, const ScarPass& b) {
        return std::tie(a.run, a.block) < std::tie(b.run, b.block);
      });
  double all = 0, left = 0;
  Vec2 sum = Vec2::Zero();
  for (const ComputedBlock& block : computed.blocks) {
    all += block.weight;
    if (block.has_left) left += block.weight;
    sum += block.weight * block.start;
  }
  if (all > 0) computed.start = sum / all;
  computed.left_share = left / all;
}

// --- along and across ----------------------------------------------------------------------------

RunoutAxis runout_axis(const Computed& computed, std::span<const ObservedPoint> boulders) {
  RunoutAxis axis{!boulders.empty() && has_start(boulders.front()), computed.start, Vec2::UnitX()};
  Vec2 along = Vec2::Zero();
  for (const ObservedPoint& boulder : boulders)
    along += boulder.place - (axis.has_starts ? boulder.start : axis.start);
  if (along.norm() > 0) axis.along = along.normalized();
  return axis;
}

namespace {

AlongAcross displaced(const RunoutAxis& axis, const Vec2& own_start, const Vec2& end) {
  const Vec2 displacement = end - (axis.has_starts ? own_start : axis.start);
  return {displacement.norm(), displacement.dot(Vec2(-axis.along.y(), axis.along.x()))};
}

}  // namespace

AlongAcross along_and_across(const RunoutAxis& axis, const ObservedPoint& boulder) {
  return displaced(axis, boulder.start, boulder.place);
}

AlongAcross along_and_across(const RunoutAxis& axis, const ComputedBlock& block) {
  return displaced(axis, block.start, block.end);
}

double area_between(std::span<const WeightedValue> a, std::span<const WeightedValue> b) {
  double whole_a = 0, whole_b = 0;
  for (const WeightedValue& v : a) whole_a += v.weight;
  for (const WeightedValue& v : b) whole_b += v.weight;
  if (!(whole_a > 0 && whole_b > 0)) return nan_value;
  double area = 0, share_a = 0, share_b = 0, at = 0;
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    const bool is_a = j == b.size() || (i < a.size() && a[i].value <= b[j].value);
    const double next = is_a ? a[i].value : b[j].value;
    if (i + j > 0) area += std::abs(share_a - share_b) * (next - at);
    at = next;
    if (is_a)
      share_a += a[i++].weight / whole_a;
    else
      share_b += b[j++].weight / whole_b;
  }
  return area;
}

// --- scores --------------------------------------------------------------------------------------

int points_needed(double p) {
  for (int n = 1;; ++n)
    if (const RankInterval ranks = rank_interval(n, p); ranks.low > 0 && ranks.high > 0) return n;
}

namespace {

// By order statistics.
Compared compared_level(const Values& observed, const Values& computed, double p) {
  const RankInterval ranks = rank_interval(static_cast<int>(observed.size()), p);
  const auto value = [&observed](int rank) {
    return rank > 0 ? observed[static_cast<std::size_t>(rank - 1)].value : nan_value;
  };
  Interval interval{value(ranks.low), value(ranks.high)};
  if (ranks.low == 0 || ranks.high == 0) interval = {nan_value, nan_value};
  return {weighted_percentile(observed, p), interval, weighted_percentile(computed, p)};
}

// Spread of as many points that are drawn from the computed ones: of a run, which is drawn by its
// weight, where an event is one.
void add_noise(const std::vector<ComputedBlock>& blocks, const std::vector<AlongAcross>& at,
               bool is_event_a_run, const Values& pooled, BoulderScore& score) {
  std::vector<Values> groups;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (groups.empty() || (is_event_a_run && blocks[b].run != blocks[b - 1].run))
      groups.emplace_back();
    groups.back().push_back({at[b].runout, blocks[b].weight});
  }
  Values numbers;  // of the groups
  Random random(1, "computed");
  std::vector<Drawing> drawings;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    numbers.push_back({static_cast<double>(g), weight_of(groups[g])});
    drawings.emplace_back(groups[g], random);
  }
  Drawing of_groups(numbers, random);
  std::vector<double> upto(1, 0);
  for (const WeightedValue& v : pooled) upto.push_back(upto.back() + v.weight);
  const auto share = [&](const WeightedValue& v) {
    const auto above = std::upper_bound(
        pooled.begin(), pooled.end(), v.value,
        [](double value, const WeightedValue& other) { return value < other.value; });
    return upto[static_cast<std::size_t>(above - pooled.begin())] / upto.back();
  };
  std::vector<double> areas, shares;
  for (int k = 0; k < n_drawn; ++k) {
    const auto group = static_cast<std::size_t>(of_groups.draw(1)[0].value);
    const Values drawn = drawings[group].draw(score.rows.size());
    areas.push_back(area_between(drawn, pooled));
    double sum = 0;
    for (const WeightedValue& v : drawn) sum += share(v);
    shares.push_back(sum / static_cast<double>(drawn.size()));
  }
  score.noise = percentile(areas, 0.5);
  score.noise_high = percentile(areas, 0.95);
  score.by_chance = {percentile(shares, 0.025), percentile(shares, 0.975)};
}

BoulderScore score_boulders(const ObservedEvent& event, const Computed& computed,
                            const ShareBasis& released) {
  const ShareBasis basis = basis_of(released, computed.blocks);
  BoulderScore score;
  score.axis = runout_axis(computed, event.boulders);
  Values runout, across, seen_runout, seen_across;
  std::vector<AlongAcross> at;  // of the computed blocks
  for (const ComputedBlock& block : computed.blocks) {
    at.push_back(along_and_across(score.axis, block));
    runout.push_back({at.back().runout, block.weight});
    across.push_back({at.back().across, block.weight});
  }
  int n_reached = 0;
  double sum = 0;
  for (const ObservedPoint& point : event.boulders) {
    BoulderRow row{
        event.name, point,     along_and_across(score.axis, point),
        {},         nan_value, is_reached(computed, cell_at(computed.grid, point.place))};
    row.percentile = share_of(basis, computed.blocks, [&](const ComputedBlock& block) {
      return at[static_cast<std::size_t>(&block - computed.blocks.data())].runout <= row.at.runout;
    });
    if (!std::isnan(point.size))
      row.volume_share = share_of(basis, computed.blocks, [&](const ComputedBlock& block) {
                           return block.volume <= point.size;
                         }).share;
    seen_runout.push_back({row.at.runout, 1});
    seen_across.push_back({row.at.across, 1});
    n_reached += row.is_in_reach;
    sum += row.percentile.share;
    score.rows.push_back(std::move(row));
  }
  for (Values* values : {&runout, &across, &seen_runout, &seen_across}) sort_values(*values);
  const auto n = static_cast<double>(score.rows.size());
  score.mean = compared(seen_runout, runout, mean_of);
  for (std::size_t k = 0; k < observed_levels.size(); ++k)
    score.levels[k] = compared_level(seen_runout, runout, observed_levels[k]);
  score.across = compared(seen_across, across, deviation_of);
  score.area = area_between(seen_runout, runout);
  if (!runout.empty()) add_noise(computed.blocks, at, computed.is_event_a_run, runout, score);
  for (int k = 0; k <= 100; ++k)
    score.computed_percentiles.push_back(weighted_percentile(runout, k / 100.0));
  score.mean_percentile = sum / n;
  score.reached = {n_reached / n, wilson_interval(n_reached / n, n), 1};
  return score;
}

ScarScore score_scars(const ObservedEvent& event, const std::vector<std::vector<ScarPass>>& passes,
                      const ShareBasis& released) {
  ScarScore score;
  double sum = 0;
  for (std::size_t s = 0; s < event.scars.size(); ++s) {
    ScarRow row{event.name, event.scars[s], 0, {}, nan_value, nan_value};
    if (!passes.empty() && !passes[s].empty()) {
      Values heights;
      for (const ScarPass& pass : passes[s]) heights.push_back({pass.height, pass.weight});
      sort_values(heights);
      row.n_passes = static_cast<int>(heights.size());
      row.percentile =
          share_of(basis_of(released, passes[s]), passes[s],
                   [&](const ScarPass& pass) { return pass.height <= row.point.size; });
      row.p50 = weighted_percentile(heights, 0.5);
      row.p95 = weighted_percentile(heights, 0.95);
      sum += row.percentile.share;
      ++score.n_passed;
    }
    score.rows.push_back(std::move(row));
  }
  score.mean_percentile = score.n_passed > 0 ? sum / score.n_passed : nan_value;
  score.by_chance = even_shares(static_cast<std::size_t>(score.n_passed));
  return score;
}

OutlineScore score_outline(const ObservedEvent& event, const Computed& computed,
                           const ShareBasis& released) {
  OutlineScore score;
  std::vector<ComputedBlock> deposited;
  std::copy_if(computed.blocks.begin(), computed.blocks.end(), std::back_inserter(deposited),
               [](const ComputedBlock& block) { return block.is_deposited; });
  score.inside =
      share_of(basis_of(released, deposited), deposited,
               [&](const ComputedBlock& block) { return contains(event.outline, block.end); });
  int n = 0, n_reached = 0;
  for (int cell = 0; cell < static_cast<int>(computed.is_passed.size()); ++cell) {
    if (!contains(event.outline, middle_of(computed.grid, cell))) continue;
    ++n;
    n_reached += is_reached(computed, cell);
  }
  score.reached_share = n > 0 ? static_cast<double>(n_reached) / n : nan_value;
  return score;
}

}  // namespace

EventScore score_of(const ObservedEvent& observed, int event, const Computed& computed,
                    const ShareBasis& basis) {
  EventScore score{observed.name, {}, {}, {}};
  if (!observed.boulders.empty()) score.boulders = score_boulders(observed, computed, basis);
  if (!observed.scars.empty())
    score.scars =
        score_scars(observed,
                    computed.passes.empty() ? std::vector<std::vector<ScarPass>>{}
                                            : computed.passes[static_cast<std::size_t>(event)],
                    basis);
  if (!observed.outline.rings.empty()) score.outline = score_outline(observed, computed, basis);
  return score;
}

// --- words ---------------------------------------------------------------------------------------

namespace {

std::string metres(double value) { return text(value, 3) + " m"; }

std::string interval_text(const Interval& interval, const char* unit) {
  return std::isnan(interval.low)
             ? ""
             : " (" + text(interval.low, 3) + " to " + text(interval.high, 3) + unit + ")";
}

std::string share_text(const ComputedShare& share) {
  return percent(share.share) +
         (std::isnan(share.interval.low)
              ? ""
              : " (" + percent(share.interval.low) + " to " + percent(share.interval.high) + ")");
}

// "their mean percentile is 0.61, of as many by chance 0.364 to 0.636"
std::string percentile_text(double mean, const Interval& by_chance) {
  return "their mean percentile is " + text(mean, 2) + ", by chance " + text(by_chance.low, 2) +
         " to " + text(by_chance.high, 2);
}

}  // namespace

std::string what_they_tell(const BoulderScore& score) {
  const int n = static_cast<int>(score.rows.size()), for_median = points_needed(0.5),
            for_ends = points_needed(observed_levels[0]);
  const std::string points = "n = " + counted(n, "point");
  if (n < for_median)
    return points + " cannot tell the median (" + std::to_string(for_median) +
           " can) nor the 10th and 90th percentiles (" + std::to_string(for_ends) + " can)";
  const std::string median =
      points + " tell the median" + interval_text(score.levels[1].interval, " m, 95 %");
  return n < for_ends
             ? median + ", not the 10th and 90th percentiles (" + std::to_string(for_ends) + " can)"
             : median + " and the 10th and 90th percentiles";
}

std::string text(const EventScore& score) {
  std::string out;
  const auto line = [&](const std::string& words) {
    out += (out.empty() ? "" : "\n") + score.name + ": " + words;
  };
  if (score.boulders) {
    const BoulderScore& b = *score.boulders;
    line("mean run-out " + metres(b.mean.computed) + ", observed " + metres(b.mean.observed) +
         interval_text(b.mean.interval, " m") + "; across " + metres(b.across.computed) +
         ", observed " + metres(b.across.observed) + interval_text(b.across.interval, " m"));
    line("area between the distributions " + metres(b.area) +
         ", of as many points drawn from the " + "computed " + metres(b.noise) + ", at most " +
         metres(b.noise_high) + ": " +
         (b.is_told_apart() ? "the points tell them apart" : "the points do not tell them apart") +
         "; " + percentile_text(b.mean_percentile, b.by_chance));
    line(what_they_tell(b) + "; " + percent(b.reached.observed) +
         " of them lie in the computed reach");
  }
  if (score.scars) {
    const ScarScore& s = *score.scars;
    const auto n = static_cast<std::int64_t>(s.rows.size());
    line("computed blocks pass " + std::to_string(s.n_passed) + " of " + counted(n, "scar") +
         (s.n_passed > 0 ? "; " + percentile_text(s.mean_percentile, s.by_chance) : ""));
  }
  if (score.outline)
    line(share_text(score.outline->inside) + " of the computed deposit lies in the outline, and " +
         "blocks pass over " + percent(score.outline->reached_share) + " of its area");
  return out;
}

}  // namespace talus
