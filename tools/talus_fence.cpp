// tools/talus_fence.cpp
// What fences would meet, what they hold and what they change. Page: docs/tools/talus-fence.md
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "base/grouped_text.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "io/geopackage_gdal.hpp"
#include "io/style.hpp"
#include "map_output.hpp"
#include "post/fence.hpp"
#include "post/fence_change.hpp"
#include "post/fence_design.hpp"
#include "post/map_style.hpp"
#include "post/runout.hpp"
#include "post/statistics.hpp"
#include "run_inputs.hpp"
#include "shipped_data.hpp"
#include "site_options.hpp"
#include "site_places.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

constexpr double degrees = 180 / std::numbers::pi;
constexpr double contact_m = 0.25;  // a block so near a standing fence touches it

struct Options {
  std::string out, json, csv, change, code = "uni";
  std::vector<std::string> without;
  DesignInput design;
  double bulking = 1.3;
  std::uint64_t seed = 1;
};

void declare(Tool& tool, Options& o) {
  o.design.block_volume = o.design.deflection = o.design.distance_to_object = std::nan("");
  tool.output("-o,--out", o.out, "fields, posts and arrivals (GeoPackage)")->required();
  tool.json_output(o.json, "verdicts, statistics, design check, comparison (JSON)");
  tool.output("--csv", o.csv, "one row a block and fence: its verdict (CSV)");
  tool.inputs("--without", o.without, "runs without the fence, to compare with");
  tool.output("--change", o.change,
              "deposit and speed with the fences minus those of --without (GeoTIFF; style and "
              "picture beside it)");
  tool.option("--code", o.code, "design code: uni, onr, or a data file (CSV)");
  tool.option("--consequence-class", o.design.consequence_class, "of ONR 24810")
      ->check(CLI::Range(1, 3));
  tool.flag("--service-level", o.design.service_level, "UNI: check the service energy level (SEL)");
  tool.option("--design-block-m3", o.design.block_volume,
              "volume of the design block [m3]; nan: 95th percentile of the released blocks")
      ->check(CLI::PositiveNumber);
  tool.option("--deflection-m", o.design.deflection, "largest deflection of the barrier [m]")
      ->check(CLI::NonNegativeNumber);
  tool.option("--object-distance-m", o.design.distance_to_object,
              "distance from the fence to the object behind it [m]")
      ->check(CLI::PositiveNumber);
  tool.option("--free-border-m", o.design.free_border, "f_min [m]; nan: that of the code")
      ->check(CLI::NonNegativeNumber);
  tool.option("--bulking", o.bulking, "volume of piled blocks over that of their rock")
      ->check(CLI::Range(1.0, 3.0));
  tool.option("--seed", o.seed, "of the bootstrap over runs");
  tool.footer(
      "Example:\n  talus-fence site.toml run_*.h5 --trn slope.tif -o fence.gpkg --json fence.json\n"
      "  talus-fence site.toml with.h5 --without without.h5 --trn slope.tif -o fence.gpkg");
}

// --- what the runs say --------------------------------------------------------------------------

/// A run at one fence.
struct RunAtFence {
  std::vector<FenceArrival> arrivals;   // what comes at the fence
  std::vector<FenceArrival> crossings;  // of its line
  std::vector<BlockVerdict> verdicts;   // at [block]
  bool standing = false;
  int n_unsettled = 0;  // blocks that the standing fence stopped and that move at the end
};

/// A run as a whole, for the comparison.
struct RunWhole {
  std::vector<double> volume, weight;
  double density = 0;
  double block_size = 0;  // mean of the cube roots of the volumes [m]
  ReachLine event, centre;
  std::vector<RunAtFence> at_fence;  // of each fence
};

struct FenceCase {
  FenceSettings settings;
  RecordLine line;
  Fence fence;
};

std::vector<FenceCase> cases_of(Tool& tool, const Site& site, const Trn& trn) {
  std::vector<FenceCase> cases;
  for (const FenceSettings& settings : site.fences)
    for (const RecordLine& line : fence_lines(tool, site, trn, settings))
      cases.push_back({settings, line, make_fence(line, settings)});
  if (cases.empty())
    throw InputError({site.file}, "has no section [fence.*]", "add one with its line and height");
  return cases;
}

// Throws InputError unless the fence that stood in a run is built as that of the site file; its
// posts are the line's points (find_line).
void check_same_fence(const RunFile& run, const FenceSettings& expected, const std::string& file,
                      const std::string& site_file) {
  const Site site = parse_site(run.info.config, file);
  const auto stood =
      std::find_if(site.fences.begin(), site.fences.end(),
                   [&](const FenceSettings& fence) { return fence.name == expected.name; });
  if (stood == site.fences.end()) return;  // the run does not say how it was built
  using Key = std::pair<const char*, double FenceSettings::*>;
  static constexpr std::array<Key, 5> keys = {
      {{"height_m", &FenceSettings::height_m},
       {"capacity_kj", &FenceSettings::capacity_kj},
       {"max_deflection_m", &FenceSettings::max_deflection_m},
       {"friction_deg", &FenceSettings::friction_deg},
       {"cor", &FenceSettings::cor}}};
  for (const auto& [key, value] : keys) {
    const auto words = [](double x) { return std::isnan(x) ? "not given" : text(x); };
    const std::string found = words((*stood).*value), wanted = words(expected.*value);
    if (found == wanted) continue;
    const std::string name = "fence." + expected.name + "." + key;
    throw InputError({file},
                     "was computed with a fence whose " + name + " is " + found + ", expected " +
                         wanted + " as in " + site_file,
                     std::isnan((*stood).*value)
                         ? "run talus-dda again with the fence as it is now"
                         : "run talus-dda again with the fence as it is now, or give --set " +
                               name + "=" + found + " to judge the one that stood");
  }
}

