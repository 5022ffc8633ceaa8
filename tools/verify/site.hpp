// tools/verify/site.hpp
// Finds the cheapest time step, stiffness and strain setting for a user's own site: the result
// stays within a tolerance of a refined run.
#pragma once

#include <string>

#include "setup/dda_inputs.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

struct SiteStudyOptions {
  std::string site;  ///< site file; empty: no such study
  DdaFiles files;
  std::string tolerance = "1%";     ///< share, or per cent with the sign
  std::string quantity = "centre";  ///< centre, p90 or spread
  int n_runs = 4;
  bool with_paper = false;  ///< law paper in the table too; never the cheapest
};

/// Runs the ladder of settings, writes DIR/site.csv, site.svg and solver.toml; returns the table.
/// Throws InputError for a tolerance that is not a share above 0 and for a site that talus-dda
/// refuses.
[[nodiscard]] std::string study_site(Tool& tool, const SiteStudyOptions& o, const std::string& out);

}  // namespace talus
