// History matching: implausibility of each run, and the set of runs that is not contradicted.
#include "post/observed/calibrate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.hpp"

namespace talus {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

// --- one run, one layer --------------------------------------------------------------------------

struct Moments {
  double n = 0;  // Kish's, of weighted values
  double mean = 0, variance = 0, fourth = 0;
};

Moments moments_of(const std::vector<WeightedValue>& values) {
  Moments m;
  double sum = 0, squares = 0;
  for (const WeightedValue& v : values) {
    sum += v.weight;
    squares += v.weight * v.weight;
    m.mean += v.weight * v.value;
  }
  m.n = effective_size(sum, squares);
  if (!(m.n > 0)) return m;
  m.mean /= sum;
  for (const WeightedValue& v : values) {
    const double square = (v.value - m.mean) * (v.value - m.mean);
    m.variance += v.weight * square / sum;
    m.fourth += v.weight * square * square / sum;
  }
  if (m.n > 1) m.variance *= m.n / (m.n - 1);
  return m;
}

double noise(const Moments& seen, const Moments& made) { return 1 / seen.n + 1 / made.n; }

// Values of the run have its variance, whichever of both they are of.
double of_means(const Moments& seen, const Moments& made) {
  return std::abs(seen.mean - made.mean) / std::sqrt(made.variance * noise(seen, made));
}

// The variance of a standard deviation follows from the fourth moment, taken no smaller than that
// of a normal distribution.
double of_deviations(const Moments& seen, const Moments& made) {
  const double square = made.variance * made.variance, fourth = std::max(made.fourth, 3 * square);
  const double variance = (fourth - square) / (4 * made.variance) * noise(seen, made);
  return std::abs(std::sqrt(seen.variance) - std::sqrt(made.variance)) / std::sqrt(variance);
}

void raise(Implausibility& worst, double value, const char* number) {
  if (std::isnan(value) || (!std::isnan(worst.value) && worst.value >= value)) return;
  worst = {value, number};
}

// Those of one run, of blocks or passes that are in the order of runs.
template <class Item>
std::span<const Item> of_run(const std::vector<Item>& items, int run) {
  const auto first = std::lower_bound(items.begin(), items.end(), run,
                                      [](const Item& item, int r) { return item.run < r; });
  const auto last = std::upper_bound(first, items.end(), run,
                                     [](int r, const Item& item) { return r < item.run; });
  return {first, last};
}

Implausibility by_boulders(const ObservedEvent& observed, const Computed& computed, int run) {
  constexpr std::size_t least_for_scatter = 3;
  Implausibility worst{nan_value, ""};
  const RunoutAxis axis = runout_axis(computed, observed.boulders);
  std::vector<WeightedValue> seen_runout, seen_across, runout, across;
  for (const ObservedPoint& boulder : observed.boulders) {
    const AlongAcross at = along_and_across(axis, boulder);
    seen_runout.push_back({at.runout, 1});
    seen_across.push_back({at.across, 1});
  }
  for (const ComputedBlock& block : of_run(computed.blocks, run)) {
    const AlongAcross at = along_and_across(axis, block);
    runout.push_back({at.runout, block.weight});
    across.push_back({at.across, block.weight});
  }
  const Moments seen = moments_of(seen_runout), made = moments_of(runout);
  if (!(made.n > 1) || observed.boulders.empty()) return worst;
  raise(worst, of_means(seen, made), "mean run-out");
  if (observed.boulders.size() < least_for_scatter) return worst;
  raise(worst, of_deviations(seen, made), "scatter of the run-out");
  raise(worst, of_deviations(moments_of(seen_across), moments_of(across)), "scatter across");
  return worst;
}

// Ranks among n + 1 that chance would spread evenly. `left_out`: a scar that does not count; -1:
// none.
Implausibility by_scars(const ObservedEvent& observed, int event, const Computed& computed, int run,
                        int left_out = -1) {
  double sum = 0, variance = 0;
  for (int s = 0; s < static_cast<int>(observed.scars.size()); ++s) {
    const auto& passes =
        computed.passes[static_cast<std::size_t>(event)][static_cast<std::size_t>(s)];
    double n_below = 0, n_ranks = 1;
    for (const ScarPass& pass : of_run(passes, run)) {
      ++n_ranks;
      n_below += pass.height <= observed.scars[static_cast<std::size_t>(s)].size;
    }
    if (n_ranks == 1 || s == left_out) continue;
    sum += (n_below + 0.5) / n_ranks - 0.5;
    variance += (n_ranks * n_ranks - 1) / (12 * n_ranks * n_ranks);
  }
  return {variance > 0 ? std::abs(sum) / std::sqrt(variance) : nan_value, "heights of scars"};
}

// An outline that was drawn around a deposit holds half of it or more.
Implausibility by_outline(const ObservedEvent& observed, const Computed& computed, int run) {
  constexpr double least_share = 0.5;
  double inside = 0, sum = 0, squares = 0;
  for (const ComputedBlock& block : of_run(computed.blocks, run)) {
    if (!block.is_deposited) continue;
    sum += block.weight;
    squares += block.weight * block.weight;
    if (contains(observed.outline, block.end)) inside += block.weight;
  }
  if (!(sum > 0)) return {nan_value, ""};
  const double deviation =
      std::sqrt(least_share * (1 - least_share) / effective_size(sum, squares));
  return {std::max(0.0, least_share - inside / sum) / deviation, "deposit within the outline"};
}

// --- all layers ----------------------------------------------------------------------------------

struct Layer {
  int event = 0;
  ObservedKind kind = ObservedKind::boulders;
};

std::vector<Layer> layers_of(const std::vector<ObservedEvent>& events) {
  std::vector<Layer> layers;
  for (int e = 0; e < static_cast<int>(events.size()); ++e) {
    const ObservedEvent& event = events[static_cast<std::size_t>(e)];
    if (!event.boulders.empty()) layers.push_back({e, ObservedKind::boulders});
    if (!event.scars.empty()) layers.push_back({e, ObservedKind::scars});
    if (!event.outline.rings.empty()) layers.push_back({e, ObservedKind::outline});
  }
  return layers;
}

using OfLayers = std::vector<Implausibility>;  // (n_layers)

// The worst of a run, but for one layer; -1: of all.
int worst_layer(const OfLayers& of_layers, int left_out) {
  int worst = -1;
  for (int l = 0; l < static_cast<int>(of_layers.size()); ++l) {
    if (l == left_out || std::isnan(of_layers[static_cast<std::size_t>(l)].value)) continue;
    if (worst < 0 || of_layers[static_cast<std::size_t>(l)].value >
                         of_layers[static_cast<std::size_t>(worst)].value)
      worst = l;
  }
  return worst;
}

// A run that nothing judges is in no set.
bool is_plausible(const OfLayers& of_layers, int left_out) {
  const int worst = worst_layer(of_layers, left_out);
  return worst >= 0 && of_layers[static_cast<std::size_t>(worst)].value <= most_implausible;
}

struct Calibrator {
  const std::vector<ObservedEvent>& events;
  const Computed& computed;
  int n_runs;
  std::vector<Layer> layers = layers_of(events);
  std::vector<OfLayers> judged = {};  // [run][layer]