// The line of the run that belongs to a fence; it must be the one of the site file.
int find_line(const RunFile& run, const FenceCase& c, const std::string& file,
              const std::string& site_file) {
  for (std::size_t l = 0; l < run.lines.size(); ++l) {
    if (run.lines[l].name != c.line.name) continue;
    const std::vector<Vec3>&a = run.lines[l].points, &b = c.line.points;
    const auto same = [](const Vec3& p, const Vec3& q) { return (p - q).norm() < 1e-3; };
    if (a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), same))
      return static_cast<int>(l);
    throw InputError({file},
                     "recorded another line for fence " + c.line.name + " than " + site_file,
                     "run talus-dda again with the fence where it is now");
  }
  throw InputError({file}, "recorded no line for fence " + c.line.name,
                   "the fence was added later: run talus-dda again");
}

RunWhole whole_of(const RunFile& run, int index, const std::vector<FenceCase>& cases,
                  const Options& o, const DesignCode& code, const RunInputs& inputs, const Trn& trn,
                  const std::string& site_file) {
  RunWhole out;
  ReachSettings reach;
  reach.rest_speed = inputs.rest_speed_m_s;
  const EventReach event = event_reach(run, trn, reach);
  out.event = event.event;
  out.centre = event.centre_of_mass;
  out.volume = run.blocks.volume;
  double mass = 0, volume = 0;
  for (int b = 0; b < n_blocks(run); ++b) {
    out.weight.push_back(weight_of(run, b));
    mass += run.blocks.mass[b];
    volume += run.blocks.volume[b];
  }
  out.density = mass / volume;
  for (const double v : run.blocks.volume) out.block_size += std::cbrt(v) / n_blocks(run);
  const double f_min =
      std::isnan(o.design.free_border) ? free_border(code, out.block_size) : o.design.free_border;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string& file = inputs.members[index].file;
    const int line = find_line(run, cases[i], file, site_file);
    RunAtFence at;
    at.standing = run.lines[line].standing;
    if (at.standing) check_same_fence(run, cases[i].settings, file, site_file);
    at.arrivals = arrivals(run, line, cases[i].fence, index);
    at.crossings = line_crossings(run, line, cases[i].fence, index);
    at.verdicts =
        verdicts_of(run, index, line, at.arrivals, cases[i].fence, f_min, at.standing, contact_m);
    for (const BlockVerdict& v : at.verdicts)
      at.n_unsettled += at.standing && v.verdict == Verdict::stopped &&
                        fate_of(run, v.block, inputs.rest_speed_m_s) == Fate::moving;
    out.at_fence.push_back(std::move(at));
  }
  return out;
}

/// Runs in the order of their ids, numbered in that order.
struct RunGroup {
  std::vector<RunMember> members;
  std::vector<RunWhole> runs;

  [[nodiscard]] std::vector<FenceArrival> arrivals_at(std::size_t fence) const {
    std::vector<FenceArrival> out;
    for (std::size_t r = 0; r < runs.size(); ++r)
      for (FenceArrival a : runs[r].at_fence[fence].arrivals) {
        a.run = static_cast<int>(r);
        out.push_back(a);
      }
    return out;
  }
  [[nodiscard]] int n() const { return static_cast<int>(runs.size()); }
  [[nodiscard]] int n_unsettled(std::size_t fence) const {
    int sum = 0;
    for (const RunWhole& run : runs) sum += run.at_fence[fence].n_unsettled;
    return sum;
  }
};

// What a standing fence lets through and what comes to its line when it does not stand are two
// samples.
void check_one_kind(const RunGroup& group, const std::vector<FenceCase>& cases) {
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (int r = 1; r < group.n(); ++r) {
      const bool here = group.runs[r].at_fence[i].standing;
      if (here == group.runs[0].at_fence[i].standing) continue;
      const std::string name = cases[i].line.name;
      throw InputError({group.members[r].file},
                       "fence " + name + (here ? " stood" : " did not stand") +
                           " in this run, expected " + (here ? "none" : "it standing") + " as in " +
                           group.members[0].file,
                       "evaluate runs with the fence and runs without it apart, or name those "
                       "without it after --without");
    }
}

// --- numbers ------------------------------------------------------------------------------------

Json quantity_json(const QuantitySummary& q, double scale) {
  Json json = {{"max", number_or_null(q.largest * scale)}};
  for (std::size_t k = 0; k < percentile_levels.size(); ++k) {
    const std::string name = percentile_levels[k].name;
    json[name] = number_or_null(q.percentile[k].value * scale);
    json[name + "_hi"] = number_or_null(q.percentile[k].upper * scale);
  }
  return json;
}

