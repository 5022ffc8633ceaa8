// libcore/ensemble/made_with.hpp: public
// The settings that runs were made with, compared with one another and with a site file.
// in:    the words of run files (RunInfo::config, made_with)
// out:   the keys that differ, with both values
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "record/run_file.hpp"
#include "site/site.hpp"

namespace talus {

/// Settings by name: "ground.g.cor", "--independent", "file forest.wood" with its digest.
struct MadeWith {
  std::map<std::string, EffectiveValue> values;
  std::vector<std::string> grounds;   ///< sections, in order: where two overlap the later applies
  std::vector<std::string> measures;  ///< variants of the site that were applied, in order
};
/// `config`: of print_config(). `more`: of RunInfo::made_with, or empty.
[[nodiscard]] MadeWith made_with(const std::string& config, const std::string& more);

/// Given by [uncertainty] to one sample or rock mass.
[[nodiscard]] bool is_drawn(const EffectiveValue& value);
/// Whether anything was drawn for a run as a whole, which all of its blocks share: by
/// [uncertainty], by scatter between runs, a stand of trees.
[[nodiscard]] bool draws_for_all(const MadeWith& settings);
/// Given by an option, or by a variant of the site.
[[nodiscard]] bool is_of_command_line(const EffectiveValue& value);

/// A setting with another value, each as text; "not given" without one.
struct SettingDifference {
  std::string name, value, other;
};
/// Names `counts` is true of, in alphabetical order; the order of grounds that both have comes
/// last. `counts` gets the name, the value and the other one, of which one may be empty.
[[nodiscard]] std::vector<SettingDifference> differences(
    const MadeWith& settings, const MadeWith& others,
    const std::function<bool(const std::string&, const EffectiveValue&, const EffectiveValue&)>&
        counts);
/// Digest of the inputs of a run, without its seed, sample and drawn quantities: settings that
/// motion and record depend on, options, files read, blocks and terrain.
[[nodiscard]] std::string settings_digest(const RunInfo& info);

/// "solver.duration_s: 20, there 6; ...": the settings in which two runs differ; "" where they
/// agree, or differ in blocks and terrain alone.
[[nodiscard]] std::string what_differs(const RunInfo& run, const RunInfo& other);

/// The number of the sample of [uncertainty] that a run drew; 0: none.
[[nodiscard]] std::int64_t sample_of(const MadeWith& settings);
/// The numerical value of a setting; 0 where it is not given.
[[nodiscard]] double number_of(const MadeWith& settings, const std::string& name);

/// "solver.duration_s: 20, there 6; ...", the first five.
[[nodiscard]] std::string text(const std::vector<SettingDifference>& list);

/// Compares the settings of runs that are evaluated together, as they come.
///
/// Runs agree in all settings that motion and record depend on, and in blocks and terrain. Seed,
/// sample and drawn quantities may differ; rock masses have blocks and beds of their own. Cases may
/// differ in settings of the command line and in their blocks.
class SettingsCheck {
 public:
  /// `info` with all words. Throws InputError with the files, keys and values.
  void add(const std::string& where, const RunInfo& info);
  /// The same for runs with other fences than those before.
  [[nodiscard]] SettingsCheck for_other_fences() const;
  /// Takes over the cases that are not known here.
  void merge(const SettingsCheck& other);

 private:
  struct First {
    std::string where;
    MadeWith settings;
  };
  struct Mass {
    std::string where, blocks_hash, trn_sha256;
  };
  void check_settings(const std::string& of_case, const std::string& where,
                      const MadeWith& settings) const;

  std::map<std::string, First> cases_;                           // first run of each
  std::map<std::pair<std::string, std::int64_t>, Mass> masses_;  // of each case
  bool fences_differ_ = false;
};

}  // namespace talus
