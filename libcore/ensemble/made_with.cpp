// Which settings of runs count, and the message about those that differ.
#include "ensemble/made_with.hpp"

#include <algorithm>
#include <set>
#include <sstream>

#include "base/error.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "site/stages.hpp"
#include "site/uncertainty.hpp"

namespace talus {
namespace {

constexpr const char* order_of_grounds = "order of [ground.*]";

// Lines "name = value" without a source: options, and digests of files.
void add_more(const std::string& more, MadeWith& out) {
  std::istringstream lines(more);
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t equals = line.find(" = "); equals != std::string::npos)
      out.values[line.substr(0, equals)] = {"", line.substr(0, equals), line.substr(equals + 3),
                                            ""};
}

// The sections that `other` has too, in one line.
std::string shared(const std::vector<std::string>& sections,
                   const std::vector<std::string>& other) {
  std::string out;
  for (const std::string& section : sections)
    if (std::count(other.begin(), other.end(), section) > 0)
      out += (out.empty() ? "" : ", ") + section;
  return out;
}

std::string value_text(const EffectiveValue& value) {
  return value.value.empty() ? "not given" : value.value;
}

// Frames that are kept or not change no run (Tool::leave_out_of_run_id of talus-dda).
bool counts_for_runs(const std::string& name, const EffectiveValue& value) {
  if (value.section.empty()) return true;
  return (stage_reads("run", value) || stage_reads("blocks", value)) && name != "output.frames" &&
         name != "output.whole_share";
}

std::int64_t rock_mass_of(const MadeWith& settings) {
  UncertaintySettings uncertainty;
  uncertainty.sample = sample_of(settings);
  uncertainty.rock_masses = static_cast<int>(number_of(settings, "uncertainty.rock_masses"));
  return rock_mass(uncertainty);
}

}  // namespace

MadeWith made_with(const std::string& config, const std::string& more) {
  MadeWith out;
  std::istringstream lines(config);
  std::string section;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(measure_comment))
      out.measures.push_back(line.substr(std::string(measure_comment).size()));
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '[') {
      section = line.substr(1, line.size() - 2);
      if (section.starts_with("ground.")) out.grounds.push_back(section);
      continue;
    }
    const std::size_t equals = line.find(" = "), source = line.rfind("  # ");
    if (equals == std::string::npos || source == std::string::npos) continue;
    const std::string key = line.substr(0, equals);
    out.values[section + "." + key] = {section, key, line.substr(equals + 3, source - equals - 3),
                                       line.substr(source + 4)};
  }
  add_more(more, out);
  return out;
}

double number_of(const MadeWith& settings, const std::string& name) {
  const auto at = settings.values.find(name);
  double number = 0;
  return at != settings.values.end() && parse_double(at->second.value, number) ? number : 0;
}

std::int64_t sample_of(const MadeWith& settings) {
  return static_cast<std::int64_t>(number_of(settings, "uncertainty.sample"));
}

std::string settings_digest(const RunInfo& info) {
  static const std::set<std::string> keeps_frames = {"output.frames", "output.whole_share"};
  const MadeWith settings = made_with(info.config, info.made_with);
  Sha256 hash;
  const auto add = [&hash](const std::string& word) { hash.add(word.c_str(), word.size() + 1); };
  for (const auto& [name, value] : settings.values)
    if ((counts_for_runs(name, value) || keeps_frames.contains(name)) && !value.value.empty())
      add(name), add(is_drawn(value) ? "drawn" : value.value);
  for (const std::string& ground : settings.grounds) add(ground);
  for (const std::string* word : {&info.case_name, &info.blocks_hash, &info.trn_sha256}) add(*word);
  return hash.hex();
}

std::string what_differs(const RunInfo& run, const RunInfo& other) {
  const auto counts = [](const std::string& name, const EffectiveValue& value,
                         const EffectiveValue& there) {
    return counts_for_runs(name, value.key.empty() ? there : value) &&
           !(is_drawn(value) && is_drawn(there));
  };
  return text(differences(made_with(run.config, run.made_with),
                          made_with(other.config, other.made_with), counts));
}

bool is_drawn(const EffectiveValue& value) {
  return value.source.starts_with("sample ") || value.source.starts_with("rock mass ");
}

bool draws_for_all(const MadeWith& settings) {
  const auto is_set = [&settings](const std::string& name) {
    return number_of(settings, name) != 0;
  };
  if (is_set("solver.friction_scatter_deg") || is_set("solver.cor_scatter")) return true;
  if (is_set("uncertainty.terrain_rmse_m") && sample_of(settings) != 0) return true;
  const auto is_true = [&settings](const std::string& name) {
    const auto at = settings.values.find(name);
    return at != settings.values.end() && at->second.value == "true";
  };
  return std::any_of(settings.values.begin(), settings.values.end(), [&](const auto& entry) {
    const EffectiveValue& value = entry.second;
    return value.source.starts_with("sample ") ||
           (value.key == "new_stand_per_run" && is_true(entry.first) &&
            is_true(value.section + ".active"));
  });
}

