// Reads the runs of a fence search: those that watched candidate lines, and those that verify.
#include "tools/fence-search/inputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/text.hpp"
#include "post/trace/trace.hpp"
#include "setup/site_places_gdal.hpp"
#include "tools/frame/fence_code.hpp"

namespace talus {
namespace {

constexpr double same_place = 0.01;  // of posts, in plan [m]

// With passages: runs that are read later must have their grid.
const RunParts wanted{.checkpoint = false,
                      .only_last_frame = true,
                      .only_faults = true,
                      .words = false,
                      .trees = false};

SearchSettings what_can_be_built(const Site& site, const FenceSearchSettings& search,
                                 const FenceCode& code) {
  SearchSettings what;
  what.share = search.share;
  what.heights = search.heights_m;
  for (const double kj : search.classes_kj) what.capacities.push_back(kj * 1e3);
  if (search.classes_kj.empty())
    for (const BarrierClass& c : code.classes) what.capacities.push_back(c.mel);
  what.prices_per_m = search.prices_per_m;
  if (search.prices_per_m.empty())
    for (std::size_t k = 0; k < what.capacities.size(); ++k)
      what.prices_per_m.push_back(1 + 0.2 * static_cast<double>(k));
  if (what.prices_per_m.size() != what.capacities.size())
    throw InputError(where_of(site, "fence_search." + search.name + ".prices_per_m"),
                     "has " +
                         counted(static_cast<std::int64_t>(what.prices_per_m.size()), "price") +
                         " for the " + std::to_string(what.capacities.size()) +
                         " classes of share/codes/barrier_classes.csv",
                     "give one for each class, or give classes_kj as well");
  what.price_per_m2 = !std::isnan(search.price_per_m2) ? search.price_per_m2
                      : search.prices_per_m.empty()    ? 0.1
                                                       : 0;
  what.spacing = search.post_spacing_m;
  what.min_fields = static_cast<int>(search.min_fields);
  what.end_fields = static_cast<int>(search.end_fields);
  if (!std::isnan(search.max_length_m)) what.max_length = search.max_length_m;
  what.two_fences = search.two_fences;
  return what;
}

bool same_in_plan(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Vec3& p, const Vec3& q) {
    return (p - q).head<2>().norm() <= same_place;
  });
}

int line_named(const RunFile& run, const std::string& name) {
  for (std::size_t l = 0; l < run.lines.size(); ++l)
    if (run.lines[l].name == name) return static_cast<int>(l);
  return -1;
}

// The line of a run that is a candidate of the search as it is now.
int candidate_of(const RunFile& run, const SearchLine& line, const std::string& file,
                 const std::string& search) {
  const int at = line_named(run, line.name);
  if (at < 0)
    throw InputError({file}, "did not watch the candidate lines of fence_search." + search,
                     "run talus-dda again with the site file as it is");
  if (!same_in_plan(run.lines[at].points, line.fence.post))
    throw InputError({file}, "watched line " + line.name + " in another place than it has now",
                     "the terrain or [fence_search." + search +
                         "] has changed since: run talus-dda again; where each rock mass has a "
                         "ground of its own, style = \"offset\" keeps lines where they are");
  return at;
}

int object_in(const RunFile& run, const RecordObject& object, const std::string& file) {
  const int at = watched_as(run, object);
  if (at >= 0) return at;
  throw InputError({file}, "did not watch object " + object.name,
                   "run talus-dda again with the site file as it is");
}

// When each block first touches the object; infinite: never.
std::vector<double> touches_of(const RunFile& run, int object) {
  std::vector<double> out(static_cast<std::size_t>(n_blocks(run)),
                          std::numeric_limits<double>::infinity());
  for (const ObjectHit& hit : run.object_hits)
    if (hit.object == object) out[hit.block] = std::min(out[hit.block], hit.time);
  return out;
}

