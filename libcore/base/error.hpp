// libcore/base/error.hpp: public
// How the library reports errors: unusable input throws InputError with place, finding, expectation
// and remedy; a run that must end throws NumericsError; a broken promise between our own functions
// asserts. The library never prints and never exits.
#pragma once

#include <stdexcept>
#include <string>

#include "base/doubt.hpp"

namespace talus {

/// The input cannot be used (exit code 1).
class InputError : public std::runtime_error {
 public:
  /// `finding` says what was found and what was expected; `hint` is a remedy (may be empty).
  InputError(const Where& where, const std::string& finding, std::string hint = {});
  explicit InputError(Doubt doubt);
  [[nodiscard]] const Doubt& doubt() const { return doubt_; }
  [[nodiscard]] const std::string& hint() const { return doubt_.hint; }

 private:
  Doubt doubt_;
};

/// The numbers failed: a limit of the run's health was broken (exit code 3).
class NumericsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The user interrupted; results that could be kept have been kept (exit code 130).
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);

}  // namespace talus

#ifdef NDEBUG
#define TALUS_ASSERT(condition) static_cast<void>(0)
#else
/// A promise between our own functions; on in every preset but release.
#define TALUS_ASSERT(condition) \
  static_cast<void>((condition) || (::talus::assertion_failed(#condition, __FILE__, __LINE__), 0))
#endif
