// tools/report/folder.hpp
// Files with the results of a site, and whether they belong to the present site file and runs.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "record/run_file.hpp"
#include "site/site.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// The files of a site's folder; files that are read are named in the registry.
class ResultFolder {
 public:
  ResultFolder(Tool& tool, std::filesystem::path path) : tool_(tool), path_(std::move(path)) {}

  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return path_ / name; }
  [[nodiscard]] bool has(const std::string& name) const;
  /// "" when there is none.
  [[nodiscard]] std::string text(const std::string& name) const;
  /// Null when there is none. Throws InputError for another content.
  [[nodiscard]] Json json(const std::string& name) const;
  /// As json(), of a file that is there and may come to be left out: not yet an input.
  [[nodiscard]] Json glance(const std::string& name) const;
  /// Its path. Throws InputError when there is none.
  std::string required(const std::string& name, const std::string& tool) const;
  /// From here on as if these files were not there, with a warning that names those that are,
  /// unless `why` is empty.
  void leave_out(const std::vector<std::string>& names, const std::string& why);

 private:
  [[nodiscard]] Json parsed(const std::string& name, const std::string& content) const;

  Tool& tool_;
  std::filesystem::path path_;
  std::set<std::string> left_out_;
};

/// A text of a report at a JSON pointer, "" where it has none.
[[nodiscard]] std::string text_at(const Json& json, const std::string& place);

/// RUNOUT.json. Throws InputError unless it names the runs that it is made from.
[[nodiscard]] Json read_runout(const ResultFolder& folder);

/// Ids of the runs that RUNOUT.json is made from.
[[nodiscard]] std::vector<std::string> ids_of(const Json& runout);

/// Leaves out files of an earlier site file or of other runs: maps and fences of
/// other runs than RUNOUT.json, fences where the site has none, contours of another terrain.
void leave_out_others(ResultFolder& folder, const Site& site, const Json& runout);

/// Throws InputError unless the run at `path` was computed with the site file's values, those of
/// the contours only where they are shown; values of a command line override both.
void check_site_of(const RunFile& run, const std::string& path, const Site& site,
                   const ResultFolder& folder);

/// Ground of a run: bed.tif or trn.tif. Throws InputError when it is neither.
[[nodiscard]] std::string ground_of(const RunInfo& run, const ResultFolder& folder);

}  // namespace talus
