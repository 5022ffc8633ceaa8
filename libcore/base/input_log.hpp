// libcore/base/input_log.hpp: public
// Reports of functions that read inputs: the files and layers read, findings for the user,
// progress. A tool records and prints them; a test collects them; this base class ignores them.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/doubt.hpp"
#include "base/progress.hpp"

namespace talus {

enum class Severity {
  detail,  ///< shown on request only
  info,
  record,  ///< kept with the results and not said
};

/// Content read from a layer of a vector source.
struct LayerRead {
  using Value = std::variant<std::string, double, std::int64_t, std::vector<std::string>>;
  std::string role;  ///< option or section that names the source
  std::string file;
  std::vector<std::pair<std::string, Value>> facts;  ///< name and value, e.g. n_polygons
};

class InputLog {
 public:
  InputLog() = default;
  InputLog(const InputLog&) = delete;
  InputLog& operator=(const InputLog&) = delete;
  virtual ~InputLog() = default;

  /// A file was read whose bytes count for the run's id; `role`: the option or key that names it.
  virtual void read_also(const std::string& /*role*/, const std::string& /*path*/) {}
  /// A file whose bytes do not count, since content_read() gives a digest of its content. To be
  /// called before read_also() names it.
  virtual void read_by_content(const std::string& /*path*/) {}
  /// Digest of the content taken from an input whose bytes do not tell all: a folder, a virtual
  /// path of GDAL, a file that is read together with further files. Counts for the run's id as
  /// bytes do.
  virtual void content_read(const std::string& /*role*/, const std::string& /*digest*/) {}
  virtual void layer_read(const LayerRead& /*layer*/) {}
  /// Findings for the user, kept with the results and reported, a sentence a kind.
  virtual void doubts(const std::vector<Doubt>& /*found*/) {}
  virtual void note(Severity /*severity*/, const std::string& /*words*/) {}
  /// For long work; the returned function may throw to end the work.
  [[nodiscard]] virtual ProgressFunction progress() {
    return [](double) {};
  }

  void detail(const std::string& words) { note(Severity::detail, words); }
  void info(const std::string& words) { note(Severity::info, words); }
  /// A doubt of which there are only words.
  void warn(const std::string& words) { doubts({doubt_on({}, words)}); }
  void record(const std::string& words) { note(Severity::record, words); }
};

}  // namespace talus
