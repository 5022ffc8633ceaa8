// tools/batch/processes.hpp
// Tools that a batch starts: their messages are read as objects, and they end with it.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

#include "tools/frame/tool.hpp"

namespace talus {

/// Output of a tool with --json. Throws InputError with its last error where it fails.
[[nodiscard]] Json output_of(const std::vector<std::string>& words);

/// A tool at work.
class Process {
 public:
  /// Starts it with --messages=json --progress=json. Its standard output is that of the batch.
  explicit Process(std::vector<std::string> words);
  Process(Process&&) noexcept;
  Process& operator=(Process&&) = delete;
  ~Process();

  /// For poll(): where its messages come from.
  [[nodiscard]] int messages() const { return messages_; }
  /// Reads its messages; `take` gets level and text. Returns false once it has ended.
  bool read(const std::function<void(const std::string& level, const std::string& text)>& take);
  void stop() const;  ///< as an interruption does
  [[nodiscard]] double progress() const { return progress_; }
  /// Once it has ended: why the result is missing, in the words of its last error or of the system.
  [[nodiscard]] std::string why() const;
  [[nodiscard]] int exit_code() const;  ///< -1: it was killed
  /// It was killed or interrupted.
  [[nodiscard]] bool was_cut_off() const { return exit_code() < 0 || exit_code() > 3; }

 private:
  pid_t pid_ = -1;
  int messages_ = -1, status_ = 0;
  double progress_ = 0;
  std::string unread_, last_error_;
};

}  // namespace talus
