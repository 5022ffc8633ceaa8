// libcore/ensemble/ensemble.hpp: public
// A set of runs as a file: ensemble.json beside the runs. docs/reference/formats.md#ensemble
// in:    the runs that are wanted, and the run files of a folder
// out:   the outcome and weight of each run, and the settings that differ
//
// The truth about a run is in its run file; ensemble.json is derived from them. It is written to a
// hidden name and renamed. A tool that finds it missing or old writes it again.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ensemble/run_set.hpp"

namespace talus {

enum class Outcome { done, failed_checks, no_result, not_started };
[[nodiscard]] const char* text(Outcome outcome);

/// A run that is wanted.
struct EnsembleMember {
  std::string file;  ///< from the folder of the ensemble
  std::string case_name;
  std::int64_t seed = 0;
  std::int64_t sample = 0;  ///< of [uncertainty]; 0: none
  Outcome outcome = Outcome::not_started;
  std::string why;       ///< why the result is missing, or the checks that it failed
  std::string digest;    ///< of the run file, as it says itself; "": there is none
  std::string run_id;    ///< "": without a result
  std::string settings;  ///< settings_digest() of the run
  std::string wanted;    ///< settings_digest() of a run that counts; "": any
  std::string mass;      ///< digest of its blocks, of several rock masses; "": there is one
  bool seed_draws = true;
  int unit = 0;       ///< runs of one unit count as one (units_of)
  double weight = 1;  ///< among the runs that have a result, 1 on average
};
[[nodiscard]] inline bool has_result(const EnsembleMember& member) {
  return member.outcome == Outcome::done || member.outcome == Outcome::failed_checks;
}

struct Ensemble {
  std::string folder;       ///< of ensemble.json
  bool is_planned = false;  ///< the members are those that were wanted; else all that are there
  double max_failed_share = 0.02;  ///< [uncertainty] max_failed_share
  std::vector<CaseWeight> cases;   ///< as given, by name; empty: runs count alike
  std::vector<EnsembleMember> members;
  std::vector<std::string> parts;    ///< files of talus-reduce with runs of these, from the folder
  std::vector<std::string> differs;  ///< settings that differ between the cases, a line each
};

[[nodiscard]] int count_of(const Ensemble& ensemble, Outcome outcome);
/// How many members have no result.
[[nodiscard]] int n_missing(const Ensemble& ensemble);

/// "ensemble.json"
extern const char* const ensemble_name;

/// Whether a file or folder of the command line names a set of runs.
[[nodiscard]] bool is_ensemble(const std::string& path);

/// A run with its inputs: its id and the digest of its settings.
[[nodiscard]] std::string key_of(const EnsembleMember& member);
/// Those of the runs in a file of talus-reduce, sorted; none where it is missing or damaged: the
/// runs themselves are there.
[[nodiscard]] std::vector<std::string> keys_in_part(const std::string& path);

/// The files that hold the runs with a result: with `with_parts` the parts all of whose runs are
/// wanted, and the other runs.
[[nodiscard]] std::vector<std::string> files_of(const Ensemble& ensemble, bool with_parts);

/// Of a folder, or of the ensemble.json in it. Brings it up to date, and writes it where that
/// changed anything and the folder can be written. Without a plan all run files of the folder and
/// of the folders in it are members. Throws InputError where there is none.
[[nodiscard]] Ensemble read_ensemble(const std::string& path);

/// The ensemble.json of a folder as it is; without members where there is none or it is damaged.
[[nodiscard]] Ensemble stored_ensemble(const std::string& folder);

/// Looks at the run file of each member: reads those that are other files than before, computes
/// units, weights and differing settings anew.
void bring_up_to_date(Ensemble& ensemble);

/// Brings it up to date and replaces ensemble.json in one go; the same bytes are left as they are.
/// Throws InputError.
void write_ensemble(Ensemble& ensemble);

/// Whether ensemble.json has these bytes already.
[[nodiscard]] bool is_written(const Ensemble& ensemble);

}  // namespace talus
