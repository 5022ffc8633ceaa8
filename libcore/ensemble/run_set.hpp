// libcore/ensemble/run_set.hpp: public
// Runs that are evaluated together: which settings must agree, their order, their health.
// in:    run files in any order
// out:   their order by run id, their health and faults
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "record/run_file.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Data of a run that are kept for the set.
struct RunMember {
  std::string file;  ///< of a run in a part: its file before, with its folder
  RunInfo info;      ///< without config, made_with and plan, as large as a small run
  PassageGrid grid;
  int n_blocks = 0;  ///< with the pieces of those that broke
  int n_released = 0;
  int n_moving = 0;   ///< at the end, by the evaluation's own limit of speed
  double weight = 0;  ///< sum over its blocks, times run_weight
  // health over the whole run
  double largest_penetration = 0;                 ///< [m]
  std::int64_t unconverged = 0;                   ///< block steps accepted without convergence
  std::int64_t left_domain = 0;                   ///< blocks
  std::int64_t fell_through = 0, not_finite = 0;  ///< steps
  std::string part;                               ///< file of the part that holds it; "": none
  double run_weight = 1;                          ///< statistical weight, 1 on average [-]
  std::string settings;                           ///< settings_digest()
  std::string measure;                            ///< variants that it is of; "": the site as it is
  bool draws_for_all = false;  ///< something was drawn for all blocks of the run (made_with.hpp)
  // of blocks that moved alone, by add_release_cells()
  std::vector<int> release_cell;     ///< of the terrain, by its number                 (n_blocks)
  std::vector<double> block_weight;  ///< without that of the run; empty: 1 each        (n_blocks)
};
/// Name of a run in messages.
[[nodiscard]] std::string where_of(const RunMember& run);
/// Of a run read in any parts; health, blocks and weight as far as they were read.
[[nodiscard]] RunMember member_of(const std::string& file, const RunFile& run);
/// Adds the cells of the terrain that its blocks were released in, where each moved alone.
void add_release_cells(RunMember& member, const RunFile& run, const Trn& trn);

/// Statistical weight of a case.
struct CaseWeight {
  std::string name;   ///< "": of runs without one
  double weight = 1;  ///< above 0; the sum of all is 1 after cases_of()
  int n_runs = 0;
};
/// The cases of the runs, by name, with their shares of the whole: as `given`, or by their number
/// of runs where none is. Throws InputError when a case of the runs is not given, or has no runs.
[[nodiscard]] std::vector<CaseWeight> cases_of(const std::vector<RunMember>& runs,
                                               const std::vector<CaseWeight>& given);
/// Weight of each run so that the cases have their shares: 1 on average.          (n_runs)
[[nodiscard]] std::vector<double> run_weights(const std::vector<RunMember>& runs,
                                              const std::vector<CaseWeight>& cases);
/// The cases of runs that have been weighed, by name, with their shares of the whole.
[[nodiscard]] std::vector<CaseWeight> case_shares(const std::vector<RunMember>& runs);
/// "low 0.25 (20 runs), high 0.75 (20 runs)"
[[nodiscard]] std::string text(const std::vector<CaseWeight>& cases);

struct RunSetOptions {
  std::string trn_file, trn_sha256;  ///< that the evaluation is given
  std::string trn_digest{};          ///< of its contents
};

/// Throws InputError unless `run` has ended, was computed on the terrain of `options`, or on a bed
/// in it where there are several rock masses, and agrees with `first`, another run of the set, in
/// site, terrain, blocks' origin, version of the program and grid of passages.
void check_member(const RunMember& run, const RunMember& first, const RunSetOptions& options);

/// Order by run id. Throws InputError naming both files when the same run is given twice.
[[nodiscard]] std::vector<int> order_by_id(const std::vector<RunMember>& runs);

/// Which runs count as one, for they move the same one of several rock masses, or have the same
/// settings and a seed that draws nothing: a number from 0 for each run. Empty where each run
/// counts for itself, as those of one mass alone do. (n_runs)
[[nodiscard]] std::vector<int> units_of(std::span<const RunMember> runs);

/// The file's name without folder and ending; with the folder where two of the runs share it.
[[nodiscard]] std::vector<std::string> names_of(const std::vector<RunMember>& runs);

/// Reason not to trust a run as it is.
struct RunFault {
  std::string name, run_id;
  std::int64_t seed = 0;
  std::string words;  ///< the broken limits
};
/// Those of a set: runs that broke a limit of their health, by seed, then by name.
struct RunFaults {
  int n_runs = 0;
  std::vector<RunFault> failed;
  std::vector<RunFault> left_out;  ///< failed, and not evaluated
};
/// `left_out`: failed runs that are not among `runs`.
[[nodiscard]] RunFaults faults_of(const std::vector<RunMember>& runs,
                                  const std::vector<RunMember>& left_out = {});

/// Of the runs that were wanted, those that failed or gave no result, `n_missing` of them, as far
/// as they are left out; and whether they may be: their share is at most `most`.
struct FailedShare {
  double share = 0;          ///< left out [-]
  bool is_left_out = false;  ///< the failed ones; else they are evaluated like the rest
};
[[nodiscard]] FailedShare failed_share(int n_runs, int n_failed, int n_missing, double most);

/// "1 of 12 runs failed its numerical checks"; "" where nothing is wrong with those evaluated.
[[nodiscard]] std::string headline(const RunFaults& faults);
/// The headline with the runs behind it, the first few of them; "" where nothing is wrong.
[[nodiscard]] std::string text(const RunFaults& faults);
/// The runs that were left out, the first few of them; "" when none were.
[[nodiscard]] std::string left_out_text(const RunFaults& faults);

/// How many runs are the same as another one but for a seed that draws nothing.
[[nodiscard]] int n_repeats(const std::vector<RunMember>& runs);
/// "2 of 3 runs repeat another one: their seeds draw nothing"; "" where none does.
[[nodiscard]] std::string repeats_text(const std::vector<RunMember>& runs);

/// Digest of the runs' ids in whatever order (16 digits): equal for evaluations of the same runs.
[[nodiscard]] std::string run_set_id(std::vector<std::string> run_ids);

/// Warnings of the runs, each once, sorted.
[[nodiscard]] std::vector<std::string> warnings_of(const std::vector<RunMember>& runs);

}  // namespace talus