Json part_json(const FencePartSummary& p) {
  return {{"n", p.n},
          {"per_run", number_or_null(p.per_run)},
          {"n_eff", p.n_eff},
          {"energy_kj", quantity_json(p.energy, 1e-3)},
          {"translational_energy_kj", quantity_json(p.translation, 1e-3)},
          {"top_height_m", quantity_json(p.top, 1)},
          {"speed_m_s", quantity_json(p.speed, 1)},
          {"mean_angle_to_normal_deg", number_or_null(p.mean_angle * degrees)},
          {"most_hits_in_a_run", p.most_in_a_run},
          {"runs_hit_twice", number_or_null(p.runs_hit_twice)},
          {"energy_in_one_second_kj", p.window_energy / 1e3},
          {"hits_in_that_second", p.window_hits}};
}

// Share of a verdict with its 95 % interval: Wilson for single-block runs, bootstrap over runs
// else. A share of none or all has no spread to resample: Wilson with the number of runs.
Json share_json(const RunGroup& group, std::size_t fence, Verdict verdict, std::uint64_t seed) {
  std::vector<RunWeight> parts;
  std::vector<double> whole;
  double n = 0, n_all = 0, weight = 0, total = 0, total_sq = 0, of_runs_sq = 0;
  bool single = true;
  for (int r = 0; r < group.n(); ++r) {
    const RunWhole& run = group.runs[r];
    parts.push_back({r, 0});
    whole.push_back(0);
    for (const BlockVerdict& v : run.at_fence[fence].verdicts) {
      const double w = run.weight[v.block];
      whole.back() += w;
      total_sq += w * w;
      n_all += 1;
      if (v.verdict != verdict) continue;
      parts.back().weight += w;
      n += 1;
    }
    single = single && run.weight.size() <= 1;
    total += whole.back();
    of_runs_sq += whole.back() * whole.back();
    weight += parts.back().weight;
  }
  Json json = {
      {"n", n}, {"share", number_or_null(weight / total)}, {"low", nullptr}, {"high", nullptr}};
  if (!single && group.n() < least_runs_to_resample) return json;
  const double share = std::clamp(weight / total, 0.0, 1.0);
  Interval interval;
  if (single) {
    interval = wilson_interval(share, effective_size(total, total_sq));
  } else if (n == 0 || n == n_all) {
    interval = wilson_interval(n == 0 ? 0 : 1, effective_size(total, of_runs_sq));
  } else {
    const RunResamples resamples = resample_runs(group.n(), fence_resamples, seed);
    interval = bootstrap_share(parts, resampled_sums(resamples, whole), resamples);
  }
  json["low"] = interval.low;
  json["high"] = interval.high;
  return json;
}

DesignInput design_input(const Options& o, const RunGroup& group) {
  DesignInput input = o.design;
  for (const RunWhole& run : group.runs) input.mean_block_size += run.block_size / group.n();
  input.density = group.runs[0].density;
  if (std::isnan(input.block_volume)) {
    std::vector<WeightedValue> volumes;
    for (const RunWhole& run : group.runs)
      for (std::size_t b = 0; b < run.volume.size(); ++b)
        volumes.push_back({run.volume[b], run.weight[b]});
    sort_values(volumes);
    input.block_volume = weighted_percentile(volumes, 0.95);
  }
  return input;
}

// null: nothing fails, but the energy could not be checked
Json pass_of(const DesignResult& r) {
  if (r.verdict == DesignVerdict::energy_unknown) return nullptr;
  return r.verdict == DesignVerdict::meets;
}

Json design_json(const DesignResult& r) {
  return {{"enough_arrivals", r.verdict != DesignVerdict::too_few},
          {"arrivals_needed", r.n_needed},
          {"design_energy_kj", number_or_null(r.design_energy / 1e3)},
          {"required_capacity_kj", number_or_null(r.required_capacity / 1e3)},
          {"smallest_class", r.smallest_class},
          {"design_height_m", number_or_null(r.design_height)},
          {"free_border_m", number_or_null(r.free_border)},
          {"required_height_m", number_or_null(r.required_height)},
          {"energy_use", number_or_null(r.energy_use)},
          {"height_use", number_or_null(r.height_use)},
          {"required_distance_m", number_or_null(r.required_distance)},
          {"distance_use", number_or_null(r.distance_use)},
          {"governs", r.governs},
          {"verdict", text(r.verdict)},
          {"pass", pass_of(r)}};
}

// The runs with the fences and those without, and where their blocks came to rest.
struct FenceRuns {
  RunGroup with, without;
  GroundSums ground_with, ground_without;
  PassageGrid grid;
};

// --- one fence ----------------------------------------------------------------------------------

struct Code {
  DesignCode code;
  std::string sha256;
  std::vector<BarrierClass> classes;
};

Code read_code(const std::string& name) {
  const bool shipped = name == "uni" || name == "onr";
  const std::string file = name == "uni" ? "codes/uni_11211-4.csv" : "codes/onr_24810.csv";
  Code out;
  out.classes = barrier_classes(
      parse_csv(shipped_data("codes/barrier_classes.csv"), "share/codes/barrier_classes.csv"));
  if (!shipped && !std::filesystem::exists(name))
    throw InputError({"", 0, "--code"}, "is \"" + name + "\", which is no file",
                     "give uni, onr, or a data file like those of share/codes/");
  if (shipped) {
    Sha256 hash;
    hash.add(shipped_data(file).data(), shipped_data(file).size());
    out.code = design_code(parse_csv(shipped_data(file), "share/" + file));
    out.sha256 = hash.hex();
  } else {
    out.code = design_code(read_csv(name));
    out.sha256 = sha256_of_file(name);
  }
  return out;
}

