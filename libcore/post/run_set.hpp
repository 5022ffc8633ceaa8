// libcore/post/run_set.hpp: public
// Runs that are evaluated together: what must agree, in which order they stand, how sound they are.
// in:    run files in any order
// out:   their order by run id, the sum of their health, tags for every output
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "record/run_file.hpp"

namespace talus {

/// What is kept of a run for the set.
struct RunMember {
  std::string file;
  RunInfo info;  ///< without config and plan, which are as large as a small run
  PassageGrid grid;
  int n_blocks = 0;
  int n_moving = 0;   ///< at the end, by the evaluation's own limit of speed
  double weight = 0;  ///< sum over its blocks
  // health over the whole run
  double largest_penetration = 0;                 ///< [m]
  std::int64_t unconverged = 0;                   ///< block steps accepted without convergence
  std::int64_t left_domain = 0;                   ///< blocks
  std::int64_t fell_through = 0, not_finite = 0;  ///< steps
};
/// Of a run read in any parts; health, blocks and weight as far as they were read.
[[nodiscard]] RunMember member_of(const std::string& file, const RunFile& run);

struct RunSetOptions {
  bool allow_unfinished = false;
  std::string trn_file, trn_sha256;  ///< that the evaluation is given
};

/// Throws InputError unless `run` has ended (or unfinished ones are allowed), was computed on the
/// terrain of `options`, and agrees with `first`, another run of the set, in site, terrain, blocks'
/// origin, version of the program and grid of passages.
void check_member(const RunMember& run, const RunMember& first, const RunSetOptions& options);

/// Order by run id. Throws InputError naming both files when the same run is given twice.
[[nodiscard]] std::vector<int> order_by_id(const std::vector<RunMember>& runs);

/// The file's name without folder and ending; with the folder where two of the runs share it.
[[nodiscard]] std::vector<std::string> names_of(const std::vector<RunMember>& runs);

/// What keeps a run from being believed as it is.
struct RunFault {
  std::string name, run_id;
  std::string words;  ///< the broken limits, or how far an unfinished run came
};
/// Those of a set: runs that broke a limit of their health, and runs that have not ended. A run
/// that a broken limit stopped counts as failed. By seed, then by name.
struct RunFaults {
  int n_runs = 0;
  std::vector<RunFault> failed, unfinished;
};
[[nodiscard]] RunFaults faults_of(const std::vector<RunMember>& runs);

/// "1 of 12 runs failed its numerical checks"; "" where nothing is wrong.
[[nodiscard]] std::string headline(const RunFaults& faults);
/// The headline with the runs behind it, the first few of them; "" where nothing is wrong.
[[nodiscard]] std::string text(const RunFaults& faults);

/// Digest of the runs' ids in whatever order (16 digits): equal for evaluations of the same runs.
[[nodiscard]] std::string run_set_id(std::vector<std::string> run_ids);

/// What the runs were warned of, each once, sorted.
[[nodiscard]] std::vector<std::string> warnings_of(const std::vector<RunMember>& runs);

/// Tags N_RUNS, N_FAILED, N_UNFINISHED, DENOMINATOR, VERSION, SITE, HEALTH, HEALTH_* and, where
/// there are any, WARNINGS; the same in whatever order the runs come.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> tags_of(
    const std::vector<RunMember>& runs);

}  // namespace talus
