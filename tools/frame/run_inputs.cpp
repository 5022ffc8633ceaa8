// Run files and their terrain as every tool that evaluates runs takes them.
#include "tools/frame/run_inputs.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "base/sha256.hpp"
#include "base/text.hpp"
#include "io/trn_digest.hpp"
#include "post/deposit.hpp"
#include "post/reduce.hpp"
#include "site/site.hpp"
#include "tools/frame/tool.hpp"

namespace talus {
namespace {

// Files of runs that are read once and held together, where little of each is wanted: opening them
// again to check them first takes a tenth of the time of all maps.
constexpr std::uintmax_t most_at_once = 200'000'000;  // [bytes]

constexpr const char* share_key = "uncertainty.max_failed_share";

std::uintmax_t bytes_of(const std::vector<std::string>& paths) {
  std::uintmax_t sum = 0;
  for (const std::string& path : paths) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    sum += error ? 0 : size;
  }
  return sum;
}

// Contents that results depend on: which runs, and how far each came.
std::string content_of(const std::vector<RunMember>& runs) {
  std::vector<std::string> ids;
  for (const RunMember& run : runs)
    ids.push_back(run.info.run_id + " " + run.info.status + " " + text(run.info.time));
  return run_set_id(std::move(ids));
}

}  // namespace

void weigh_as_classes(RunSet& set, std::size_t n_classes) {
  if (n_classes > 1) set.weights.clear();
}

RunInputs::RunInputs(Tool& tool, RunUse use) : tool_(tool), use_(use) {
  tool.inputs("run", paths_,
              "runs of talus-dda and parts of talus-reduce (HDF5), in any order, or their folder");
  tool.input("--trn", trn_file, "terrain of the runs (GeoTIFF of talus-trn)").required();
  // the runs themselves replace them
  tool.leave_out_of_run_id({"run", "without", "compare"});
}

const Trn& RunInputs::trn() {
  if (has_trn_) return trn_;
  trn_ = read_trn(trn_file);
  has_trn_ = true;
  return trn_;
}

RunSet RunInputs::set_of(const std::vector<std::string>& paths, const std::string& role) {
  RunSet set;
  for (const std::string& path : paths) {
    if (!is_ensemble(path)) {
      set.files.push_back(path);
      continue;
    }
    const Ensemble ensemble = read_ensemble(path);
    for (std::string& file : files_of(ensemble, use_ == RunUse::evaluated)) {
      tool_.read_also(role, file);
      set.files.push_back(std::move(file));
    }
    set.n_missing += talus::n_missing(ensemble);
    if (ensemble.is_planned) set.max_failed_share = ensemble.max_failed_share;
    set.weights = ensemble.cases;
    if (set.files.empty())
      throw InputError({path}, "has no run with a result", "let talus-batch make its runs");
  }
  return set;
}

const RunSet& RunInputs::runs() {
  if (!runs_.files.empty()) return runs_;
  runs_ = set_of(paths_, "run");
  n_missing = runs_.n_missing;
  return runs_;
}

std::vector<RunSet> RunInputs::of_classes(const std::vector<HazardClass>& classes) {
  RunSet all = runs();
  weigh_as_classes(all, classes.size());
  if (classes.size() < 2) return {all};
  std::map<std::string, int> missing;
  for (const std::string& path : paths_)
    if (is_ensemble(path))
      for (const EnsembleMember& member : read_ensemble(path).members)
        missing[member.case_name] += has_result(member) ? 0 : 1;
  std::vector<RunSet> sets;
  for (const HazardClass& kind : classes) {
    sets.push_back(all);
    sets.back().only_case = kind.name;
    sets.back().n_missing = missing[kind.name];
  }
  return sets;
}

// The runs of a set, before they are put in order.
struct RunInputs::Found {
  std::vector<RunMember> members;
  std::vector<Place> places;
  std::vector<RunFile> runs;  // held; of runs of parts, and of all where not all are held, empty
  double max_failed_share = UncertaintySettings{}.max_failed_share;  // as the first run says
};