// Crossings of blocks that passed a fence for good; one that hangs in a panel has not.
std::vector<FenceArrival> passed(const RunAtFence& at) {
  std::vector<FenceArrival> out;
  for (const FenceArrival& crossing : at.crossings)
    if (crossing.passed_for_good &&
        !(at.standing && at.verdicts[crossing.block].verdict == Verdict::stopped))
      out.push_back(crossing);
  return out;
}

struct FieldResult {
  FencePartSummary part;
  DesignResult design;
  double storage = 0;
};

struct FenceResult {
  std::vector<FenceArrival> arrivals;  // at the line itself
  std::vector<FieldResult> fields;
  std::vector<FencePartSummary> posts;
  FencePartSummary whole;
  DesignResult design;
  double storage = 0, retained = 0;  // [m3]; retained a run, as it lies
  double kept = std::nan("");        // from passing, a run, by the comparison, as it lies [m3]
  int side = 0;
};

std::vector<FenceArrival> only(const std::vector<FenceArrival>& list, int FenceArrival::*member,
                               int value) {
  std::vector<FenceArrival> out;
  for (const FenceArrival& a : list)
    if (a.*member == value) out.push_back(a);
  return out;
}

// Rock behind the line of a fence, a run: blocks that crossed it for good and that the fence does
// not hold [m3].
double volume_behind(const RunGroup& group, std::size_t fence) {
  double volume = 0;
  for (const RunWhole& run : group.runs)
    for (const FenceArrival& crossing : passed(run.at_fence[fence])) volume += crossing.volume;
  return volume / group.n();
}

// Rock volume that the fence would hold, a run, in the run where it is largest.
double retained_volume(const RunGroup& group, std::size_t fence) {
  double largest = 0;
  for (const RunWhole& run : group.runs) {
    double volume = 0;
    for (const BlockVerdict& v : run.at_fence[fence].verdicts)
      if (v.verdict == Verdict::stopped) volume += run.volume[v.block];
    largest = std::max(largest, volume);
  }
  return largest;
}

FenceResult evaluate(const FenceCase& c, std::size_t index, const FenceRuns& runs, const Code& code,
                     const Options& o, const Trn& trn) {
  const RunGroup& group = runs.with;
  FenceResult r;
  int towards_left = 0;
  for (const FenceArrival& a : group.arrivals_at(index)) {
    if (a.beside) continue;
    r.arrivals.push_back(a);
    towards_left += a.direction;
  }
  r.side = towards_left != 0 ? (towards_left > 0 ? -1 : 1) : uphill_side(c.fence, trn);
  const DesignInput input = design_input(o, group);
  r.whole = summarise(r.arrivals, group.n(), o.seed);
  r.design = check_design(code.code, code.classes, input, r.whole, c.fence);
  const double reach = 50 * c.fence.height;
  for (int f = 0; f < n_fields(c.fence); ++f) {
    FieldResult field;
    field.part = summarise(only(r.arrivals, &FenceArrival::field, f), group.n(), o.seed);
    field.design = check_design(code.code, code.classes, input, field.part, c.fence);
    field.storage = storage(c.fence, f, r.side, trn, reach);
    r.storage += field.storage;
    r.fields.push_back(std::move(field));
  }
  for (int p = 0; p <= n_fields(c.fence); ++p)
    r.posts.push_back(summarise(only(r.arrivals, &FenceArrival::post, p), group.n(), o.seed));
  r.retained = o.bulking * retained_volume(group, index);
  if (runs.without.n() > 0)
    r.kept = o.bulking * (volume_behind(runs.without, index) - volume_behind(group, index));
  return r;
}

// What the numbers do not know, in plain words.
Json notes_of(const FenceCase& c, std::size_t index, const FenceResult& r, const RunGroup& group,
              const DesignCode& code) {
  const bool standing = group.runs[0].at_fence[index].standing;
  Json notes = Json::array();
  notes.push_back(standing
                      ? "The runs were computed with the fence standing: verdicts are observed."
                      : "The runs were computed without the fence: verdicts say what each block "
                        "would meet at the line; how blocks pile up, deflect or break the fence "
                        "one after the other was not modelled.");
  notes.push_back(
      "Barrier classes are tested with single blocks at mid-field; hits at posts, by "
      "several blocks at once or in a damaged field are not covered by them.");
  if (r.whole.window_hits > 1)
    notes.push_back("Up to " + std::to_string(r.whole.window_hits) +
                    " blocks come within one "
                    "second: the sum of their energies stands beside the single-block check.");
  if (std::fmax(r.retained, r.kept) > 0.5 * r.storage)
    notes.push_back(
        "The retained volume fills more than half of the storage wedge: the fence is "
        "then loaded by a deposit, for which no barrier class is tested.");
  if (std::isnan(c.fence.capacity))
    notes.push_back(standing ? "The fence has no capacity_kj: it stood rigid, and the design check "
                               "leaves its energy open."
                             : "The fence has no capacity_kj: no block counts as piercing it, and "
                               "the design check leaves its energy open.");
  if (const int n = group.n_unsettled(index); n > 0)
    notes.push_back(std::to_string(n) +
                    " of the blocks that the fence stopped were still moving when their run ended: "
                    "they may pass it yet.");
  for (const std::string& remark : build_remarks(code, c.fence)) notes.push_back(remark);
  return notes;
}

