// Effect of fences on candidate lines, followed hit by hit through runs without fences.
#include "post/fence_search/screen.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/numbers.hpp"
#include "base/percentile.hpp"
#include "post/fence/fence_result.hpp"

namespace talus {
namespace {

auto order_of(const SearchHit& hit) {
  return std::tuple(hit.arrival.run, hit.arrival.world, hit.arrival.time, hit.block);
}

Vec3 point_at(const Fence& fence, double chainage) {
  const auto after = std::upper_bound(fence.chainage.begin(), fence.chainage.end(), chainage);
  const int field =
      std::clamp(static_cast<int>(after - fence.chainage.begin()) - 1, 0, n_fields(fence) - 1);
  const double s =
      (chainage - fence.chainage[field]) / (fence.chainage[field + 1] - fence.chainage[field]);
  return fence.post[field] + s * (fence.post[field + 1] - fence.post[field]);
}

// The hits of all fences, in the order of run and time.
struct Event {
  const SearchHit* hit = nullptr;
  int fence = 0;
};
std::vector<Event> events_of(const std::vector<SearchLine>& lines,
                             const std::vector<PlacedFence>& fences) {
  std::vector<Event> events;
  for (int f = 0; f < static_cast<int>(fences.size()); ++f) {
    const auto known = static_cast<std::ptrdiff_t>(events.size());
    for (const SearchHit& hit : lines[fences[f].line].hits)
      if (is_on(fences[f], hit.arrival.chainage)) events.push_back({&hit, f});
    std::inplace_merge(
        events.begin(), events.begin() + known, events.end(),
        [](const Event& a, const Event& b) { return order_of(*a.hit) < order_of(*b.hit); });
  }
  return events;
}

// A fence of one run, or for one rock that falls alone.
struct Standing {
  std::vector<double> taken;  // by field [J]
  std::vector<bool> broken;
};

bool stops(Standing& standing, const PlacedFence& fence, const FenceArrival& arrival,
           bool adds_up) {
  if (arrival.top < 0 || arrival.top > fence.height) return false;
  const int field = field_of(fence, arrival.chainage);
  if (standing.broken[field]) return false;
  const double taken = arrival.energy() + (adds_up ? standing.taken[field] : 0.0);
  if (taken > fence.capacity) {
    standing.broken[field] = adds_up;
    return false;
  }
  standing.taken[field] = taken;
  return true;
}

}  // namespace

std::optional<Stretch> shortest_stretch(const std::vector<double>& place,
                                        const std::vector<double>& weight, double needed) {
  std::optional<Stretch> best;
  const double enough = needed * (1 - 1e-9);
  double held = 0;
  std::size_t first = 0;
  for (std::size_t last = 0; last < place.size(); ++last) {
    held += weight[last];
    while (first < last && held - weight[first] >= enough) held -= weight[first++];
    if (held < enough) continue;
    if (!best || place[last] - place[first] < best->to - best->from - 1e-9)
      best = Stretch{place[first], place[last]};
  }
  return best;
}

void sort_hits(SearchLine& line) {
  std::sort(line.hits.begin(), line.hits.end(),
            [](const SearchHit& a, const SearchHit& b) { return order_of(a) < order_of(b); });
}

double weight_on_object(const SearchRuns& runs) {
  double sum = 0;
  for (const BlockOnObject& block : runs.on_object) sum += block.of.weight;
  return sum;
}

int field_of(const PlacedFence& fence, double chainage) {
  const double share = (chainage - fence.from) / (fence.to - fence.from);
  return std::clamp(static_cast<int>(share * fence.n_fields), 0, fence.n_fields - 1);
}

std::optional<PlacedFence> place_fence(const SearchLine& line, int index, const Stretch& stretch,
                                       double spacing, int min_fields, int end_fields) {
  const double whole = length(line.fence), ends = end_fields * spacing;
  double from = stretch.from - ends, to = stretch.to + ends;
  if (from < -1e-9 || to > whole + 1e-9) return {};
  const double lacking = std::max(0.0, min_fields * spacing - (to - from));
  if (to - from + lacking > whole + 1e-9) return {};
  from = std::clamp(from - lacking / 2, 0.0, std::max(0.0, whole - (to - from) - lacking));
  to = from + (stretch.to - stretch.from) + 2 * ends + lacking;
  PlacedFence placed;
  placed.line = index;
  placed.from = from;
  placed.to = to;
  placed.n_fields = std::max(min_fields, static_cast<int>(std::ceil((to - from) / spacing - 1e-9)));
  return placed;
}

Fence fence_on(const SearchLine& line, const PlacedFence& placed) {
  Fence out;
  out.name = line.name;
  out.height = placed.height;
  out.capacity = placed.capacity;
  for (int k = 0; k <= placed.n_fields; ++k) {
    const double at = placed.from + length(placed) * k / placed.n_fields;
    out.post.push_back(point_at(line.fence, at));
    out.chainage.push_back(
        k == 0 ? 0.0 : out.chainage.back() + (out.post[k] - out.post[k - 1]).head<2>().norm());
  }
  return out;
}

ScreenOutcome follow(const SearchRuns& runs, const std::vector<SearchLine>& lines,
                     const std::vector<PlacedFence>& fences, bool adds_up) {
  ScreenOutcome out;
  out.is_stopped.assign(static_cast<std::size_t>(runs.n_blocks), false);
  std::vector<bool> is_kept_off(out.is_stopped.size(), false);  // the object
  std::vector<Standing> standing(fences.size());
  std::vector<std::vector<double>> volumes(
      fences.size(), std::vector<double>(static_cast<std::size_t>(runs.n_runs)));
  double weight = 0;
  int run = -1, world = -1;
  for (const Event& event : events_of(lines, fences)) {
    const FenceArrival& arrival = event.hit->arrival;
    if (arrival.run != run || arrival.world != world) {
      run = arrival.run;
      world = arrival.world;
      for (std::size_t f = 0; f < fences.size(); ++f) {
        standing[f].taken.assign(static_cast<std::size_t>(fences[f].n_fields), 0);
        standing[f].broken.assign(static_cast<std::size_t>(fences[f].n_fields), false);
      }
    }
    if (out.is_stopped[event.hit->block]) continue;
    if (!stops(standing[event.fence], fences[event.fence], arrival, adds_up)) continue;
    out.is_stopped[event.hit->block] = true;
    volumes[event.fence][run] += arrival.volume;
    if (!event.hit->matters) continue;
    weight += arrival.weight;
    is_kept_off[event.hit->block] = true;
  }
  const double all = weight_on_object(runs);
  out.stopped = all > 0 ? std::min(1.0, weight / all) : no_value;
  for (const BlockOnObject& block : runs.on_object)
    if (!is_kept_off[block.block]) out.hit.push_back(block.of);
  for (std::vector<double>& of_fence : volumes) out.retained.push_back(median(std::move(of_fence)));
  return out;
}

FieldLoads field_loads(const SearchLine& line, const PlacedFence& fence, double share,
                       const std::vector<bool>& gone) {
  std::vector<double> single, second, whole;
  std::vector<std::vector<const FenceArrival*>> of_field(static_cast<std::size_t>(fence.n_fields));
  const auto close_run = [&] {
    double largest = 0, in_second = 0, in_run = 0;
    bool any = false;
    for (std::vector<const FenceArrival*>& hits : of_field) {
      double sum = 0, window = 0;
      std::size_t first = 0;
      for (std::size_t last = 0; last < hits.size(); ++last) {
        const double energy = hits[last]->energy();
        largest = std::max(largest, energy);
        sum += energy;
        window += energy;
        while (hits[last]->time - hits[first]->time > 1) window -= hits[first++]->energy();
        in_second = std::max(in_second, window);
      }
      in_run = std::max(in_run, sum);
      any = any || !hits.empty();
      hits.clear();
    }
    if (!any) return;
    single.push_back(largest);
    second.push_back(in_second);
    whole.push_back(in_run);
  };
  int run = -1, world = -1;
  for (const SearchHit& hit : line.hits) {
    if (hit.arrival.run != run || hit.arrival.world != world) close_run();
    run = hit.arrival.run;
    world = hit.arrival.world;
    if (!is_on(fence, hit.arrival.chainage) || (!gone.empty() && gone[hit.block])) continue;
    of_field[field_of(fence, hit.arrival.chainage)].push_back(&hit.arrival);
  }
  close_run();
  if (single.empty()) return {};
  return {percentile(single, share), percentile(second, share), percentile(whole, share)};
}

FenceDemand fence_demand(const SearchRuns& runs, const SearchLine& line, const PlacedFence& fence,
                         const DesignCode& code, const std::vector<bool>& gone) {
  std::vector<FenceArrival> arrivals;
  for (const SearchHit& hit : line.hits)
    if (hit.matters && is_on(fence, hit.arrival.chainage) && (gone.empty() || !gone[hit.block]))
      arrivals.push_back(hit.arrival);
  DesignInput input;
  input.density = runs.density;
  input.mean_block_size = runs.mean_block_size;
  input.block_volume = input.deflection = input.distance_to_object = no_value;
  set_design_block(input, arrivals);
  const FencePartSummary part = summarise(arrivals, runs.basis.clusters);
  Fence as_built;
  as_built.height = 1;
  as_built.capacity = 1;
  const DesignResult result = check_design(code, {}, input, part, as_built);
  return {part.n, result.required_height, result.required_capacity,
          result.n_arrivals > 0 && result.verdict != DesignVerdict::too_few};
}

}  // namespace talus