  [[nodiscard]] const ObservedEvent& event_of(const Layer& layer) const {
    return events[static_cast<std::size_t>(layer.event)];
  }

  void judge() {
    for (int run = 0; run < n_runs; ++run) {
      judged.emplace_back();
      for (const Layer& layer : layers)
        judged.back().push_back(
            implausibility_of(event_of(layer), layer.event, layer.kind, computed, run));
    }
  }

  [[nodiscard]] LeftOutLayer without_layer(int left_out) const {
    const Layer& layer = layers[static_cast<std::size_t>(left_out)];
    LeftOutLayer out{layer.kind, event_of(layer).name, 0, 0};
    for (const OfLayers& of_layers : judged) {
      if (!is_plausible(of_layers, left_out)) continue;
      ++out.n_plausible;
      out.n_contradicted += of_layers[static_cast<std::size_t>(left_out)].value > most_implausible;
    }
    return out;
  }

  // The share of the blocks of these runs that come no farther than the boulder, or pass no higher
  // than the scar. Runs weigh alike.
  [[nodiscard]] double percentile_of(const Layer& layer, int point,
                                     const std::vector<bool>& of_set) const {
    std::vector<double> below(of_set.size(), 0), all(of_set.size(), 0);
    const auto count = [&](int run, double weight, bool is_below) {
      all[static_cast<std::size_t>(run)] += weight;
      if (is_below) below[static_cast<std::size_t>(run)] += weight;
    };
    const ObservedEvent& event = event_of(layer);
    if (layer.kind == ObservedKind::boulders) {
      const RunoutAxis axis = runout_axis(computed, event.boulders);
      const double runout =
          along_and_across(axis, event.boulders[static_cast<std::size_t>(point)]).runout;
      for (const ComputedBlock& block : computed.blocks)
        count(block.run, block.weight, along_and_across(axis, block).runout <= runout);
    } else {
      const auto s = static_cast<std::size_t>(point);
      for (const ScarPass& pass : computed.passes[static_cast<std::size_t>(layer.event)][s])
        count(pass.run, pass.weight, pass.height <= event.scars[s].size);
    }
    double sum = 0;
    int n = 0;
    for (std::size_t run = 0; run < of_set.size(); ++run)
      if (of_set[run] && all[run] > 0) sum += below[run] / all[run], ++n;
    return n == 0 ? nan_value : sum / n;
  }

