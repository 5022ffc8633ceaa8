// tools/dda/run.hpp
// A run of talus-dda from its scene to its outputs: checkpoints, signals, the report.
#pragma once

#include <string>

#include "setup/set_up_gdal.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

struct DdaOptions {
  SetUpRequest request;
  std::string out, plan, passages_by = "footprint";
  bool resume = false;
  int threads = 0;  ///< 0: as many as there are
};

/// Declares the files beside the outputs. Throws InputError or UsageError where an option lacks or
/// makes no sense, and for files that a stopped run left unless it is to be resumed or replaced.
void check_options(Tool& tool, const DdaOptions& options);

/// To the end, to a broken limit, to a stable mass, or to a signal (Interrupted, after a
/// checkpoint); stages the outputs. `cpu_start_s`: processor_seconds() when the tool began.
void compute_run(Tool& tool, const Site& site, const SetUp& setup, const DdaOptions& options,
                 double cpu_start_s);

/// Once the run is in place, its checkpoints are not needed any more.
void remove_checkpoints(const DdaOptions& options);

}  // namespace talus