Json fence_json(const FenceCase& c, std::size_t index, const FenceResult& r, const RunGroup& group,
                const Code& code, const Options& o) {
  const bool standing = group.runs[0].at_fence[index].standing;
  Json shares;
  for (const Verdict v : verdicts) shares[text(v)] = share_json(group, index, v, o.seed);
  Json fields = Json::array(), posts = Json::array();
  for (std::size_t f = 0; f < r.fields.size(); ++f) {
    Json json = part_json(r.fields[f].part);
    json["from_m"] = c.fence.chainage[f];
    json["to_m"] = c.fence.chainage[f + 1];
    json["storage_m3"] = r.fields[f].storage;
    json["design"] = design_json(r.fields[f].design);
    fields.push_back(json);
  }
  for (std::size_t p = 0; p < r.posts.size(); ++p) {
    Json json = part_json(r.posts[p]);
    json["chainage_m"] = c.fence.chainage[p];
    posts.push_back(json);
  }
  const auto n_touches =
      std::count_if(r.arrivals.begin(), r.arrivals.end(), [](auto& a) { return a.by_touch; });
  const double top_p95 = r.whole.top.percentile[2].value;
  return {{"name", c.line.name},
          {"length_m", length(c.fence)},
          {"height_m", c.fence.height},
          {"capacity_kj", number_or_null(c.fence.capacity / 1e3)},
          {"standing", standing},
          {"free_border_m", r.design.free_border},
          {"height_left_m", number_or_null(c.fence.height - top_p95)},
          {"verdicts", shares},
          {"arrivals", {{"first_touches", n_touches}, {"crossings", r.whole.n - n_touches}}},
          {"whole", part_json(r.whole)},
          {"storage_m3", r.storage},
          {"retained_m3", r.retained},
          {"kept_from_passing_m3", number_or_null(r.kept)},
          {"stopped_but_moving", group.n_unsettled(index)},
          {"design",
           {{"code", code.code.file},
            {"sha256", code.sha256},
            {"from_memory", code.code.from_memory},
            {"whole", design_json(r.design)}}},
          {"fields", fields},
          {"posts", posts},
          {"notes", notes_of(c, index, r, group, code.code)}};
}

// --- with and without ---------------------------------------------------------------------------

Json side_json(const RunGroup& group, std::size_t fence) {
  double weight = 0, weight_sq = 0, total = 0, volume = 0, n = 0;
  double length = 0, angle = 0, centre = 0;
  std::vector<WeightedValue> energy;
  for (const RunWhole& run : group.runs) {
    for (const double w : run.weight) total += w;
    for (const FenceArrival& a : passed(run.at_fence[fence])) {
      weight += a.weight;
      weight_sq += a.weight * a.weight;
      volume += a.volume;
      n += 1;
      energy.push_back({a.energy() / 1e3, a.weight});
    }
    length += run.event.path / group.n();
    angle += run.event.path_angle() * degrees / group.n();
    centre += run.centre.path / group.n();
  }
  sort_values(energy);
  const bool enough = effective_size(weight, weight_sq) + 1e-9 >= smallest_sample(0.5);
  return {{"n_runs", group.n()},
          {"blocks_behind_the_line", n},
          {"share_behind_the_line", number_or_null(weight / total)},
          {"volume_behind_the_line_m3_per_run", volume / group.n()},
          {"energy_at_the_line_kj_p50",
           number_or_null(enough ? weighted_percentile(energy, 0.5) : std::nan(""))},
          {"energy_at_the_line_kj_max",
           number_or_null(energy.empty() ? std::nan("") : energy.back().value)},
          {"mean_L_path_m", number_or_null(length)},
          {"mean_reach_angle_path_deg", number_or_null(angle)},
          {"mean_centre_of_mass_L_path_m", number_or_null(centre)}};
}

Json comparison_json(const RunGroup& with, const RunGroup& without, std::size_t fence) {
  const Json a = side_json(with, fence), b = side_json(without, fence);
  Json change;
  for (const auto& [key, value] : a.items())
    if (key != "n_runs" && value.is_number() && b[key].is_number())
      change[key] = value.get<double>() - b[key].get<double>();
  return {{"with", a}, {"without", b}, {"with_minus_without", change}};
}

// --- layers and tables --------------------------------------------------------------------------

VectorStyle verdict_style(SymbolKind kind, double size) {
  return {kind,
          "verdict",
          {{"stopped", "stopped", {51, 160, 44, 255}},
           {"pierced", "pierced", {227, 26, 28, 255}},
           {"free_border", "free border", {253, 191, 111, 255}},
           {"overtopped", "overtopped", {255, 127, 0, 255}},
           {"bypassed_left", "bypassed on the left", {106, 61, 154, 255}},
           {"bypassed_right", "bypassed on the right", {202, 178, 214, 255}},
           {"underpassed", "underpassed", {177, 89, 40, 255}}},
          size};
}

void add_part(std::vector<FieldValue>& values, const FencePartSummary& p) {
  values.insert(
      values.end(),
      {static_cast<std::int64_t>(p.n), p.per_run, p.energy.percentile[2].value / 1e3,
       p.energy.percentile[2].upper / 1e3, p.energy.largest / 1e3, p.top.percentile[2].value,
       p.top.percentile[2].upper, p.top.largest, p.speed.percentile[2].value, p.speed.largest,
       p.mean_angle * degrees, p.window_energy / 1e3});
}