  [[nodiscard]] LeftOutPoint without_point(int l, int point) const {
    const Layer& layer = layers[static_cast<std::size_t>(l)];
    const ObservedEvent& event = event_of(layer);
    LeftOutPoint out{layer.kind, event.name, point, 0, nan_value};
    std::vector<bool> of_set;
    for (int run = 0; run < n_runs; ++run) {
      OfLayers of_layers = judged[static_cast<std::size_t>(run)];
      of_layers[static_cast<std::size_t>(l)] = rest_of(layer, point, run);
      of_set.push_back(is_plausible(of_layers, -1));
      out.n_plausible += of_set.back();
    }
    out.percentile = percentile_of(layer, point, of_set);
    return out;
  }

 private:
  [[nodiscard]] Implausibility rest_of(const Layer& layer, int point, int run) const {
    if (layer.kind == ObservedKind::scars)
      return by_scars(event_of(layer), layer.event, computed, run, point);
    ObservedEvent rest;
    rest.boulders = event_of(layer).boulders;
    rest.boulders.erase(rest.boulders.begin() + point);
    return by_boulders(rest, computed, run);
  }
};

}  // namespace

std::string text(ObservedKind kind, const std::string& event) {
  constexpr const char* names[] = {"boulders of ", "scars of ", "outline of "};
  return names[static_cast<int>(kind)] + event;
}

Implausibility implausibility_of(const ObservedEvent& observed, int event, ObservedKind kind,
                                 const Computed& computed, int run) {
  switch (kind) {
    case ObservedKind::boulders:
      return by_boulders(observed, computed, run);
    case ObservedKind::scars:
      return by_scars(observed, event, computed, run);
    default:
      return by_outline(observed, computed, run);
  }
}

int n_plausible(const Calibration& calibration) {
  return static_cast<int>(std::count_if(calibration.runs.begin(), calibration.runs.end(),
                                        [](const JudgedRun& run) { return run.is_plausible(); }));
}

Calibration calibrate(const std::vector<ObservedEvent>& events, const Computed& computed,
                      const std::vector<std::vector<DrawnKey>>& drawn) {
  Calibration out;
  Calibrator calibrator{events, computed, static_cast<int>(drawn.size())};
  calibrator.judge();
  const bool all_drew = std::all_of(drawn.begin(), drawn.end(), [&drawn](const auto& of_run) {
    return of_run.size() == drawn.front().size();
  });
  if (all_drew && !drawn.empty())
    for (const DrawnKey& key : drawn.front())
      if (!is_rock_key(key.key)) out.keys.push_back(key.key);
  for (std::size_t r = 0; r < drawn.size(); ++r) {
    JudgedRun run{static_cast<int>(r), nan_value, "", {}};
    if (const int worst = worst_layer(calibrator.judged[r], -1); worst >= 0) {
      const Layer& layer = calibrator.layers[static_cast<std::size_t>(worst)];
      const Implausibility& of_run = calibrator.judged[r][static_cast<std::size_t>(worst)];
      run.implausibility = of_run.value;
      run.worst = text(layer.kind, calibrator.event_of(layer).name) + ": " + of_run.number;
    }
    for (const DrawnKey& key : drawn[r])
      if (all_drew && !is_rock_key(key.key)) run.drawn.push_back(key.value);
    out.runs.push_back(std::move(run));
  }
  for (int l = 0; l < static_cast<int>(calibrator.layers.size()); ++l) {
    const Layer& layer = calibrator.layers[static_cast<std::size_t>(l)];
    if (calibrator.layers.size() > 1) out.layers.push_back(calibrator.without_layer(l));
    const ObservedEvent& event = calibrator.event_of(layer);
    const std::size_t n = layer.kind == ObservedKind::boulders ? event.boulders.size()
                          : layer.kind == ObservedKind::scars  ? event.scars.size()
                                                               : 0;
    for (int point = 0; n > 1 && point < static_cast<int>(n); ++point)
      out.points.push_back(calibrator.without_point(l, point));
  }
  return out;
}