void add_search_run(SearchCase& of, const RunFile& run, int index, const std::string& file) {
  const std::vector<double> touched = touches_of(run, object_in(run, of.object, file));
  SearchRuns& runs = of.runs;
  for (int b = 0; b < n_blocks(run); ++b)
    if (std::isfinite(touched[b]))
      runs.on_object.push_back({{index, b, weight_of(run, b)}, runs.n_blocks + b});
  for (SearchLine& line : of.lines) {
    const int at = candidate_of(run, line, file, of.settings->name);
    Fence fence = line.fence;
    fence.post = run.lines[at].points;  // heights of the ground that the run had
    for (const FenceArrival& arrival : line_crossings(run, at, fence, index)) {
      if (arrival.beside) continue;
      const double touch = touched[arrival.block];
      line.hits.push_back(
          {arrival, runs.n_blocks + arrival.block, std::isfinite(touch) && arrival.time < touch});
    }
  }
  runs.n_blocks += n_blocks(run);
  ++runs.n_runs;
  of.on_object.push_back(touched);
}

// Weight of a run of each class by the frequency of its events, 1 on average
// over all runs; `n`: runs of each. A run of rocks is as many events as their weight.
std::vector<double> class_factors(const std::vector<HazardRuns>& classes,
                                  const std::vector<int>& n) {
  if (classes.size() == 1) return {1.0};
  std::vector<double> often;
  double all = 0, n_all = 0;
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const HazardClass& kind = classes[c].kind;
    const double events = kind.of_rocks ? classes[c].basis.over.whole / classes[c].n : 1;
    often.push_back(
        (kind.kind == FrequencyKind::of_failure ? kind.probability : kind.frequency.value) /
        events);
    all += often.back();
    n_all += n[c];
  }
  for (std::size_t c = 0; c < classes.size(); ++c) often[c] *= n_all / (all * n[c]);
  return often;
}

void weigh_classes(RunInputs& runs, std::vector<HazardRuns>& classes,
                   std::vector<SearchCase>& cases) {
  std::vector<int> n;
  for (const HazardRuns& of : classes) n.push_back(of.n);
  const std::vector<double> factors = class_factors(classes, n);
  std::vector<double> factor;  // by run
  for (std::size_t c = 0; c < classes.size(); ++c)
    factor.insert(factor.end(), static_cast<std::size_t>(n[c]), factors[c]);
  for (std::size_t c = 0; c < classes.size(); ++c) {  // shares of the samples weighed below
    ShareBasis& basis = classes[c].basis;
    for (double& weight : basis.clusters.weight) weight *= factors[c];
    basis.over.whole *= factors[c];
    basis.over.squares *= factors[c] * factors[c];
  }
  for (std::size_t r = 0; r < factor.size(); ++r) {
    runs.members[r].run_weight *= factor[r];
    runs.members[r].weight *= factor[r];
  }
  for (SearchCase& search : cases)
    for (BlockOnObject& block : search.runs.on_object) block.of.weight *= factor[block.of.run];
  for (SearchCase& search : cases)
    for (SearchLine& line : search.lines)
      for (SearchHit& hit : line.hits)
        hit.arrival.weight *= factor[static_cast<std::size_t>(hit.arrival.run)];
}

// The same for runs with a fence, by their cases; by run.
std::vector<double> verified_factors(const std::vector<RunMember>& members,
                                     const std::vector<HazardRuns>& classes) {
  if (classes.size() < 2) return std::vector<double>(members.size(), 1.0);
  std::vector<int> n(classes.size(), 0);
  std::vector<std::size_t> kind;
  for (const RunMember& member : members) {
    const std::string name = member.info.case_name;
    const auto found = std::find_if(classes.begin(), classes.end(),
                                    [&](const HazardRuns& of) { return of.kind.name == name; });
    if (found == classes.end())
      throw InputError({where_of(member)},
                       "is of case '" + name + "', which is not a class of [hazard.class.*]",
                       "compute runs of class " + classes[0].kind.name +
                           " with talus-dda --variant " + classes[0].kind.name);
    kind.push_back(static_cast<std::size_t>(found - classes.begin()));
    ++n[kind.back()];
  }
  for (std::size_t c = 0; c < classes.size(); ++c)
    if (n[c] == 0)
      throw InputError({"", 0, "--verified"}, "has no run of class " + classes[c].kind.name,
                       "give runs of all classes ([variant.CLASS])");
  const std::vector<double> factors = class_factors(classes, n);
  std::vector<double> out;
  for (const std::size_t c : kind) out.push_back(factors[c]);
  return out;
}

