// tools/frame/progress_line.hpp
// The line of GDAL's tools on standard error, rewritten in place, with the time left once it can be
// guessed: 0...10...20...30 (about 12 s left). Only for work above a second.
#pragma once

#include <chrono>
#include <string>

namespace talus {

class ProgressLine {
 public:
  /// The line for the share of the work done, 0 to 1; not more often than can be read.
  void show(double share);
  /// The same where no terminal shows it: a line of its own each minute.
  void report(double share);
  /// Ends a line that is open, with these words behind it.
  void end(const char* last_words);
  /// A word before the line, to tell runs apart.
  void label(const std::string& word) { label_ = word; }
  /// New work begins: the time left is guessed from now on.
  void restart();

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double shown_at_ = 0;  ///< since `start_` [s]
  bool is_open_ = false;
  std::string label_;
};

}  // namespace talus