std::vector<VectorField> part_fields(std::vector<VectorField> fields) {
  fields.push_back({"n", FieldType::integer});
  for (const char* name : {"per_run", "energy_p95_kj", "energy_p95_hi_kj", "energy_max_kj",
                           "top_p95_m", "top_p95_hi_m", "top_max_m", "speed_p95_m_s",
                           "speed_max_m_s", "angle_to_normal_deg", "energy_in_one_second_kj"})
    fields.push_back({name, FieldType::real});
  return fields;
}

FieldValue pass_field(const DesignResult& design) {
  const Json pass = pass_of(design);
  if (pass.is_null()) return {};
  return static_cast<std::int64_t>(pass.get<bool>() ? 1 : 0);
}

VectorLayer field_layer(const std::vector<FenceCase>& cases,
                        const std::vector<FenceResult>& results, const Vec3& origin) {
  VectorLayer layer{
      "fence_fields",
      "fields of the fences",
      GeometryType::line_zm,
      part_fields({{"fence", FieldType::text}, {"field", FieldType::integer}}),
      {},
      vector_qml(
          {SymbolKind::line,
           "verdict",
           {{"meets", "meets the code", {51, 160, 44, 255}},
            {"does not meet", "does not meet it", {227, 26, 28, 255}},
            {"energy not checked", "no capacity given: energy not checked", {253, 191, 111, 255}},
            {"too few arrivals", "too few arrivals", {120, 120, 120, 255}}},
           1.2})};
  for (const char* name : {"storage_m3", "required_capacity_kj", "required_height_m"})
    layer.fields.push_back({name, FieldType::real});
  for (const char* name : {"smallest_class", "governs"})
    layer.fields.push_back({name, FieldType::text});
  layer.fields.push_back({"pass", FieldType::integer});
  layer.fields.push_back({"verdict", FieldType::text});
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (std::size_t f = 0; f < results[i].fields.size(); ++f) {
      const FieldResult& r = results[i].fields[f];
      const Fence& fence = cases[i].fence;
      VectorFeature feature;
      feature.points = {fence.post[f] + origin, fence.post[f + 1] + origin};
      feature.measure = {fence.chainage[f], fence.chainage[f + 1]};
      feature.values = {fence.name, static_cast<std::int64_t>(f)};
      add_part(feature.values, r.part);
      feature.values.insert(feature.values.end(),
                            {r.storage, r.design.required_capacity / 1e3, r.design.required_height,
                             r.design.smallest_class, r.design.governs, pass_field(r.design),
                             std::string(text(r.design.verdict))});
      layer.features.push_back(std::move(feature));
    }
  return layer;
}

VectorLayer post_layer(const std::vector<FenceCase>& cases, const std::vector<FenceResult>& results,
                       const Vec3& origin) {
  VectorLayer layer{"fence_posts",
                    "posts, with the arrivals nearest to each",
                    GeometryType::point_z,
                    part_fields({{"fence", FieldType::text}, {"post", FieldType::integer}}),
                    {},
                    vector_qml({SymbolKind::point, "", {{"", "", {60, 60, 60, 255}}}, 1.6})};
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (std::size_t p = 0; p < results[i].posts.size(); ++p) {
      VectorFeature feature;
      feature.points = {cases[i].fence.post[p] + origin};
      feature.values = {cases[i].fence.name, static_cast<std::int64_t>(p)};
      add_part(feature.values, results[i].posts[p]);
      layer.features.push_back(std::move(feature));
    }
  return layer;
}

// Place of an arrival on the line, its height that of the centroid, or by touch half way up.
Vec3 place_of(const FenceArrival& a, const Fence& fence) {
  const int field = std::clamp(
      static_cast<int>(std::upper_bound(fence.chainage.begin(), fence.chainage.end(), a.chainage) -
                       fence.chainage.begin()) -
          1,
      0, n_fields(fence) - 1);
  const double s =
      (a.chainage - fence.chainage[field]) / (fence.chainage[field + 1] - fence.chainage[field]);
  Vec3 at = fence.post[field] + s * (fence.post[field + 1] - fence.post[field]);
  at.z() = base_at(fence, a.chainage) + (a.by_touch ? 0.5 * (a.top + a.bottom) : a.centroid);
  return at;
}

const char* recorded_at(const FenceArrival& a) { return a.by_touch ? "first touch" : "crossing"; }

