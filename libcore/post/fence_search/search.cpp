// Search for fences that protect an object: options, their costs and residual hits.
#include "post/fence_search/search.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace talus {
namespace {

// Shares of the hits that stretches are sought for, beside the one that is asked for.
constexpr std::array front_shares = {0.5, 0.8, 0.9, 1.0};
constexpr std::array first_shares = {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
constexpr int most_first_lines = 12;  // for the first fence of a pair
constexpr int most_proposals = 10;

struct Search {
  const SearchRuns& runs;
  const std::vector<SearchLine>& lines;
  const DesignCode& code;
  const SearchSettings& settings;
  const Trn& trn;
};

double storage_of(const Search& s, const PlacedFence& placed) {
  const SearchLine& line = s.lines[placed.line];
  const Fence fence = fence_on(line, placed);
  double sum = 0;
  for (int f = 0; f < n_fields(fence); ++f)
    sum += storage(fence, f, line.side, s.trn, 50 * fence.height);
  return sum;
}

// The shortest stretch of a line for `share` of all hits on the object, `gone` ones left out: they
// are `before` of it already. Only where end fields still find room on the line.
std::optional<PlacedFence> place_for(const Search& s, int line, double share,
                                     const std::vector<bool>& gone = {}, double before = 0) {
  const double ends = s.settings.end_fields * s.settings.spacing;
  const double last = length(s.lines[line].fence) - ends;
  std::vector<std::pair<double, double>> hits;
  for (const SearchHit& hit : s.lines[line].hits)
    if (hit.matters && hit.arrival.chainage >= ends && hit.arrival.chainage <= last &&
        (gone.empty() || !gone[hit.block]))
      hits.emplace_back(hit.arrival.chainage, hit.arrival.weight);
  std::sort(hits.begin(), hits.end());
  std::vector<double> place, weight;
  for (const auto& [at, w] : hits) {
    place.push_back(at);
    weight.push_back(w);
  }
  const double needed = (share - before) * weight_on_object(s.runs);
  const std::optional<Stretch> stretch = shortest_stretch(place, weight, needed);
  if (!stretch) return {};
  return place_fence(s.lines[line], line, *stretch, s.settings.spacing, s.settings.min_fields,
                     s.settings.end_fields);
}

void fill(FenceOption& option, const SearchRuns& runs, const ScreenOutcome& outcome) {
  option.stopped = outcome.stopped;
  option.hit = outcome.hit;
  option.residual = share_of_runs(runs.basis, outcome.hit);
  option.residual_interval = run_share_interval(runs.basis, outcome.hit);
}

void find_faults(FenceOption& option, const SearchSettings& settings) {
  const auto add = [&](SearchFault fault) {
    if (std::find(option.faults.begin(), option.faults.end(), fault) == option.faults.end())
      option.faults.push_back(fault);
  };
  if (option.stopped < settings.share - 1e-9) add(SearchFault::share);
  for (const OptionPart& part : option.parts) {
    if (part.demand.height > part.placed.height) add(SearchFault::height);
    if (part.demand.capacity > part.placed.capacity || part.loads.second > part.placed.capacity)
      add(SearchFault::energy);
    if (part.retained > part.storage) add(SearchFault::storage);
    if (length(part.placed) > settings.max_length) add(SearchFault::length);
  }
}

// Results for fences that were followed; each demand and load is known.
FenceOption made(const Search& s, std::vector<OptionPart> parts, const ScreenOutcome& outcome) {
  FenceOption option;
  option.parts = std::move(parts);
  for (std::size_t f = 0; f < option.parts.size(); ++f) {
    OptionPart& part = option.parts[f];
    option.length += length(part.placed);
    option.height = std::max(option.height, part.placed.height);
    option.capacity = std::max(option.capacity, part.placed.capacity);
    option.cost += cost_of(part.placed, s.settings);
    part.retained = s.settings.bulking * outcome.retained[f];
  }
  fill(option, s.runs, outcome);
  find_faults(option, s.settings);
  return option;
}

void add_stretch(const Search& s, PlacedFence placed, std::vector<FenceOption>& options) {
  OptionPart part;
  part.demand = fence_demand(s.runs, s.lines[placed.line], placed, s.code);
  part.loads = field_loads(s.lines[placed.line], placed, s.settings.share);
  for (const double height : s.settings.heights) {
    placed.height = height;
    part.storage = storage_of(s, placed);
    for (std::size_t k = 0; k < s.settings.capacities.size(); ++k) {
      placed.kind = static_cast<int>(k);
      placed.capacity = s.settings.capacities[k];
      part.placed = placed;
      options.push_back(made(s, {part}, follow(s.runs, s.lines, {placed})));
    }
  }
}

bool apart(const PlacedFence& a, const PlacedFence& b) {
  return a.line != b.line || a.to <= b.from || b.to <= a.from;
}

// The second fence of a pair, on each line: for the blocks that the first lets through; only where
// both can cost less than `limit`.
void add_seconds(const Search& s, const OptionPart& first, double limit,
                 std::vector<FenceOption>& options) {
  const ScreenOutcome alone = follow(s.runs, s.lines, {first.placed});
  if (!(alone.stopped > 0) || alone.stopped >= s.settings.share) return;
  for (int line = 0; line < static_cast<int>(s.lines.size()); ++line) {
    std::optional<PlacedFence> placed =
        place_for(s, line, s.settings.share, alone.is_stopped, alone.stopped);
    if (!placed || !apart(first.placed, *placed)) continue;
    placed->height = s.settings.heights.front();
    if (cost_of(first.placed, s.settings) + cost_of(*placed, s.settings) >= limit) continue;
    OptionPart second;
    second.demand = fence_demand(s.runs, s.lines[line], *placed, s.code, alone.is_stopped);
    second.loads = field_loads(s.lines[line], *placed, s.settings.share, alone.is_stopped);
    FenceDemand sized = second.demand;
    sized.capacity = std::max(sized.capacity, second.loads.second);
    size_fence(*placed, sized, s.settings);
    second.placed = *placed;
    second.storage = storage_of(s, *placed);
    options.push_back(made(s, {first, second}, follow(s.runs, s.lines, {first.placed, *placed})));
  }
}

// Lines by the cheapest fence on each, of those that stop most.
std::vector<int> first_lines(const std::vector<FenceOption>& singles) {
  std::vector<std::tuple<double, double, int>> order;
  for (const FenceOption& option : singles)
    order.emplace_back(-option.stopped, option.cost, option.parts[0].placed.line);
  std::sort(order.begin(), order.end());
  std::vector<int> lines;
  for (const auto& [stopped, cost, line] : order) {
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    if (lines.size() == most_first_lines) break;
  }
  return lines;
}

void add_pairs(const Search& s, std::vector<FenceOption>& options) {
  double limit = std::numeric_limits<double>::infinity();
  for (const FenceOption& option : options)
    if (option.faults.empty()) limit = std::min(limit, option.cost);
  for (const int line : first_lines(options)) {
    std::set<std::pair<double, double>> seen;
    for (const double share : first_shares) {
      std::optional<PlacedFence> placed = place_for(s, line, share);
      if (!placed || !seen.insert({placed->from, placed->to}).second) continue;
      OptionPart first;
      first.demand = fence_demand(s.runs, s.lines[line], *placed, s.code);
      first.loads = field_loads(s.lines[line], *placed, s.settings.share);
      FenceDemand sized = first.demand;
      sized.capacity = std::max(sized.capacity, first.loads.second);
      size_fence(*placed, sized, s.settings);
      first.placed = *placed;
      first.storage = storage_of(s, *placed);
      add_seconds(s, first, limit, options);
    }
  }
}

bool is_cheaper(const FenceOption& a, const FenceOption& b) {
  if (a.cost != b.cost) return a.cost < b.cost;
  if (a.stopped != b.stopped) return a.stopped > b.stopped;
  if (a.parts.size() != b.parts.size()) return a.parts.size() < b.parts.size();
  for (std::size_t f = 0; f < a.parts.size(); ++f) {
    const PlacedFence &p = a.parts[f].placed, &q = b.parts[f].placed;
    const auto key = [](const PlacedFence& x) {
      return std::tuple(x.line, x.from, x.to, x.height, x.kind);
    };
    if (key(p) != key(q)) return key(p) < key(q);
  }
  return false;
}

bool no_worse(const FenceOption& a, const FenceOption& b) {
  return a.length <= b.length && a.height <= b.height && a.capacity <= b.capacity &&
         a.cost <= b.cost && a.stopped >= b.stopped;
}

std::vector<int> lines_of(const FenceOption& option) {
  std::vector<int> lines;
  for (const OptionPart& part : option.parts) lines.push_back(part.placed.line);
  std::sort(lines.begin(), lines.end());
  return lines;
}

// Fewest faults, then most stopped, then cheapest.
bool is_nearer(const FenceOption& a, const FenceOption& b) {
  if (a.faults.size() != b.faults.size()) return a.faults.size() < b.faults.size();
  if (a.stopped != b.stopped) return a.stopped > b.stopped;
  return is_cheaper(a, b);
}

}  // namespace

double cost_of(const PlacedFence& fence, const SearchSettings& settings) {
  return length(fence) * (settings.prices_per_m[fence.kind] + settings.price_per_m2 * fence.height);
}

const char* text(SearchFault fault) {
  constexpr std::array names = {"share", "height", "energy", "storage", "length"};
  return names[static_cast<std::size_t>(fault)];
}

std::string governs(const FenceOption& option) {
  double largest = -1;
  std::string name;
  const auto look = [&](double use, const char* of) {
    if (!(use > largest)) return;
    largest = use;
    name = of;
  };
  for (const OptionPart& part : option.parts) {
    look(part.demand.height / part.placed.height, "height");
    look(part.demand.capacity / part.placed.capacity, "energy of single blocks");
    look(part.loads.second / part.placed.capacity, "energies within a second");
    look(part.loads.run / part.placed.capacity, "energies of a run");
    if (part.retained > 0) look(part.retained / part.storage, "storage");
  }
  return name;
}

void size_fence(PlacedFence& fence, const FenceDemand& demand, const SearchSettings& settings) {
  fence.height = settings.heights.back();
  for (const double height : settings.heights)
    if (height >= demand.height && height < fence.height) fence.height = height;
  fence.kind = static_cast<int>(settings.capacities.size()) - 1;
  for (int k = fence.kind; k >= 0; --k)
    if (settings.capacities[k] >= demand.capacity) fence.kind = k;
  fence.capacity = settings.capacities[fence.kind];
}

FenceOption option_of(const SearchRuns& runs, const std::vector<SearchLine>& lines,
                      const std::vector<PlacedFence>& fences, const DesignCode& code,
                      const SearchSettings& settings, const Trn& trn) {
  const Search s{runs, lines, code, settings, trn};
  std::vector<OptionPart> parts;
  for (const PlacedFence& placed : fences) {
    OptionPart part;
    part.placed = placed;
    part.demand = fence_demand(runs, lines[placed.line], placed, code);
    part.loads = field_loads(lines[placed.line], placed, settings.share);
    part.storage = storage_of(s, placed);
    parts.push_back(part);
  }
  return made(s, std::move(parts), follow(runs, lines, fences));
}

FenceOption cheapest_on(const SearchRuns& runs, const std::vector<SearchLine>& lines,
                        const PlacedFence& place, const DesignCode& code,
                        const SearchSettings& settings, const Trn& trn) {
  const Search s{runs, lines, code, settings, trn};
  OptionPart part;
  part.demand = fence_demand(runs, lines[place.line], place, code);
  part.loads = field_loads(lines[place.line], place, settings.share);
  std::vector<PlacedFence> sizes;
  PlacedFence sized = place;
  for (const double height : settings.heights)
    for (std::size_t k = 0; k < settings.capacities.size(); ++k) {
      sized.height = height;
      sized.kind = static_cast<int>(k);
      sized.capacity = settings.capacities[k];
      if (height >= part.demand.height &&
          sized.capacity >= std::max(part.demand.capacity, part.loads.second))
        sizes.push_back(sized);
    }
  std::stable_sort(sizes.begin(), sizes.end(), [&](const PlacedFence& a, const PlacedFence& b) {
    return cost_of(a, settings) < cost_of(b, settings);
  });
  sized.height = settings.heights.back();
  sizes.push_back(sized);  // the largest of all, where none does
  FenceOption option;
  for (const PlacedFence& size : sizes) {
    part.placed = size;
    part.storage = storage_of(s, size);
    option = made(s, {part}, follow(runs, lines, {size}));
    if (option.faults.empty()) break;
  }
  return option;
}

bool beats(const FenceOption& a, const FenceOption& b) {
  return no_worse(a, b) && (a.length < b.length || a.height < b.height || a.capacity < b.capacity ||
                            a.cost < b.cost || a.stopped > b.stopped);
}

FenceSearchResult search_fences(const SearchRuns& runs, const std::vector<SearchLine>& lines,
                                const DesignCode& code, const SearchSettings& settings,
                                const Trn& trn) {
  FenceSearchResult out;
  if (!(weight_on_object(runs) > 0)) return out;
  const Search s{runs, lines, code, settings, trn};
  std::vector<FenceOption> options;
  for (int line = 0; line < static_cast<int>(lines.size()); ++line) {
    std::set<std::pair<double, double>> seen;
    const auto add = [&](double share) {
      const std::optional<PlacedFence> placed = place_for(s, line, share);
      if (placed && seen.insert({placed->from, placed->to}).second)
        add_stretch(s, *placed, options);
    };
    add(settings.share);
    for (const double share : front_shares) add(share);
  }
  if (settings.two_fences) add_pairs(s, options);
  out.n_options = static_cast<int>(options.size());
  std::sort(options.begin(), options.end(), is_cheaper);
  for (const FenceOption& option : options) {
    if (option.parts.size() > 0 && (out.nearest.parts.empty() || is_nearer(option, out.nearest)))
      out.nearest = option;
    const bool is_beaten =
        std::any_of(out.front.begin(), out.front.end(),
                    [&](const FenceOption& other) { return no_worse(other, option); });
    if (!is_beaten) out.front.push_back(option);
    if (!option.faults.empty() || out.proposals.size() == most_proposals) continue;
    const bool is_known =
        std::any_of(out.proposals.begin(), out.proposals.end(),
                    [&](const FenceOption& other) { return lines_of(other) == lines_of(option); });
    if (!is_known) out.proposals.push_back(option);
  }
  const std::vector<FenceOption> all = out.front;  // of equal cost a later one may beat
  std::erase_if(out.front, [&](const FenceOption& option) {
    return std::any_of(all.begin(), all.end(),
                       [&](const FenceOption& other) { return beats(other, option); });
  });
  return out;
}

std::vector<FenceOption> cost_curve(const std::vector<FenceOption>& front) {
  std::vector<FenceOption> out;
  for (const FenceOption& option : front)
    if (out.empty() || option.stopped > out.back().stopped + 1e-12) out.push_back(option);
  return out;
}

bool shares_agree(double a, const Interval& of_a, double b, const Interval& of_b) {
  const double difference = a - b;
  const double below = std::hypot(a - of_a.low, of_b.high - b);
  const double above = std::hypot(of_a.high - a, b - of_b.low);
  return difference - below <= 0 && difference + above >= 0;
}

}  // namespace talus
