#include "tools/frame/run_inputs.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "base/read_file.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "io/trn_digest.hpp"
#include "post/deposit.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/options.hpp"

namespace talus {
namespace {

// Files of runs that are read once and held together, where little of each is wanted: opening them
// again to check them first takes a tenth of the time of all maps.
constexpr std::uintmax_t most_at_once = 200'000'000;  // [bytes]

std::uintmax_t bytes_of(const std::vector<std::string>& paths) {
  std::uintmax_t sum = 0;
  for (const std::string& path : paths) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    sum += error ? 0 : size;
  }
  return sum;
}

// What results depend on: which runs, and how far each came.
std::string content_of(const std::vector<RunMember>& runs) {
  std::vector<std::string> ids;
  for (const RunMember& run : runs)
    ids.push_back(run.info.run_id + " " + run.info.status + " " + text(run.info.time));
  return run_set_id(std::move(ids));
}

CaseWeight case_weight(const std::string& text) {
  const std::size_t at = text.rfind('=');
  CaseWeight out{text.substr(0, std::min(at, text.size())), 0, 0};
  if (at == std::string::npos || !parse_double(text.substr(at + 1), out.weight)) out.weight = 0;
  return out;
}

std::string check_case_weight(const std::string& text) {
  const double weight = case_weight(text).weight;
  return weight >= 1e-9 && weight <= 1e9 ? ""
                                         : text +
                                               " is no weight of a case, expected NAME=WEIGHT "
                                               "with a weight from 1e-9 to 1e9";
}

}  // namespace

RunInputs::RunInputs(Tool& tool, RunUse use) : tool_(tool) {
  tool.inputs("run", files_, "runs of talus-dda and parts of talus-reduce (HDF5), in any order")
      ->required(false);
  tool.input("--runs-from", runs_from_, "list of runs and parts, a line each, taken as well");
  tool.input("--trn", trn_file, "terrain of the runs (GeoTIFF of talus-trn)")->required();
  tool.flag("--allow-unfinished", allow_unfinished,
            "take runs that were interrupted before their end; every output is marked");
  tool.leave_out_of_run_id({"run", "runs-from", "without", "without-from", "compare",
                            "compare-from"});  // the runs themselves stand for them
  if (use == RunUse::reduced) {
    max_failed_share = 0;
    return;
  }
  tool.option("--rest-speed-m-s", rest_speed_m_s,
              "blocks slower than this at the end count as deposited [m/s]")
      ->check(number_between(0, 1000));
  tool.option("--missing", n_missing,
              "runs that were wanted and are not there: every output says so")
      ->check(number_between(0, 1e9));
  tool.option("--max-failed-share", max_failed_share,
              "up to this share, runs that failed are left out and widen the intervals; of more, "
              "every output says so")
      ->check(number_between(0, 1));
  tool.option("--case-weight", weights_given,
              "NAME=WEIGHT: what a case (run_NAME_SEED.h5) counts among the others; of each case")
      ->allow_extra_args(false)
      ->check(check_case_weight);
  tool.option("--only-case", only_case, "takes the runs of this case alone");
}

const Trn& RunInputs::trn() {
  if (has_trn_) return trn_;
  trn_ = read_trn(trn_file);
  has_trn_ = true;
  return trn_;
}

const std::vector<std::string>& RunInputs::files() {
  if (has_listed_) return files_;
  has_listed_ = true;
  for (const std::string& path : listed_files(runs_from_)) {
    tool_.read_also("run", path);
    files_.push_back(path);
  }
  if (files_.empty() && runs_from_.empty())
    throw UsageError({"", 0, "run"}, "no run is named", "give RUN.h5..., or --runs-from FILE");
  if (files_.empty()) throw InputError({runs_from_}, "names no run", "give it a line a run");
  return files_;
}

// The runs of a set, before they are put in order.
struct RunInputs::Found {
  std::vector<RunMember> members;
  std::vector<Place> places;
  std::vector<RunFile> runs;  // held; of runs of parts, and of all where not all are held, empty
};

RunInputs::Found RunInputs::look_at(const std::vector<std::string>& paths, const RunParts& parts,
                                    bool at_once, SettingsCheck& settings) {
  Found found;
  RunParts with_words = parts;
  with_words.words = true;
  const ProgressFunction progress = tool_.progress();
  const auto add = [&](const std::string& name, RunFile&& run, const Place& place) {
    found.members.push_back(member_of(name, run));
    if (place.part >= 0) found.members.back().part = part_files_[place.part];
    check_member(found.members.back(), members.empty() ? found.members.front() : members.front(),
                 set_options_);
    settings.add(name, where_of(found.members.back()), run.info);
    found.places.push_back(place);
    if (!at_once || place.part >= 0) run = {};
    if (!parts.words)
      for (std::string* words : {&run.info.config, &run.info.made_with, &run.info.plan})
        std::string().swap(*words);
    std::vector<HealthRow>().swap(run.health);
    found.runs.push_back(std::move(run));
  };
  std::size_t n_read = 0;
  for (const std::string& path : paths) {
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
    progress(static_cast<double>(++n_read) / static_cast<double>(paths.size()));
  }
  return found;
}

