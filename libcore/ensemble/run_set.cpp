// Runs that are evaluated together: reading, agreement, order, health, failed ones.
#include "ensemble/run_set.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <tuple>

#include "base/error.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "ensemble/made_with.hpp"
#include "record/pieces.hpp"

namespace talus {
namespace {

bool has_ended(const RunInfo& info) { return info.status == "done" || info.status == "failed"; }

// "5 of 8 s"
std::string time_reached(const RunInfo& info) {
  return text(info.time, 4) + " of " + text(info.duration, 4) + " s";
}

std::string fault_words(const RunInfo& info) {
  return info.time < info.duration ? info.reason + "; ended at " + time_reached(info) : info.reason;
}

// "1 of 12 runs failed its numerical checks"
std::string count_words(std::size_t n, int n_runs, const char* one, const char* several) {
  return std::to_string(n) + " of " + counted(n_runs, "run") + (n == 1 ? one : several);
}

// ": run_3 (...), run_7 (...) and 4 more"
std::string first_few(const std::vector<RunFault>& faults) {
  constexpr std::size_t most = 5;
  std::string out;
  for (std::size_t i = 0; i < std::min(most, faults.size()); ++i)
    out += (i == 0 ? ": " : ", ") + faults[i].name + " (" + faults[i].words + ")";
  return faults.size() <= most ? out
                               : out + " and " + std::to_string(faults.size() - most) + " more";
}

std::string words_of(const RunFaults& faults, bool with_list) {
  if (faults.failed.empty()) return "";
  return count_words(faults.failed.size(), faults.n_runs, " failed its numerical checks",
                     " failed their numerical checks") +
         (with_list ? first_few(faults.failed) : "");
}

std::string file_name(const std::string& file) {
  return std::filesystem::path(file).stem().string();
}

void check_same(const std::string& mine, const std::string& other, const char* what,
                const RunMember& run, const RunMember& first, const char* hint) {
  if (mine == other) return;
  throw InputError(
      {where_of(run)},
      std::string(what) + " is " + mine + ", expected " + other + " as in " + where_of(first),
      hint);
}

std::string text_of(const PassageGrid& grid) {
  return text(grid.cell_size) + " m cells, " + std::to_string(grid.n_rows) + " x " +
         std::to_string(grid.n_cols) + " from " + text(grid.corner.x()) + ", " +
         text(grid.corner.y());
}

}  // namespace

RunMember member_of(const std::string& file, const RunFile& run) {
  RunMember member;
  member.file = file;
  member.info = run.info;
  member.grid = run.grid;
  member.n_blocks = n_blocks(run);
  member.n_released = count_different(released_of(run));
  member.run_weight = run.run_weight;
  member.settings = settings_digest(run.info);
  const MadeWith made = made_with(run.info.config, "");
  member.draws_for_all = draws_for_all(made);
  for (const std::string& name : made.measures)
    member.measure += (member.measure.empty() ? "" : " + ") + name;
  for (std::string* words : {&member.info.config, &member.info.made_with, &member.info.plan})
    std::string().swap(*words);
  for (int block = 0; block < member.n_blocks; ++block) member.weight += weight_of(run, block);
  for (const HealthRow& row : run.health) {
    member.largest_penetration = std::max(member.largest_penetration, row.largest_penetration);
    member.unconverged += row.unconverged;
    member.left_domain = row.left_domain;  // these three count from the start
    member.fell_through = row.fell_through;
    member.not_finite = row.not_finite;
  }
  return member;
}

void add_release_cells(RunMember& member, const RunFile& run, const Trn& trn) {
  if (!run.info.independent) return;
  member.block_weight = run.blocks.weight;
  for (const Pose& rest : run.blocks.rest)
    member.release_cell.push_back(triangle_at(trn, rest.position.x(), rest.position.y()) / 2);
}

std::vector<CaseWeight> cases_of(const std::vector<RunMember>& runs,
                                 const std::vector<CaseWeight>& given) {
  std::map<std::string, CaseWeight> by_name;
  for (const CaseWeight& one : given) by_name[one.name] = {one.name, one.weight, 0};
  for (const RunMember& run : runs) {
    const std::string name = run.info.case_name;
    if (!given.empty() && !by_name.contains(name))
      throw InputError({where_of(run)}, "is of case '" + name + "', which has no weight",
                       "give each case of the runs its weight, or leave its runs out");
    by_name[name].name = name;
    ++by_name[name].n_runs;
  }
  std::vector<CaseWeight> cases;
  double sum = 0;
  for (auto& [name, one] : by_name) {
    if (one.n_runs == 0)
      throw InputError({}, "case '" + name + "' has a weight and no run",
                       "compute runs of it, or give no weight to it");
    if (given.empty()) one.weight = one.n_runs;
    sum += one.weight;
    cases.push_back(one);
  }
  for (CaseWeight& one : cases) one.weight /= sum;
  return cases;
}

std::vector<double> run_weights(const std::vector<RunMember>& runs,
                                const std::vector<CaseWeight>& cases) {
  std::map<std::string, double> factor;
  for (const CaseWeight& one : cases)
    factor[one.name] = one.weight * static_cast<double>(runs.size()) / one.n_runs;
  std::vector<double> weights;
  for (const RunMember& run : runs) weights.push_back(factor[run.info.case_name]);
  return weights;
}

std::string text(const std::vector<CaseWeight>& cases) {
  std::string words;
  for (const CaseWeight& one : cases)
    words += (words.empty() ? "" : ", ") + (one.name.empty() ? "no name" : one.name) + " " +
             text(one.weight, 3) + " (" + counted(one.n_runs, "run") + ")";
  return words;
}

std::vector<CaseWeight> case_shares(const std::vector<RunMember>& runs) {
  std::map<std::string, CaseWeight> by_name;
  for (const RunMember& run : runs) {
    CaseWeight& one = by_name.try_emplace(run.info.case_name, CaseWeight{"", 0, 0}).first->second;
    one.name = run.info.case_name;
    one.weight += run.run_weight / static_cast<double>(runs.size());
    ++one.n_runs;
  }
  std::vector<CaseWeight> cases;
  for (const auto& [name, one] : by_name) cases.push_back(one);
  return cases;
}

std::string where_of(const RunMember& run) {
  return run.part.empty() ? run.file : run.part + " (" + run.file + ")";
}

void check_member(const RunMember& run, const RunMember& first, const RunSetOptions& options) {
  if (!has_ended(run.info))
    throw InputError({where_of(run)},
                     "the run is " + run.info.status + " at " + time_reached(run.info) +
                         ", expected one that has ended",
                     "let talus-dda finish it (--resume)");
  const bool on_bed = !run.info.terrain_digest.empty() &&
                      run.info.terrain_digest == options.trn_digest &&
                      first.info.terrain_digest == options.trn_digest;
  if (!on_bed && !run.info.trn_sha256.empty() && run.info.trn_sha256 != options.trn_sha256)
    throw InputError(
        {where_of(run)},
        "was computed on another terrain than " + options.trn_file + " (SHA-256 " +
            run.info.trn_sha256.substr(0, 16) + ", not " + options.trn_sha256.substr(0, 16) + ")",
        run.info.terrain_digest.empty()
            ? "give the TRN that talus-dda was given"
            : "runs of several rock masses are evaluated on the terrain that they were "
              "cut from (talus-trn)");
  check_same(run.info.site, first.info.site, "the site", run, first,
             "evaluate each site by itself");
  if (!on_bed)
    check_same(run.info.trn_sha256, first.info.trn_sha256, "the terrain's SHA-256", run, first,
               "evaluate runs on one terrain together");
  check_same(run.info.version, first.info.version, "the version of the program", run, first,
             "compute all runs with one version");
  check_same(text_of(run.grid), text_of(first.grid), "the grid of passages", run, first,
             "compute all runs with the same [output] cell_size_m");
  if (run.info.origin != first.info.origin)
    throw InputError({where_of(run)}, "has another local origin than " + where_of(first),
                     "compute all runs from the same TRN");
}

std::vector<int> order_by_id(const std::vector<RunMember>& runs) {
  std::vector<int> order(runs.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&runs](int a, int b) { return runs[a].info.run_id < runs[b].info.run_id; });
  for (std::size_t i = 1; i < order.size(); ++i) {
    const RunMember &a = runs[order[i - 1]], &b = runs[order[i]];
    if (a.info.run_id == b.info.run_id)
      throw InputError({where_of(b)},
                       "is the same run as " + where_of(a) + " (id " + a.info.run_id + ")",
                       "name each run once; give runs different seeds");
  }
  return order;
}

