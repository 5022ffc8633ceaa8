// Rates of events at a cell with their bounds, and the energy of a return period.
#include "post/hazard/hazard_rates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "base/error.hpp"
#include "base/numbers.hpp"

namespace talus {
namespace {

void add_rate(Rate& sum, const Rate& more) {
  sum.value += more.value;
  sum.low += more.low;
  sum.high += more.high;
}

Rate share_of_rocks(const HazardRuns& runs, std::span<const BlockWeight> hit) {
  double sum = 0;
  for (const BlockWeight& rock : hit) sum += rock.weight;
  const double share = std::min(1.0, sum / runs.basis.over.whole);
  const Interval interval = share_interval(runs.basis, hit, share);
  Rate rate{share, interval.low, interval.high};
  // Of less than one rock in all nobody saw how rocks scatter.
  if (share > 0 && share * runs.n_rocks < 1)
    rate.high = std::max(rate.high, share_interval(runs.basis, {}, 0).high);
  return rate;
}

void nest_bounds(std::vector<Rate>& rates) {
  for (std::size_t i = 1; i < rates.size(); ++i)
    rates[i].high = std::min(rates[i].high, rates[i - 1].high);
  for (std::size_t i = rates.size() - 1; i > 0; --i)
    rates[i - 1].low = std::max(rates[i - 1].low, rates[i].low);
}

// Whether a count of runs is all that a share of them needs: each weighs 1, and is its own unit.
bool counts_runs(const HazardRuns& runs) {
  return runs.basis.runs.n == runs.n && runs.basis.runs.whole == runs.n &&
         runs.basis.runs.squares == runs.n;
}

// Of a share of the runs of a class.
Rate rate_of_share(const HazardClass& kind, const Rate& share) {
  if (kind.kind == FrequencyKind::of_failure) {
    const auto rate = [&kind](double p) {
      return equivalent_rate(kind.probability * p, kind.years);
    };
    return {rate(share.value), rate(share.low), rate(share.high)};
  }
  return {kind.frequency.value * share.value, kind.frequency.low * share.low,
          kind.frequency.high * share.high};
}

bool comes_within(double rate, double period) { return rate * period >= 1 - rate_rounding; }

bool has_frequency(const HazardClass& kind) {
  return kind.frequency.value > 0 || kind.kind == FrequencyKind::of_failure;
}

void check_run(const HazardClass& kind, const RunMember& run, const RunMember& first) {
  const auto words = [](const RunMember& of) {
    return of.info.independent ? "each block as if it were alone" : "its blocks together";
  };
  const std::string item = "hazard.class." + kind.name;
  if (run.n_released > 1 && run.info.independent != first.info.independent)
    throw InputError({where_of(run), 0, item},
                     std::string("the run moved ") + words(run) + ", " + where_of(first) +
                         " moved " + words(first),
                     "run all of a class with solver.blocks = \"alone\", or none");
  if (has_frequency(kind) && run.info.weights_are_frequencies)
    throw InputError({where_of(run), 0, item},
                     "the blocks of the run have frequencies, and the class has one too: both say "
                     "how often rocks come",
                     two_frequencies_hint);
  if (kind.kind == FrequencyKind::of_weights && !run.info.weights_are_frequencies)
    throw InputError(
        {where_of(run), 0, item},
        "the class has no frequency, and the weights of the run's blocks are not frequencies",
        "give frequency_per_a or frequency_per_m2_a to [rockfall.*] and run "
        "talus-blocks and talus-dda again, or give the class a frequency");
}

}  // namespace

HazardRuns hazard_runs(const HazardClass& kind, std::span<const RunMember> members, int first,
                       double failed_share) {
  const std::span<const RunMember> own = members.subspan(static_cast<std::size_t>(first));
  HazardRuns runs{kind, {}, first, static_cast<int>(own.size())};
  const auto first_of_several =
      std::find_if(own.begin(), own.end(), [](const RunMember& run) { return run.n_released > 1; });
  const RunMember& first_run = first_of_several == own.end() ? own.front() : *first_of_several;
  for (const RunMember& run : own) check_run(kind, run, first_run);
  runs.kind.of_rocks = kind.kind == FrequencyKind::of_weights ||
                       blocks_are_events(first_run.info, first_run.n_released);
  runs.basis = share_basis(clusters_of(own), failed_share);
  for (const RunMember& run : own) runs.n_rocks += runs.kind.of_rocks ? run.n_released : 0;
  if (kind.kind == FrequencyKind::of_weights) {
    const double all = runs.basis.over.whole / runs.n;
    runs.kind.frequency = {all, all, all};
  }
  return runs;
}

Rate share_of(const HazardRuns& runs, int n_hit) {
  const double share = static_cast<double>(n_hit) / runs.n;
  const Interval interval = run_share_interval(runs.basis, share);
  return {share, interval.low, interval.high};
}

Rate share_of(const HazardRuns& runs, std::span<const BlockWeight> hit) {
  if (runs.kind.of_rocks) return share_of_rocks(runs, hit);
  if (counts_runs(runs)) return share_of(runs, static_cast<int>(hit.size()));
  const Interval interval = run_share_interval(runs.basis, hit);
  return {share_of_runs(runs.basis, hit), interval.low, interval.high};
}

Rate rate_of(const HazardRuns& runs, int n_hit) {
  return rate_of_share(runs.kind, share_of(runs, n_hit));
}

Rate rate_of(const HazardRuns& runs, std::span<const BlockWeight> hit) {
  return rate_of_share(runs.kind, share_of(runs, hit));
}

bool adds_up(const HazardRuns& runs) { return runs.kind.kind != FrequencyKind::of_failure; }

std::vector<BlockWeight> rate_amounts(const HazardRuns& runs, std::span<const EventRow> rows,
                                      const std::function<double(float)>& value) {
  const double rate = runs.kind.frequency.value;
  std::vector<BlockWeight> amounts;
  for (const EventRow& row : rows) {  // of one run one behind the other
    double amount = rate * runs.n * value(row.intensity);
    if (runs.kind.of_rocks) {
      amounts.push_back({row.run, row.block, amount * row.weight / runs.basis.over.whole});
      continue;
    }
    amount *= runs.basis.clusters.run_weight[row.run] / runs.basis.runs.whole;
    if (amounts.empty() || amounts.back().run != row.run)
      amounts.push_back({row.run, row.block, amount});
    else
      amounts.back().weight = std::max(amounts.back().weight, amount);
  }
  return amounts;
}

double largest_rate_elsewhere(std::span<const HazardRuns> classes) {
  double sum = 0;
  for (const HazardRuns& runs : classes) sum += rate_of(runs, std::span<const BlockWeight>{}).high;
  return sum;
}

HazardRates::HazardRates(std::span<const HazardRuns> classes)
    : classes_(classes), n_hit_(classes.size()), hit_(classes.size()) {
  for (std::size_t c = 0; c < classes.size(); ++c) {
    costs_all_ = costs_all_ || classes[c].kind.of_rocks || !counts_runs(classes[c]);
    kind_of_run_.resize(static_cast<std::size_t>(classes[c].first + classes[c].n), c);
  }
}

std::size_t HazardRates::kind_of(int run) const {
  return kind_of_run_[static_cast<std::size_t>(run)];
}

// Of events that are runs one row each.
template <class Counts>
void HazardRates::take_rows(std::span<const EventRow> rows, Counts&& counts) {
  for (std::vector<BlockWeight>& hit : hit_) hit.clear();
  std::int32_t last = -1;
  for (const EventRow& row : rows) {
    if (!counts(row)) continue;
    const std::size_t c = kind_of(row.run);
    if (classes_[c].kind.of_rocks || row.run != last)
      hit_[c].push_back({row.run - classes_[c].first, row.block, row.weight});
    last = row.run;
  }
}

template <class Counts>
Rate HazardRates::rate_of_rows(std::span<const EventRow> rows, Counts&& counts) {
  take_rows(rows, counts);
  Rate sum;
  for (std::size_t c = 0; c < classes_.size(); ++c) add_rate(sum, rate_of(classes_[c], hit_[c]));
  return sum;
}

std::vector<Rate> HazardRates::above(std::span<const EventRow> rows,
                                     std::span<const double> breaks) {
  std::vector<Rate> rates{rate_of_rows(rows, [](const EventRow&) { return true; })};
  for (const double limit : breaks)
    rates.push_back(rate_of_rows(rows, [limit](const EventRow& r) { return r.intensity > limit; }));
  nest_bounds(rates);
  return rates;
}

std::vector<Rate> HazardRates::shares_above(std::span<const EventRow> rows,
                                            std::span<const double> breaks, std::size_t kind) {
  std::vector<Rate> shares;
  for (std::size_t i = 0; i <= breaks.size(); ++i) {
    take_rows(rows, [&](const EventRow& row) { return i == 0 || row.intensity > breaks[i - 1]; });
    shares.push_back(share_of(classes_[kind], hit_[kind]));
  }
  nest_bounds(shares);
  return shares;
}

std::vector<double> HazardRates::passages_above(std::span<const EventRow> rows,
                                                std::span<const double> breaks) {
  std::vector<double> sums(breaks.size() + 1, 0);
  for (const EventRow& row : rows) {
    const HazardRuns& runs = classes_[kind_of(row.run)];
    const double all = runs.kind.of_rocks ? runs.basis.over.whole : runs.n;
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (i == 0 || row.intensity > breaks[i - 1])
        sums[i] += runs.kind.frequency.value * row.weight / all;
  }
  return sums;
}

void HazardRates::find_events(std::span<const EventRow> rows) {
  events_.clear();
  std::int32_t last = -1;
  for (const EventRow& row : rows) {  // of one run one behind the other
    const auto c = static_cast<std::int32_t>(kind_of(row.run));
    if (!classes_[static_cast<std::size_t>(c)].kind.of_rocks && row.run == last)
      events_.back().energy = std::max(events_.back().energy, row.energy);
    else
      events_.push_back({row.energy, row.weight, c, row.run, row.block});
    last = row.run;
  }
  std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) {
    return std::tie(b.energy, a.run, a.weight, a.block) <
           std::tie(a.energy, b.run, b.weight, b.block);
  });
}

