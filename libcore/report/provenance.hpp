// libcore/report/provenance.hpp: public
// From the first files to the results: the steps as a table of a page.
// in:    runs of the registry
// out:   HTML, the same wherever the programs and the site's folder lie
#pragma once

#include <string>
#include <vector>

#include "report/texts.hpp"
#include "store/runs.hpp"

namespace talus {

/// A row a step: command, version, run id, files read and written with the beginning of their
/// digests; paths below the folder of `site_file` are relative to it. So that shards and one make
/// give the same table, a command names its runs and parts by RUN.h5..., and neither the registry
/// nor inputs of the role "part" are shown: the runs of a part stand beside it.
[[nodiscard]] std::string provenance_table(const Texts& texts, const std::vector<RunRecord>& steps,
                                           const std::string& site_file);

}  // namespace talus
