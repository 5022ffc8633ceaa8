// tools/frame/progress_line.hpp
// How much of the work is done, on standard error: the line of GDAL's tools on a terminal,
// rewritten in place (0...10...20...30 (about 12 s left), only for work above a second), lines of
// their own elsewhere, or an object a line for a program that shows it.
#pragma once

#include <chrono>
#include <string>

namespace talus {

/// How it is said: in place on a terminal; a line a minute; a line a second; an object a line.
enum class ProgressForm { in_place, each_minute, plain, json, none };

/// Of --progress (auto, plain, json, none); a form that is asked for is used with -q, too.
[[nodiscard]] ProgressForm progress_form(const std::string& asked, bool on_terminal, bool quiet,
                                         bool messages_in_json);

class ProgressLine {
 public:
  void form(ProgressForm form) { form_ = form; }
  /// The line for the share of the work done, 0 to 1; not more often than can be read.
  void show(double share);
  /// Ends a line that is open, e.g. before other words.
  void end();
  /// All is done: who asked for lines is told so, also by a tool that does one thing only.
  void done();
  /// A word before the line, to tell runs apart.
  void label(const std::string& word) { label_ = word; }
  /// New work begins: the time left is guessed from now on.
  void restart();

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] bool is_due(double share, double elapsed) const;
  void print_in_place(double share, double left_s);
  void print_line(double share, double left_s) const;
  void print_object(double share, double left_s) const;

  ProgressForm form_ = ProgressForm::none;
  Clock::time_point start_ = Clock::now();  ///< of this work
  Clock::time_point shown_at_ = start_;
  bool was_shown_ = false;  ///< a line of this work, or of one before
  double last_share_ = 0;
  bool is_open_ = false;
  std::string label_;
};

}  // namespace talus
