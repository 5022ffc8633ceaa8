// libcore/report/provenance.hpp: public
// From the first files to the results: the steps as a page shows them.
// in:    runs of the registry
// out:   rows, the same wherever the programs and the site's folder lie
#pragma once

#include <compare>
#include <string>
#include <vector>

#include "store/runs.hpp"

namespace talus {

struct StepFile {
  std::string path;  ///< below the site's folder: relative to it
  std::string sha;   ///< the beginning of its SHA-256; "": not hashed
  auto operator<=>(const StepFile&) const = default;
};

struct ProvenanceStep {
  std::string command, version, run_id;
  std::vector<std::string> notes;  ///< its remarks on its inputs: how they were reprojected
  std::vector<StepFile> read, wrote;
};

/// So that shards and one make give the same steps, a command names its runs and parts by
/// RUN.h5..., and neither the registry nor inputs of the role "part" are shown: the runs of a part
/// are listed beside it.
[[nodiscard]] std::vector<ProvenanceStep> provenance_steps(const std::vector<RunRecord>& steps,
                                                           const std::string& site_file);

}  // namespace talus
