// tools/batch/plan.hpp
// Which runs are wanted, where they lie, how each is made, and which of them are there already.
#pragma once

#include <string>
#include <vector>

#include "ensemble/ensemble.hpp"
#include "site/site.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

struct BatchOptions {
  std::string results = "out", into = "runs", runs, part, launcher;
  std::int64_t seed = -1;  ///< -1: that of the site
  std::vector<std::string> dda_options;
  int jobs = 0, most = 1600;
  bool status = false;
};

/// One of several parts that runs are made in, each by a batch of its own, maybe elsewhere.
struct BatchPart {
  int number = 0, n_parts = 1;  ///< 0: all of them
  [[nodiscard]] bool has(std::size_t run) const {
    return number == 0 || static_cast<int>(run) % n_parts == number - 1;
  }
};

/// The runs of one folder.
struct BatchPlan {
  std::vector<std::string> site_words;  ///< the site file, and which variant of it
  std::string results;             ///< folder with blocks.h5 and bed.tif, or with rock/blocks_K.h5
  std::string folder;              ///< of the runs
  std::vector<std::string> cases;  ///< variants that are counted together; "": the site as it is
  std::int64_t first_seed = 1;
  bool draws_samples = false;
  int rock_masses = 0;
  std::vector<std::string> dda_options;  ///< of all cases
  std::string launcher;                  ///< before the names of tools
  BatchPart part;
  Ensemble ensemble;  ///< all runs that are wanted, also those of other parts
};

/// Of the site file and the options. Throws InputError and UsageError. Without `n_runs` of each
/// case.
[[nodiscard]] BatchPlan plan_of(const Site& site, const std::vector<std::string>& site_words,
                                const BatchOptions& options);

/// Wants `n_runs` of each case.
void set_runs(BatchPlan& plan, int n_runs);

/// Asks talus-dda the inputs of runs now, and compares the runs that exist. With `says` it
/// tells `tool` the differences where runs are to be made again. Throws InputError where talus-dda
/// refuses the site. Without blocks nothing is asked: all runs are to be made.
void compare_with_now(BatchPlan& plan, Tool& tool, bool says);

/// The members that are to be made, of all parts or of the one of the plan.
[[nodiscard]] std::vector<std::size_t> to_make(const BatchPlan& plan);
[[nodiscard]] std::vector<std::size_t> to_make_here(const BatchPlan& plan);

/// The rock mass of a member; 0: there is but one.
[[nodiscard]] std::int64_t mass_of(const BatchPlan& plan, const EnsembleMember& member);
/// A file of a rock mass: rock/NAME_K, or NAME where there is but one.
[[nodiscard]] std::string rock_file(const BatchPlan& plan, const char* name, const char* end,
                                    std::int64_t mass);
/// The terrain that runs are evaluated on.
[[nodiscard]] std::string ground_of(const BatchPlan& plan);

/// The words of a tool that is started.
[[nodiscard]] std::vector<std::string> tool_words(const BatchPlan& plan, const std::string& tool);
/// Command that makes a run, up to options that all runs have.
[[nodiscard]] std::vector<std::string> run_words(const BatchPlan& plan,
                                                 const EnsembleMember& member);

/// Where parts of these runs are.
[[nodiscard]] std::string parts_folder(const BatchPlan& plan);

/// Writes the ensemble with the parts that are there, and one in the folder of each of several
/// cases. Throws InputError.
void write_ensembles(BatchPlan& plan);
/// Whether all of these are written.
[[nodiscard]] bool are_written(BatchPlan& plan);

}  // namespace talus
