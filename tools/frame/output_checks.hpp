// tools/frame/output_checks.hpp
// Outputs that cannot or must not be written are refused before long work.
#pragma once

#include <filesystem>
#include <vector>

#include "store/runs.hpp"
#include "tools/frame/tool_options.hpp"

namespace talus {

/// Throws CLI::ValidationError for an output whose name is empty on the command line: it is no
/// output left away.
void check_output_names(const ToolOptions& options);

/// Throws UsageError for a file that is one of `inputs`, InputError for one that cannot be written.
void check_output_file(const std::filesystem::path& path, const std::vector<RunArtifact>& inputs);

/// Throws InputError for a file that exists, unless it may be replaced.
void refuse_existing(const std::filesystem::path& path, bool overwrite);

/// All outputs of the command line: as check_output_file() and refuse_existing(), and UsageError
/// for a name given twice. Makes folders that are missing.
void check_outputs(const ToolOptions& options, const std::vector<RunArtifact>& inputs);

}  // namespace talus