RunInputs::Found RunInputs::look_at(const RunSet& set, const RunParts& parts, bool at_once,
                                    SettingsCheck& settings, bool on_another_ground) {
  Found found;
  RunParts with_words = parts;
  with_words.words = true;
  const ProgressFunction progress = tool_.progress();
  const auto add = [&](const std::string& name, RunFile&& run, const Place& place) {
    if (!set.only_case.empty() && run.info.case_name != set.only_case) return;
    found.members.push_back(member_of(name, run));
    add_release_cells(found.members.back(), run, trn());
    if (place.part >= 0) found.members.back().part = part_files_[place.part];
    RunMember first = members.empty() ? found.members.front() : members.front();
    RunSetOptions options = set_options_;
    if (on_another_ground) {
      const RunInfo& info = found.members.front().info;
      first.info.trn_sha256 = options.trn_sha256 = info.trn_sha256;
      first.info.terrain_digest = options.trn_digest = info.terrain_digest;
    }
    check_member(found.members.back(), first, options);
    if (found.members.size() == 1) {
      const MadeWith made = made_with(run.info.config, "");
      if (made.values.contains(share_key)) found.max_failed_share = number_of(made, share_key);
    }
    settings.add(where_of(found.members.back()), run.info);
    found.places.push_back(place);
    if (!at_once || place.part >= 0) run = {};
    if (!parts.words)
      for (std::string* words : {&run.info.config, &run.info.made_with, &run.info.plan})
        std::string().swap(*words);
    std::vector<HealthRow>().swap(run.health);
    found.runs.push_back(std::move(run));
  };
  std::size_t n_read = 0;
  for (const std::string& path : set.files) {
    if (is_part_file(path)) {
      const int p = static_cast<int>(parts_.size());
      parts_.push_back({PartFile(path), {}});
      part_files_.push_back(path);
      const Part& part = parts_.back().file.part;
      parts_.back().member.assign(static_cast<std::size_t>(n_runs(part)), -1);
      for (int r = 0; r < n_runs(part); ++r) add(part.name[r], run_of(part, r), {p, r});
    } else {
      add(path, at_once ? read_run_file(path, with_words) : read_run_head(path), {});
    }
    progress(static_cast<double>(++n_read) / static_cast<double>(set.files.size()));
  }
  if (found.members.empty())
    throw InputError({set.files[0]}, "is of no case " + set.only_case + ", nor is any other run",
                     "give runs of talus-dda --variant " + set.only_case);
  return found;
}

// The limit of the runs, unless their ensemble gives one.
double RunInputs::share_allowed(const RunSet& set, const Found& found) const {
  if (use_ == RunUse::reduced) return 0;
  return std::isnan(set.max_failed_share) ? found.max_failed_share : set.max_failed_share;
}

void RunInputs::leave_out_failed(Found& found, const RunSet& set, bool is_first) {
  const auto is_failed = [](const RunMember& run) { return run.info.status == "failed"; };
  const auto n_failed = std::count_if(found.members.begin(), found.members.end(), is_failed);
  const FailedShare failed =
      talus::failed_share(static_cast<int>(found.members.size()), static_cast<int>(n_failed),
                          set.n_missing, max_failed_share_);
  last_failed_share_ = failed.share;
  if (is_first) failed_share_ = failed.share;
  if (!failed.is_left_out || n_failed == 0) return;
  Found kept;
  for (std::size_t i = 0; i < found.members.size(); ++i) {
    if (is_failed(found.members[i])) {
      left_out.push_back(std::move(found.members[i]));
      continue;
    }
    kept.members.push_back(std::move(found.members[i]));
    kept.places.push_back(found.places[i]);
    kept.runs.push_back(std::move(found.runs[i]));
  }
  found = std::move(kept);
}

