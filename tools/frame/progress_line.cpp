// Progress on standard error: a line on a terminal, lines elsewhere, or JSON objects.
#include "tools/frame/progress_line.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "base/text.hpp"
#include "tools/frame/tool.hpp"

namespace talus {
namespace {

double seconds_between(std::chrono::steady_clock::time_point from,
                       std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

std::string words_on(double left_s) {
  return left_s < 0 ? "" : " (about " + text(left_s, 6) + " s left)";
}

}  // namespace

ProgressForm progress_form(const std::string& asked, bool on_terminal, bool quiet,
                           bool messages_in_json) {
  if (asked == "plain") return ProgressForm::plain;
  if (asked == "json") return ProgressForm::json;
  if (asked == "none" || quiet) return ProgressForm::none;
  if (messages_in_json) return ProgressForm::json;
  return on_terminal ? ProgressForm::in_place : ProgressForm::each_minute;
}

// The end is always said to who asked for lines, so that a bar comes to it.
bool ProgressLine::is_due(double share, double elapsed) const {
  const double since = was_shown_ ? seconds_between(shown_at_, Clock::now()) : elapsed;
  switch (form_) {
    case ProgressForm::in_place:
      return elapsed >= 1 && (since >= 0.2 || share >= 1);
    case ProgressForm::each_minute:
      return since >= 60 && share < 1;
    case ProgressForm::plain:
      return !was_shown_ || since >= 1 || share >= 1;
    case ProgressForm::json:
      return !was_shown_ || since >= 0.5 || share >= 1;
    case ProgressForm::none:
      return false;
  }
  return false;
}

void ProgressLine::show(double share) {
  share = std::clamp(share, 0.0, 1.0);
  const double elapsed = seconds_between(start_, Clock::now());
  if (!is_due(share, elapsed)) return;
  shown_at_ = Clock::now();
  last_share_ = share;
  was_shown_ = true;
  // Before 2 % nothing can be said of the rest.
  const double left_s = share > 0.02 ? std::ceil(elapsed / share * (1 - share)) : -1;
  if (form_ == ProgressForm::in_place)
    print_in_place(share, left_s);
  else if (form_ == ProgressForm::json)
    print_object(share, left_s);
  else
    print_line(share, left_s);
}

void ProgressLine::print_in_place(double share, double left_s) {
  std::string line = label_.empty() ? "" : label_ + ": ";
  for (int mark = 0; mark <= static_cast<int>(share * 40); ++mark)
    line += mark % 4 == 0 ? std::to_string(mark / 4 * 10) : ".";
  std::cerr << "\r\033[K" << line << (share < 1 ? words_on(left_s) : "") << std::flush;
  is_open_ = true;
}

void ProgressLine::print_line(double share, double left_s) const {
  std::cerr << (label_.empty() ? "" : label_ + ": ") << text(std::floor(100 * share), 3) << " %"
            << (share < 1 ? words_on(left_s) : "") << std::endl;
}

void ProgressLine::print_object(double share, double left_s) const {
  Json object;
  if (!label_.empty()) object["label"] = label_;
  object["progress"] = std::floor(1e4 * share) / 1e4;
  if (left_s >= 0) object["eta_s"] = static_cast<long long>(left_s);
  std::cerr << json_text(object) << std::endl;
}

void ProgressLine::end() {
  if (is_open_) std::cerr << '\n';
  is_open_ = false;
}

void ProgressLine::done() {
  if (is_open_) std::cerr << " - done.";
  end();
  const bool is_asked_for = form_ == ProgressForm::plain || form_ == ProgressForm::json;
  if (is_asked_for && last_share_ < 1) show(1);
}

void ProgressLine::restart() { start_ = Clock::now(); }

}  // namespace talus
