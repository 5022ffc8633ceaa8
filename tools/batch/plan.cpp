// Plan of a batch: the wanted runs, their files and commands, and which of them exist.
#include "tools/batch/plan.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "base/error.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "ensemble/made_with.hpp"
#include "io/blocks_hdf5.hpp"
#include "site/uncertainty.hpp"
#include "tools/batch/processes.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/tool.hpp"

namespace talus {
namespace {

namespace fs = std::filesystem;

std::string in(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).lexically_normal().string();
}

// Variants with a weight, by name.
std::vector<CaseWeight> alternatives_of(const Site& site) {
  std::vector<CaseWeight> out;
  for (const VariantSettings& variant : site.variants)
    if (is_alternative(variant)) out.push_back({variant.name, variant.weight, 0});
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return out;
}

BatchPart part_of(const std::string& words) {
  BatchPart part;
  if (words.empty()) return part;
  const std::size_t slash = words.find('/');
  double number = 0, n_parts = 0;
  if (slash == std::string::npos || !parse_double(words.substr(0, slash), number) ||
      !parse_double(words.substr(slash + 1), n_parts) || number < 0 || number > n_parts ||
      n_parts < 1 || number != std::floor(number) || n_parts != std::floor(n_parts))
    throw UsageError({"", 0, "--part"}, "is " + words + ", expected K/N with K up to N",
                     "e.g. --part 1/8");
  return {static_cast<int>(number), static_cast<int>(n_parts)};
}

// --- inputs of the runs
// ---------------------------------------------------------------------------

// Inputs of a run of the case, as talus-dda reports them.
RunInfo asked(const BatchPlan& plan, const EnsembleMember& member) {
  std::vector<std::string> words = run_words(plan, member);
  for (const char* word : {"--plan", "--json", "--no-db", "-q"}) words.emplace_back(word);
  const Json json = output_of(words);
  RunInfo info;
  info.case_name = member.case_name;
  json.at("config").get_to(info.config);
  json.at("made_with").get_to(info.made_with);
  json.at("trn_sha256").get_to(info.trn_sha256);
  json.at("blocks_hash").get_to(info.blocks_hash);
  return info;
}

// Blocks and bed of each mass.
struct RockMass {
  std::string blocks_hash, trn_sha256;
};

void say_what_differs(const BatchPlan& plan, const std::map<std::string, RunInfo>& now,
                      Tool& tool) {
  std::set<std::string> said;
  for (const EnsembleMember& member : plan.ensemble.members) {
    const std::string file = in(plan.folder, member.file);
    if (member.outcome != Outcome::not_started || member.digest.empty() ||
        !said.insert(member.case_name).second)
      continue;
    const std::string words = what_differs(now.at(member.case_name), read_run_head(file).info);
    tool.info(file + " is made again: it was made with other settings" +
              (words.empty() ? "" : ": " + words));
  }
}

}  // namespace

BatchPlan plan_of(const Site& site, const std::vector<std::string>& site_words,
                  const BatchOptions& options) {
  BatchPlan plan;
  plan.site_words = site_words;
  plan.results = options.results;
  plan.folder = in(options.results, options.into);
  plan.first_seed = options.seed < 0 ? site.solver.seed : options.seed;
  plan.draws_samples = !site.quantities.empty() || site.uncertainty.rock_masses > 0;
  plan.rock_masses = site.uncertainty.rock_masses;
  plan.dda_options = options.dda_options;
  plan.launcher = options.launcher;
  plan.part = part_of(options.part);
  plan.ensemble.folder = plan.folder;
  plan.ensemble.is_planned = true;
  plan.ensemble.max_failed_share = site.uncertainty.max_failed_share;
  plan.ensemble.cases = alternatives_of(site);
  for (const VariantSettings& variant : site.variants)
    if (is_alternative(variant)) plan.cases.push_back(variant.name);
  if (plan.cases.empty()) plan.cases.emplace_back();
  if (plan.draws_samples && plan.first_seed == 0)
    throw UsageError({"", 0, "--seed"}, "is 0: samples of [uncertainty] count from 1");
  return plan;
}

void set_runs(BatchPlan& plan, int n_runs) {
  std::map<std::string, EnsembleMember> known;
  for (const Ensemble& from : {stored_ensemble(plan.folder), plan.ensemble})
    for (const EnsembleMember& member : from.members) known[member.file] = member;
  plan.ensemble.members.clear();
  for (const std::string& name : plan.cases)
    for (int i = 0; i < n_runs; ++i) {
      const std::int64_t seed = plan.first_seed + i;
      const std::string file =
          (name.empty() ? "" : name + "/") + "run_" + std::to_string(seed) + ".h5";
      EnsembleMember member = known[file];
      member.file = file;
      member.case_name = name;
      member.seed = seed;
      member.sample = plan.draws_samples ? seed : 0;
      plan.ensemble.members.push_back(std::move(member));
    }
}

std::int64_t mass_of(const BatchPlan& plan, const EnsembleMember& member) {
  UncertaintySettings uncertainty;
  uncertainty.sample = member.sample;
  uncertainty.rock_masses = plan.rock_masses;
  return rock_mass(uncertainty);
}

std::string rock_file(const BatchPlan& plan, const char* name, const char* end, std::int64_t mass) {
  return in(plan.results, mass > 0 ? std::string("rock/") + name + "_" + std::to_string(mass) + end
                                   : std::string(name) + end);
}

