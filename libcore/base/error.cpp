#include "base/error.hpp"

#include <cstdio>
#include <cstdlib>
#include <utility>

namespace talus {

std::string Where::text() const {
  std::string place = file;
  if (line > 0) place += ":" + std::to_string(line);
  if (!item.empty()) place += place.empty() ? item : ": " + item;
  return place;
}

InputError::InputError(const Where& where, const std::string& finding, std::string hint)
    : std::runtime_error(where.text().empty() ? finding : where.text() + ": " + finding),
      hint_(std::move(hint)) {}

void assertion_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: assertion failed: %s\n", file, line, condition);
  std::abort();
}

}  // namespace talus