void warn_of_standing(Tool& tool, const std::set<std::string>& standing) {
  std::string names;
  for (const std::string& name : standing) names += (names.empty() ? "" : ", ") + name;
  if (!names.empty())
    tool.warn("fences stood in the runs: " + names +
              "; what is searched is one more fence, and what these stop counts as no hit");
}

struct Rock {
  double mass = 0, volume = 0, sizes = 0;
  std::int64_t n = 0;
};

void set_sides(std::vector<SearchLine>& lines, const Trn& trn) {
  for (SearchLine& line : lines) {
    int to_left = 0;
    for (const SearchHit& hit : line.hits) to_left += hit.arrival.direction;
    Fence of_some_height = line.fence;
    of_some_height.height = 5;
    line.side = to_left != 0 ? (to_left > 0 ? -1 : 1) : uphill_side(of_some_height, trn);
    sort_hits(line);
  }
}

}  // namespace

std::vector<SearchCase> search_cases(Tool& tool, const Site& site, const std::string& only,
                                     const Trn& trn) {
  if (site.fence_searches.empty())
    throw InputError({site.file}, "has no section [fence_search.*]",
                     "add one that names the object to protect: [fence_search.NAME] protect = "
                     "\"OBJECT\"");
  const std::vector<RecordObject> objects = site_objects(tool, site, trn);
  std::vector<SearchCase> cases;
  std::vector<std::string> names;
  for (const FenceSearchSettings& search : site.fence_searches) {
    names.push_back(search.name);
    if (!only.empty() && search.name != only) continue;
    SearchCase of;
    of.settings = &search;
    const SearchCandidates candidates = search_candidates(tool, site, trn, search, objects);
    of.object = objects[protected_object(site, search)];
    const bool is_shipped = search.code == "uni" || search.code == "onr";
    const std::string code_file = is_shipped ? search.code : resolved(site, search.code);
    if (!is_shipped) tool.read_also("code." + search.name, code_file);
    const FenceCode code = read_fence_code(code_file);
    of.code = code.code;
    of.code_sha256 = code.sha256;
    of.what = what_can_be_built(site, search, code);
    of.step = candidates.step;
    for (const RecordLine& line : candidates.lines) {
      SearchLine made;
      made.name = line.name;
      made.fence.name = line.name;
      made.fence.post = line.points;
      made.fence.chainage = line.chainage;
      of.lines.push_back(std::move(made));
    }
    cases.push_back(std::move(of));
  }
  if (cases.empty()) {
    const std::string nearest = nearest_name(only, names);
    throw InputError(
        {site.file}, "has no [fence_search." + only + "]",
        nearest.empty() ? "give the name of one that it has" : "did you mean " + nearest + "?");
  }
  return cases;
}