std::string ground_of(const BatchPlan& plan) {
  return in(plan.results, plan.rock_masses > 0 ? "trn.tif" : "bed.tif");
}

void compare_with_now(BatchPlan& plan, Tool& tool, bool says) {
  std::map<std::string, RunInfo> now;       // by case
  std::map<std::int64_t, RockMass> masses;  // but for the one that was asked with
  for (EnsembleMember& member : plan.ensemble.members) {
    const std::int64_t mass = mass_of(plan, member);
    const std::string blocks = rock_file(plan, "blocks", ".h5", mass),
                      bed = rock_file(plan, "bed", ".tif", mass);
    member.wanted = "unknown";
    if (!fs::exists(blocks) || !fs::exists(bed)) continue;
    if (!now.contains(member.case_name)) now[member.case_name] = asked(plan, member);
    RunInfo info = now[member.case_name];
    if (mass > 0) {
      if (!masses.contains(mass))
        masses[mass] = {read_blocks(blocks).content_hash, sha256_of_file(bed)};
      info.blocks_hash = masses[mass].blocks_hash;
      info.trn_sha256 = masses[mass].trn_sha256;
    }
    member.wanted = settings_digest(info);
  }
  bring_up_to_date(plan.ensemble);
  if (says && !now.empty()) say_what_differs(plan, now, tool);
}

std::vector<std::size_t> to_make(const BatchPlan& plan) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < plan.ensemble.members.size(); ++i)
    if (!has_result(plan.ensemble.members[i])) list.push_back(i);
  return list;
}

std::vector<std::size_t> to_make_here(const BatchPlan& plan) {
  std::vector<std::size_t> list = to_make(plan);
  std::erase_if(list, [&plan](std::size_t run) { return !plan.part.has(run); });
  return list;
}

std::vector<std::string> tool_words(const BatchPlan& plan, const std::string& tool) {
  std::vector<std::string> words;
  std::istringstream launcher(plan.launcher);
  for (std::string word; std::getline(launcher, word, ' ');)
    if (!word.empty()) words.push_back(word);
  if (words.empty() || plan.launcher.ends_with(' ')) words.emplace_back();
  words.back() += tool;
  return words;
}

std::vector<std::string> run_words(const BatchPlan& plan, const EnsembleMember& member) {
  const std::int64_t mass = mass_of(plan, member);
  std::vector<std::string> words = tool_words(plan, "talus-dda");
  const auto add = [&words](std::initializer_list<std::string> more) {
    words.insert(words.end(), more);
  };
  words.insert(words.end(), plan.site_words.begin(), plan.site_words.end());
  if (!member.case_name.empty()) add({"--variant", member.case_name});
  add({"--trn", rock_file(plan, "bed", ".tif", mass), "--blocks",
       rock_file(plan, "blocks", ".h5", mass), "--seed", std::to_string(member.seed)});
  if (member.sample > 0) add({"--sample", std::to_string(member.sample)});
  words.insert(words.end(), plan.dda_options.begin(), plan.dda_options.end());
  return words;
}

namespace {

// One of a case alone, in its own folder.
Ensemble of_case(const Ensemble& all, const std::string& name) {
  Ensemble out = all;
  out.folder = in(all.folder, name);
  out.cases.clear();
  out.parts.clear();
  out.differs.clear();
  std::erase_if(out.members, [&name](const auto& member) { return member.case_name != name; });
  for (EnsembleMember& member : out.members) member.file = member.file.substr(name.size() + 1);
  return out;
}

// Parts of talus-reduce all of whose runs are wanted.
std::vector<std::string> parts_of(const BatchPlan& plan) {
  std::set<std::string> keys;
  for (const EnsembleMember& member : plan.ensemble.members)
    if (has_result(member)) keys.insert(key_of(member));
  std::vector<std::string> parts;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(parts_folder(plan), error)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".h5") || name[0] == '.') continue;
    const std::vector<std::string> in_part = keys_in_part(entry.path().string());
    if (!in_part.empty() && std::all_of(in_part.begin(), in_part.end(),
                                        [&keys](const auto& key) { return keys.contains(key); }))
      parts.push_back(fs::relative(entry.path(), plan.folder).string());
  }
  std::sort(parts.begin(), parts.end());
  return parts;
}

std::vector<Ensemble> ensembles_of(BatchPlan& plan) {
  plan.ensemble.parts = parts_of(plan);
  bring_up_to_date(plan.ensemble);
  std::vector<Ensemble> list{plan.ensemble};
  if (plan.cases.size() < 2) return list;
  for (const std::string& name : plan.cases) {
    list.push_back(of_case(plan.ensemble, name));
    bring_up_to_date(list.back());
  }
  return list;
}

}  // namespace

std::string parts_folder(const BatchPlan& plan) {
  const std::string into = fs::path(plan.folder).lexically_relative(plan.results).string();
  return in(plan.results, into == "runs" ? "parts" : "parts/" + into);
}

void write_ensembles(BatchPlan& plan) {
  for (Ensemble& ensemble : ensembles_of(plan)) {
    fs::create_directories(ensemble.folder);
    write_ensemble(ensemble);
  }
}

bool are_written(BatchPlan& plan) {
  const std::vector<Ensemble> list = ensembles_of(plan);
  return std::all_of(list.begin(), list.end(), is_written);
}

}  // namespace talus