VectorLayer arrival_layer_of(const std::vector<FenceCase>& cases, const RunGroup& group,
                             const Vec3& origin) {
  VectorLayer layer{"fence_arrivals",
                    "where and how blocks come at the fences or pass beside them",
                    GeometryType::point_z,
                    {{"fence", FieldType::text},
                     {"run_id", FieldType::text},
                     {"block", FieldType::integer},
                     {"verdict", FieldType::text},
                     {"recorded_at", FieldType::text}},
                    {},
                    vector_qml(verdict_style(SymbolKind::point, 2))};
  for (const char* name : {"time_s", "chainage_m", "speed_m_s", "angle_to_normal_deg", "spin_rad_s",
                           "translational_energy_kj", "rotational_energy_kj", "centroid_height_m",
                           "top_height_m", "bottom_height_m", "volume_m3"})
    layer.fields.push_back({name, FieldType::real});
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (int r = 0; r < group.n(); ++r)
      for (const BlockVerdict& v : group.runs[r].at_fence[i].verdicts) {
        if (v.arrival < 0) continue;
        const FenceArrival& a = group.runs[r].at_fence[i].arrivals[v.arrival];
        VectorFeature f;
        f.points = {place_of(a, cases[i].fence) + origin};
        f.values = {cases[i].fence.name,
                    group.members[r].info.run_id,
                    static_cast<std::int64_t>(a.block),
                    std::string(text(v.verdict)),
                    std::string(recorded_at(a)),
                    a.time,
                    a.chainage,
                    a.speed,
                    a.beside ? std::nan("") : a.angle * degrees,
                    a.spin,
                    a.translation / 1e3,
                    a.rotation / 1e3,
                    a.centroid,
                    a.top,
                    a.bottom,
                    a.volume};
        layer.features.push_back(std::move(f));
      }
  return layer;
}

std::string verdict_csv(const std::vector<FenceCase>& cases, const RunGroup& group) {
  std::string out =
      csv_line({"fence", "run_id", "block", "verdict", "weight", "volume_m3", "chainage_m",
                "time_s", "energy_kj", "top_height_m", "bottom_height_m", "recorded_at"});
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (int r = 0; r < group.n(); ++r)
      for (const BlockVerdict& v : group.runs[r].at_fence[i].verdicts) {
        std::vector<std::string> row = {cases[i].fence.name,
                                        group.members[r].info.run_id,
                                        std::to_string(v.block),
                                        text(v.verdict),
                                        text(group.runs[r].weight[v.block]),
                                        text(group.runs[r].volume[v.block], 7)};
        if (v.arrival >= 0) {
          const FenceArrival& a = group.runs[r].at_fence[i].arrivals[v.arrival];
          for (const double value : {a.chainage, a.time, a.energy() / 1e3, a.top, a.bottom})
            row.push_back(text(value, 7));
          row.emplace_back(recorded_at(a));
        }
        row.resize(12);
        out += csv_line(row);
      }
  return out;
}

// "63 first touches of the fence, 2 crossings of its line"
std::string arrivals_text(const FenceResult& r) {
  int n_touches = 0;
  for (const FenceArrival& a : r.arrivals) n_touches += a.by_touch;
  const int n_crossings = r.whole.n - n_touches;
  std::string out;
  if (n_touches > 0)
    out = std::to_string(n_touches) + (n_touches == 1 ? " first touch" : " first touches") +
          " of the fence";
  if (n_crossings > 0)
    out += (out.empty() ? "" : ", ") + std::to_string(n_crossings) +
           (n_crossings == 1 ? " crossing" : " crossings") + " of its line";
  return out;
}

std::string summary_of(const FenceCase& c, std::size_t index, const FenceResult& r,
                       const RunGroup& group) {
  std::map<Verdict, int> count;
  int total = 0;
  for (const RunWhole& run : group.runs)
    for (const BlockVerdict& v : run.at_fence[index].verdicts) ++count[v.verdict], ++total;
  std::string out = "fence " + c.line.name + ": " + std::to_string(total) + " blocks of " +
                    std::to_string(group.n()) + (group.n() == 1 ? " run:" : " runs:");
  for (const auto& [verdict, n] : count) out += " " + std::to_string(n) + " " + text(verdict) + ",";
  std::replace(out.begin() + static_cast<std::ptrdiff_t>(out.find(':')), out.end(), '_', ' ');
  out.back() = ';';
  if (r.whole.n == 0) return out + " nothing came to it";
  out += " " + arrivals_text(r) + ": largest energy " +
         grouped_text(r.whole.energy.largest / 1e3, 4) + " kJ, highest top " +
         text(r.whole.top.largest, 3) + " m; ";
  if (r.design.verdict == DesignVerdict::too_few)
    return out + "design check not possible: " + std::to_string(r.whole.n) + " arrivals, needs " +
           std::to_string(r.design.n_needed);
  out += "needs " + grouped_text(r.design.required_capacity / 1e3, 4) +
         " kJ (class: " + r.design.smallest_class + ") and a height of " +
         text(r.design.required_height, 3) + " m: ";
  if (r.design.verdict == DesignVerdict::meets) return out + "meets the code";
  if (r.design.verdict == DesignVerdict::energy_unknown)
    return out + "high enough; no capacity given: energy not checked";
  return out + "does not meet the code, " + r.design.governs + " governs";
}

// --- the whole ----------------------------------------------------------------------------------

Json change_json(const GroundSums& with, const GroundSums& without) {
  const DepositChange change = deposit_change(with, without);
  return {{"with_m3_per_run", change.with},
          {"without_m3_per_run", change.without},
          {"more_m3_per_run", change.more},
          {"less_m3_per_run", change.less}};
}