// Of events with the largest energies, `n_events` of them.
Rate HazardRates::rate_of_first(std::size_t n_events) {
  for (std::vector<BlockWeight>& hit : hit_) hit.clear();
  for (std::size_t i = 0; i < n_events; ++i) {
    const Event& event = events_[i];
    const auto c = static_cast<std::size_t>(event.kind);
    hit_[c].push_back({event.run - classes_[c].first, event.block, event.weight});
  }
  Rate sum;
  for (std::size_t c = 0; c < classes_.size(); ++c) add_rate(sum, rate_of(classes_[c], hit_[c]));
  return sum;
}

std::vector<Rate> HazardRates::energies(std::span<const EventRow> rows,
                                        std::span<const double> periods) {
  find_events(rows);
  std::vector<Rate> out(periods.size(), Rate{no_value, no_value, no_value});
  // So many events in, each rate comes often enough; the energy of the last of them is the answer.
  const auto settle = [&](std::size_t n, const Rate& rate, std::vector<std::array<bool, 3>>& done) {
    const float energy = n == 0 ? std::nanf("") : events_[n - 1].energy;
    for (std::size_t t = 0; t < periods.size(); ++t) {
      const std::array<double, 3> values = {rate.value, rate.low, rate.high};
      const std::array<double*, 3> to = {&out[t].value, &out[t].low, &out[t].high};
      for (std::size_t k = 0; k < 3; ++k)
        if (!done[t][k] && comes_within(values[k], periods[t])) {
          done[t][k] = true;
          *to[k] = energy;
        }
    }
  };
  std::vector<std::array<bool, 3>> done(periods.size(), {false, false, false});
  settle(0, rate_of_first(0), done);
  if (costs_all_) {  // each rate costs all events before it: halve
    for (std::size_t t = 0; t < periods.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        if (done[t][k]) continue;
        const auto often = [&](std::size_t n) {
          const Rate rate = rate_of_first(n);
          return comes_within(k == 0 ? rate.value : k == 1 ? rate.low : rate.high, periods[t]);
        };
        if (events_.empty() || !often(events_.size())) continue;
        std::size_t low = 0, high = events_.size();
        while (high - low > 1) {
          const std::size_t middle = (low + high) / 2;
          (often(middle) ? high : low) = middle;
        }
        (k == 0 ? out[t].value : k == 1 ? out[t].low : out[t].high) = events_[high - 1].energy;
      }
    return out;
  }
  std::vector<Rate> of_class;
  for (const HazardRuns& runs : classes_) of_class.push_back(rate_of(runs, 0));
  std::fill(n_hit_.begin(), n_hit_.end(), 0);
  for (std::size_t i = 0; i < events_.size(); ++i) {
    const auto c = static_cast<std::size_t>(events_[i].kind);
    of_class[c] = rate_of(classes_[c], ++n_hit_[c]);
    Rate sum;
    for (const Rate& rate : of_class) add_rate(sum, rate);
    settle(i + 1, sum, done);
  }
  return out;
}

}  // namespace talus
