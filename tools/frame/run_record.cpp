// Record of a run for the registry, and the id that equal runs share.
#include "tools/frame/run_record.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <map>
#include <utility>

#include "base/file_paths.hpp"
#include "base/sha256.hpp"
#include "tools/frame/build_info.hpp"
#include "tools/frame/exit_code.hpp"
#include "tools/frame/machine.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

constexpr const char* late_mark = ".late-";

// Role and digest of all that was read. Results do not depend on the order in which several inputs
// of one option are named.
std::vector<std::pair<std::string, std::string>> contents_of(const RunRecord& record,
                                                             const RunIdParts& parts) {
  std::vector<std::pair<std::string, std::string>> contents = parts.contents;
  for (const RunArtifact& file : record.inputs)
    if (!parts.left_out.contains(file.role)) contents.emplace_back(file.role, file.sha256);
  std::sort(contents.begin(), contents.end());
  return contents;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  char buffer[32];
  std::strftime(buffer, sizeof buffer, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return buffer;
}

}  // namespace

RunArtifact artifact_of(const std::string& role, const std::string& path) {
  const std::string where = absolute_path(path);
  const std::string file = file_behind(path);
  if (is_virtual(path) || !fs::is_regular_file(file)) return {role, where, "", 0};
  return {role, where, sha256_of_file(file), static_cast<std::int64_t>(fs::file_size(file))};
}

void begin_record(const std::string& tool, const std::string& command_line, RunRecord& record) {
  record.tool = tool;
  record.version = build_version;
  record.git_commit = build_commit;
  record.command_line = command_line;
  record.folder = fs::current_path().string();
  record.host = host_name();
  record.cpu = processor_name();
  record.process_id = getpid();
  record.started = utc_now();
}

std::string content_id(const RunRecord& record, const RunIdParts& parts) {
  Sha256 hash;
  const auto add = [&hash](const std::string& word) { hash.add(word.c_str(), word.size() + 1); };
  add(record.tool);
  add(record.version);
  for (const RunParam& param : record.params)
    if (!parts.left_out.contains(param.key)) add(param.key), add(param.value);
  for (const auto& [role, sha256] : contents_of(record, parts)) add(role), add(sha256);
  return hash.hex().substr(0, 16);
}

std::string made_with_text(const RunRecord& record, const RunIdParts& parts,
                           const std::set<std::string>& left_out) {
  std::string out;
  for (const RunParam& param : record.params)
    if (!parts.left_out.contains(param.key) && param.key.find('.') == std::string::npos)
      out += "--" + param.key + " = " + param.value + "\n";
  std::map<std::string, std::string> files;  // several of one role are in one line
  for (const auto& [role, sha256] : contents_of(record, parts))
    if (!left_out.contains(role)) files[role] += (files[role].empty() ? "" : " ") + sha256;
  for (const auto& [role, digests] : files) out += "file " + role + " = " + digests + "\n";
  return out;
}

std::string late_registry(const std::string& db) {
  return db + late_mark + host_name() + "-" + std::to_string(getpid());
}

bool is_late_registry(const std::string& path) {
  return fs::path(path).filename().string().find(late_mark) != std::string::npos;
}

std::vector<std::string> late_registries(const std::string& db) {
  const std::string begin = fs::path(db).filename().string() + late_mark;
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder_of(db))) {
    const std::string name = entry.path().filename().string();
    const bool is_part = name.ends_with("-wal") || name.ends_with("-shm");
    if (name.starts_with(begin) && !is_part) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void end_record(int exit_code, double wall_time_s, RunRecord& record) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  record.ended = utc_now();
  record.exit_code = exit_code;
  record.status = exit_code == done ? "done" : exit_code == stopped ? "interrupted" : "failed";
  record.cpu_time_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  record.wall_time_s = wall_time_s;
  record.peak_memory_kb = usage.ru_maxrss;
}

}  // namespace talus