namespace {

// A number from 0 for each run, equal where the keys are; `n`: how many there are.
std::vector<int> numbered(const std::vector<std::string>& keys, std::size_t& n) {
  std::map<std::string, int> known;
  std::vector<int> number;
  for (const std::string& key : keys)
    number.push_back(known.try_emplace(key, static_cast<int>(known.size())).first->second);
  n = known.size();
  return number;
}

// Equal for runs that are the same but for a seed that draws nothing.
std::vector<std::string> sameness(std::span<const RunMember> runs) {
  std::vector<std::string> keys;
  for (const RunMember& run : runs)
    keys.push_back(run.info.seed_draws ? "run " + std::to_string(keys.size()) : run.settings);
  return keys;
}

}  // namespace

std::vector<int> units_of(std::span<const RunMember> runs) {
  std::size_t n = 0;
  std::vector<std::string> masses;
  for (const RunMember& run : runs)
    if (!run.info.terrain_digest.empty()) masses.push_back(run.info.blocks_hash);
  if (masses.size() == runs.size()) {
    std::vector<int> unit = numbered(masses, n);
    if (n > 1 && n < runs.size()) return unit;
  }
  std::vector<int> unit = numbered(sameness(runs), n);
  if (n == runs.size()) unit.clear();
  return unit;
}

