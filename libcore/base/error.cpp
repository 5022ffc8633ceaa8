// Texts of errors and failed assertions.
#include "base/error.hpp"

#include <cstdio>
#include <cstdlib>
#include <utility>

namespace talus {

InputError::InputError(Doubt doubt)
    : std::runtime_error(sentence_on(doubt)), doubt_(std::move(doubt)) {
  doubt_.state = DoubtState::refused;
}

InputError::InputError(const Where& where, const std::string& finding, std::string hint)
    : InputError(doubt_on(where, finding, std::move(hint))) {}

void assertion_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: assertion failed: %s\n", file, line, condition);
  std::abort();
}

}  // namespace talus