FenceRuns read_runs(const std::vector<FenceCase>& cases, const Options& o, const DesignCode& code,
                    RunInputs& inputs, const Trn& trn, const std::string& site_file) {
  FenceRuns out;
  out.grid = passage_grid(trn, 0);
  std::vector<RunWhole> runs;
  const auto take = [&](RunFile& run, int index) {
    if (run.grid.n_rows > 0) out.grid = run.grid;
    add_run(runs.size() < inputs.files.size() ? out.ground_with : out.ground_without, out.grid, run,
            inputs.rest_speed_m_s);
    runs.push_back(whole_of(run, index, cases, o, code, inputs, trn, site_file));
  };
  const RunParts parts{.checkpoint = false};
  inputs.read(parts, take);
  const std::size_t n_with = runs.size();
  inputs.read(o.without, parts, take);
  const auto split = [&](std::size_t first, std::size_t last) {
    return RunGroup{{inputs.members.begin() + first, inputs.members.begin() + last},
                    {runs.begin() + first, runs.begin() + last}};
  };
  out.with = split(0, n_with);
  out.without = split(n_with, runs.size());
  for (const RunGroup* group : {&out.with, &out.without}) check_one_kind(*group, cases);
  return out;
}

// What a reader of the verdicts at fence i must know.
void warn_of(Tool& tool, const FenceCase& fence, std::size_t i, const FenceResult& result,
             const FenceRuns& runs) {
  const std::string name = "fence " + fence.line.name;
  if (runs.without.n() > 0 && !runs.with.runs[0].at_fence[i].standing)
    tool.warn(name + " did not stand in the runs compared with --without");
  if (runs.without.n() > 0 && runs.without.runs[0].at_fence[i].standing)
    tool.warn(name + " stood in the runs of --without as well");
  if (std::isnan(fence.fence.capacity))
    tool.warn(name + " has no capacity_kj: the design check leaves its energy open");
  if (const int n = runs.with.n_unsettled(i); n > 0)
    tool.warn(name + ": " + std::to_string(n) +
              " of the blocks that it stopped were still moving when their run ended; give "
              "talus-dda a longer --duration-s");
  if (result.whole.n > 0 && result.design.verdict == DesignVerdict::too_few)
    tool.warn(name + ": " + std::to_string(result.whole.n) +
              " arrivals are too few for the percentiles of the code, which need " +
              std::to_string(result.design.n_needed) +
              ": the largest values stand in for them, and nothing passes");
}

std::vector<std::pair<std::string, std::string>> output_tags(Tool& tool, const RunInputs& inputs,
                                                             const FenceRuns& runs,
                                                             const std::string& remark) {
  auto tags = tags_of(runs.with.members);
  tags.insert(tags.begin(), {{"RUN_ID", tool.run_id()}, {"RUN_SET", inputs.run_set()}});
  if (runs.without.n() > 0)
    for (const auto& [name, value] : tags_of(runs.without.members))
      if (name == "N_RUNS" || name == "DENOMINATOR" || name == "HEALTH")
        tags.emplace_back(name + "_WITHOUT", value);
  if (!remark.empty()) tags.emplace_back("REMARK", remark);
  return tags;
}

void run_tool(Tool& tool, Options& o, SiteOptions& site_options, RunInputs& inputs) {
  const Site& site = site_options.load();
  const Code code = read_code(o.code);
  if (!o.change.empty() && o.without.empty())
    throw InputError({"", 0, "--change"}, "has nothing to compare with",
                     "give runs without the fences by --without");
  if (o.code != "uni" && o.code != "onr") tool.read_also("code", o.code);
  const Trn& trn = inputs.trn();
  const std::vector<FenceCase> cases = cases_of(tool, site, trn);
  const FenceRuns runs = read_runs(cases, o, code.code, inputs, trn, site.file);

  std::vector<FenceResult> results;
  Json fences = Json::array();
  std::string summary;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    results.push_back(evaluate(cases[i], i, runs, code, o, trn));
    fences.push_back(fence_json(cases[i], i, results[i], runs.with, code, o));
    if (runs.without.n() > 0)
      fences.back()["comparison"] = comparison_json(runs.with, runs.without, i);
    warn_of(tool, cases[i], i, results[i], runs);
    summary += (i > 0 ? "\n" : "") + summary_of(cases[i], i, results[i], runs.with);
  }
  inputs.warn_of_ends();
  const std::string remark = inputs.remark();
  const auto tags = output_tags(tool, inputs, runs, remark);
  if (!o.change.empty()) {
    const MapLayer layer = change_layer(runs.ground_with, runs.ground_without, runs.grid.cell_size);
    write_map(tool, map_frame(trn, runs.grid, true, layer.cell), o.change, layer,
              change_style(layer, remark), tags);
  }
  write_geopackage(tool.stage(o.out), trn.crs_wkt,
                   {field_layer(cases, results, trn.origin), post_layer(cases, results, trn.origin),
                    arrival_layer_of(cases, runs.with, trn.origin)},
                   tags);
  if (!o.csv.empty()) tool.write_text(o.csv, verdict_csv(cases, runs.with));
  Json tag_list;
  for (const auto& [key, value] : tags) tag_list[key] = value;
  Json result = {{"run_id", tool.run_id()}, {"tags", tag_list}, {"fences", fences}};
  if (runs.without.n() > 0)
    result["deposit_change"] = change_json(runs.ground_with, runs.ground_without);
  tool.result(result, summary);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Tool tool("talus-fence", "What fences would meet, what they hold and what they change.");
  SiteOptions site(tool);
  RunInputs runs(tool);
  declare(tool, options);
  return tool.run(argc, argv, [&] { run_tool(tool, options, site, runs); });
}
