// ensemble/ensemble.hpp as JSON: reads, brings up to date and writes ensemble.json.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "base/error.hpp"
#include "base/file_paths.hpp"
#include "base/json.hpp"
#include "base/write_bytes.hpp"
#include "ensemble/ensemble.hpp"
#include "ensemble/made_with.hpp"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr const char* format_name = "talus-ensemble";
constexpr int format_version = 1;
constexpr Outcome outcomes[] = {Outcome::done, Outcome::failed_checks, Outcome::no_result,
                                Outcome::not_started};

std::string path_in(const std::string& folder, const std::string& file) {
  return (fs::path(folder) / file).string();
}

// The digest at the end of a run file (io/seal.hpp); "" where there is none.
std::string digest_in(const std::string& path) {
  constexpr std::streamoff length = 64;
  std::ifstream in(path, std::ios::binary);
  std::string digest(length, ' ');
  if (!in.seekg(-length, std::ios::end) || !in.read(digest.data(), length)) return "";
  return digest;
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// --- JSON ----------------------------------------------------------------------------------------

// The keys of a member, without its outcome.
template <class Member, class Take>
void each_key(Member& m, const Take& take) {
  take("file", m.file), take("case", m.case_name), take("seed", m.seed), take("sample", m.sample);
  take("unit", m.unit), take("weight", m.weight), take("run_id", m.run_id), take("why", m.why);
  take("digest", m.digest), take("settings", m.settings), take("wanted", m.wanted);
  take("mass", m.mass), take("seed_draws", m.seed_draws);
}

Json json_of(const EnsembleMember& m) {
  Json json = {{"outcome", text(m.outcome)}};
  each_key(m, [&json](const char* key, const auto& value) { json[key] = value; });
  return json;
}

EnsembleMember member_of(const Json& json) {
  EnsembleMember m;
  each_key(m, [&json](const char* key, auto& value) { json.at(key).get_to(value); });
  const auto outcome = json.at("outcome").get<std::string>();
  for (const Outcome one : outcomes)
    if (outcome == text(one)) m.outcome = one;
  return m;
}

Ensemble parsed(const std::string& folder, const std::string& bytes) {
  Ensemble out;
  out.folder = folder;
  const Json json = Json::parse(bytes);
  if (json.at("format") != format_name || json.at("format_version") != format_version) return out;
  json.at("planned").get_to(out.is_planned);
  json.at("max_failed_share").get_to(out.max_failed_share);
  for (const auto& [name, weight] : json.at("weights").items())
    out.cases.push_back({name, weight.get<double>(), 0});
  json.at("settings_that_differ").get_to(out.differs);
  json.at("parts").get_to(out.parts);
  for (const Json& member : json.at("members")) out.members.push_back(member_of(member));
  return out;
}

// --- run files -----------------------------------------------------------------------------------

// Makes all run files of the folder, and of the folders in it, its members.
void add_files(Ensemble& ensemble) {
  const std::string& folder = ensemble.folder;
  std::vector<std::string> files;
  const auto add_from = [&](const fs::path& from) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(from, error))
      if (entry.path().extension() == ".h5" && entry.path().filename().string()[0] != '.')
        files.push_back(entry.path().lexically_relative(folder).string());
  };
  add_from(folder);
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.is_directory(error)) add_from(entry.path());
  std::sort(files.begin(), files.end());
  std::map<std::string, EnsembleMember> known;
  for (EnsembleMember& member : ensemble.members) known[member.file] = std::move(member);
  ensemble.members.clear();
  for (const std::string& file : files) {
    ensemble.members.push_back(std::move(known[file]));
    ensemble.members.back().file = file;
  }
}

// The member of a run file.
EnsembleMember member_of(const std::string& file, const std::string& digest,
                         const std::string& path) {
  EnsembleMember out;
  out.file = file;
  const RunInfo info = read_run_head(path).info;
  out.case_name = info.case_name;
  out.seed = info.seed;
  out.sample = sample_of(made_with(info.config, ""));
  out.outcome = info.status == "done"     ? Outcome::done
                : info.status == "failed" ? Outcome::failed_checks
                                          : Outcome::no_result;
  out.why = info.status == "running" ? "has not ended" : info.reason;
  if (!has_result(out)) return out;
  out.digest = digest;
  out.run_id = info.run_id;
  out.settings = settings_digest(info);
  if (!info.terrain_digest.empty()) out.mass = info.blocks_hash;
  out.seed_draws = info.seed_draws;
  return out;
}

// Takes over the entry of the file. A run with other settings than the wanted ones has no result.
void take(EnsembleMember& member, EnsembleMember found) {
  if (!member.wanted.empty()) {
    const bool is_wanted = found.seed == member.seed && found.sample == member.sample &&
                           found.case_name == member.case_name && found.settings == member.wanted;
    if (has_result(found) && !is_wanted) {
      found.outcome = Outcome::not_started;
      found.why = "what is there was made with other settings";
    }
    found.wanted = member.wanted;
    found.seed = member.seed;
    found.sample = member.sample;
    found.case_name = member.case_name;
  }
  member = std::move(found);
}