LeftOutCount left_out_count(const Calibration& calibration) {
  LeftOutCount count;
  for (const LeftOutPoint& point : calibration.points) {
    if (std::isnan(point.percentile)) continue;
    ++count.n;
    count.n_within += point.percentile >= 0.05 && point.percentile <= 0.95;
  }
  return count;
}

DrawnRange drawn_range(const Calibration& calibration, std::size_t key, bool of_set) {
  DrawnRange range{nan_value, nan_value};
  for (const JudgedRun& run : calibration.runs) {
    if (of_set && !run.is_plausible()) continue;
    range.low = std::fmin(range.low, run.drawn[key]);
    range.high = std::fmax(range.high, run.drawn[key]);
  }
  return range;
}

// --- words ---------------------------------------------------------------------------------------

namespace {

std::string runs_of_all(const Calibration& calibration) {
  return std::to_string(n_plausible(calibration)) + " of " +
         counted(std::ssize(calibration.runs), "run");
}

std::string range_text(const DrawnRange& range) {
  return talus::text(range.low, 3) + " to " + talus::text(range.high, 3);
}

}  // namespace

std::string section_text(const Calibration& calibration) {
  if (calibration.keys.empty()) return "# nothing was drawn: give [uncertainty.*]\n";
  if (n_plausible(calibration) == 0) return "# the observations contradict all runs\n";
  std::vector<const JudgedRun*> set;
  for (const JudgedRun& run : calibration.runs)
    if (run.is_plausible()) set.push_back(&run);
  std::stable_sort(set.begin(), set.end(),
                   [](const JudgedRun* a, const JudgedRun* b) { return a->drawn < b->drawn; });
  std::string out = "[uncertainty.calibrated]\nkeys = [";
  for (const std::string& key : calibration.keys)
    out += std::string(out.back() == '[' ? "" : ", ") + "\"" + key + "\"";
  out += "]\ndistribution = \"rows\"\nvalues = [\n";
  for (const JudgedRun* run : set) {
    out += " ";
    for (const double value : run->drawn) out += " " + talus::text(value) + ",";
    out += "\n";
  }
  return out + "]\nsource = \"" + runs_of_all(calibration) +
         " that the observations do not contradict\"\n";
}

std::string text(const Calibration& calibration) {
  std::string out = "the observations do not contradict " + runs_of_all(calibration);
  if (n_plausible(calibration) == 0 && !calibration.runs.empty()) {
    const auto least = std::min_element(
        calibration.runs.begin(), calibration.runs.end(),
        [](const JudgedRun& a, const JudgedRun& b) { return a.implausibility < b.implausibility; });
    return out + "; least, by " + talus::text(least->implausibility, 3) +
           " standard deviations, the " + std::to_string(least->run + 1) + ". run (" +
           least->worst + ")";
  }
  for (std::size_t k = 0; k < calibration.keys.size(); ++k)
    out += "\n" + calibration.keys[k] + ": " + range_text(drawn_range(calibration, k, true)) +
           ", drawn from " + range_text(drawn_range(calibration, k, false));
  if (const LeftOutCount count = left_out_count(calibration); count.n > 0)
    out += "\nleft out one by one, " + std::to_string(count.n_within) + " of " +
           counted(count.n, "point") +
           " lie between the 5th and 95th percentile of the runs that the rest leaves; 90 % are "
           "expected";
  for (const LeftOutLayer& layer : calibration.layers)
    out += "\nleft out, " + text(layer.kind, layer.event) + " contradict " +
           std::to_string(layer.n_contradicted) + " of " + counted(layer.n_plausible, "run") +
           " that the rest leaves";
  return out;
}

}  // namespace talus
