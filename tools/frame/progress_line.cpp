#include "tools/frame/progress_line.hpp"

#include <cmath>
#include <iostream>

#include "base/text.hpp"

namespace talus {

void ProgressLine::show(double share) {
  const double elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (elapsed < 1 || (elapsed - shown_at_ < 0.2 && share < 1)) return;
  shown_at_ = elapsed;
  std::string line = label_.empty() ? "" : label_ + ": ";
  for (int mark = 0; mark <= static_cast<int>(share * 40); ++mark)
    line += mark % 4 == 0 ? std::to_string(mark / 4 * 10) : ".";
  if (share > 0.02 && share < 1)
    line += " (about " + text(std::ceil(elapsed / share * (1 - share)), 6) + " s left)";
  std::cerr << "\r\033[K" << line << std::flush;
  is_open_ = true;
}

void ProgressLine::report(double share) {
  constexpr double interval_s = 60;
  const double elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (elapsed - shown_at_ < interval_s || share >= 1) return;
  shown_at_ = elapsed;
  std::cerr << (label_.empty() ? "" : label_ + ": ") << text(std::round(100 * share)) << " %";
  if (share > 0.02)
    std::cerr << " (about " << text(std::ceil(elapsed / share * (1 - share)), 6) << " s left)";
  std::cerr << std::endl;
}

void ProgressLine::end(const char* last_words) {
  if (is_open_) std::cerr << last_words << '\n';
  is_open_ = false;
}

void ProgressLine::restart() {
  start_ = std::chrono::steady_clock::now();
  shown_at_ = 0;
}

}  // namespace talus