// A member without a file keeps why it has no result.
void look_at(EnsembleMember& member, const std::string& folder) {
  const std::string path = path_in(folder, member.file), digest = digest_in(path);
  const bool fits = member.wanted.empty() || member.settings == member.wanted;
  if (digest == member.digest && (digest.empty() || has_result(member) == fits)) return;
  EnsembleMember found;
  found.file = member.file;
  found.seed = member.seed;
  found.sample = member.sample;
  found.case_name = member.case_name;
  try {
    if (!digest.empty()) found = member_of(member.file, digest, path);
  } catch (const InputError& error) {
    found.outcome = Outcome::no_result;
    found.why = error.what();
  }
  take(member, std::move(found));
}

void weigh(Ensemble& ensemble) {
  std::vector<EnsembleMember*> list;
  std::vector<RunMember> runs;
  for (EnsembleMember& member : ensemble.members) {
    if (!has_result(member)) continue;
    list.push_back(&member);
    RunMember run;
    run.file = path_in(ensemble.folder, member.file);
    run.info.case_name = member.case_name;
    run.info.seed_draws = member.seed_draws;
    run.info.terrain_digest = run.info.blocks_hash = member.mass;
    run.settings = member.settings;
    runs.push_back(std::move(run));
  }
  const bool have_all_runs =
      std::all_of(ensemble.cases.begin(), ensemble.cases.end(), [&runs](const CaseWeight& one) {
        return std::any_of(runs.begin(), runs.end(),
                           [&one](const RunMember& run) { return run.info.case_name == one.name; });
      });
  const std::vector<int> units = units_of(runs);
  const std::vector<double> weights =
      run_weights(runs, cases_of(runs, have_all_runs ? ensemble.cases : std::vector<CaseWeight>{}));
  for (std::size_t i = 0; i < list.size(); ++i) {
    list[i]->unit = units.empty() ? static_cast<int>(i) : units[i];
    list[i]->weight = weights[i];
  }
}

// Compares the settings that options gave to the cases, in their first runs.
void compare_cases(Ensemble& ensemble) {
  std::map<std::string, MadeWith> first;
  for (const EnsembleMember& member : ensemble.members) {
    if (!has_result(member) || first.contains(member.case_name)) continue;
    const RunInfo info = read_run_head(path_in(ensemble.folder, member.file)).info;
    first[member.case_name] = made_with(info.config, info.made_with);
  }
  const auto counts = [](const std::string& name, const EffectiveValue& a,
                         const EffectiveValue& b) {
    return name != "solver.seed" && name != "uncertainty.sample" &&
           (is_of_command_line(a) || is_of_command_line(b));
  };
  ensemble.differs.clear();
  for (const auto& [name, settings] : first)
    for (const auto& d : differences(settings, first.begin()->second, counts))
      ensemble.differs.push_back("case " + name + ": " + d.name + " = " + d.value + "; case " +
                                 first.begin()->first + ": " + d.other);
}

// Locks the folder against other processes that bring its ensemble up to date.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder) : file_(open(folder.c_str(), O_RDONLY)) {
    if (file_ >= 0) flock(file_, LOCK_EX);
  }
  ~FolderLock() {
    if (file_ >= 0) close(file_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

std::string text_of(const Ensemble& ensemble) {
  Json weights = Json::object(), members = Json::array();
  for (const CaseWeight& one : ensemble.cases) weights[one.name] = one.weight;
  for (const EnsembleMember& member : ensemble.members) members.push_back(json_of(member));
  const Json json = {{"format", format_name},
                     {"format_version", format_version},
                     {"planned", ensemble.is_planned},
                     {"max_failed_share", ensemble.max_failed_share},
                     {"weights", weights},
                     {"settings_that_differ", ensemble.differs},
                     {"parts", ensemble.parts},
                     {"members", members}};
  return json.dump(1) + "\n";
}

// In one go; the same bytes are left as they are.
void replace(const Ensemble& ensemble) {
  if (is_written(ensemble)) return;
  const std::string path = path_in(ensemble.folder, ensemble_name), bytes = text_of(ensemble);
  const std::string fresh =
      path_in(ensemble.folder, ".ensemble.part-" + std::to_string(getpid()) + ".json");
  write_bytes(fresh, {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
  std::error_code error;
  fs::rename(fresh, path, error);
  if (error) throw InputError({path}, "cannot be written: " + error.message());
}

}  // namespace

Ensemble stored_ensemble(const std::string& folder) {
  try {
    return parsed(folder, bytes_of(path_in(folder, ensemble_name)));
  } catch (const JsonError&) {
    Ensemble none;
    none.folder = folder;
    return none;
  }
}

void bring_up_to_date(Ensemble& ensemble) {
  for (EnsembleMember& member : ensemble.members) look_at(member, ensemble.folder);
  weigh(ensemble);
  compare_cases(ensemble);
}

Ensemble read_ensemble(const std::string& path) {
  const std::string folder = fs::is_directory(path) ? path : folder_of(path).string();
  const FolderLock lock(folder);
  Ensemble ensemble = stored_ensemble(folder);
  if (!ensemble.is_planned) add_files(ensemble);
  if (ensemble.members.empty())
    throw InputError({folder}, "holds no run", "give a folder with runs of talus-dda");
  bring_up_to_date(ensemble);
  try {
    replace(ensemble);
  } catch (const InputError&) {  // a read-only folder, or a full disk: the next process writes it
  }
  return ensemble;
}

bool is_written(const Ensemble& ensemble) {
  return bytes_of(path_in(ensemble.folder, ensemble_name)) == text_of(ensemble);
}

void write_ensemble(Ensemble& ensemble) {
  const FolderLock lock(ensemble.folder);
  bring_up_to_date(ensemble);
  replace(ensemble);
}

}  // namespace talus