void RunInputs::weigh(std::vector<RunMember>& found, const RunSet& set, bool is_first) {
  const std::vector<CaseWeight> cases = cases_of(found, set.weights);
  if (is_first) cases_ = cases;
  if (is_first) is_weighed_ = !set.weights.empty();
  if (set.weights.empty()) return;
  const std::vector<double> weights = run_weights(found, cases);
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i].run_weight = weights[i];
    found[i].weight *= weights[i];
  }
}

// Lengths of a run without frames are those that were measured when it had them.
void RunInputs::check_reach(const RunFile& run, const RunMember& member) const {
  if (!run.reach || run.reach->tolerance == path_tolerance_m) return;
  throw InputError(
      {where_of(member)},
      "has no frames, and its lengths are of paths simplified to " + text(run.reach->tolerance) +
          " m, expected " + text(path_tolerance_m) + " m",
      "give --path-tolerance-m " + text(run.reach->tolerance) + ", or runs with their frames");
}

void RunInputs::read(const RunSet& set, const std::string& role, const RunParts& parts,
                     const std::function<void(RunFile&, int)>& take, RunSettings settings) {
  const bool is_first = set_options_.trn_sha256.empty();
  if (is_first) set_options_ = {trn_file, sha256_of_file(trn_file), trn_digest(trn())};
  const bool at_once = parts.only_last_frame && bytes_of(set.files) <= most_at_once;
  SettingsCheck check =
      settings == RunSettings::with_other_fences ? settings_.for_other_fences() : SettingsCheck();
  Found found = look_at(set, parts, at_once, check, settings == RunSettings::on_another_ground);
  settings_.merge(check);
  static_cast<void>(order_by_id(found.members));  // the same run twice
  tool_.content_read(role, content_of(found.members));
  max_failed_share_ = share_allowed(set, found);
  leave_out_failed(found, set, is_first);
  weigh(found.members, set, is_first);
  const std::size_t first = members.size();
  const std::vector<int> order = order_by_id(found.members);
  for (const int i : order) {
    const Place place = found.places[i];
    if (place.part >= 0) parts_[place.part].member[place.run] = static_cast<int>(members.size());
    members.push_back(std::move(found.members[i]));
    places_.push_back(place);
  }
  if (is_first || !set.only_case.empty()) n_first_ = members.size();
  const auto hand_over = [&](RunFile& run, int i) {
    members[i].n_moving = balance_of(run, rest_speed_m_s).n_moving;
    check_reach(run, members[i]);
    take(run, i);
  };
  if (at_once) {
    for (std::size_t k = 0; k < order.size(); ++k) {
      const Place place = places_[first + k];
      RunFile run = place.part >= 0 ? run_of(parts_[place.part].file.part, place.run)
                                    : std::move(found.runs[order[k]]);
      run.run_weight = members[first + k].run_weight;
      hand_over(run, static_cast<int>(first + k));
    }
    return;
  }
  read_members(first, parts, [&](RunFile& run, int i) {
    RunMember whole = member_of(members[i].file, run);
    whole.part = std::move(members[i].part);
    whole.settings = std::move(members[i].settings);
    whole.measure = std::move(members[i].measure);
    whole.draws_for_all = members[i].draws_for_all;
    add_release_cells(whole, run, trn());
    members[i] = std::move(whole);
    hand_over(run, i);
  });
}

void RunInputs::read_again(const RunParts& parts, const std::function<void(RunFile&, int)>& take) {
  read_members(0, parts, take);
}

RunFile RunInputs::read_member(std::size_t i, const RunParts& parts) const {
  const Place place = places_[i];
  RunFile run = place.part >= 0 ? run_of(parts_[place.part].file.part, place.run)
                                : read_run_file(members[i].file, parts);
  run.run_weight = members[i].run_weight;
  return run;
}

MapPlaces RunInputs::places() const {
  constexpr std::size_t most_sets = 100;
  const RunParts parts{.frames = false,
                       .passages = false,
                       .health = false,
                       .checkpoint = false,
                       .words = false,
                       .trees = false};
  MapPlaces out;
  std::set<std::string> known;
  for (std::size_t i = 0; i < n_first_ && known.size() < most_sets; ++i)
    if (known.insert(members[i].info.blocks_hash).second) add_places(out, read_member(i, parts));
  return out;
}

