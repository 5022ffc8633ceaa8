// Outputs of talus-fence-search: sections of a site file, JSON, layers, a chart.
#include "tools/fence-search/output.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/grouped_text.hpp"
#include "base/numbers.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "draw/chart.hpp"
#include "io/style.hpp"

namespace talus {
namespace {

std::string bounded(double share, const Interval& interval) {
  if (std::isnan(interval.high)) return percent(share);
  return percent(share) + " (" + percent(interval.low) + " to " + percent(interval.high) + ")";
}

// Events a year with a block on the object, in these runs by the weight of such blocks; NaN where
// no frequencies are known.
Rate rate_of_runs(const SearchCase& search, const std::vector<BlockWeight>& hit) {
  if (search.classes.empty()) return {no_value, no_value, no_value};
  std::vector<EventRow> rows;
  for (const BlockWeight& of : hit) rows.push_back({0, of.run, of.block, 1, 0, of.weight});
  sort_events(rows);
  HazardRates rates(search.classes);
  return rates.above(rows, {})[0];
}

std::vector<BlockWeight> hit_now(const SearchRuns& runs) {
  std::vector<BlockWeight> out;
  for (const BlockOnObject& block : runs.on_object) out.push_back(block.of);
  return out;
}
int n_runs_of(const std::vector<BlockWeight>& blocks) {
  std::set<int> runs;
  for (const BlockWeight& block : blocks) runs.insert(block.run);
  return static_cast<int>(runs.size());
}
// Share of the hits, by their weight, that reach the object behind a built fence.
double let_through(const VerifiedFence& verified, const SearchRuns& runs) {
  return verified.weight_a_run * runs.n_runs / weight_on_object(runs);
}

// "60 m long, 4 m high, 500 kJ"; of two both.
std::string size_text(const FenceOption& option) {
  std::string out;
  for (const OptionPart& part : option.parts)
    out += (out.empty() ? "" : " and ") + text(length(part.placed), 3) + " m long, " +
           text(part.placed.height) + " m high, " + grouped_text(part.placed.capacity / 1e3) +
           " kJ";
  return out;
}

std::string faults_text(const FenceOption& option) {
  std::string out;
  for (const SearchFault fault : option.faults)
    out += (out.empty() ? "" : ", ") + std::string(text(fault));
  return out;
}

// Demands that the nearest option does not meet, with numbers.
std::string lacking(const SearchCase& search, const FenceOption& option) {
  std::string out;
  const auto add = [&](const std::string& words) { out += (out.empty() ? "" : "; ") + words; };
  for (const SearchFault fault : option.faults) {
    if (fault == SearchFault::share)
      add("it stops " + percent(option.stopped) + " of the hits, asked for are " +
          percent(search.what.share));
    for (const OptionPart& part : option.parts) {
      if (fault == SearchFault::height && part.demand.height > part.placed.height)
        add("it needs a height of " + needed_text(part.demand.height) + " m, the highest is " +
            text(search.what.heights.back()) + " m");
      const double energy = std::max(part.demand.capacity, part.loads.second);
      if (fault == SearchFault::energy && energy > part.placed.capacity)
        add("it needs " + needed_text(energy / 1e3) + " kJ, the strongest class takes " +
            grouped_text(search.what.capacities.back() / 1e3) + " kJ");
      if (fault == SearchFault::storage && part.retained > part.storage)
        add("half of the runs bring it more than " + grouped_text(part.retained) +
            " m3, it has room for " + grouped_text(part.storage) + " m3");
      if (fault == SearchFault::length && length(part.placed) > search.what.max_length)
        add("it is " + text(length(part.placed), 3) + " m long, the longest allowed " +
            text(search.what.max_length) + " m");
    }
  }
  return out;
}

Json interval_json(const Interval& interval) {
  return {number_or_null(interval.low), number_or_null(interval.high)};
}

Json line_json(const Fence& fence, const Vec3& origin) {
  Json points = Json::array();
  for (const Vec3& post : fence.post) {
    const Vec3 at = post + origin;
    points.push_back({std::round(at.x() * 1e3) / 1e3, std::round(at.y() * 1e3) / 1e3,
                      std::round(at.z() * 1e2) / 1e2});
  }
  return points;
}

Json part_json(const SearchCase& search, const OptionPart& part) {
  return {{"line", part.placed.line >= 0 ? Json(search.lines[part.placed.line].name) : Json()},
          {"from_m", part.placed.from},
          {"to_m", part.placed.to},
          {"fields", part.placed.n_fields},
          {"height_m", part.placed.height},
          {"capacity_kj", part.placed.capacity / 1e3},
          {"needed_height_m", number_or_null(part.demand.height)},
          {"needed_capacity_kj", number_or_null(part.demand.capacity / 1e3)},
          {"design_hits", part.demand.n},
          {"enough_hits_for_the_code", part.demand.is_bounded},
          {"field_energy_single_kj", part.loads.single / 1e3},
          {"field_energy_one_second_kj", part.loads.second / 1e3},
          {"field_energy_run_kj", part.loads.run / 1e3},
          {"retained_m3_p50", part.retained},
          {"storage_m3", part.storage}};
}

Json option_json(const SearchCase& search, const FenceOption& option) {
  Json parts = Json::array();
  for (const OptionPart& part : option.parts) parts.push_back(part_json(search, part));
  const Rate rate = rate_of_runs(search, option.hit);
  Json faults = Json::array();
  for (const SearchFault fault : option.faults) faults.push_back(text(fault));
  Json json = {{"length_m", option.length},
               {"height_m", option.height},
               {"capacity_kj", option.capacity / 1e3},
               {"cost", option.cost},
               {"stopped_share", number_or_null(option.stopped)},
               {"residual_run_share", option.residual},
               {"residual_interval", interval_json(option.residual_interval)},
               {"governs", governs(option)},
               {"lacks", faults},
               {"fences", parts}};
  if (!std::isnan(rate.value))
    json["residual_per_a"] = {number_or_null(rate.value), number_or_null(rate.low),
                              number_or_null(rate.high)};
  return json;
}

Json proposal_json(const SearchCase& search, const Proposal& proposal, const Vec3& origin) {
  Json json = option_json(search, proposal.option);
  json["name"] = proposal.name;
  json["moves"] = proposal.n_moves;
  Json lines = Json::array();
  for (const Fence& fence : proposal.fences)
    lines.push_back({{"name", fence.name}, {"posts", line_json(fence, origin)}});
  json["lines"] = lines;
  json["verified"] = Json();
  if (const auto& verified = proposal.verified)
    json["verified"] = {{"n_runs", verified->n_runs},
                        {"residual_run_share", verified->residual},
                        {"residual_interval", interval_json(verified->interval)},
                        {"hits_a_run", verified->hits_a_run},
                        {"stopped_share", number_or_null(1 - let_through(*verified, search.runs))},
                        {"comparison", comparison_of(proposal)}};
  return json;
}

using Value = FieldValue;
constexpr FieldType words = FieldType::text, whole = FieldType::integer;

VectorFeature line_of(const Fence& fence, const Vec3& origin) {
  VectorFeature f;
  for (const Vec3& post : fence.post) f.points.push_back(post + origin);
  f.measure = fence.chainage;
  return f;
}

struct OptionRow {
  const SearchCase& search;
  const std::string& name;
  const FenceOption& option;
  const Proposal* proposal;  // null: of the front

