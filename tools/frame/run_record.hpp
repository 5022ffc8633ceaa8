// tools/frame/run_record.hpp
// Record of a run, beside the tool's own results: user, time, machine, inputs and cost; and the id
// that equal runs share.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "store/runs.hpp"

namespace talus {

/// A file with its digest; none of a folder and of GDAL's virtual paths.
[[nodiscard]] RunArtifact artifact_of(const std::string& role, const std::string& path);

/// Fills in the facts of a run of `tool` at its begin: program, command, folder, machine, time.
void begin_record(const std::string& tool, const std::string& command_line, RunRecord& record);

/// Parts of a run's id beside its record, and parts that it omits.
struct RunIdParts {
  std::set<std::string> left_out;                             ///< keys of settings, roles of inputs
  std::vector<std::pair<std::string, std::string>> contents;  ///< role, digest of the content
};

/// Digest of tool, version, settings and contents of the inputs (16 digits).
[[nodiscard]] std::string content_id(const RunRecord& record, const RunIdParts& parts);

/// Contents that content_id() counts beside keys of the site file ("section.key"), a line each:
/// options as "--name = value", contents as "file role = digest"; without the roles of `left_out`.
[[nodiscard]] std::string made_with_text(const RunRecord& record, const RunIdParts& parts,
                                         const std::set<std::string>& left_out);

/// Where the entry of this process is kept when its registry cannot be written.
[[nodiscard]] std::string late_registry(const std::string& db);

[[nodiscard]] bool is_late_registry(const std::string& path);

/// The registries of this kind beside `db`, by name.
[[nodiscard]] std::vector<std::string> late_registries(const std::string& db);

/// Fills in the end of the run and its cost. `wall_time_s`: since it began [s].
void end_record(int exit_code, double wall_time_s, RunRecord& record);

}  // namespace talus
