// tools/frame/output_checks.hpp
// Outputs that cannot or must not be written are refused before long work.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "tools/frame/tool_options.hpp"

namespace talus {

/// Files that are read, or that the site file names whether or not they are read: no output may be
/// one of them, under any name, nor belong to one (.prj, .aux.xml, -wal).
class KeptFiles {
 public:
  /// `source` as for parse_source_path(); `finding` is the message for an output that is this file.
  /// Names of GDAL without a file behind them are passed over.
  void add(const std::string& source, const std::string& finding);
  /// Throws UsageError.
  void refuse(const std::filesystem::path& output) const;

 private:
  [[nodiscard]] const std::string* finding_on(const std::filesystem::path& output) const;

  std::map<std::string, std::string> by_path_;  // in the one spelling of it
  std::map<std::pair<dev_t, ino_t>, std::string> by_file_;
};

/// Throws CLI::ValidationError for an output whose name is empty on the command line: it is not
/// an omitted output.
void check_output_names(const ToolOptions& options);

/// Throws UsageError for a file that is to be kept, InputError for one that cannot be written.
void check_output_file(const std::filesystem::path& path, const KeptFiles& kept);

/// Throws InputError for a file that exists, unless it may be replaced.
void refuse_existing(const std::filesystem::path& path, bool overwrite);

/// All outputs of the command line and the registry: as check_output_file() and refuse_existing(),
/// and UsageError for a name given twice. Makes folders that are missing.
void check_outputs(const ToolOptions& options, const KeptFiles& kept);

}  // namespace talus