void read_search_runs(Tool& tool, RunInputs& runs, const Site& site,
                      std::vector<SearchCase>& cases) {
  const std::vector<HazardClass> classes = hazard_classes(site);
  Rock rock;
  std::vector<HazardRuns> rates;
  std::set<std::string> standing;
  for (const RunSet& set : runs.of_classes(classes)) {
    const HazardClass kind = class_at(classes, rates.size());
    const int first = static_cast<int>(runs.members.size());
    runs.read(set, "class." + kind.name, wanted, [&](RunFile& run, int index) {
      const RunMember& member = runs.members[static_cast<std::size_t>(index)];
      for (SearchCase& search : cases) add_search_run(search, run, index, where_of(member));
      for (int b = 0; b < n_blocks(run); ++b) {
        rock.mass += run.blocks.mass[b];
        rock.volume += run.blocks.volume[b];
        rock.sizes += std::cbrt(run.blocks.volume[b]);
        ++rock.n;
      }
      for (const RecordLine& line : run.lines)
        if (line.standing) standing.insert(line.name);
    });
    rates.push_back(hazard_runs(kind, runs.members, first, runs.last_failed_share()));
  }
  warn_of_standing(tool, standing);
  if (!classes.empty()) weigh_classes(runs, rates, cases);
  const ShareBasis basis = share_basis(clusters_of(runs.members), runs.failed_share());
  for (SearchCase& search : cases) {
    search.runs.basis = basis;
    search.runs.density = rock.mass / rock.volume;
    search.runs.mean_block_size = rock.sizes / static_cast<double>(rock.n);
    if (!classes.empty()) search.classes = rates;
    for (const BlockOnObject& block : search.runs.on_object)
      search.hits_a_run += runs.members[block.of.run].run_weight;
    search.hits_a_run /= search.runs.n_runs;
    set_sides(search.lines, runs.trn());
  }
}

VerifiedFence read_verified(RunInputs& runs, const std::string& name,
                            const std::vector<std::string>& paths, const std::vector<Fence>& fences,
                            const SearchCase& search) {
  std::set<std::string> ids;
  std::set<std::int64_t> seeds;
  for (int r = 0; r < search.runs.n_runs; ++r) {
    ids.insert(runs.members[r].info.run_id);
    seeds.insert(runs.members[r].info.seed);
  }
  const std::size_t before = runs.members.size();
  std::vector<double> n_hits, weight;  // on the object, by run
  const auto take = [&](RunFile& run, int index) {
    const RunMember& member = runs.members[static_cast<std::size_t>(index)];
    const std::string file = where_of(member);
    const char* const way_out =
        "verify with other seeds: what was found from these fits them too well";
    if (ids.contains(run.info.run_id))
      throw InputError({file}, "is one of the runs that the search was made from", way_out);
    if (seeds.contains(run.info.seed))
      throw InputError({file},
                       "has seed " + std::to_string(run.info.seed) +
                           ", as has one of the runs that the search was made from",
                       way_out);
    for (const Fence& fence : fences) {
      const int at = line_named(run, fence.name);
      if (at < 0 || !run.lines[at].standing || !same_in_plan(run.lines[at].points, fence.post))
        throw InputError({file}, "did not have fence " + fence.name + " standing where it is now",
                         "run talus-dda with --add of the proposal's file, and law \"talus\"");
    }
    const std::vector<double> touched = touches_of(run, object_in(run, search.object, file));
    n_hits.push_back(0);
    weight.push_back(0);
    for (int block = 0; block < n_blocks(run); ++block) {
      if (!std::isfinite(touched[block])) continue;
      ++n_hits.back();
      weight.back() += weight_of(run, block);
    }
  };
  RunSet set = runs.set_of(paths, "verified." + name);
  weigh_as_classes(set, search.classes.size());
  runs.read(set, "verified." + name, wanted, take, RunSettings::with_other_fences);
  std::vector<RunMember> members(runs.members.begin() + static_cast<std::ptrdiff_t>(before),
                                 runs.members.end());
  const std::vector<double> factor = verified_factors(members, search.classes);
  VerifiedFence out;
  out.n_runs = static_cast<int>(members.size());
  std::vector<BlockWeight> hit;  // a block of each run that has any
  for (int r = 0; r < out.n_runs; ++r) {
    members[r].weight *= factor[r];
    members[r].run_weight *= factor[r];
    out.hits_a_run += members[r].run_weight * n_hits[r] / out.n_runs;
    out.weight_a_run += factor[r] * weight[r] / out.n_runs;
    if (weight[r] > 0) hit.push_back({r, 0, weight[r]});
  }
  const ShareBasis basis = share_basis(clusters_of(members), runs.last_failed_share());
  out.residual = share_of_runs(basis, hit);
  out.interval = run_share_interval(basis, hit);
  return out;
}

}  // namespace talus
