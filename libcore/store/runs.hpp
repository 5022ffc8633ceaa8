// libcore/store/runs.hpp: public
// The run registry: each run with user, inputs, options and outcome. One SQLite file
// (WAL), shared by any number of processes; every write is one BEGIN IMMEDIATE transaction.
// The tables are those of W3C PROV: run = Activity, artifact = Entity, run_input = used,
// run_output = wasGeneratedBy. docs/reference/formats.md#registry
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace talus {

struct RunParam {
  std::string key;  ///< long option name or site-file key, unit in the name
  std::string value;
  std::string source;  ///< "default", "cli", or the place in the site file ("file, line 7")
  bool operator==(const RunParam&) const = default;
};

/// A file read or written, with its digest; `sha256` is empty when the content was not hashed.
struct RunArtifact {
  std::string role;  ///< name of the option that gave it
  std::string path;  ///< absolute
  std::string sha256;
  std::int64_t n_bytes = 0;
  bool operator==(const RunArtifact&) const = default;
};

struct RunMetric {
  std::string name;
  double value = 0;
  std::string unit;
  bool operator==(const RunMetric&) const = default;
};

struct RunEvent {
  double time_s = 0;  ///< since the run's start [s]
  std::string level;  ///< "info", "warning" or "error"
  std::string text;
  bool operator==(const RunEvent&) const = default;
};

struct RunCheck {
  std::string name;
  double value = 0;
  double limit = 0;
  bool pass = false;
  bool operator==(const RunCheck&) const = default;
};

/// One run of one tool.
struct RunRecord {
  std::int64_t id = 0;  ///< row of the registry, given by start_run
  /// Digest of tool, version, options and input contents: equal for runs that must give equal
  /// bytes.
  std::string content_id;
  std::string tool, version, git_commit, command_line, folder, host, cpu;
  int process_id = 0;
  std::string started, ended;       ///< UTC, ISO 8601; `ended` empty while running
  std::string status;               ///< "running", "done", "failed" or "interrupted"
  int exit_code = -1;               ///< -1 while running
  double cpu_time_s = 0;            ///< user + system [s]
  double wall_time_s = 0;           ///< [s]
  std::int64_t peak_memory_kb = 0;  ///< largest resident set [KiB]
  std::vector<RunParam> params;
  std::vector<RunArtifact> inputs, outputs;
  std::vector<RunMetric> metrics;
  std::vector<RunEvent> events;
  std::vector<RunCheck> checks;
  bool operator==(const RunRecord&) const = default;
};

/// A registry that cannot be written now: somebody else has held it for as long as was waited, the
/// disk is full, it is another user's.
struct RegistryBusy : InputError {
  using InputError::InputError;
};

/// How long a write waits for another process that writes [ms]: a minute, or the environment
/// variable TALUS_REGISTRY_WAIT_S [s]. Throws InputError when that is not a number from 0 to 3600.
[[nodiscard]] int registry_wait_ms();

/// Writes the run as it begins (status "running") and returns its row. Makes the registry when it
/// does not exist. Throws InputError when `db` cannot be written or is not a registry, RegistryBusy
/// (all that write do).
[[nodiscard]] std::int64_t start_run(const std::string& db, const RunRecord& run);

/// Records the results of a run in progress, before the first output is put in place: content id,
/// inputs named since, outputs, metrics, events, checks. The registry entry is thus complete before
/// any output has its name, even if the run is killed the next moment. A run whose row was lost
/// with its registry gets a new one; finish_run does the same.
void record_results(const std::string& db, const RunRecord& run);

/// Completes the row `run.id`: outcome, times, and all that record_results writes.
void finish_run(const std::string& db, const RunRecord& run, int wait_ms = registry_wait_ms());

/// Writes a run that is over as a new row, and returns it.
std::int64_t add_run(const std::string& db, const RunRecord& run, int wait_ms = registry_wait_ms());

/// Takes over all runs of another registry: one in progress in `db` (same tool, host, process and
/// start) is completed, any other is added. Returns how many there were.
int adopt_runs(const std::string& db, const std::string& other);

/// Result of merge_runs with the runs of other registries.
struct RegistryMerge {
  int n_added = 0;
  int n_completed = 0;                ///< were known as running, and have ended since
  int n_known = 0;                    ///< were there already, the same
  std::vector<std::string> left_out;  ///< why, of each registry that is damaged
};

/// Takes over all runs of other registries, in the order of their starts, in one transaction: all
/// or none. A run (tool, host, process, start, folder and command) that is known is not added
/// again. A registry is a log: one that is damaged is left out. Throws InputError when all are, one
/// is missing, or two entries of one run that has ended differ.
RegistryMerge merge_runs(const std::string& db, const std::vector<std::string>& others);

/// All runs without their details, in the order of their rows. Throws InputError when `db` does not
/// exist or is not a registry.
[[nodiscard]] std::vector<RunRecord> list_runs(const std::string& db);

/// One run with everything known of it. `id` is a row or the beginning of a content id (the newest
/// run that has it). Throws InputError when there is none.
[[nodiscard]] RunRecord read_run(const std::string& db, const std::string& id);

/// Rows of the finished runs that wrote a file with this digest, newest first.
[[nodiscard]] std::vector<std::int64_t> runs_that_wrote(const std::string& db,
                                                        const std::string& sha256);

}  // namespace talus