bool is_of_command_line(const EffectiveValue& value) {
  return value.source == "cli" || value.source.starts_with("variant ");
}

std::vector<SettingDifference> differences(
    const MadeWith& settings, const MadeWith& others,
    const std::function<bool(const std::string&, const EffectiveValue&, const EffectiveValue&)>&
        counts) {
  static const EffectiveValue none;
  std::vector<SettingDifference> out;
  const auto compare = [&](const std::string& name, const EffectiveValue& value,
                           const EffectiveValue& other) {
    if (value.value != other.value && counts(name, value, other))
      out.push_back({name, value_text(value), value_text(other)});
  };
  for (const auto& [name, value] : settings.values) {
    const auto at = others.values.find(name);
    compare(name, value, at == others.values.end() ? none : at->second);
  }
  for (const auto& [name, other] : others.values)
    if (!settings.values.contains(name)) compare(name, none, other);
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  const std::string order = shared(settings.grounds, others.grounds),
                    other_order = shared(others.grounds, settings.grounds);
  if (order != other_order) out.push_back({order_of_grounds, order, other_order});
  return out;
}

std::string text(const std::vector<SettingDifference>& list) {
  constexpr std::size_t most = 5;
  std::string out;
  for (std::size_t i = 0; i < std::min(most, list.size()); ++i)
    out += (i == 0 ? "" : "; ") + list[i].name + ": " + list[i].value + ", there " + list[i].other;
  return list.size() <= most ? out : out + "; and " + std::to_string(list.size() - most) + " more";
}

void SettingsCheck::check_settings(const std::string& of_case, const std::string& where,
                                   const MadeWith& settings) const {
  const auto mine = cases_.find(of_case);
  const bool is_other_case = mine == cases_.end();
  const First& first = is_other_case ? cases_.begin()->second : mine->second;
  const auto counts = [&](const std::string& name, const EffectiveValue& value,
                          const EffectiveValue& other) {
    if (!counts_for_runs(name, value.key.empty() ? other : value)) return false;
    if (is_drawn(value) && is_drawn(other)) return false;
    if (fences_differ_ && (name.starts_with("fence.") || name.starts_with("file fence.")))
      return false;
    return !is_other_case || !(is_of_command_line(value) || is_of_command_line(other));
  };
  const std::vector<SettingDifference> list = differences(settings, first.settings, counts);
  if (list.empty()) return;
  throw InputError(
      {where}, "was computed with other settings than " + first.where + ": " + text(list),
      "evaluate runs of other settings by themselves, or compute all with one site "
      "file and the same options; alternatives may differ ([variant.*] with a weight)");
}

void SettingsCheck::add(const std::string& where, const RunInfo& info) {
  MadeWith settings = made_with(info.config, info.made_with);
  const std::string& of_case = info.case_name;
  if (!cases_.empty()) check_settings(of_case, where, settings);
  const std::int64_t mass = rock_mass_of(settings);
  const bool is_one_of_many = !info.terrain_digest.empty();
  if (!is_one_of_many || mass > 0) {
    const Mass now{where, info.blocks_hash, info.trn_sha256};
    const Mass& first = masses_.try_emplace({of_case, mass}, now).first->second;
    const std::string of_mass = mass > 0 ? " of rock mass " + std::to_string(mass) : "";
    if (first.blocks_hash != now.blocks_hash)
      throw InputError({where},
                       "was computed with other blocks" + of_mass + " than " + first.where +
                           " (digest " + now.blocks_hash.substr(0, 16) + ", not " +
                           first.blocks_hash.substr(0, 16) + ")",
                       "evaluate runs of other blocks by themselves, or compute all with one file "
                       "of talus-blocks");
    if (first.trn_sha256 != now.trn_sha256)
      throw InputError({where},
                       "was computed on another terrain" + of_mass + " than " + first.where,
                       "evaluate runs on each terrain by themselves, or compute all on one");
  }
  cases_.try_emplace(of_case, First{where, std::move(settings)});
}

SettingsCheck SettingsCheck::for_other_fences() const {
  SettingsCheck out = *this;
  out.fences_differ_ = true;
  return out;
}

void SettingsCheck::merge(const SettingsCheck& other) {
  cases_.insert(other.cases_.begin(), other.cases_.end());
  masses_.insert(other.masses_.begin(), other.masses_.end());
}

}  // namespace talus
