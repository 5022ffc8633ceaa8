// libcore/base/input_log.hpp: public
// What those who read inputs tell: which files and layers they read, what a user should know, how
// far they are. A tool records and prints it; a test collects it; this class itself hears nothing.
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
  detail,  ///< for those who ask for more
  info,
  record,  ///< kept with the results and not said
};

/// What was taken from a layer of a vector source.
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
  /// A file whose bytes do not count, since content_read() says what was read of it. To be called
  /// before read_also() names it.
  virtual void read_by_content(const std::string& /*path*/) {}
  /// Digest of what was taken from an input whose bytes do not say all: a folder, a virtual path of
  /// GDAL, a file that is read with others beside it. Counts for the run's id as bytes do.
  virtual void content_read(const std::string& /*role*/, const std::string& /*digest*/) {}
  virtual void layer_read(const LayerRead& /*layer*/) {}
  /// What a user should look at, kept with the results and said, a sentence a kind.
  virtual void doubts(const std::vector<Doubt>& /*found*/) {}
  virtual void note(Severity /*severity*/, const std::string& /*words*/) {}
  /// To hand to long work; what it returns may throw to end the work.
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