void RunInputs::read_members(std::size_t first, const RunParts& parts,
                             const std::function<void(RunFile&, int)>& take) {
  const ProgressFunction progress = tool_.progress();
  const auto n = static_cast<double>(members.size() - first);
  for (std::size_t i = first; i < members.size(); ++i) {
    progress(static_cast<double>(i - first) / n);
    RunFile run = read_member(i, parts);
    take(run, static_cast<int>(i));
  }
  progress(1);
}

void RunInputs::warn_of_ends() const {
  int moving = 0, released = 0;
  std::int64_t left = 0;
  for (const RunMember& member : members) {
    moving += member.n_moving;
    released += member.n_blocks;
    left += member.left_domain;
  }
  if (left > 0)
    tool_.warn(std::to_string(left) + " of " + std::to_string(released) +
               " blocks left the known terrain: maps and run-out end where it does");
  if (moving > 0)
    tool_.warn(std::to_string(moving) + " of " + std::to_string(released) +
               " blocks were still moving when their runs ended: deposits leave them out; give "
               "talus-dda a longer [solver] duration_s");
}

std::string RunInputs::run_set() const {
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < n_first_; ++i) ids.push_back(members[i].info.run_id);
  return run_set_id(std::move(ids));
}

void RunInputs::read_parts(
    const std::function<void(const RunFile&, const std::vector<Passage>&, int)>& take) const {
  for (const PartInput& part : parts_) {
    std::vector<std::vector<Passage>> rows(part.member.size());
    for_each_strip(part.file, 1, {}, std::numeric_limits<std::uint64_t>::max(),
                   [&](const auto& by_run) {
                     for (std::size_t r = 0; r < by_run.size(); ++r)
                       rows[r].insert(rows[r].end(), by_run[r].begin(), by_run[r].end());
                   });
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (part.member[r] < 0) continue;
      RunFile run = run_of(part.file.part, static_cast<int>(r));
      run.run_weight = members[part.member[r]].run_weight;
      take(run, rows[r], part.member[r]);
    }
  }
}

std::string RunInputs::remark() const {
  const RunFaults faults = faults_of(members, left_out);
  std::string words = text(faults), short_words = headline(faults), few = left_out_text(faults);
  if (n_missing > 0) {
    const int n_wanted = static_cast<int>(n_first_ + left_out.size()) + n_missing;
    const std::string missing =
        std::to_string(n_missing) + " of " + std::to_string(n_wanted) + " runs missing";
    const auto add = [&missing](std::string& to) { to += (to.empty() ? "" : "; ") + missing; };
    if (n_missing + static_cast<int>(left_out.size()) <= max_failed_share_ * n_wanted) {
      add(few);
    } else {
      add(words);
      add(short_words);
    }
  }
  if (const std::string repeats = repeats_text(members); !repeats.empty()) {
    short_words += (short_words.empty() ? "" : "; ") + repeats;
    tool_.warn(repeats +
               "; they count as one in every interval. Give [solver] start_jitter_m_s (1e-4 does), "
               "or another scatter, so that seeds differ");
  }
  if (pools_unasked()) {
    const std::string pooled = "runs of " + std::to_string(cases_.size()) +
                               " cases pooled, each run alike: no probability";
    short_words += (short_words.empty() ? "" : "; ") + pooled;
    tool_.warn(pooled + " (" + text(cases_) +
               "): make them by talus-batch, which weighs them, or evaluate the folder of one");
  }
  if (!few.empty()) tool_.warn(few + ": the intervals of shares count them");
  if (!words.empty()) tool_.warn(words + ": every output says so");
  return short_words;
}

void mark_layers(std::vector<VectorLayer>& layers, const std::string& remark) {
  if (remark.empty()) return;
  for (VectorLayer& layer : layers) layer.description += " (" + remark + ")";
}

}  // namespace talus
