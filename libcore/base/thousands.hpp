// libcore/base/thousands.hpp: public
// Whether a point in numbers written as text parts thousands: 1.010 for 1010.
#pragma once

#include <string>

namespace talus {

/// Collects the texts of one column of heights. In doubt: all are whole numbers, or have one digit
/// before a point and three behind it (1.010, 8.848), and there is one of these.
class ThousandsDoubt {
 public:
  void add(const std::string& word);
  [[nodiscard]] bool is_doubtful() const { return !has_other_ && !first_.empty(); }
  /// The first text in doubt.
  [[nodiscard]] const std::string& first() const { return first_; }

 private:
  bool has_other_ = false;
  std::string first_;
};

}  // namespace talus