  [[nodiscard]] Value verified(double (*get)(const VerifiedFence&)) const {
    return proposal == nullptr || !proposal->verified ? Value() : Value(get(*proposal->verified));
  }
};
const std::vector<Field<OptionRow>>& option_fields() {
  using Row = const OptionRow&;
  using Verified = const VerifiedFence&;
  static const std::vector<Field<OptionRow>> fields = {
      {"search", "", "Search", [](Row r) -> Value { return r.search.settings->name; }, words},
      {"name", "", "Name", [](Row r) -> Value { return r.name; }, words},
      {"length_m", "m", "Length", [](Row r) -> Value { return r.option.length; }},
      {"height_m", "m", "Height", [](Row r) -> Value { return r.option.height; }},
      {"capacity_kj", "kJ", "Capacity", [](Row r) -> Value { return r.option.capacity / 1e3; }},
      {"cost", "", "Cost", [](Row r) -> Value { return r.option.cost; }},
      {"stopped_share", "", "Share of the hits that it stops",
       [](Row r) -> Value { return r.option.stopped; }},
      {"residual", "", "Share of runs that still hit",
       [](Row r) -> Value { return r.option.residual; }},
      {"residual_lo", "", "Share of runs that still hit, lower bound",
       [](Row r) -> Value { return r.option.residual_interval.low; }},
      {"residual_hi", "", "Share of runs that still hit, upper bound",
       [](Row r) -> Value { return r.option.residual_interval.high; }},
      {"verified", "", "Share of other runs that still hit",
       [](Row r) { return r.verified([](Verified v) { return v.residual; }); }},
      {"verified_lo", "", "Share of other runs that still hit, lower bound",
       [](Row r) { return r.verified([](Verified v) { return v.interval.low; }); }},
      {"verified_hi", "", "Share of other runs that still hit, upper bound",
       [](Row r) { return r.verified([](Verified v) { return v.interval.high; }); }},
      {"comparison", "", "Compared with what was predicted",
       [](Row r) -> Value { return r.proposal == nullptr ? "" : comparison_of(*r.proposal); },
       words},
      {"lacks", "", "What it lacks", [](Row r) -> Value { return faults_text(r.option); }, words},
      {"governs", "", "What governs", [](Row r) -> Value { return governs(r.option); }, words}};
  return fields;
}

struct CandidateRow {
  const SearchCase& search;
  const SearchLine& line;
};
const std::vector<Field<CandidateRow>>& candidate_fields() {
  using Row = const CandidateRow&;
  static const std::vector<Field<CandidateRow>> fields = {
      {"search", "", "Search", [](Row r) -> Value { return r.search.settings->name; }, words},
      {"line", "", "Line", [](Row r) -> Value { return r.line.name; }, words},
      {"length_m", "m", "Length", [](Row r) -> Value { return length(r.line.fence); }},
      {"n_crossings", "", "Number of crossings",
       [](Row r) -> Value { return static_cast<std::int64_t>(r.line.hits.size()); }, whole},
      {"n_on_the_object", "", "Number on the object",
       [](Row r) -> Value {
         return std::count_if(r.line.hits.begin(), r.line.hits.end(),
                              [](const SearchHit& hit) { return hit.matters; });
       },
       whole}};
  return fields;
}

struct PostRow {
  const Fence& fence;
  std::size_t post;
};
const std::vector<Field<PostRow>>& post_fields() {
  using Row = const PostRow&;
  static const std::vector<Field<PostRow>> fields = {
      {"fence", "", "Fence", [](Row r) -> Value { return r.fence.name; }, words},
      {"post", "", "Post", [](Row r) -> Value { return static_cast<std::int64_t>(r.post); },
       whole}};
  return fields;
}

void add_candidates(VectorLayer& layer, const SearchCase& search, const Vec3& origin) {
  for (const SearchLine& line : search.lines) {
    VectorFeature f = line_of(line.fence, origin);
    f.values = values_of(candidate_fields(), {search, line});
    layer.features.push_back(std::move(f));
  }
}

ChartSeries points(const std::string& name, const char* colour, double marker) {
  return {name, colour, {}, {}, 0, marker};
}

}  // namespace

std::string comparison_of(const Proposal& proposal) {
  if (!proposal.verified || std::isnan(proposal.verified->interval.high) ||
      std::isnan(proposal.option.residual_interval.high))
    return "";
  const VerifiedFence& verified = *proposal.verified;
  const FenceOption& predicted = proposal.option;
  if (shares_agree(predicted.residual, predicted.residual_interval, verified.residual,
                   verified.interval))
    return "as predicted";
  return verified.residual < predicted.residual ? "better than predicted" : "worse than predicted";
}

std::string proposal_toml(const Proposal& proposal, const Vec3& origin) {
  std::string out = "# A proposal of talus-fence-search: " + size_text(proposal.option) +
                    ".\n# Put it into the site file, or give it to talus-dda with --add.\n";
  for (const Fence& fence : proposal.fences) {
    std::string line;
    double longest = 0;
    for (std::size_t i = 0; i < fence.post.size(); ++i) {
      const Vec3 at = fence.post[i] + origin;
      const auto coordinate = [](double value) { return text(std::round(value * 1e3) / 1e3); };
      line += (i > 0 ? ", [" : "[") + coordinate(at.x()) + ", " + coordinate(at.y()) + "]";
      if (i > 0) longest = std::max(longest, fence.chainage[i] - fence.chainage[i - 1]);
    }
    out += "[fence." + json_text(fence.name) + "]\nline = [" + line +
           "]\nheight_m = " + text(fence.height) + "\ncapacity_kj = " + text(fence.capacity / 1e3) +
           "\npost_spacing_m = " + text(std::ceil(longest * 100 + 1) / 100) + "\nactive = true\n";
  }
  return out;
}

std::string answer_text(const SearchCase& search, const SearchAnswer& answer) {
  const SearchRuns& runs = search.runs;
  const std::vector<BlockWeight> now = hit_now(runs);
  std::string out = search.settings->name + ": ";
  if (now.empty())
    return out + "nothing hits " + search.object.name + " in " + counted(runs.n_runs, "run") +
           ": no fence is the best";
  out += search.object.name + " is hit in " + std::to_string(n_runs_of(now)) + " of " +
         counted(runs.n_runs, "run");
  if (answer.proposals.empty()) {
    out += "; no fence of this kind";
    if (answer.result.nearest.parts.empty())
      return out + ": no candidate line has room for one where the blocks pass";
    return out + ": of " + counted(answer.result.n_options, "option") + " the nearest is " +
           size_text(answer.result.nearest) + ": " + lacking(search, answer.result.nearest);
  }
  const bool is_any_worse =
      std::any_of(answer.proposals.begin(), answer.proposals.end(),
                  [](const Proposal& p) { return comparison_of(p) == "worse than predicted"; });
  const Proposal& first = answer.proposals[answer.best >= 0 ? answer.best : 0];
  out += "; " +
         std::string(answer.best > 0                   ? "cheapest fence that holds "
                     : answer.best < 0 && is_any_worse ? "no fence held what was predicted; first "
                                                       : "cheapest fence ") +
         first.name + ": " + size_text(first.option) + ", cost " + grouped_text(first.option.cost) +
         "; predicted: it is hit in " +
         bounded(first.option.residual, first.option.residual_interval) + " of the runs";
  if (!first.verified) return out + ", not verified";
  out += "; with the fence standing and " + counted(first.verified->n_runs, "other run") + ": " +
         bounded(first.verified->residual, first.verified->interval);
  const std::string comparison = comparison_of(first);
  return comparison.empty() ? out : out + ", " + comparison;
}

Json search_json(const SearchCase& search, const SearchAnswer& answer, const Vec3& origin) {
  const SearchRuns& runs = search.runs;
  const std::vector<BlockWeight> now = hit_now(runs);
  const Interval interval = run_share_interval(runs.basis, now);
  const Rate rate = rate_of_runs(search, now);
  Json front = Json::array(), curve = Json::array(), proposals = Json::array();
  for (const FenceOption& option : answer.result.front)
    front.push_back(option_json(search, option));
  for (const FenceOption& option : cost_curve(answer.result.front))
    curve.push_back(option_json(search, option));
  for (const Proposal& proposal : answer.proposals)
    proposals.push_back(proposal_json(search, proposal, origin));
  const char* const verdict = now.empty()                ? "none needed"
                              : answer.proposals.empty() ? "no fence of this kind"
                                                         : "fence";
  Json json = {{"name", search.settings->name},
               {"protects", search.object.name},
               {"answer", answer_text(search, answer)},
               {"verdict", verdict},
               {"n_runs", runs.n_runs},
               {"n_runs_hit", n_runs_of(now)},
               {"run_share", share_of_runs(runs.basis, now)},
               {"run_share_interval", interval_json(interval)},
               {"hits_a_run", search.hits_a_run},
               {"share_wanted", search.what.share},
               {"code", search.code.file},
               {"code_sha256", search.code_sha256},
               {"prices_given", !search.settings->prices_per_m.empty()},
               {"prices_per_m", search.what.prices_per_m},
               {"price_per_m2", search.what.price_per_m2},
               {"n_candidates", search.lines.size()},
               {"step_m", search.step},
               {"n_options", answer.result.n_options},
               {"best", answer.best >= 0 ? Json(answer.proposals[answer.best].name) : Json()},
               {"nearest", answer.proposals.empty() && !answer.result.nearest.parts.empty()
                               ? option_json(search, answer.result.nearest)
                               : Json()},
               {"proposals", proposals},
               {"curve", curve},
               {"front", front}};
  if (!std::isnan(rate.value))
    json["hit_per_a"] = {number_or_null(rate.value), number_or_null(rate.low),
                         number_or_null(rate.high)};
  return json;
}

std::vector<VectorLayer> search_layers(const std::vector<SearchCase>& searches,
                                       const std::vector<SearchAnswer>& answers,
                                       const Vec3& origin) {
  const auto line_style = [](Colour colour, double size, const char* label = "") {
    return vector_qml({SymbolKind::line, "", {{"", "", colour}}, size, label});
  };
  VectorLayer candidates{"candidates",
                         "lines that were screened",
                         GeometryType::line_zm,
                         vector_fields(candidate_fields()),
                         {},
                         line_style({150, 150, 150, 255}, 0.2)};
  VectorLayer front{"front",
                    "options that no other beats in all respects",
                    GeometryType::line_zm,
                    vector_fields(option_fields()),
                    {},
                    line_style({49, 130, 189, 160}, 0.5)};
  VectorLayer proposals{"proposals",
                        "fences that do what is asked for",
                        GeometryType::line_zm,
                        vector_fields(option_fields()),
                        {},
                        line_style({203, 24, 29, 255}, 1.0, "\"name\"")};
  VectorLayer posts{"posts",
                    "posts of the proposals",
                    GeometryType::point_z,
                    vector_fields(post_fields()),
                    {},
                    vector_qml({SymbolKind::point, "", {{"", "", {203, 24, 29, 255}}}, 1.6})};
  for (std::size_t s = 0; s < searches.size(); ++s) {
    const SearchCase& search = searches[s];
    add_candidates(candidates, search, origin);
    int number = 0;
    for (const FenceOption& option : answers[s].result.front) {
      const std::string name = search.settings->name + " front " + std::to_string(++number);
      for (const OptionPart& part : option.parts) {
        VectorFeature f = line_of(fence_on(search.lines[part.placed.line], part.placed), origin);
        f.values = values_of(option_fields(), {search, name, option, nullptr});
        front.features.push_back(std::move(f));
      }
    }
    for (const Proposal& proposal : answers[s].proposals)
      for (const Fence& fence : proposal.fences) {
        VectorFeature f = line_of(fence, origin);
        f.values = values_of(option_fields(), {search, proposal.name, proposal.option, &proposal});
        proposals.features.push_back(std::move(f));
        for (std::size_t p = 0; p < fence.post.size(); ++p) {
          VectorFeature post;
          post.points = {fence.post[p] + origin};
          post.values = values_of(post_fields(), {fence, p});
          posts.features.push_back(std::move(post));
        }
      }
  }
  return {candidates, front, proposals, posts};
}

std::string search_chart(const SearchCase& search, const SearchAnswer& answer) {
  Chart chart;
  chart.title = "What a fence for " + search.object.name + " costs, and what it lets through";
  chart.x_label = search.settings->prices_per_m.empty() ? "cost (relative)" : "cost";
  chart.y_label = "hits let through [%]";
  ChartSeries all = points("not beaten by another", "#9ecae1", 2.5);
  for (const FenceOption& option : answer.result.front) {
    all.x.push_back(option.cost);
    all.y.push_back(100 * (1 - option.stopped));
  }
  ChartSeries curve{"most stopped for its cost", "#3182bd", {0}, {100}};
  for (const FenceOption& option : cost_curve(answer.result.front)) {
    curve.x.push_back(option.cost);  // a step: the option paid for so far holds until then
    curve.y.push_back(curve.y.back());
    curve.x.push_back(option.cost);
    curve.y.push_back(100 * (1 - option.stopped));
  }
  ChartSeries predicted = points("proposals, predicted", "#cb181d", 6);
  ChartSeries verified = points("proposals, verified with other runs", "#238b45", 3);
  for (const Proposal& proposal : answer.proposals) {
    predicted.x.push_back(proposal.option.cost);
    predicted.y.push_back(100 * (1 - proposal.option.stopped));
    if (!proposal.verified) continue;
    verified.x.push_back(proposal.option.cost);
    verified.y.push_back(100 * let_through(*proposal.verified, search.runs));
  }
  for (const ChartSeries& series : {all, curve, predicted, verified})
    if (!series.x.empty()) chart.series.push_back(series);
  return chart_file(chart);
}

}  // namespace talus
