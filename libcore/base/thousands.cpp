// Doubts whether a point in numbers written as text separates thousands: "1.234" for 1234. Only one
// digit before it is doubted, as of heights above 1000 m: coordinates such as 412.345 are rounded
// to millimetres more often. Any other number with a sign in it tells that the point is decimal.
#include "base/thousands.hpp"

namespace talus {
namespace {

bool has_only_digits(const std::string& word) {
  return !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
}

bool may_have_thousands(const std::string& word) {
  return word.size() == 5 && word[0] != '0' && word[1] == '.' &&
         has_only_digits(word.substr(0, 1) + word.substr(2));
}

}  // namespace

void ThousandsDoubt::add(const std::string& word) {
  if (may_have_thousands(word)) {
    if (first_.empty()) first_ = word;
  } else if (!word.empty() && !has_only_digits(word)) {
    has_other_ = true;
  }
}

}  // namespace talus