int n_repeats(const std::vector<RunMember>& runs) {
  std::size_t n = 0;
  numbered(sameness(runs), n);
  return static_cast<int>(runs.size() - n);
}

std::string repeats_text(const std::vector<RunMember>& runs) {
  const int n = n_repeats(runs);
  if (n == 0) return "";
  return std::to_string(n) + " of " + std::to_string(runs.size()) +
         (n == 1 ? " runs repeats another one: its seed draws nothing"
                 : " runs repeat another one: their seeds draw nothing");
}

std::vector<std::string> names_of(const std::vector<RunMember>& runs) {
  std::map<std::string, int> count;
  for (const RunMember& run : runs) ++count[file_name(run.file)];
  std::vector<std::string> names;
  for (const RunMember& run : runs) {
    const std::string name = file_name(run.file);
    const auto folder = std::filesystem::absolute(run.file).parent_path().filename();
    names.push_back(count[name] == 1 ? name : (folder / name).string());
  }
  return names;
}

RunFaults faults_of(const std::vector<RunMember>& runs, const std::vector<RunMember>& left_out) {
  std::vector<RunMember> all = runs;
  all.insert(all.end(), left_out.begin(), left_out.end());
  const std::vector<std::string> names = names_of(all);
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(all[a].info.seed, names[a], all[a].info.run_id) <
           std::tie(all[b].info.seed, names[b], all[b].info.run_id);
  });
  RunFaults faults{static_cast<int>(runs.size()), {}, {}};
  for (const std::size_t i : order) {
    const RunInfo& info = all[i].info;
    if (info.status != "failed") continue;
    std::vector<RunFault>& list = i >= runs.size() ? faults.left_out : faults.failed;
    list.push_back({names[i], info.run_id, info.seed, fault_words(info)});
  }
  return faults;
}

FailedShare failed_share(int n_runs, int n_failed, int n_missing, double most) {
  const double wanted = n_runs + n_missing;
  const bool few = n_failed < n_runs && n_failed + n_missing <= most * wanted;
  return {((few ? n_failed : 0) + n_missing) / wanted, few};
}

std::string headline(const RunFaults& faults) { return words_of(faults, false); }
std::string text(const RunFaults& faults) { return words_of(faults, true); }
std::string left_out_text(const RunFaults& faults) {
  if (faults.left_out.empty()) return "";
  const int n_all = faults.n_runs + static_cast<int>(faults.left_out.size());
  return count_words(faults.left_out.size(), n_all, " failed its numerical checks and is left out",
                     " failed their numerical checks and are left out") +
         first_few(faults.left_out);
}

std::string run_set_id(std::vector<std::string> run_ids) {
  std::sort(run_ids.begin(), run_ids.end());
  Sha256 hash;
  for (const std::string& id : run_ids) hash.add(id.c_str(), id.size() + 1);
  return hash.hex().substr(0, 16);
}

std::vector<std::string> warnings_of(const std::vector<RunMember>& runs) {
  std::set<std::string> lines;
  for (const RunMember& run : runs) {
    std::istringstream text(run.info.warnings);
    for (std::string line; std::getline(text, line);) lines.insert(line);
  }
  return {lines.begin(), lines.end()};
}

}  // namespace talus