void RunInputs::leave_out_failed(Found& found, bool is_first) {
  const auto is_failed = [](const RunMember& run) { return run.info.status == "failed"; };
  const auto n_failed = std::count_if(found.members.begin(), found.members.end(), is_failed);
  const FailedShare failed =
      talus::failed_share(static_cast<int>(found.members.size()), static_cast<int>(n_failed),
                          is_first ? n_missing : 0, max_failed_share);
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

void RunInputs::take_one_case(Found& found) const {
  if (only_case.empty() || found.members.empty()) return;
  Found kept;
  for (std::size_t i = 0; i < found.members.size(); ++i) {
    if (case_of(found.members[i].file) != only_case) continue;
    kept.members.push_back(std::move(found.members[i]));
    kept.places.push_back(found.places[i]);
    kept.runs.push_back(std::move(found.runs[i]));
  }
  if (kept.members.empty())
    throw InputError(
        {"", 0, "--only-case"}, "no run is of case '" + only_case + "'",
        "cases are those of the names run_CASE_SEED.h5: " + text(cases_of(found.members, {})));
  found = std::move(kept);
}

void RunInputs::weigh(std::vector<RunMember>& found, bool is_first) {
  std::vector<CaseWeight> given;
  for (const std::string& one : weights_given) given.push_back(case_weight(one));
  const std::vector<CaseWeight> cases = cases_of(found, given);
  if (is_first) cases_ = cases;
  if (given.empty()) return;
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

void RunInputs::read(const std::vector<std::string>& paths, const std::string& role,
                     const RunParts& parts, const std::function<void(RunFile&, int)>& take,
                     RunSettings settings) {
  const bool is_first = set_options_.trn_sha256.empty();
  if (is_first)
    set_options_ = {allow_unfinished, trn_file, sha256_of_file(trn_file), trn_digest(trn())};
  const bool at_once = parts.only_last_frame && bytes_of(paths) <= most_at_once;
  SettingsCheck check =
      settings == RunSettings::with_other_fences ? settings_.for_other_fences() : SettingsCheck();
  Found found = look_at(paths, parts, at_once, check);
  settings_.merge(check);
  take_one_case(found);
  static_cast<void>(order_by_id(found.members));  // the same run twice
  tool_.content_read(role, content_of(found.members));
  leave_out_failed(found, is_first);
  weigh(found.members, is_first);
  const std::size_t first = members.size();
  const std::vector<int> order = order_by_id(found.members);
  for (const int i : order) {
    const Place place = found.places[i];
    if (place.part >= 0) parts_[place.part].member[place.run] = static_cast<int>(members.size());
    members.push_back(std::move(found.members[i]));
    places_.push_back(place);
  }
  if (is_first) n_first_ = members.size();
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
    const std::string part = members[i].part;
    members[i] = member_of(members[i].file, run);
    members[i].part = part;
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
  for (std::size_t i = 0; i < members.size() && known.size() < most_sets; ++i)
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

std::string RunInputs::remark() const {
  const RunFaults faults = faults_of(members, left_out);
  std::string words = text(faults), short_words = headline(faults), few = left_out_text(faults);
  if (n_missing > 0) {
    const int n_wanted = static_cast<int>(n_first_ + left_out.size()) + n_missing;
    const std::string missing =
        std::to_string(n_missing) + " of " + std::to_string(n_wanted) + " runs missing";
    const auto add = [&missing](std::string& to) { to += (to.empty() ? "" : "; ") + missing; };
    if (n_missing + static_cast<int>(left_out.size()) <= max_failed_share * n_wanted) {
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
               "): give --case-weight NAME=WEIGHT of each, or --only-case NAME");
  }
  if (!few.empty()) tool_.warn(few + ": the intervals of shares count them");
  if (!words.empty()) tool_.warn(words + ": every output says so");
  return short_words;
}

std::vector<std::string> listed_files(const std::string& list) {
  std::vector<std::string> files;
  if (list.empty()) return files;
  std::istringstream lines(read_file(list));
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with("\r")) line.pop_back();
    if (!line.empty()) files.push_back(line);
  }
  return files;
}

void mark_layers(std::vector<VectorLayer>& layers, const std::string& remark) {
  if (remark.empty()) return;
  for (VectorLayer& layer : layers) layer.description += " (" + remark + ")";
}

}  // namespace talus
